// The passes that turn a Code into what the interpreter runs well. Each is a function over the whole program; all of
// them keep what `verify` checks, and take time that grows with the length of the program only.
#pragma once

#include <cstdint>
#include <vector>

#include "shader/ir.h"

namespace lapilli {

// Where instruction operands come from and results go (Form, interpreter/op.h), one for each instruction; and which
// registers are in memory at all. Swaps operands of ops that commute.
struct FormChoice {
  std::vector<uint8_t> forms;
  std::vector<uint8_t> in_memory;  // for each virtual register
};
FormChoice choose_forms(Code& code);

// Physical registers of the virtual ones; kNoOperand for those that are not in memory.
struct Allocation {
  std::vector<uint16_t> physical;
  uint32_t count = 0;  // above kMaxRegisters: the program does not fit
};
Allocation allocate_registers(const Code& code, const FormChoice& choice);

}  // namespace lapilli
