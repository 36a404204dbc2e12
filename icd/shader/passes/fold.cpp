#include "shader/passes/fold.h"

#include <algorithm>
#include <cstring>
#include <new>

namespace lapilli {

ConstantFolder::ConstantFolder(SimdTarget target) : target_(target) { new (memory_) Frame; }

uint32_t ConstantFolder::run(Opcode op, uint32_t a, uint32_t b, uint32_t c) {
  Frame* const frame = std::launder(reinterpret_cast<Frame*>(memory_));
  frame->exec = ~uint64_t{0};
  const uint32_t operands[] = {a, b, c};
  uint32_t lanes[kBatchLanes];
  for (size_t i = 0; i < 3; ++i) {
    std::fill_n(lanes, kBatchLanes, operands[i]);
    std::memcpy(frame->registers() + (i + 1) * kRegisterBytes, lanes, sizeof lanes);
  }
  const Op program[] = {{find_handler(target_, op, kStore), 0, 1, 2, 3, 0, 0},
                        {find_handler(target_, Opcode::end, kStore), 0, 0, 0, 0, 0, 0}};
  interpreter_run(target_)(program, frame);
  uint32_t result;
  std::memcpy(&result, frame->registers(), sizeof result);
  return result;
}

}  // namespace lapilli
