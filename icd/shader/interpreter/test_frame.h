// A frame with a few registers and a list of ops, for tests of single handlers.
#pragma once

#include <array>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

#include "shader/interpreter/op.h"

namespace lapilli {

class TestFrame {
 public:
  explicit TestFrame(SimdTarget target) : target_(target) {
    new (memory_.bytes) Frame;
    frame().exec = frame().write = frame().lanes = ~uint64_t{0};
  }

  Frame& frame() { return *std::launder(reinterpret_cast<Frame*>(memory_.bytes)); }

  void write(uint32_t reg, const std::array<uint32_t, kBatchLanes>& lanes) {
    std::memcpy(frame().registers() + reg * kRegisterBytes, lanes.data(), kRegisterBytes);
  }
  void read(uint32_t reg, std::array<uint32_t, kBatchLanes>& lanes) {
    std::memcpy(lanes.data(), frame().registers() + reg * kRegisterBytes, kRegisterBytes);
  }

  void add(Opcode op, uint32_t form, Op operands) {
    operands.handler = find_handler(target_, op, form);
    ops_.push_back(operands);
  }
  void add(Opcode op, uint32_t form, uint16_t dst, uint16_t a) {
    Op operands = {};
    operands.dst = dst;
    operands.a = a;
    add(op, form, operands);
  }
  // Calls `then` with the first op when the run has ended.
  template <class Then>
  void run(Then&& then) {
    add(Opcode::end, kStore, Op{});
    interpreter_run(target_)(ops_.data(), &frame());
    then(ops_.data());
    ops_.clear();
  }
  void run() {
    run([](const Op*) {});
  }

 private:
  static constexpr uint32_t kRegisters = 16;
  struct alignas(64) Memory {
    std::byte bytes[sizeof(Frame) + kRegisters * kRegisterBytes];
  };

  SimdTarget target_;
  Memory memory_;
  std::vector<Op> ops_;
};

}  // namespace lapilli
