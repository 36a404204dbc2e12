// Decoding and encoding of texels on one vector of lanes, instantiated for each line of formats.def.
// Per-target header, like base/lanes-inl.h. Specification: "Conversion from Normalized Fixed-Point to Floating-Point"
// and back.
#if defined(LAPILLI_IMAGE_TEXEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LAPILLI_IMAGE_TEXEL_INL_H
#undef LAPILLI_IMAGE_TEXEL_INL_H
#else
#define LAPILLI_IMAGE_TEXEL_INL_H
#endif

#include "base/lanes-inl.h"
#include "base/lanes_gather-inl.h"
#include "image/format.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {

// 1/255 as two floats. The upper one has 9 bits, so that its product with a code is exact and the sum below is rounded
// once: code / 255 bit for bit, for all 256 codes.
inline constexpr float kUpper255th = 0x1.01p-8f;
inline constexpr float kLower255th = 0x1.010102p-24f;

// The integers 0 … 255 as floats.
HWY_API F unorm8_to_float(F code) { return fma_exact(code, broadcast(kUpper255th), code * broadcast(kLower255th)); }
// Any number of them, such as a filtered one; the error is below 1 ULP, and integers give what unorm8_to_float gives.
HWY_API F unorm8_between_to_float(F code) { return fma(code, broadcast(kUpper255th), code * broadcast(kLower255th)); }

// To an integer in [0, largest].
HWY_API U float_to_unorm(F value, float largest) {
  const F clamped = min(max(zero_f(), value), broadcast(1.0f));  // max(0, NaN) is 0
  return as_u(nearest_in_range(clamped * broadcast(largest)));
}

// To an integer in [-largest, largest].
HWY_API I float_to_snorm(F value, float largest) {
  const F number = select(is_nan(value), zero_f(), value);
  return nearest_in_range(min(max(number, broadcast(-1.0f)), broadcast(1.0f)) * broadcast(largest));
}

// An unsigned float of 5 bits of exponent and 6 or 5 of mantissa: the upper bits of a half, rounded from it to nearest
// even. What is negative becomes 0, what is finite stays finite.
template <int kBits>
HWY_API U to_small_float(F value) {
  constexpr int dropped = 15 - kBits;
  const U half = to_half(select(lt(value, zero_f()), zero_f(), value)) & broadcast(0x7FFFu);
  const U odd = shift_right<dropped>(half) & broadcast(1u);
  const U rounded = shift_right<dropped>(half + broadcast((1u << (dropped - 1)) - 1) + odd);
  const U largest = broadcast((31u << (kBits - 5)) - 1);
  return select(is_finite(value), min(rounded, largest), rounded);
}

template <size_t kBytes>
HWY_API U gather_bytes(const std::byte* base, U byte_offsets, M m) {
  alignas(64) uint32_t lanes[kVectorLanes];
  store(byte_offsets, lanes);
  const uint64_t live = bits_of(m);
  for (int lane = 0; lane < kVectorLanes; ++lane) {
    const uint32_t offset = lanes[lane];
    lanes[lane] = 0;
    if ((live >> lane & 1) != 0) __builtin_memcpy(&lanes[lane], base + offset, kBytes);
  }
  return load<U>(lanes);
}

// The same for a whole texel, from byte 0 on: to integers, of which the packing drops what is below 0.
HWY_API I float_to_unorm8(F value) {
  return nearest_in_range(min(value * broadcast(255.0f), broadcast(255.0f)));  // a NaN becomes INT_MIN
}
HWY_API U pack_unorm8(F c0, F c1, F c2, F c3) {
  return pack_bytes(float_to_unorm8(c0), float_to_unorm8(c1), float_to_unorm8(c2), float_to_unorm8(c3));
}

// The same for numbers that are in [-2, 2] anyway.
HWY_API U pack_near_unorm8(F c0, F c1, F c2, F c3) {
  const F codes = broadcast(255.0f);
  return pack_bytes(nearest_in_range(c0 * codes), nearest_in_range(c1 * codes), nearest_in_range(c2 * codes),
                    nearest_in_range(c3 * codes));
}

template <size_t kFormat>
struct Texel {
  static constexpr const FormatInfo& kInfo = kFormats[kFormat];
  static constexpr bool kIsSmall = kInfo.texel_size < 4;  // the lowest bytes of a word
  static constexpr size_t kWords = kIsSmall ? 1 : kInfo.texel_size / 4;
  static_assert((kIsSmall || kInfo.texel_size % 4 == 0) && kWords <= 4,
                "texels are whole 32-bit words or less than one");

  static constexpr ComponentLayout component(int c) { return kInfo.components[static_cast<size_t>(c)]; }
  static constexpr size_t word_of(int c) { return component(c).first_bit / 32; }
  static constexpr int shift_of(int c) { return component(c).first_bit % 32; }
  static constexpr uint32_t mask_of_bits(int c) { return 0xFFFFFFFFu >> (32 - component(c).bits); }
  static constexpr bool is_normalized(int c) {
    return component(c).kind == ComponentKind::unorm || component(c).kind == ComponentKind::snorm;
  }
  // The code of 1.
  static constexpr float largest(int c) {
    return static_cast<float>(component(c).kind == ComponentKind::snorm ? mask_of_bits(c) >> 1 : mask_of_bits(c));
  }

  // All colour components are UNORM of 8 bits: filters then work on the codes and divide once, at the end.
  static constexpr bool kFiltersCodes = [] {
    for (const ComponentLayout& c : kInfo.components) {
      if (c.kind != ComponentKind::unorm || c.bits != 8) return false;
    }
    return true;
  }();

