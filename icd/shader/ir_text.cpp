// Text of a Code, one instruction a line: %4 value, $4 variable, &4 uniform, 0x3f800000 constant, m2 mask register, L3
// label.
#include <cinttypes>

#include "base/text.h"
#include "shader/ir.h"

namespace lapilli {
namespace {

void print_register(std::string& text, const Code& code, Reg reg) {
  if (reg == kNoReg) {
    text += "none";
  } else if (reg >= code.registers.size()) {
    append_format(text, "?%" PRIu32, reg);
  } else if (code.registers[reg].kind == RegKind::constant) {
    append_format(text, "0x%08" PRIx32, code.registers[reg].bits);
  } else {
    const RegKind kind = code.registers[reg].kind;
    append_format(text, "%c%" PRIu32, kind == RegKind::variable ? '$' : kind == RegKind::uniform ? '&' : '%', reg);
  }
}

void print_imm(std::string& text, ImmRole role, uint32_t imm) {
  switch (role) {
    case ImmRole::none:
      return;
    case ImmRole::mask:
      append_format(text, " m%" PRIu32, imm);
      return;
    case ImmRole::forward:
    case ImmRole::backward:
      append_format(text, " L%" PRIu32, imm);
      return;
    case ImmRole::array:
      append_format(text, " array%" PRIu32, imm);
      return;
    case ImmRole::resource:
      append_format(text, " resource%" PRIu32, imm);
      return;
    case ImmRole::bytes:
      append_format(text, " +%" PRIu32, imm);
      return;
    default:
      append_format(text, " #%" PRIu32, imm);
      return;
  }
}

void print_instruction(std::string& text, const Code& code, const Instruction& instruction) {
  if (instruction.results > 0) {
    print_register(text, code, instruction.dst);
    if (instruction.results > 1) {
      text += " .. ";
      print_register(text, code, instruction.dst + instruction.results - 1u);
    }
    text += " = ";
  }
  text += op_info(instruction.op).name;
  for (Reg reg : {instruction.a, instruction.b, instruction.c}) {
    if (reg == kNoReg) continue;
    text += ' ';
    print_register(text, code, reg);
  }
  const ImmRoles roles = imm_roles(instruction.op);
  print_imm(text, roles.imm, instruction.imm);
  print_imm(text, roles.imm2, instruction.imm2);
  if (instruction.list_count > 0) {
    text += " (";
    for (uint32_t i = 0; i < instruction.list_count; ++i) {
      if (i > 0) text += ' ';
      print_register(text, code, code.operand_list[instruction.list_first + i]);
    }
    text += ')';
  }
  if (instruction.line != 0) append_format(text, "  // line %" PRIu32, instruction.line);
}

}  // namespace

std::string disassemble(const Code& code) {
  std::string text;
  for (const Instruction& instruction : code.once) {
    text += " once  ";
    print_instruction(text, code, instruction);
    text += '\n';
  }
  for (uint32_t at = 0; at <= code.instructions.size(); ++at) {
    for (size_t label = 0; label < code.labels.size(); ++label) {
      if (code.labels[label] == at) append_format(text, "L%zu:\n", label);
    }
    if (at == code.instructions.size()) break;
    append_format(text, "%5" PRIu32 "  ", at);
    print_instruction(text, code, code.instructions[at]);
    text += '\n';
  }
  return text;
}

}  // namespace lapilli
