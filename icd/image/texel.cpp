// The load and store functions of every format, for every SIMD target.
#include "image/texel.h"

#include <array>
#include <bit>
#include <cstring>
#include <utility>

#include "base/simd_targets.h"
#include "image/tile.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "image/texel.cpp"
#include <hwy/foreach_target.h>

#include "image/texel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
namespace {

constexpr int kQuads = kLanes / 4;

// The words of a batch's texels, word by word: word w of lane i is word[w][i].
template <size_t kWords>
struct BatchWords {
  alignas(64) uint32_t word[kWords][kLanes];
};

template <size_t kWords>
void read_quads(const std::byte* plane, const QuadPlaces& places, uint64_t lanes, BatchWords<kWords>& words) {
  static constexpr std::byte kDeadQuad[16 * kWords] = {};
  const uint64_t live = live_quads(lanes);
  const void* quads[kQuads];
  for (int quad = 0; quad < kQuads; ++quad) {
    const std::byte* const texels = plane + places.quad[quad] * 16 * kWords;
    quads[quad] = (live >> (quad * 4) & 1) != 0 ? texels : kDeadQuad;
  }
  if constexpr (kWords == 1) {
    for (int i = 0; i < kLanes; i += kVectorLanes) store(load_quads(quads + i / 4), &words.word[0][i]);
  } else {
    for (int quad = 0; quad < kQuads; ++quad) {
      const std::byte* texel = static_cast<const std::byte*>(quads[quad]);
      for (int lane = quad * 4; lane < quad * 4 + 4; ++lane) {
        for (size_t w = 0; w < kWords; ++w, texel += 4) std::memcpy(&words.word[w][lane], texel, 4);
      }
    }
  }
}

template <size_t kWords>
void write_quads(const BatchWords<kWords>& words, std::byte* plane, const QuadPlaces& places, uint64_t lanes) {
  constexpr size_t quad_bytes = 16 * kWords;
  for (int quad = 0; quad < kQuads; ++quad) {
    const uint32_t quad_lanes = lanes >> (quad * 4) & 15;
    if (quad_lanes == 0) continue;
    std::byte* texels = plane + places.quad[quad] * quad_bytes;
    if constexpr (kWords == 1) {
      store_quad(&words.word[0][quad * 4], quad_lanes, texels);
      continue;
    }
    for (int lane = 0; lane < 4; ++lane, texels += 4 * kWords) {
      if ((quad_lanes >> lane & 1) == 0) continue;
      for (size_t w = 0; w < kWords; ++w) std::memcpy(texels + 4 * w, &words.word[w][quad * 4 + lane], 4);
    }
  }
}

HWY_API void store_components(const F* rgba, int vector, float* const registers[4]) {
  const int first = vector * kVectorLanes;
  if (registers[0] != nullptr) store(rgba[0], registers[0] + first);
  if (registers[1] != nullptr) store(rgba[1], registers[1] + first);
  if (registers[2] != nullptr) store(rgba[2], registers[2] + first);
  if (registers[3] != nullptr) store(rgba[3], registers[3] + first);
}

// Vector `vector` of a whole block, whose first texel is `block`.
template <size_t kWords, class Byte>
HWY_API Byte* vector_of_block(Byte* block, int vector) {
  return block + static_cast<size_t>(vector * kVectorLanes) * 4 * kWords;
}

template <size_t kFormat>
void load_quads(const std::byte* plane, const QuadPlaces& places, uint64_t lanes, float* const registers[4]) {
  using T = Texel<kFormat>;
  BatchWords<T::kWords> words;
  if (!places.whole_block) read_quads<T::kWords>(plane, places, lanes, words);
  const std::byte* const block = plane + places.quad[0] * 16 * T::kWords;
  for (int vector = 0; vector < kVectorsPerBatch; ++vector) {
    U texel[T::kWords];
    if (places.whole_block) {
      load_interleaved<T::kWords>(vector_of_block<T::kWords>(block, vector), texel);
    } else {
      for (size_t w = 0; w < T::kWords; ++w) texel[w] = load<U>(&words.word[w][vector * kVectorLanes]);
    }
    F rgba[4];
    T::decode(texel, rgba);
    store_components(rgba, vector, registers);
  }
}

// The bits of the texel that belong to a set of components.
template <class T>
struct ComponentBits {
  uint32_t word[T::kWords] = {};
  bool all = true;
};
template <class T>
constexpr std::array<ComponentBits<T>, 16> kComponentBits = [] {
  std::array<ComponentBits<T>, 16> table{};
  for (uint32_t components = 0; components < 16; ++components) {
    ComponentBits<T>& bits = table[components];
    for (int c = 0; c < 4; ++c) {
      if (T::component(c).bits == 0) continue;
      if ((components >> c & 1) != 0) {
        bits.word[T::word_of(c)] |= T::mask_of_bits(c) << T::shift_of(c);
      } else {
        bits.all = false;
      }
    }
  }
  return table;
}();

// Takes the bits of the written components from the new words, the others from the texels that are there.
template <size_t kWords>
HWY_API void keep_other_components(const BatchWords<kWords>& old, const uint32_t* bits, BatchWords<kWords>& words) {
  for (size_t w = 0; w < kWords; ++w) {
    const U taken = broadcast(bits[w]);
    for (int lane = 0; lane < kLanes; lane += kVectorLanes) {
      const U mixed = (load<U>(&words.word[w][lane]) & taken) | and_not(taken, load<U>(&old.word[w][lane]));
      store(mixed, &words.word[w][lane]);
    }
  }
}

// The registers of a colour. Those that the format or the mask does not ask for may be null: 0.
alignas(64) constexpr float kZeros[kLanes] = {};
struct Color {
  const float* component[4];

