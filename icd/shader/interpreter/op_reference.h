// What the equations of ops.def mean, one lane at a time, for tests. Written with the C math library and plain
// integers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shader/ir.h"

namespace lapilli {

struct OpReference {
  using Exact = uint32_t (*)(uint32_t a, uint32_t b, uint32_t c);
  using Real = double (*)(double a, double b);

  Opcode op;
  Exact exact = nullptr;  // bits of the result, or
  Real real = nullptr;    // its value, of which `ulp` is the largest error
  double ulp = 0;
  bool float_result = true;                                       // a NaN has no particular bits
  bool (*defined)(uint32_t a, uint32_t b, uint32_t c) = nullptr;  // null: everywhere
};

// All pure ops.
std::span<const OpReference> op_references();
const OpReference* find_reference(Opcode op);

// Zeros, ones, denormals, infinities, NaN, limits of conversions; INT_MIN, shift counts …
std::span<const uint32_t> edge_values();

bool is_nan_bits(uint32_t bits);

}  // namespace lapilli
