// Folding of constants by the op's own handler, so that a folded result has the bits of a computed one by construction.
#pragma once

#include "base/fp_environment.h"
#include "shader/interpreter/op.h"

namespace lapilli {

class ConstantFolder {
 public:
  explicit ConstantFolder(SimdTarget target);
  // The result of a pure op of up to three operands, given as bits.
  uint32_t run(Opcode op, uint32_t a, uint32_t b, uint32_t c);

 private:
  static constexpr uint32_t kRegisters = 4;

  const SimdTarget target_;
  const FpEnvironment environment_;
  alignas(64) std::byte memory_[sizeof(Frame) + kRegisters * kRegisterBytes];
};

}  // namespace lapilli