  // The bits of component c, from bit 0 on.
  template <int c>
  HWY_API U field(const U* words) {
    static_assert(shift_of(c) + component(c).bits <= 32, "a component lies in one word");
    U bits = words[word_of(c)];
    if constexpr (shift_of(c) != 0) bits = shift_right<shift_of(c)>(bits);
    if constexpr (shift_of(c) + component(c).bits < 32) bits = bits & broadcast(mask_of_bits(c));
    return bits;
  }

  // UNORM and SNORM as the code, the others as decode().
  template <int c>
  HWY_API F decode_code(const U* words) {
    constexpr ComponentLayout layout = component(c);
    if constexpr (layout.kind == ComponentKind::none) {
      return c < 3 ? zero_f() : kInfo.is_integer() ? as_f(broadcast(1u)) : broadcast(1.0f);
    } else if constexpr (layout.kind == ComponentKind::unorm) {
      static_assert(layout.bits <= 16);
      if constexpr (kFiltersCodes) return to_float(as_i(byte_of<shift_of(c) / 8>(words[0])));
      return to_float(as_i(field<c>(words)));
    } else if constexpr ((layout.kind == ComponentKind::sint || layout.kind == ComponentKind::snorm) &&
                         layout.bits < 32) {
      constexpr int unused = 32 - layout.bits;
      const I code = shift_right<unused>(as_i(shift_left<unused>(field<c>(words))));
      return layout.kind == ComponentKind::snorm ? to_float(code) : as_f(code);
    } else if constexpr (layout.kind == ComponentKind::sfloat && layout.bits == 16) {
      return from_half(field<c>(words));
    } else if constexpr (layout.kind == ComponentKind::ufloat) {
      return from_half(shift_left<15 - layout.bits>(field<c>(words)));
    } else {
      static_assert(layout.kind != ComponentKind::sfloat || layout.bits == 32);
      return as_f(field<c>(words));
    }
  }

  // `code` from decode_code().
  template <int c>
  HWY_API F finish_code(F code) {
    constexpr ComponentLayout layout = component(c);
    if constexpr (!is_normalized(c)) {
      return code;
    } else if constexpr (layout.kind == ComponentKind::snorm) {
      return max(code / broadcast(largest(c)), broadcast(-1.0f));
    } else if constexpr (layout.bits == 8) {
      return unorm8_to_float(code);
    } else {
      return code / broadcast(largest(c));
    }
  }

  // The component that byte kByte of a texel of bytes holds.
  static constexpr int component_of_byte(int byte) {
    for (int c = 0; c < 4; ++c) {
      if (shift_of(c) == 8 * byte) return c;
    }
    return 0;
  }

  HWY_API void decode(const U* words, F* rgba) {
    if constexpr (kFiltersCodes) {
      rgba[0] = byte_over_255<shift_of(0) / 8>(words[0]);
      rgba[1] = byte_over_255<shift_of(1) / 8>(words[0]);
      rgba[2] = byte_over_255<shift_of(2) / 8>(words[0]);
      rgba[3] = byte_over_255<shift_of(3) / 8>(words[0]);
      return;
    }
    rgba[0] = finish_code<0>(decode_code<0>(words));
    rgba[1] = finish_code<1>(decode_code<1>(words));
    rgba[2] = finish_code<2>(decode_code<2>(words));
    rgba[3] = finish_code<3>(decode_code<3>(words));
  }

  template <int c>
  HWY_API void encode_component(F value, U* words) {
    constexpr ComponentLayout layout = component(c);
    if constexpr (layout.kind != ComponentKind::none) {
      U bits = as_u(value);
      if constexpr (layout.kind == ComponentKind::unorm) bits = float_to_unorm(value, largest(c));
      if constexpr (layout.kind == ComponentKind::snorm) bits = as_u(float_to_snorm(value, largest(c)));
      if constexpr (layout.kind == ComponentKind::sfloat && layout.bits == 32) bits = as_u(canonical(value));
      if constexpr (layout.kind == ComponentKind::sfloat && layout.bits == 16) bits = to_half(value);
      if constexpr (layout.kind == ComponentKind::ufloat) bits = to_small_float<layout.bits>(value);
      if constexpr (layout.bits < 32 && layout.kind != ComponentKind::unorm) bits = bits & broadcast(mask_of_bits(c));
      if constexpr (shift_of(c) != 0) bits = shift_left<shift_of(c)>(bits);
      words[word_of(c)] = words[word_of(c)] | bits;
    }
  }

  HWY_API void encode(const F* rgba, U* words) {
    if constexpr (kFiltersCodes) {
      words[0] = pack_unorm8(rgba[component_of_byte(0)], rgba[component_of_byte(1)], rgba[component_of_byte(2)],
                             rgba[component_of_byte(3)]);
      return;
    }
    for (size_t word = 0; word < kWords; ++word) words[word] = zero_u();
    encode_component<0>(rgba[0], words);
    encode_component<1>(rgba[1], words);
    encode_component<2>(rgba[2], words);
    encode_component<3>(rgba[3], words);
  }

  // `base` + byte offsets; 0 where m is not set.
  HWY_API void gather(const std::byte* base, U byte_offsets, M m, U* words) {
    if constexpr (kIsSmall) {
      words[0] = gather_bytes<kInfo.texel_size>(base, byte_offsets, m);
    } else if constexpr (kWords == 1) {
      words[0] = gather32(base, byte_offsets, m);
    } else {
      gather_words<kWords>(base, byte_offsets, m, words);
    }
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#endif  // per target
