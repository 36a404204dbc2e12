// Run-time choice of the SIMD target.
#include "base/simd_dispatch.h"

#include <atomic>

namespace lapilli {
namespace {

#if defined(__x86_64__)
constexpr std::array<const char*, kSimdTargetCount> kNames = {"sse2", "avx2", "avx3"};

// Everything that Highway lets the compiler use for HWY_AVX2 and HWY_AVX3.
bool machine_has(SimdTarget target) {
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") &&
                    __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("aes") &&
                    __builtin_cpu_supports("pclmul") && __builtin_cpu_supports("sse4.2");
  const bool avx3 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                    __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
  switch (target) {
    case SimdTarget::kBaseline:
      return true;
    case SimdTarget::kAvx2:
      return avx2;
    case SimdTarget::kAvx3:
      return avx3;
  }
  return false;
}
#else
constexpr std::array<const char*, kSimdTargetCount> kNames = {"neon", "avx2", "avx3"};

bool machine_has(SimdTarget target) { return target == SimdTarget::kBaseline; }
#endif

constexpr int kNotChosen = -1;
std::atomic<int> chosen{kNotChosen};

}  // namespace

const char* simd_target_name(SimdTarget target) { return kNames[static_cast<std::size_t>(target)]; }

std::optional<SimdTarget> simd_target_of_name(std::string_view name) {
  for (std::size_t i = 0; i < kSimdTargetCount; ++i) {
    if (name == kNames[i]) return static_cast<SimdTarget>(i);
  }
  return std::nullopt;
}

bool simd_target_supported(SimdTarget target) { return machine_has(target); }

std::vector<SimdTarget> supported_simd_targets() {
  std::vector<SimdTarget> targets;
  for (std::size_t i = 0; i < kSimdTargetCount; ++i) {
    const auto target = static_cast<SimdTarget>(i);
    if (machine_has(target)) targets.push_back(target);
  }
  return targets;
}

SimdTarget best_simd_target() {
  if (machine_has(SimdTarget::kAvx3)) return SimdTarget::kAvx3;
  return machine_has(SimdTarget::kAvx2) ? SimdTarget::kAvx2 : SimdTarget::kBaseline;
}

SimdTarget simd_target() {
  const int target = chosen.load(std::memory_order_relaxed);
  return target == kNotChosen ? best_simd_target() : static_cast<SimdTarget>(target);
}

bool set_simd_target(SimdTarget target) {
  if (!machine_has(target)) return false;
  chosen.store(static_cast<int>(target), std::memory_order_relaxed);
  return true;
}

}  // namespace lapilli
