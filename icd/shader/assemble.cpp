// From a Code to a Program: passes, registers, handlers.
#include <algorithm>
#include <atomic>
#include <cassert>
#include <cinttypes>
#include <cstdio>

#include "base/text.h"
#include "image/format.h"
#include "image/sampling.h"
#include "image/texel.h"
#include "shader/fixed_function.h"
#include "shader/passes/passes.h"
#include "shader/program_data.h"

namespace lapilli {
namespace {

// Rounds of a loop, or batches, between two looks at the clock are the immediate of `end`: fewer in a long program.
constexpr uint32_t kCostPerLook = 1 << 20;  // about 2 ms, see ops.def

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
    if (Result<void> done = place_scalars(); !done) return done;
    make_once();
    for (const Instruction& instruction : code_.instructions) {
      if (instruction.op == Opcode::barrier) program_.frames = (code_.invocations() - 1) / kBatchLanes + 1;
    }
    program_.ops.reserve(code_.instructions.size());
    for (uint32_t i = 0; i < code_.instructions.size(); ++i) program_.ops.push_back(make_op(i));
    program_.ops.back().imm = std::clamp(kCostPerLook / (program_.lane_cost + 1), 1u, kLoopsPerClockRead);
    if (program_.lists.size() > kNoOperand)
      return error("the shader has too many operand lists", program_.lists.size());
    return {};
  }

 private:
  // Constants first, each where lanes or the once section read it.
  Result<void> place_scalars() {
    scalars_.assign(code_.registers.size(), kNoOperand);
    for (const Instruction& instruction : code_.once) {
      for_each_operand(code_, instruction, [this](Reg reg) { place_constant(reg); });
    }
    for (Reg reg = 0; reg < code_.registers.size(); ++reg) {
      if (allocation_.physical[reg] != kNoOperand) place_constant(reg);
    }
    uint32_t count = static_cast<uint32_t>(program_.constants.size());
    for (const Instruction& instruction : code_.once) {
      for (uint32_t k = 0; k < instruction.results; ++k) scalars_[instruction.dst + k] = static_cast<uint16_t>(count++);
    }
    if (count > kNoOperand) return error("the shader has too many constants", count);
    program_.scalar_count = count;
    for (Reg reg = 0; reg < code_.registers.size(); ++reg) {
      const uint16_t lanes = allocation_.physical[reg];
      if (scalars_[reg] == kNoOperand || lanes == kNoOperand) continue;
      const bool constant = code_.registers[reg].kind == RegKind::constant;
      (constant ? program_.constant_lanes : program_.uniform_lanes).push_back({lanes, scalars_[reg]});
    }
    return {};
  }

  void place_constant(Reg reg) {
    if (code_.registers[reg].kind != RegKind::constant || scalars_[reg] != kNoOperand) return;
    scalars_[reg] = static_cast<uint16_t>(program_.constants.size());
    program_.constants.push_back(code_.registers[reg].bits);
  }

  uint16_t scalar(Reg reg) const { return reg == kNoReg ? kNoOperand : scalars_[reg]; }

  void make_once() {
    if (code_.once.empty()) return;
    program_.once.reserve(code_.once.size() + 1);
    for (const Instruction& instruction : code_.once) {
      Op op = {};
      op.handler = find_handler(program_.target, instruction.op, kOnce);
      op.dst = scalar(instruction.dst);
      op.a = scalar(instruction.a);
      op.b = scalar(instruction.b);
      op.c = op_info(instruction.op).results < 0 ? instruction.results : scalar(instruction.c);
      op.imm = instruction.imm;
      op.imm2 = instruction.imm2;
      program_.once.push_back(op);
      program_.once_reads_batch |= instruction.op == Opcode::builtin;
      program_.once_cost += op_info(instruction.op).cost;
    }
    Op end = {};
    end.handler = find_handler(program_.target, Opcode::end, kStore);
    program_.once.push_back(end);
  }

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
    program_.lane_cost += op_info(instruction.op).cost;
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
    if (instruction.op == Opcode::blend_color) {
      op.imm2 = static_cast<uint32_t>(program_.blends.size());
      program_.blends.push_back(blend_equation(instruction.imm2));
    }
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
  std::vector<uint16_t> scalars_;  // places in Frame::scalars, for each virtual register
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
  if (dumps_passes()) std::fprintf(stderr, "--- program\n%s", disassemble(*program).c_str());
  return program;
}

uint32_t register_count(const Program& program) { return program.register_count; }
uint32_t once_cost(const Program& program) { return program.once_cost; }
uint32_t lane_cost(const Program& program) { return program.lane_cost; }
const Code& source(const Program& program) { return program.source; }

namespace {

// r: registers, s: scalars. `at`: the op's place, for labels.
void print_op(std::string& text, const Program& program, const Instruction& instruction, const Op& op, uint8_t form,
              uint32_t at) {
  const char file = form == kOnce ? 's' : 'r';
  if (instruction.results > 0) {
    if (form == kOnce || (form & kStore) != 0) {
      append_format(text, "%c%u = ", file, unsigned{op.dst});
    } else {
      text += "acc = ";
    }
  }
  text += op_info(instruction.op).name;
  const Reg operands[] = {instruction.a, instruction.b, instruction.c};
  const uint16_t registers[] = {op.a, op.b, op.c};
  for (int operand = 0; operand < 3; ++operand) {
    if (operands[operand] == kNoReg) continue;
    if (form != kOnce && form >> 1 == operand + 1) {
      text += " acc";
    } else {
      append_format(text, " %c%u", file, unsigned{registers[operand]});
    }
  }
  for (uint32_t k = 0; k < instruction.list_count; ++k) {
    const uint16_t reg = program.lists[op.a + k];
    append_format(text, reg == kNoOperand ? " none" : " r%u", unsigned{reg});
  }
  const ImmRoles roles = imm_roles(instruction.op);
  const uint32_t imms[] = {op.imm, op.imm2};
  const ImmRole role[] = {roles.imm, roles.imm2};
  for (int k = 0; k < 2; ++k) {
    if (role[k] == ImmRole::none) continue;
    if (role[k] == ImmRole::forward || role[k] == ImmRole::backward) {
      append_format(text, " -> %" PRIu32, at + imms[k]);
    } else {
      append_format(text, role[k] == ImmRole::mask ? " m%" PRIu32 : " #%" PRIu32, imms[k]);
    }
  }
  text += '\n';
}

}  // namespace

std::string disassemble(const Program& program) {
  std::string text;
  for (size_t i = 0; i < program.source.once.size(); ++i) {
    text += " once  ";
    print_op(text, program, program.source.once[i], program.once[i], kOnce, 0);
  }
  for (const Spread& each : program.uniform_lanes)
    append_format(text, " once  r%u = s%u\n", unsigned{each.reg}, unsigned{each.scalar});
  for (uint32_t i = 0; i < program.ops.size(); ++i) {
    append_format(text, "%5" PRIu32 "  ", i);
    print_op(text, program, program.source.instructions[i], program.ops[i], program.forms[i], i);
  }
  return text;
}

}  // namespace lapilli
