// What is behind the type Program: ops with their handlers, and the tables that they need.
#pragma once

#include <vector>

#include "image/texel.h"
#include "shader/interpreter/op.h"
#include "shader/program.h"

namespace lapilli {

struct Program {
  uint64_t id = 0;  // never used twice
  SimdTarget target = SimdTarget::kBaseline;
  Code source;
  std::vector<uint8_t> forms;  // of source.instructions, which are the ops one to one
  std::vector<Op> ops;
  std::vector<uint16_t> lists;
  std::vector<Op> once;                // source.once, then `end`
  std::vector<uint32_t> constants;     // the first scalars
  std::vector<Spread> constant_lanes;  // registers that hold a constant
  std::vector<Spread> uniform_lanes;   // registers that hold a result of `once`
  uint32_t scalar_count = 0;
  bool once_reads_batch = false;  // blend constants
  std::vector<Attribute> attributes;
  std::vector<const TexelFunctions*> colors;
  std::vector<BlendEquation> blends;
  const TexelFunctions* depth = nullptr;
  const SamplingFunctions* sampling = nullptr;
  uint32_t register_count = 0;
  uint32_t frames = 1;  // batches of a workgroup that may wait at a barrier at once
  uint32_t once_cost = 0, lane_cost = 0;
};

}  // namespace lapilli
