// A plain evaluator of Code for tests: no passes, no registers shared, one lane at a time. The oracle of random
// programs.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "shader/ir.h"

namespace lapilli {

using LaneValues = std::array<uint32_t, 64>;

struct EvaluationInput {
  uint64_t lanes = ~uint64_t{0};
  std::vector<std::byte> push_constants;
  std::vector<std::byte> buffer;  // of every resource; written in place
};

// Output slots of a program of pure ops, arrays, control flow, load_push, load_buffer, store_buffer and lane_index.
// Throws nothing; an op that it does not know, or more than `limit` steps, give an empty result.
std::vector<LaneValues> evaluate(const Code& code, EvaluationInput& input, uint64_t limit = 1000000);

}  // namespace lapilli
