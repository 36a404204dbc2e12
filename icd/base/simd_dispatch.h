// Which SIMD target the process runs on, and how code compiled once per target is picked.
// The pattern for per-target code is in simd_targets.h and lanes-inl.h.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace lapilli {

// From the narrowest to the widest. The baseline is SSE2 on x86-64 and NEON on aarch64.
enum class SimdTarget { kBaseline, kAvx2, kAvx3 };
inline constexpr std::size_t kSimdTargetCount = 3;

// "sse2" (or "neon"), "avx2", "avx3": the values of LAPILLI_SIMD.
const char* simd_target_name(SimdTarget target);
std::optional<SimdTarget> simd_target_of_name(std::string_view name);

// What this machine and the operating system can run; the baseline comes first.
bool simd_target_supported(SimdTarget target);
std::vector<SimdTarget> supported_simd_targets();
SimdTarget best_simd_target();

// The chosen one, for the whole process: the best at first. Programs built earlier keep what they were built for, so
// that it may change while others draw. Setting an unsupported target changes nothing and returns false.
SimdTarget simd_target();
bool set_simd_target(SimdTarget target);

// One value for each target, indexed by SimdTarget; nullptr where the target is not compiled.
template <class T>
using PerTarget = std::array<T*, kSimdTargetCount>;

// T may be an object or a function.
template <class T>
T& for_target(const PerTarget<T>& table, SimdTarget target) {
  return *table[static_cast<std::size_t>(target)];
}
template <class T>
T& for_target(const PerTarget<T>& table) {
  return for_target(table, simd_target());
}

}  // namespace lapilli
