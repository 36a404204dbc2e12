// The rare cases of lane_math that are worked out one lane at a time, in integers: the same bits everywhere.
#pragma once

#include <cstdint>

namespace lapilli {

// angle = quadrant · π/2 + r + tail, |r| ≤ π/4, correct to 24 bits of r and more by the tail; for angle ≥ 2^6, NaN or ∞
// (r and tail are NaN then). Returns the quadrant modulo 4. (Payne and Hanek's method.)
std::uint32_t reduce_large_angle(float angle, float* r, float* tail);

// The exact remainder of |x| / |y| with the sign of x; x finite, y finite and not 0.
float exact_remainder(float x, float y);

}  // namespace lapilli
