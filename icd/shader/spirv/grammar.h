// Names and operands of SPIR-V instructions, generated from the machine-readable grammar (grammar.py).
// Specification: SPIR-V, chapters "Binary Form" and "Instructions".
#pragma once

#include <cstdint>
#include <string>

namespace lapilli {

struct SpirvOpInfo {
  uint32_t opcode;
  const char* name;  // "OpFAdd"
  // One letter for each operand, ? or * behind it: t result type, r result, i id, l literal word, s string, n literal
  // number, x image operands, m memory access, e a mode with its literals, p id pairs, P literal and id, q id and
  // literal, o the opcode of OpSpecConstantOp and its operands.
  const char* signature;
};
const SpirvOpInfo* find_spirv_op(uint32_t opcode);  // null: no such instruction

enum class SpirvEnum : uint8_t {
  BuiltIn,
  Capability,
  Decoration,
  Dim,
  ExecutionMode,
  ExecutionModel,
  ExtInst,
  ImageOperands,
  StorageClass
};
std::string spirv_enum_name(SpirvEnum kind, uint32_t value);  // "Capability 4711" if it has no name

enum class OperandKind : uint8_t { type, result, id, literal };

namespace detail {
constexpr uint32_t kMemoryAligned = 2, kMemoryMakeAvailable = 8, kMemoryMakeVisible = 16;

// The word after a string that starts at `at`; 0 if it has no end.
inline uint32_t skip_string(const uint32_t* words, uint32_t count, uint32_t at) {
  for (; at < count; ++at) {
    const uint32_t w = words[at];
    if ((w & 0xFF) == 0 || (w & 0xFF00) == 0 || (w & 0xFF0000) == 0 || (w & 0xFF000000) == 0) return at + 1;
  }
  return 0;
}

// Reads one operand; the next word, or 0 if words are missing. The caller sees to it that there is at least one.
template <class Visit>
uint32_t walk_operand(char letter, const uint32_t* words, uint32_t count, uint32_t at, Visit& visit) {
  const auto one = [&](OperandKind kind) {
    if (at == 0 || at >= count) {
      at = 0;
    } else {
      visit(kind, at++);
    }
  };
  switch (letter) {
    case 't':
      one(OperandKind::type);
      return at;
    case 'r':
      one(OperandKind::result);
      return at;
    case 'i':
      one(OperandKind::id);
      return at;
    case 's':
      return skip_string(words, count, at);
    case 'n':
    case 'e':
      while (at < count) one(OperandKind::literal);
      return at;
    case 'x':
      one(OperandKind::literal);
      while (at < count) one(OperandKind::id);
      return at;
    case 'm': {
      const uint32_t mask = words[at];
      one(OperandKind::literal);
      if (mask & kMemoryAligned) one(OperandKind::literal);
      if (mask & kMemoryMakeAvailable) one(OperandKind::id);
      if (mask & kMemoryMakeVisible) one(OperandKind::id);
      return at;
    }
    case 'p':
      one(OperandKind::id);
      one(OperandKind::id);
      return at;
    case 'P':
      one(OperandKind::literal);
      one(OperandKind::id);
      return at;
    case 'q':
      one(OperandKind::id);
      one(OperandKind::literal);
      return at;
    default:
      one(OperandKind::literal);
      return at;
  }
}
}  // namespace detail

// Calls visit(OperandKind, word index) for each operand word but strings. False: words are missing or left over.
template <class Visit>
bool walk_operands(const char* signature, const uint32_t* words, uint32_t count, uint32_t at, Visit&& visit) {
  for (const char* s = signature; *s != 0; ++s) {
    const char quantifier = s[1] == '?' || s[1] == '*' ? s[1] : '\0';
    if (*s == 'o') {
      if (at >= count) return false;
      const SpirvOpInfo* inner = find_spirv_op(words[at]);
      if (inner == nullptr || inner->signature[0] != 't' || inner->signature[1] != 'r') return false;
      visit(OperandKind::literal, at);
      for (const char* i = inner->signature; *i != 0; ++i) {
        if (*i == 'o') return false;
      }
      return walk_operands(inner->signature + 2, words, count, at + 1, visit);
    }
    if (quantifier == 0 && at >= count) return false;
    while (at < count) {
      at = detail::walk_operand(*s, words, count, at, visit);
      if (at == 0) return false;
      if (quantifier != '*') break;
    }
    if (quantifier != 0) ++s;
  }
  return at == count;
}

}  // namespace lapilli
