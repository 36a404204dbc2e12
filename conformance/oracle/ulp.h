// Errors in units in the last place of float32.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace lapilli::oracle {

// The distance of neighbouring float32 around |value|: 2^(e - 23), at least the smallest denormal.
inline double ulp(double value) {
  constexpr uint64_t kExponent = uint64_t{0x7FF} << 52;
  const double power = std::bit_cast<double>(std::bit_cast<uint64_t>(value) & kExponent);  // 2^e
  return std::max(power, double(std::numeric_limits<float>::min())) * 0x1p-23;
}

// |got - want| in ULP of want. A result that rounds to infinity, and one that is infinite, agree.
inline double ulp_error(float got, double want) {
  if (std::isnan(got) || std::isnan(want)) return std::isnan(got) && std::isnan(want) ? 0 : INFINITY;
  if (double(got) == want || got == float(want)) return 0;
  if (std::isinf(got) || std::isinf(want)) {
    // The largest finite value's neighbour would be 2^128.
    const double limit = std::ldexp(1.0, 128);
    const double finite_got = std::isinf(got) ? std::copysign(limit, double(got)) : double(got);
    const double finite_want = std::isinf(want) ? std::copysign(limit, want) : want;
    return std::abs(finite_got - finite_want) / std::ldexp(1.0, 104);
  }
  return std::abs(double(got) - want) / ulp(want);
}

}  // namespace lapilli::oracle
