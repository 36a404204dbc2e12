// The values follow C's Annex F where it knows the function, and the specification's formula elsewhere.
#include "precision/edges.h"

#include <cmath>
#include <limits>

namespace lapilli::precision {

std::span<const Edge> edges() {
  constexpr float kInf = INFINITY, kNaN = NAN, kMax = std::numeric_limits<float>::max();
  constexpr float kSmallest = 0x1p-149f;
  static const std::vector<Edge> all = {
      {"pow(0, 0)", 55, {0, 0}, {1}},
      {"pow(-0, -1)", 55, {-0.0f, -1}, {-kInf}},
      {"pow(-1, 2)", 55, {-1, 2}, {1}},
      {"pow(-1, 3)", 55, {-1, 3}, {-1}},
      {"pow(-2, 0.5)", 55, {-2, 0.5f}, {kNaN}},
      {"pow(NaN, 0)", 55, {kNaN, 0}, {1}},
      {"pow(2, 128)", 55, {2, 128}, {kInf}},
      {"pow(2, -149)", 55, {2, -149}, {kSmallest}},
      {"atan(0, 0)", 56, {0, 0}, {0}},
      {"atan(0, -0)", 56, {0, -0.0f}, {3.14159274f}},
      {"atan(Inf, -Inf)", 56, {kInf, -kInf}, {2.35619449f}},
      {"mod(-1, 3)", 57, {-1, 3}, {2}},
      {"mod(1e30, 3)", 57, {1e30f, 3}, {float(std::fmod(double(1e30f), 3.0))}},
      {"mod(1, 0)", 57, {1, 0}, {kNaN}},
      {"1.0 / 0", 27, {0}, {kInf}},
      {"1.0 / -0", 27, {-0.0f}, {-kInf}},
      {"1.0 / 2^-149", 27, {kSmallest}, {kInf}},
      {"sqrt(-1)", 16, {-1}, {kNaN}},
      {"sqrt(-0)", 16, {-0.0f}, {-0.0f}},
      {"inversesqrt(0)", 17, {0}, {kInf}},
      {"inversesqrt(Inf)", 17, {kInf}, {0}},
      {"log(0)", 14, {0}, {-kInf}},
      {"log2(2^-149)", 15, {kSmallest}, {-149}},
      {"log(-1)", 14, {-1}, {kNaN}},
      {"exp(-Inf)", 12, {-kInf}, {0}},
      {"exp(89)", 12, {89}, {kInf}},
      {"sin(Inf)", 0, {kInf}, {kNaN}},
      {"sin(-0)", 0, {-0.0f}, {-0.0f}},
      {"asin(1.5)", 3, {1.5f}, {kNaN}},
      {"tanh(Inf)", 8, {kInf}, {1}},
      {"atanh(1)", 11, {1}, {kInf}},
      {"floor(-0)", 18, {-0.0f}, {-0.0f}},
      {"int(NaN)", 28, {kNaN}, {0}},
      {"int(1e30)", 28, {1e30f}, {2147483648.0f}},
      {"length(1e30, 1e30)", 61, {1e30f, 1e30f}, {kInf}},
      {"length(1e-30, 0)", 61, {1e-30f, 0}, {0}},
      {"distance from (max, 0, 0) to (-max, 0, 0)", 64, {kMax, 0, 0, -kMax, 0, 0}, {kInf}},
      {"normalize(0, 0, 0)", 67, {0, 0, 0}, {kNaN, kNaN, kNaN}},
      {"smoothstep(0, 0, 1)", 60, {0, 0, 1}, {1}},
      {"mix(1, 2, Inf)", 59, {1, 2, kInf}, {kNaN}},
      {"refract, total reflection", 69, {1, 0, 0, 0, 1, 0, 2}, {0, 0, 0}},
      {"inverse of a singular mat2", 74, {1, 2, 2, 4}, {kInf, -kInf, -kInf, kInf}},
  };
  return all;
}

}  // namespace lapilli::precision
