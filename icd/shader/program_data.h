// What is behind the type Program: ops with their handlers, and the tables that they need.
#pragma once

#include <vector>

#include "shader/interpreter/op.h"
#include "shader/program.h"

namespace lapilli {

struct Program {
  struct Constant {
    uint16_t reg;
    uint32_t bits;
  };

  uint64_t id = 0;  // never used twice
  SimdTarget target = SimdTarget::kBaseline;
  Code source;
  std::vector<uint8_t> forms;  // of source.instructions, which are the ops one to one
  std::vector<Op> ops;
  std::vector<uint16_t> lists;
  std::vector<Constant> constants;
  std::vector<Attribute> attributes;
  std::vector<const TexelFunctions*> colors;
  const TexelFunctions* depth = nullptr;
  const SamplingFunctions* sampling = nullptr;
  uint32_t register_count = 0;
};

}  // namespace lapilli
