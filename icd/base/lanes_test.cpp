// The lane primitives against plain C++, on every SIMD target of the machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "base/lane_math_runs.h"
#include "base/lanes_runs.h"

namespace lapilli {
namespace {

using Word = std::uint32_t;

float as_float(Word bits) { return std::bit_cast<float>(bits); }
Word as_bits(float value) { return std::bit_cast<Word>(value); }
std::int32_t as_signed(Word bits) { return static_cast<std::int32_t>(bits); }
Word as_word(std::int32_t value) { return static_cast<Word>(value); }
Word condition(bool value) { return value ? 0xFFFFFFFFu : 0u; }

// Edges of integers and floats, then patterns of every magnitude.
std::vector<Word> sample_words(std::size_t count, Word seed) {
  std::vector<Word> words = {0u,          1u,          2u,          3u,          7u,          31u,         32u,
                             33u,         0x7Fu,       0xFFFFu,     0x10000u,    0x7FFFFFFFu, 0x80000000u, 0x80000001u,
                             0xFFFFFFFFu, 0xFFFFFFFEu, 0x3F800000u, 0xBF800000u, 0x3F7FFFFFu, 0x3F800001u, 0x7F800000u,
                             0xFF800000u, 0x7FC00000u, 0xFFC00001u, 0x7F800001u, 0x7F7FFFFFu, 0xFF7FFFFFu, 0x00800000u,
                             0x007FFFFFu, 0x807FFFFFu, 0x4F000000u, 0xCF000000u, 0x4EFFFFFFu, 0x4F800000u, 0x4F7FFFFFu,
                             0x477FE000u, 0x477FEFFFu, 0x477FF000u, 0x38800000u, 0x387FFFFFu, 0x33000000u, 0x33000001u,
                             0x4B000000u, 0x4AFFFFFFu, 0x4B7FFFFFu, 0xCB000000u, 0x3F000000u, 0x3FC00000u, 0x40200000u};
  std::mt19937 engine(seed);
  const auto random = [&engine] { return static_cast<Word>(engine()); };
  while (words.size() < count) {
    switch (random() % 4) {
      case 0:
        words.push_back(random());
        break;
      case 1:
        words.push_back(random() >> random() % 32);
        break;  // small integers
      case 2:
        words.push_back(0u - (random() >> random() % 32));
        break;  // small negative ones
      default:
        words.push_back((random() & 0x807FFFFFu) | (100 + random() % 60) << 23);  // floats around 1
    }
  }
  words.resize(count & ~std::size_t{15});
  return words;
}

bool same_float(Word a, Word b) { return a == b || (std::isnan(as_float(a)) && std::isnan(as_float(b))); }
bool same_word(Word a, Word b) { return a == b; }

void check_unary(const char* name, UnaryBits* LaneRuns::*run, Word (*reference)(Word),
                 bool (*same)(Word, Word) = same_word) {
  const std::vector<Word> x = sample_words(400'000, 1);
  std::vector<Word> result(x.size());
  for (const SimdTarget target : supported_simd_targets()) {
    (lane_runs(target).*run)(x.data(), result.data(), x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      ASSERT_TRUE(same(result[i], reference(x[i])))
          << simd_target_name(target) << " " << name << std::hex << " of 0x" << x[i] << " is 0x" << result[i]
          << ", expected 0x" << reference(x[i]);
    }
  }
}

void check_binary(const char* name, BinaryBits* LaneRuns::*run, Word (*reference)(Word, Word),
                  bool (*same)(Word, Word) = same_word) {
  // Every edge with every edge, then random pairs.
  const std::vector<Word> edges = sample_words(64, 2);
  std::vector<Word> x = sample_words(200'000, 3);
  std::vector<Word> y = sample_words(200'000, 4);
  std::mt19937 random(5);
  std::shuffle(y.begin(), y.end(), random);
  for (const Word a : edges) {
    for (const Word b : edges) {
      x.push_back(a);
      y.push_back(b);
    }
  }
  std::vector<Word> result(x.size());
  for (const SimdTarget target : supported_simd_targets()) {
    (lane_runs(target).*run)(x.data(), y.data(), result.data(), x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      ASSERT_TRUE(same(result[i], reference(x[i], y[i])))
          << simd_target_name(target) << " " << name << std::hex << " of 0x" << x[i] << ", 0x" << y[i] << " is 0x"
          << result[i] << ", expected 0x" << reference(x[i], y[i]);
    }
  }
}

#define CHECK_UNARY(name, ...) check_unary(#name, &LaneRuns::name, [](Word x) -> Word { return __VA_ARGS__; })
#define CHECK_UNARY_FLOAT(name, ...) \
  check_unary(                       \
      #name, &LaneRuns::name, [](Word x) -> Word { return __VA_ARGS__; }, same_float)
#define CHECK_BINARY(name, ...) check_binary(#name, &LaneRuns::name, [](Word x, Word y) -> Word { return __VA_ARGS__; })
#define CHECK_BINARY_FLOAT(name, ...) \
  check_binary(                       \
      #name, &LaneRuns::name, [](Word x, Word y) -> Word { return __VA_ARGS__; }, same_float)

Word reference_to_int(float v) {
  if (std::isnan(v)) return 0;
  if (v >= 0x1p31f) return 0x7FFFFFFFu;
  if (v <= -0x1p31f) return 0x80000000u;
  return as_word(static_cast<std::int32_t>(v));
}
Word reference_to_uint(float v) {
  if (!(v > 0.0f)) return 0;
  return v >= 0x1p32f ? 0xFFFFFFFFu : static_cast<Word>(v);
}

TEST(Lanes, ConvertBetweenIntegersAndFloats) {
  CHECK_UNARY(to_int, reference_to_int(as_float(x)));
  CHECK_UNARY(to_uint, reference_to_uint(as_float(x)));
  CHECK_UNARY(int_to_float, as_bits(static_cast<float>(as_signed(x))));
  CHECK_UNARY(uint_to_float, as_bits(static_cast<float>(x)));
  CHECK_UNARY(int_through_double, x);
  CHECK_UNARY(uint_through_double, x);
}

// The value of a half, from its definition.
double half_value(Word half) {
  const int exponent = static_cast<int>(half >> 10 & 31);
  const auto fraction = static_cast<double>(half & 1023);
  const double magnitude = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
  return (half & 0x8000) != 0 ? -magnitude : magnitude;
}
// The nearest half by search among all of them; the even one of two equally near.
Word reference_to_half(float v) {
  if (std::isnan(v)) return 0x7E00;
  const Word sign = std::signbit(v) ? 0x8000u : 0u;
  const double a = std::abs(static_cast<double>(v));
  if (a >= 65520.0) return sign | 0x7C00;
  Word low = 0;
  Word high = 0x7C00;  // stands for 65536 here
  while (high - low > 1) {
    const Word middle = (low + high) / 2;
    (half_value(middle) <= a ? low : high) = middle;
  }
  const double to_low = a - half_value(low);
  const double to_high = half_value(high) - a;
  const bool up = to_high < to_low || (to_high == to_low && (low & 1) != 0);
  return sign | (up ? high : low);
}
Word reference_from_half(Word half) {
  if ((half & 0x7C00) == 0x7C00) {
    if ((half & 0x3FF) != 0) return 0x7FC00000u;
    return (half & 0x8000) != 0 ? 0xFF800000u : 0x7F800000u;
  }
  return as_bits(static_cast<float>(half_value(half)));
}

TEST(Lanes, ConvertHalves) {
  CHECK_UNARY(to_half, reference_to_half(as_float(x)));
  CHECK_UNARY(from_half, reference_from_half(x & 0xFFFF));
  // All of them there and back.
  std::vector<Word> halves(65536), floats(65536), back(65536);
  for (Word i = 0; i < 65536; ++i) halves[i] = i;
  for (const SimdTarget target : supported_simd_targets()) {
    lane_runs(target).from_half(halves.data(), floats.data(), halves.size());
    lane_runs(target).to_half(floats.data(), back.data(), halves.size());
    for (Word i = 0; i < 65536; ++i) {
      ASSERT_EQ(floats[i], reference_from_half(i)) << i;
      ASSERT_EQ(back[i], (i & 0x7FFF) > 0x7C00 ? 0x7E00 : i);
    }
  }
}

TEST(Lanes, CountAndFindBits) {
  CHECK_UNARY(bit_count, static_cast<Word>(std::popcount(x)));
  CHECK_UNARY(find_lsb, x == 0 ? ~0u : static_cast<Word>(std::countr_zero(x)));
  CHECK_UNARY(find_msb_unsigned, x == 0 ? ~0u : static_cast<Word>(31 - std::countl_zero(x)));
  CHECK_UNARY(find_msb_signed,
              x == 0 || x == ~0u ? ~0u : static_cast<Word>(31 - std::countl_zero(as_signed(x) < 0 ? ~x : x)));
  CHECK_UNARY(absolute_int, as_signed(x) < 0 ? 0u - x : x);
  check_unary("bit_reverse", &LaneRuns::bit_reverse, [](Word x) {
    Word reversed = 0;
    for (int bit = 0; bit < 32; ++bit) reversed |= (x >> bit & 1) << (31 - bit);
    return reversed;
  });
}

TEST(Lanes, ClassifyFloats) {
  CHECK_UNARY(canonical, std::isnan(as_float(x)) ? 0x7FC00000u : x);
  CHECK_UNARY(negate_float, x ^ 0x80000000u);
  CHECK_UNARY(is_nan, condition(std::isnan(as_float(x))));
  CHECK_UNARY(is_inf, condition(std::isinf(as_float(x))));
  CHECK_UNARY(is_finite, condition(std::isfinite(as_float(x))));
}

TEST(Lanes, MultiplyAndDivideIntegers) {
  CHECK_BINARY(multiply, x * y);
  CHECK_BINARY(mul_high_unsigned, static_cast<Word>(std::uint64_t{x} * y >> 32));
  CHECK_BINARY(mul_high_signed, static_cast<Word>(std::int64_t{as_signed(x)} * as_signed(y) >> 32));
  CHECK_BINARY(divide_unsigned, y == 0 ? ~0u : x / y);
  CHECK_BINARY(remainder_unsigned, y == 0 ? x : x % y);
  // In 64 bits INT_MIN / -1 is 2^31, whose low word is INT_MIN.
  CHECK_BINARY(divide_signed, y == 0 ? 0u : static_cast<Word>(std::int64_t{as_signed(x)} / as_signed(y)));
  CHECK_BINARY(remainder_signed, y == 0 ? x : static_cast<Word>(std::int64_t{as_signed(x)} % as_signed(y)));
  check_binary("modulo_signed", &LaneRuns::modulo_signed, [](Word x, Word y) {
    if (y == 0) return x;
    const std::int64_t divisor = as_signed(y);
    const std::int64_t rest = as_signed(x) % divisor;
    return static_cast<Word>(rest != 0 && (rest < 0) != (divisor < 0) ? rest + divisor : rest);
  });
}

TEST(Lanes, ShiftCarryAndOrderIntegers) {
  CHECK_BINARY(shift_left, x << (y & 31));
  CHECK_BINARY(shift_right_logical, x >> (y & 31));
  CHECK_BINARY(shift_right_arithmetic, as_word(as_signed(x) >> (y & 31)));
  CHECK_BINARY(add_carry, (std::uint64_t{x} + y) >> 32 != 0 ? 1u : 0u);
  CHECK_BINARY(sub_borrow, x < y ? 1u : 0u);
  CHECK_BINARY(min_unsigned, std::min(x, y));
  CHECK_BINARY(max_unsigned, std::max(x, y));
  CHECK_BINARY(min_signed, as_word(std::min(as_signed(x), as_signed(y))));
  CHECK_BINARY(max_signed, as_word(std::max(as_signed(x), as_signed(y))));
  CHECK_BINARY(less_unsigned, condition(x < y));
  CHECK_BINARY(less_signed, condition(as_signed(x) < as_signed(y)));
  CHECK_BINARY(less_equal_unsigned, condition(x <= y));
  CHECK_BINARY(less_equal_signed, condition(as_signed(x) <= as_signed(y)));
  CHECK_BINARY(equal_bits, condition(x == y));
}

TEST(Lanes, CompareFloats) {
  CHECK_BINARY(equal, condition(as_float(x) == as_float(y)));
  CHECK_BINARY(not_equal, condition(as_float(x) != as_float(y)));
  CHECK_BINARY(less, condition(as_float(x) < as_float(y)));
  CHECK_BINARY(less_equal, condition(as_float(x) <= as_float(y)));
  CHECK_BINARY(greater, condition(as_float(x) > as_float(y)));
  CHECK_BINARY(greater_equal, condition(as_float(x) >= as_float(y)));
  CHECK_BINARY(ordered_not_equal, condition(std::islessgreater(as_float(x), as_float(y))));
  CHECK_BINARY(unordered_equal, condition(!std::islessgreater(as_float(x), as_float(y))));
  CHECK_BINARY(unordered_less, condition(!std::isgreaterequal(as_float(x), as_float(y))));
  CHECK_BINARY(unordered_less_equal, condition(!std::isgreater(as_float(x), as_float(y))));
  CHECK_BINARY(unordered_greater, condition(!std::islessequal(as_float(x), as_float(y))));
  CHECK_BINARY(unordered_greater_equal, condition(!std::isless(as_float(x), as_float(y))));
  CHECK_BINARY(less_in_double, condition(as_float(x) < as_float(y)));
}

TEST(Lanes, ComputeFloats) {
  CHECK_BINARY_FLOAT(add_float, as_bits(as_float(x) + as_float(y)));
  CHECK_BINARY_FLOAT(divide_float, as_bits(as_float(x) / as_float(y)));
  CHECK_BINARY_FLOAT(product_in_double, as_bits(as_float(x) * as_float(y)));
  CHECK_BINARY_FLOAT(min_in_double, as_bits(as_float(y) < as_float(x) ? as_float(y) : as_float(x)));
  CHECK_BINARY(select_float, x < y ? x : y);
  CHECK_BINARY(select_bits, x < y ? x : y);
}

TEST(Lanes, ExtractAndInsertBitFields) {
  const std::vector<Word> x = {0u, ~0u, 0x80000000u, 0x7FFFFFFFu, 0x12345678u, 0x9ABCDEF0u, 0x55555555u, 0xAAAAAAAAu,
                               1u, 2u,  0xFFFF0000u, 0x0000FFFFu, 0x13579BDFu, 0xFDB97531u, 0xDEADBEEFu, 0x01020304u};
  std::vector<Word> result(16);
  for (const SimdTarget target : supported_simd_targets()) {
    for (Word offset = 0; offset < 32; ++offset) {
      for (Word width = 0; width <= 32 - offset; ++width) {
        const std::uint64_t ones = (std::uint64_t{1} << width) - 1;
        lane_runs(target).extract_unsigned(x.data(), offset, width, result.data());
        for (std::size_t i = 0; i < 16; ++i) ASSERT_EQ(result[i], x[i] >> offset & ones);
        lane_runs(target).extract_signed(x.data(), offset, width, result.data());
        for (std::size_t i = 0; i < 16; ++i) {
          const auto field = static_cast<std::int64_t>(x[i] >> offset & ones);
          const bool negative = width > 0 && (field >> (width - 1) & 1) != 0;
          const std::int64_t value = negative ? field - (std::int64_t{1} << width) : field;
          ASSERT_EQ(as_signed(result[i]), value) << offset << " " << width;
        }
        lane_runs(target).insert(x.data(), offset, width, result.data());
        for (std::size_t i = 0; i < 16; ++i) {
          const std::uint64_t field = ones << offset;
          ASSERT_EQ(result[i], (~x[i] & ~field) | (std::uint64_t{x[i]} << offset & field));
        }
      }
    }
  }
}

TEST(Lanes, MasksAndWordsAgree) {
  std::mt19937_64 random(7);
  for (const SimdTarget target : supported_simd_targets()) {
    for (int i = 0; i < 1000; ++i) {
      const std::uint64_t word = i < 64 ? std::uint64_t{1} << i : random();
      ASSERT_EQ(lane_runs(target).mask_round_trip(word), word);
    }
  }
}

// Lane = quad * 4 + (y & 1) * 2 + (x & 1).
TEST(Lanes, QuadsSwapTheirColumnsAndRows) {
  std::vector<Word> lanes(64), result(64);
  for (Word i = 0; i < 64; ++i) lanes[i] = i;
  for (const SimdTarget target : supported_simd_targets()) {
    lane_runs(target).swap_columns(lanes.data(), result.data(), 64);
    for (Word i = 0; i < 64; ++i) ASSERT_EQ(result[i], i ^ 1);
    lane_runs(target).swap_rows(lanes.data(), result.data(), 64);
    for (Word i = 0; i < 64; ++i) ASSERT_EQ(result[i], i ^ 2);
  }
}

TEST(Lanes, GatherTouchesOnlyItsLanes) {
  std::vector<unsigned char> memory(4096 + 4);
  for (std::size_t i = 0; i < memory.size(); ++i) memory[i] = static_cast<unsigned char>(i * 7 + i / 256);
  std::mt19937_64 random(8);
  std::vector<Word> offsets(64), result(64);
  for (const SimdTarget target : supported_simd_targets()) {
    for (int round = 0; round < 100; ++round) {
      const std::uint64_t mask = random();
      // Lanes that are off point far outside: reading there would crash.
      for (std::size_t i = 0; i < 64; ++i) {
        offsets[i] = (mask >> i & 1) != 0 ? static_cast<Word>(random() % 4097) : 0x7FFF0000u;
      }
      lane_runs(target).gather(memory.data(), offsets.data(), mask, result.data());
      for (std::size_t i = 0; i < 64; ++i) {
        Word expected = 0;
        if ((mask >> i & 1) != 0) std::memcpy(&expected, &memory[offsets[i]], 4);
        ASSERT_EQ(result[i], expected);
      }
    }
  }
}

// Triples that stress fma: cancellation, ties, denormal results, overflow, and plain random ones.
TEST(Lanes, FmaRoundsOnce) {
  constexpr std::size_t kCount = 1 << 20;
  std::vector<float> a(kCount), b(kCount), c(kCount), result(kCount);
  const std::vector<Word> x = sample_words(kCount, 11);
  const std::vector<Word> y = sample_words(kCount, 12);
  std::mt19937 engine(13);
  const auto random = [&engine] { return static_cast<Word>(engine()); };
  for (std::size_t i = 0; i < kCount; ++i) {
    a[i] = as_float(x[random() % kCount]);
    b[i] = as_float(y[random() % kCount]);
    switch (random() % 4) {
      case 0:
        c[i] = as_float(x[i]);
        break;
      case 1:
        c[i] = -(a[i] * b[i]);
        break;  // what is left is the product's rounding error
      case 2: {
        // Around 24 to 26 places below the product or above it: ties and sticky bits.
        const int shift = static_cast<int>(random() % 80) - 40;
        const float product = std::isnormal(a[i] * b[i]) ? a[i] * b[i] : 0x1p-120f;
        c[i] = std::ldexp(random() % 2 != 0 ? 1.0f : -1.5f, std::ilogb(product) + shift);
        break;
      }
      default: {
        // Denormal products with a denormal addend.
        a[i] = std::ldexp(static_cast<float>(random() % (1 << 24)), -100);
        b[i] = std::ldexp(static_cast<float>(random() % (1 << 24)), -72);
        c[i] = as_float(random() & 0x80FFFFFFu);
      }
    }
  }
  for (const SimdTarget target : supported_simd_targets()) {
    math_runs(target).fma(a.data(), b.data(), c.data(), result.data(), kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
      ASSERT_TRUE(same_float(as_bits(result[i]), as_bits(std::fma(a[i], b[i], c[i]))))
          << simd_target_name(target) << std::hexfloat << " " << a[i] << " * " << b[i] << " + " << c[i] << " is "
          << result[i] << ", expected " << std::fma(a[i], b[i], c[i]);
    }
  }
}

void check_rounding(const char* name, UnaryRun* MathRuns::*run, float (*reference)(float)) {
  const std::vector<Word> words = sample_words(400'000, 21);
  std::vector<float> x(words.size()), result(words.size());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = as_float(words[i]);
  // Halves and their neighbours.
  for (std::size_t i = 0; i < 1600; ++i) x[i + 1024] = static_cast<float>(i) * 0.5f - 400.0f;
  for (const SimdTarget target : supported_simd_targets()) {
    (math_runs(target).*run)(x.data(), result.data(), x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      ASSERT_TRUE(same_float(as_bits(result[i]), as_bits(reference(x[i]))))
          << simd_target_name(target) << " " << name << " " << std::hexfloat << x[i] << " is " << result[i];
    }
  }
}

TEST(Lanes, RoundToIntegersKeepingTheSign) {
  check_rounding("trunc", &MathRuns::trunc, std::trunc);
  check_rounding("floor", &MathRuns::floor, std::floor);
  check_rounding("ceil", &MathRuns::ceil, std::ceil);
  check_rounding("round_even", &MathRuns::round_even, std::nearbyint);
  check_rounding("sqrt", &MathRuns::sqrt, std::sqrt);
}

// All significands, with even and odd exponents; the scale is exact but near the ends, which the samples above reach.
TEST(Lanes, RootsOfAllSignificandsAreCorrectlyRounded) {
  constexpr Word kOne = 0x3F800000, kFour = 0x40800000, kBlock = 1 << 16;
  std::vector<float> x(kBlock), root(kBlock), inverse(kBlock);
  for (Word first = kOne; first < kFour; first += kBlock) {
    for (Word i = 0; i < kBlock; ++i) x[i] = as_float(first + i);
    math_runs(best_simd_target()).sqrt(x.data(), root.data(), kBlock);
    math_runs(best_simd_target()).inverse_sqrt(x.data(), inverse.data(), kBlock);
    Word wrong = 0;
    for (Word i = 0; i < kBlock; ++i) {
      const float expected = std::sqrt(x[i]);
      wrong += root[i] != expected || inverse[i] != 1.0f / expected;
    }
    ASSERT_EQ(wrong, 0u) << std::hexfloat << as_float(first);
  }
}

TEST(Lanes, MinAndMaxFollowTheirRule) {
  const std::vector<Word> xs = sample_words(64, 31);
  std::vector<float> x, y;
  for (const Word a : xs) {
    for (const Word b : xs) {
      x.push_back(as_float(a));
      y.push_back(as_float(b));
    }
  }
  std::vector<float> result(x.size());
  struct Rule {
    BinaryRun* MathRuns::*run;
    float (*reference)(float, float);
  };
  const Rule rules[] = {
      {&MathRuns::min, [](float a, float b) { return b < a ? b : a; }},
      {&MathRuns::max, [](float a, float b) { return a < b ? b : a; }},
      {&MathRuns::nmin, [](float a, float b) { return std::isnan(a) ? b : (b < a ? b : a); }},
      {&MathRuns::nmax, [](float a, float b) { return std::isnan(a) ? b : (a < b ? b : a); }},
  };
  for (const SimdTarget target : supported_simd_targets()) {
    for (const Rule& rule : rules) {
      (math_runs(target).*rule.run)(x.data(), y.data(), result.data(), x.size());
      for (std::size_t i = 0; i < x.size(); ++i) {
        ASSERT_TRUE(same_float(as_bits(result[i]), as_bits(rule.reference(x[i], y[i])))) << x[i] << " " << y[i];
      }
    }
  }
}

}  // namespace
}  // namespace lapilli
