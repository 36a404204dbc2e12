// Derivatives of values that differ in every pixel. Specification: SPIR-V, "Derivative Instructions"; Vulkan,
// "Derivative Operations": coarse ones may be those of either row or column, plain ones are fine or coarse.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "harness/devices.h"
#include "spirv/snippet.h"

namespace lapilli::conformance::spirv {
namespace {

constexpr uint32_t kWidth = 64, kRows = 4;  // of the canvas that snippets are drawn on

struct Derivative {
  spv::Op op;
  bool x, y;  // along x; along y; both: the sum of magnitudes
};

class Differences {
 public:
  explicit Differences(const Words& values) : values_(values) {}
  // right - left in a row, lower - upper in a column, of the quad that pixel (x, y) is in.
  float along_x(uint32_t x, uint32_t row) const { return at((x & ~1u) + 1, row) - at(x & ~1u, row); }
  float along_y(uint32_t y, uint32_t column) const { return at(column, (y & ~1u) + 1) - at(column, y & ~1u); }

 private:
  float at(uint32_t x, uint32_t y) const { return std::bit_cast<float>(values_[y * kWidth + x]); }
  const Words& values_;
};

void check(const Derivative& derivative, bool fine, bool coarse) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> numbers(-100, 100);
  Words values;
  for (uint32_t i = 0; i < kWidth * kRows; ++i) values.push_back(std::bit_cast<uint32_t>(numbers(random)));
  const Snippet snippet = {1, 1, [&](Module& m, const Words& w) -> Words {
                             m.capability(spv::Capability::DerivativeControl);
                             const Id value = m.emit(spv::Op::OpBitcast, m.float_type(), {w[0]});
                             const Id result = m.emit(derivative.op, m.float_type(), {value});
                             return {m.emit(spv::Op::OpBitcast, m.uint_type(), {result})};
                           }};
  const Words got = run(subject(), snippet, Stage::fragment, values);
  const Differences differences(values);
  int wrong = 0;
  for (uint32_t y = 0; y < kRows; ++y) {
    for (uint32_t x = 0; x < kWidth; ++x) {
      const float result = std::bit_cast<float>(got[y * kWidth + x]);
      bool right = false;
      // Rows and columns of the quad that may be taken.
      for (uint32_t row = y & ~1u; row <= (y | 1); ++row) {
        for (uint32_t column = x & ~1u; column <= (x | 1); ++column) {
          if (!coarse && (row != y || column != x)) continue;
          // Lapilli's coarse derivatives are those of the first row and column.
          if (!fine && subject_is_lapilli() && (row % 2 != 0 || column % 2 != 0)) continue;
          const float dx = differences.along_x(x, row), dy = differences.along_y(y, column);
          const float want = derivative.x && derivative.y ? std::abs(dx) + std::abs(dy) : derivative.x ? dx : dy;
          right = right || std::abs(result - want) <= (subject_is_lapilli() ? 0 : 1e-4f);
        }
      }
      wrong += !right;
    }
  }
  EXPECT_EQ(wrong, 0) << uint32_t(derivative.op);
}

TEST(Derivatives, Fine) {
  check({spv::Op::OpDPdxFine, true, false}, true, false);
  check({spv::Op::OpDPdyFine, false, true}, true, false);
  check({spv::Op::OpFwidthFine, true, true}, true, false);
}

TEST(Derivatives, Coarse) {
  check({spv::Op::OpDPdxCoarse, true, false}, false, true);
  check({spv::Op::OpDPdyCoarse, false, true}, false, true);
  check({spv::Op::OpFwidthCoarse, true, true}, false, true);
}

TEST(Derivatives, Plain) {
  check({spv::Op::OpDPdx, true, false}, true, true);
  check({spv::Op::OpDPdy, false, true}, true, true);
  check({spv::Op::OpFwidth, true, true}, true, true);
}

}  // namespace
}  // namespace lapilli::conformance::spirv
