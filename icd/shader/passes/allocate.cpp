// Register allocation: virtual registers to places in the frame.
#include "shader/interpreter/op.h"
#include "shader/passes/passes.h"

namespace lapilli {

Allocation allocate_registers(const Code& code, const FormChoice& choice) {
  Allocation allocation;
  allocation.physical.assign(code.registers.size(), kNoOperand);
  for (Reg reg = 0; reg < code.registers.size(); ++reg) {
    if (choice.in_memory[reg] != 0) allocation.physical[reg] = static_cast<uint16_t>(allocation.count++);
  }
  return allocation;
}

}  // namespace lapilli
