// From a Code to a Program: passes, registers, handlers.
#include <algorithm>
#include <atomic>
#include <cassert>
#include <cinttypes>
#include <cstdio>

#include "image/format.h"
#include "image/sampling.h"
#include "image/texel.h"
#include "shader/passes/passes.h"
#include "shader/program_data.h"

namespace lapilli {
namespace {

Error error(const char* what, uint64_t number) {
  return {VK_ERROR_UNKNOWN, std::string(what) + " (" + std::to_string(number) + ")"};
}

class Assembler {
 public:
  explicit Assembler(Program& program) : program_(program), code_(program.source) {}

  Result<void> run() {
    if (Result<void> done = resolve_formats(); !done) return done;
    optimize(code_, program_.target);
    assert(verify(code_).empty());
    FormChoice choice = choose_forms(code_);
    allocation_ = allocate_registers(code_, choice);
    if (allocation_.count > kMaxRegisters) return error("the shader needs too many registers", allocation_.count);
    program_.register_count = allocation_.count;
    program_.forms = std::move(choice.forms);
    for (Reg reg = 0; reg < code_.registers.size(); ++reg) {
      if (code_.registers[reg].kind == RegKind::constant && allocation_.physical[reg] != kNoOperand) {
        program_.constants.push_back({allocation_.physical[reg], code_.registers[reg].bits});
      }
    }
    program_.ops.reserve(code_.instructions.size());
    for (uint32_t i = 0; i < code_.instructions.size(); ++i) program_.ops.push_back(make_op(i));
    if (program_.lists.size() > kNoOperand)
      return error("the shader has too many operand lists", program_.lists.size());
    return {};
  }

 private:
  Result<void> resolve_formats() {
    program_.sampling = &sampling_functions(program_.target);
    program_.depth = &texel_functions(kFormats[static_cast<size_t>(FormatIndex::D32_SFLOAT)], program_.target);
    for (const VertexAttribute& attribute : code_.attributes) {
      const FormatInfo* const format = find_format(attribute.format);
      if (format == nullptr || !format->has(kVertex))
        return error("vertex attribute of an unsupported format", attribute.format);
      if (attribute.binding >= kMaxVertexBindings) return error("no such vertex binding", attribute.binding);
      program_.attributes.push_back(
          {attribute.binding, attribute.offset, format->texel_size, &texel_functions(*format, program_.target)});
    }
    for (VkFormat color : code_.color_formats) {
      const FormatInfo* const format = find_format(color);
      const bool unused = color == VK_FORMAT_UNDEFINED;
      if (!unused && (format == nullptr || !format->has(kColorTarget)))
        return error("colour attachment of an unsupported format", color);
      program_.colors.push_back(unused ? nullptr : &texel_functions(*format, program_.target));
    }
    return {};
  }

  uint16_t physical(Reg reg) const { return reg == kNoReg ? kNoOperand : allocation_.physical[reg]; }

  uint32_t distance(uint32_t from, uint32_t label) const {
    return static_cast<uint32_t>(static_cast<int32_t>(code_.labels[label]) - static_cast<int32_t>(from));
  }

  uint32_t immediate(ImmRole role, uint32_t imm, uint32_t at) const {
    const bool label = role == ImmRole::forward || role == ImmRole::backward;
    return label ? distance(at, imm) : role == ImmRole::array ? code_.arrays[imm].count : imm;
  }

  Op make_op(uint32_t at) {
    const Instruction& instruction = code_.instructions[at];
    const ImmRoles roles = imm_roles(instruction.op);
    Op op = {};
    op.handler = find_handler(program_.target, instruction.op, program_.forms[at]);
    assert(op.handler != nullptr);
    op.dst = physical(instruction.dst);
    op.a = physical(instruction.a);
    op.b = physical(instruction.b);
    op.c = physical(instruction.c);
    op.imm = immediate(roles.imm, instruction.imm, at);
    op.imm2 = immediate(roles.imm2, instruction.imm2, at);
    if (instruction.op == Opcode::load_array) op.b = physical(code_.arrays[instruction.imm].first);
    if (instruction.op == Opcode::store_array) op.c = physical(code_.arrays[instruction.imm].first);
    if (op_info(instruction.op).results < 0) op.c = instruction.results;
    if (instruction.list_count > 0) {
      op.a = static_cast<uint16_t>(program_.lists.size());
      for (uint32_t i = 0; i < instruction.list_count; ++i) {
        program_.lists.push_back(physical(code_.operand_list[instruction.list_first + i]));
      }
    }
    return op;
  }

  Program& program_;
  Code& code_;
  Allocation allocation_;
};

}  // namespace

void ProgramDeleter::operator()(Program* program) const { delete program; }

Result<ProgramPtr> assemble(Code code) {
  static std::atomic<uint64_t> next_id{1};
  // What the reader made of SPIR-V that it should have refused must not run.
  if (const std::string defect = verify(code); !defect.empty()) return Error{VK_ERROR_UNKNOWN, "internal: " + defect};
  ProgramPtr program(new Program);
  program->id = next_id.fetch_add(1, std::memory_order_relaxed);
  program->target = simd_target();
  program->source = std::move(code);
  Assembler assembler(*program);
  if (Result<void> done = assembler.run(); !done) return done.error();
  return program;
}

uint32_t register_count(const Program& program) { return program.register_count; }
const Code& source(const Program& program) { return program.source; }

std::string disassemble(const Program& program) {
  std::string text;
  char line[160];
  for (size_t i = 0; i < program.ops.size(); ++i) {
    const Op& op = program.ops[i];
    const Instruction& instruction = program.source.instructions[i];
    const uint8_t form = program.forms[i];
    std::snprintf(line, sizeof line, "%5zu  ", i);
    text += line;
    if (instruction.results > 0) {
      std::snprintf(line, sizeof line, (form & kStore) != 0 ? "r%u = " : "acc = ", unsigned{op.dst});
      text += line;
    }
    text += op_info(instruction.op).name;
    const Reg operands[] = {instruction.a, instruction.b, instruction.c};
    const uint16_t registers[] = {op.a, op.b, op.c};
    for (int operand = 0; operand < 3; ++operand) {
      if (operands[operand] == kNoReg) continue;
      const bool accumulator = (form >> 1) == operand + 1;
      std::snprintf(line, sizeof line, accumulator ? " acc" : " r%u", unsigned{registers[operand]});
      text += line;
    }
    for (uint32_t k = 0; k < instruction.list_count; ++k) {
      const uint16_t reg = program.lists[op.a + k];
      std::snprintf(line, sizeof line, reg == kNoOperand ? " none" : " r%u", unsigned{reg});
      text += line;
    }
    const ImmRoles roles = imm_roles(instruction.op);
    const uint32_t imms[] = {op.imm, op.imm2};
    const ImmRole role[] = {roles.imm, roles.imm2};
    for (int k = 0; k < 2; ++k) {
      if (role[k] == ImmRole::none) continue;
      const bool label = role[k] == ImmRole::forward || role[k] == ImmRole::backward;
      const uint32_t shown = label ? static_cast<uint32_t>(i) + imms[k] : imms[k];
      std::snprintf(line, sizeof line,
                    label                      ? " -> %" PRIu32
                    : role[k] == ImmRole::mask ? " m%" PRIu32
                                               : " #%" PRIu32,
                    shown);
      text += line;
    }
    text += '\n';
  }
  return text;
}

}  // namespace lapilli
