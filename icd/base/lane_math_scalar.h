// The rare cases of lane_math that are worked out one lane at a time, in integers: the same bits everywhere.
#pragma once

#include <cstdint>

namespace lapilli {

// Reduction of large angles by Payne and Hanek's method, for angle ≥ 64, infinite or NaN (r and tail are NaN then).
// |angle| + quarter_turns · π/2 = k π + r with |r| ≤ π/2, r rounded to nearest give or take little; returns k modulo 2.
std::uint32_t reduce_to_half_turn(float angle, std::uint32_t quarter_turns, float* r);
// |angle| = k · π/2 + r + tail with |r| ≤ π/4; returns k modulo 4.
std::uint32_t reduce_to_quadrant(float angle, float* r, float* tail);

// The exact remainder of |x| / |y| with the sign of x; x finite, y finite and not 0.
float exact_remainder(float x, float y);

}  // namespace lapilli
