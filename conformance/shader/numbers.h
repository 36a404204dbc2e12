// Operands for the arithmetic tests: special values in all combinations, and random ones of all magnitudes.
#pragma once

#include <cstdint>
#include <vector>

#include "harness/compute.h"

namespace lapilli::conformance {

struct FloatOperands {
  std::vector<float> a, b, c;
};
// Any bit patterns (NaN, infinities, denormals included) and moderate numbers.
FloatOperands float_operands(uint32_t seed);
// Values in [low, high], the ends and special values inside of it included, dense near 0.
std::vector<float> floats_between(uint32_t seed, float low, float high, size_t count);

struct IntOperands {
  std::vector<uint32_t> a, b, c;
};
IntOperands int_operands(uint32_t seed);

// Runs operation `op` of a shader with three inputs and one output (float_basic.comp and its like).
template <typename T>
std::vector<T> run_op(const samples::Context& context, std::span<const uint32_t> shader, int op,
                      const std::vector<T>& a, const std::vector<T>& b, const std::vector<T>& c) {
  ComputeRun run;
  run.shader = shader;
  run.buffers = {to_bytes(a), to_bytes(b), to_bytes(c), Bytes(a.size() * sizeof(T))};
  run.groups[0] = uint32_t((a.size() + 63) / 64);
  run.push_constants = to_bytes(std::vector<int>{op});
  return from_bytes<T>(run_compute(context, run)[3]);
}

}  // namespace lapilli::conformance
