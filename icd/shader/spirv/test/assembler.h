// A module in pieces that tests change, and what the reader says of it.
#pragma once

#include <functional>
#include <span>

#include "shader/spirv/module.h"
#include "shader/spirv/test/run_shader.h"

namespace lapilli {

// A compute shader that does nothing, in pieces that tests change. Ids up to kFree are taken.
enum Ids : uint32_t { kVoid = 1, kFunctionType, kMain, kEntryLabel, kUint, kFloat, kOne, kFree };

struct Assembler {
  std::vector<uint32_t> head, interface, annotations, globals, body, functions;
  uint32_t version = 0x00010000, bound = 100;

  static void add(std::vector<uint32_t>& to, spv::Op op, std::span<const uint32_t> operands) {
    to.push_back(static_cast<uint32_t>(op) | static_cast<uint32_t>(operands.size() + 1) << 16);
    to.insert(to.end(), operands.begin(), operands.end());
  }

  static void add(std::vector<uint32_t>& to, spv::Op op, std::initializer_list<uint32_t> operands) {
    add(to, op, std::span(operands.begin(), operands.size()));
  }

  Assembler() {
    add(head, spv::Op::OpCapability, {static_cast<uint32_t>(spv::Capability::Shader)});
    add(globals, spv::Op::OpTypeVoid, {kVoid});
    add(globals, spv::Op::OpTypeFunction, {kFunctionType, kVoid});
    add(globals, spv::Op::OpTypeInt, {kUint, 32, 0});
    add(globals, spv::Op::OpTypeFloat, {kFloat, 32});
    add(globals, spv::Op::OpConstant, {kUint, kOne, 1});
  }

  std::vector<uint32_t> words() const {
    std::vector<uint32_t> all{spv::MagicNumber, version, 0, bound, 0};
    const auto append = [&](const std::vector<uint32_t>& part) { all.insert(all.end(), part.begin(), part.end()); };
    append(head);
    add(all, spv::Op::OpMemoryModel, {0, 1});
    const size_t entry = all.size();
    add(all, spv::Op::OpEntryPoint,
        {static_cast<uint32_t>(spv::ExecutionModel::GLCompute), kMain, 0x6E69616D, 0});  // "main"
    append(interface);
    all[entry] += static_cast<uint32_t>(interface.size()) << 16;
    add(all, spv::Op::OpExecutionMode, {kMain, static_cast<uint32_t>(spv::ExecutionMode::LocalSize), 1, 1, 1});
    append(annotations);
    append(globals);
    add(all, spv::Op::OpFunction, {kVoid, kMain, 0, kFunctionType});
    add(all, spv::Op::OpLabel, {kEntryLabel});
    append(body);
    add(all, spv::Op::OpReturn, {});
    add(all, spv::Op::OpFunctionEnd, {});
    append(functions);
    return all;
  }
};

inline std::string outcome(const std::vector<uint32_t>& words, std::string_view entry = "main") {
  Result<std::shared_ptr<const SpirvModule>> module = parse_spirv(words);
  if (!module) {
    EXPECT_EQ(module.error().code, VK_ERROR_UNKNOWN);
    return module.error().message;
  }
  const Result<Code> code = make_compute_code({*module, entry, {}}, {});
  EXPECT_TRUE(code.ok() || code.error().code == VK_ERROR_UNKNOWN);
  return code.ok() ? verify(*code) : code.error().message;
}

inline std::string outcome_of(const std::function<void(Assembler&)>& change) {
  Assembler assembler;
  change(assembler);
  return outcome(assembler.words());
}

}  // namespace lapilli