  HWY_INLINE explicit Color(const float* const registers[4]) {
    for (int c = 0; c < 4; ++c) component[c] = registers[c] != nullptr ? registers[c] : kZeros;
  }
  template <int c>
  HWY_INLINE F load_component(int vector) const {
    return load<F>(component[c] + vector * kVectorLanes);
  }
};

// (Loops over components stay loops at -O2, and vectors go through memory.)
template <class T>
HWY_API void encode_vector(const Color& color, int vector, U* texel) {
  const F rgba[4] = {color.load_component<0>(vector), color.load_component<1>(vector), color.load_component<2>(vector),
                     color.load_component<3>(vector)};
  T::encode(rgba, texel);
}

template <class T>
void store_block(std::byte* block, uint64_t lanes, const Color& color, const ComponentBits<T>& bits) {
  const bool everything = bits.all && lanes == ~uint64_t{0};
  for (int vector = 0; vector < kVectorsPerBatch; ++vector) {
    std::byte* const texels = vector_of_block<T::kWords>(block, vector);
    U texel[T::kWords];
    encode_vector<T>(color, vector, texel);
    if (!everything) {
      const U written = mask_to_u(mask_of(lanes, vector));
      U old[T::kWords];
      load_interleaved<T::kWords>(texels, old);
      for (size_t w = 0; w < T::kWords; ++w) {
        const U taken = written & broadcast(bits.word[w]);
        texel[w] = (texel[w] & taken) | and_not(taken, old[w]);
      }
    }
    store_interleaved<T::kWords>(texel, texels);
  }
}

template <size_t kFormat>
void store_quads(std::byte* plane, const QuadPlaces& places, uint64_t lanes, const float* const registers[4],
                 uint32_t components) {
  using T = Texel<kFormat>;
  const ComponentBits<T>& bits = kComponentBits<T>[components & 15];
  const Color color(registers);
  if (places.whole_block) return store_block<T>(plane + places.quad[0] * 16 * T::kWords, lanes, color, bits);
  BatchWords<T::kWords> words;
  for (int vector = 0; vector < kVectorsPerBatch; ++vector) {
    U texel[T::kWords];
    encode_vector<T>(color, vector, texel);
    for (size_t w = 0; w < T::kWords; ++w) store(texel[w], &words.word[w][vector * kVectorLanes]);
  }
  if (!bits.all) {
    BatchWords<T::kWords> old;
    read_quads<T::kWords>(plane, places, lanes, old);
    keep_other_components(old, bits.word, words);
  }
  write_quads<T::kWords>(words, plane, places, lanes);
}

// A source colour, clamped; a NaN becomes 0. kSame: R G B are those of the first vector.
template <bool kSame>
struct ClampedColor {
  const Color& color;
  F same[3];
  HWY_INLINE explicit ClampedColor(const Color& from) : color(from) {
    if constexpr (kSame) {
      same[0] = clamp01(from.load_component<0>(0));
      same[1] = clamp01(from.load_component<1>(0));
      same[2] = clamp01(from.load_component<2>(0));
    }
  }
  template <int c>
  HWY_INLINE F component(int vector) const {
    if constexpr (kSame && c < 3) return same[c];
    return clamp01(color.load_component<c>(vector));
  }
  static HWY_INLINE F clamp01(F x) { return min(max(zero_f(), x), broadcast(1.0f)); }
};

// A blend equation in vectors.
struct VectorFactor {
  F slope, offset;
  HWY_INLINE VectorFactor(const BlendEquation::Factor& f, float scale)
      : slope(broadcast(f.slope * scale)), offset(broadcast(f.offset * scale)) {}
  HWY_INLINE F of(F alpha) const { return fma_exact(alpha, slope, offset); }
};
// The destination keeps its scale until it is multiplied by a factor, which has the inverse: that changes no bit, but
// for factors below 2^-94, whose products are too small for a code. kOver: BlendEquation::over.
template <bool kOver>
struct Blender {
  VectorFactor source_color, source_alpha, destination_color, destination_alpha;
  HWY_INLINE explicit Blender(const BlendEquation& e)
      : source_color(e.source[0], 1),
        source_alpha(e.source[1], 1),
        destination_color(e.destination[0], kByteScale),
        destination_alpha(e.destination[1], kByteScale) {}

