// The SIMD targets that Lapilli is compiled for. Include before any header of Highway.
// x86-64: AVX3 (AVX-512 F/VL/DQ/BW), AVX2 with FMA, and the baseline, SSE2. aarch64: NEON.
#pragma once

#if defined(HWY_DISABLED_TARGETS) || defined(HIGHWAY_HWY_DETECT_TARGETS_H_)
#error "base/simd_targets.h must come before Highway's headers"
#endif

// Highway 1.0.3 has no SSE2 target of its own: its fallback is HWY_SCALAR, for which
// lanes_sse2-inl.h supplies the vectors. EMU128 would be the fallback of clang but not of g++ 12
// (whose version miscompiles it); one fallback for both keeps the namespaces the same.
#define HWY_BROKEN_EMU128 1
#if defined(__x86_64__)
// Also where the compiler was told of a better machine (-march): all three tables always exist.
#define HWY_BASELINE_TARGETS HWY_SCALAR
#endif
#define HWY_DISABLED_TARGETS \
  (HWY_AVX3_DL | HWY_SSE4 | HWY_SSSE3 | HWY_SVE2_128 | HWY_SVE_256 | HWY_SVE2 | HWY_SVE | HWY_PPC8)

// What selects a member of each compiled target, in the order of SimdTarget (simd_dispatch.h). Use it after the last
// HWY_AFTER_NAMESPACE(), inside namespace lapilli and `#if HWY_ONCE`:
//   constexpr PerTarget<OpTable> kTables = LAPILLI_PER_TARGET(op_table);
//   const OpTable& table = for_target(kTables);
#if defined(__x86_64__)
#define LAPILLI_PER_TARGET(name) \
  { &N_SCALAR::name, &N_AVX2::name, &N_AVX3::name }
#else
#define LAPILLI_PER_TARGET(name) \
  { &N_NEON::name, nullptr, nullptr }
#endif