  template <class T, class Source>
  HWY_INLINE U blend(const Source& color, int vector, U old) const {
    const F d[4] = {scaled_byte_over_255<T::shift_of(0) / 8>(old), scaled_byte_over_255<T::shift_of(1) / 8>(old),
                    scaled_byte_over_255<T::shift_of(2) / 8>(old), scaled_byte_over_255<T::shift_of(3) / 8>(old)};
    const F alpha = color.template component<3>(vector);
    const F by = kOver ? alpha : source_color.of(alpha);
    const F destination_by = destination_color.of(alpha);
    const F destination_alpha_by = kOver ? destination_by : destination_alpha.of(alpha);
    const F source_by_alpha = kOver ? alpha : alpha * source_alpha.of(alpha);
    const F result[4] = {fma(d[0], destination_by, color.template component<0>(vector) * by),
                         fma(d[1], destination_by, color.template component<1>(vector) * by),
                         fma(d[2], destination_by, color.template component<2>(vector) * by),
                         fma(d[3], destination_alpha_by, source_by_alpha)};
    return pack_near_unorm8(result[T::component_of_byte(0)], result[T::component_of_byte(1)],
                            result[T::component_of_byte(2)], result[T::component_of_byte(3)]);
  }
};

template <class T, class Source, bool kOver>
void blend_block(std::byte* block, uint64_t lanes, const Source& source, const Blender<kOver>& blender,
                 const ComponentBits<T>& bits) {
  const bool everything = bits.all && lanes == ~uint64_t{0};
  for (int vector = 0; vector < kVectorsPerBatch; ++vector) {
    std::byte* const texels = vector_of_block<1>(block, vector);
    const U old = load_unaligned<U>(texels);
    U texel = blender.template blend<T>(source, vector, old);
    if (!everything) {
      const U taken = mask_to_u(mask_of(lanes, vector)) & broadcast(bits.word[0]);
      texel = (texel & taken) | and_not(taken, old);
    }
    store_unaligned(texel, texels);
  }
}

template <class T, bool kOver>
void blend_whole(std::byte* block, uint64_t lanes, const Color& color, const BlendEquation& equation,
                 const ComponentBits<T>& bits) {
  const Blender<kOver> blender(equation);
  equation.same_color ? blend_block<T>(block, lanes, ClampedColor<true>(color), blender, bits)
                      : blend_block<T>(block, lanes, ClampedColor<false>(color), blender, bits);
}

template <size_t kFormat>
void blend_quads(std::byte* plane, const QuadPlaces& places, uint64_t lanes, const float* const source[4],
                 const BlendEquation& equation) {
  using T = Texel<kFormat>;
  const ComponentBits<T>& bits = kComponentBits<T>[equation.components & 15];
  const Color color(source);
  if (places.whole_block) {
    std::byte* const block = plane + places.quad[0] * 16;
    return equation.over ? blend_whole<T, true>(block, lanes, color, equation, bits)
                         : blend_whole<T, false>(block, lanes, color, equation, bits);
  }
  const Blender<false> blender(equation);
  const ClampedColor<false> clamped(color);
  BatchWords<1> old, words;
  read_quads<1>(plane, places, lanes, old);
  for (int vector = 0; vector < kVectorsPerBatch; ++vector) {
    const int first = vector * kVectorLanes;
    store(blender.blend<T>(clamped, vector, load<U>(&old.word[0][first])), &words.word[0][first]);
  }
  if (!bits.all) keep_other_components(old, bits.word, words);
  write_quads<1>(words, plane, places, lanes);
}

template <size_t kFormat>
constexpr auto blend_of() -> decltype(TexelFunctions::blend_quads) {
  if constexpr (Texel<kFormat>::kFiltersCodes) {
    return blend_quads<kFormat>;
  } else {
    return nullptr;
  }
}

template <size_t kFormat>
void load_gathered(const std::byte* base, const uint32_t* byte_offsets, uint64_t lanes, float* const registers[4]) {
  using T = Texel<kFormat>;
  for (int vector = 0; vector < kVectorsPerBatch; ++vector) {
    const M m = mask_of(lanes, vector);
    U texel[T::kWords];
    T::gather(base, load<U>(byte_offsets + vector * kVectorLanes), m, texel);
    F rgba[4];
    T::decode(texel, rgba);
    const F one = T::kInfo.is_integer() ? as_f(broadcast(1u)) : broadcast(1.0f);
    rgba[3] = select(m, rgba[3], one);
    store_components(rgba, vector, registers);
  }
}

template <size_t kFormat>
void store_scattered(std::byte* base, const uint32_t* byte_offsets, uint64_t lanes, const float* const registers[4]) {
  using T = Texel<kFormat>;
  const Color color(registers);
  BatchWords<T::kWords> words;
  for (int vector = 0; vector < kVectorsPerBatch; ++vector) {
    U texel[T::kWords];
    encode_vector<T>(color, vector, texel);
    for (size_t w = 0; w < T::kWords; ++w) store(texel[w], &words.word[w][vector * kVectorLanes]);
  }
  for (; lanes != 0; lanes &= lanes - 1) {
    const int lane = std::countr_zero(lanes);
    std::byte* const to = base + byte_offsets[lane];
    constexpr size_t bytes = T::kIsSmall ? T::kInfo.texel_size : 4;
    for (size_t w = 0; w < T::kWords; ++w) std::memcpy(to + 4 * w, &words.word[w][lane], bytes);
  }
}

template <size_t kFormat>
constexpr TexelFunctions functions_of() {
  TexelFunctions functions = {};
  functions.load_gathered = load_gathered<kFormat>;
  if constexpr (kFormats[kFormat].has(kStorage)) functions.store_scattered = store_scattered<kFormat>;
  if constexpr (kFormats[kFormat].is_target()) {
    functions.blend_quads = blend_of<kFormat>();
    functions.load_quads = load_quads<kFormat>;
    functions.store_quads = store_quads<kFormat>;
  }
  return functions;
}

template <size_t... kIndices>
constexpr std::array<TexelFunctions, sizeof...(kIndices)> make_table(std::index_sequence<kIndices...>) {
  return {functions_of<kIndices>()...};
}

}  // namespace

using TexelTable = std::array<TexelFunctions, kFormatCount>;
extern const TexelTable kTexelTable;
const TexelTable kTexelTable = make_table(std::make_index_sequence<kFormatCount>());

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {
namespace {

constexpr PerTarget<const std::array<TexelFunctions, kFormatCount>> kTables = LAPILLI_PER_TARGET(kTexelTable);

}  // namespace

const TexelFunctions& texel_functions(const FormatInfo& format) { return for_target(kTables)[format.index]; }
const TexelFunctions& texel_functions(const FormatInfo& format, SimdTarget target) {
  return for_target(kTables, target)[format.index];
}

}  // namespace lapilli
#endif
