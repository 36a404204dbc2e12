// Snapping to 1/256 pixel.
#include "base/fixed_point.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace lapilli {
namespace {

TEST(FixedPoint, SnapsToTheNearestTiesToEven) {
  EXPECT_EQ(snap(1.0f).value, 256);
  EXPECT_EQ(snap(-1.5f).value, -384);
  EXPECT_EQ(snap(0.5f / 256).value, 0);
  EXPECT_EQ(snap(1.5f / 256).value, 2);
  EXPECT_EQ(snap(2.5f / 256).value, 2);
  EXPECT_EQ(snap(-0.5f / 256).value, 0);
  EXPECT_EQ(snap(-1.5f / 256).value, -2);
  EXPECT_EQ(snap(std::nextafter(0.5f / 256, 1.0f)).value, 1);
  EXPECT_EQ(snap(1e-40f).value, 0);
  for (std::uint64_t bits = 0; bits < (std::uint64_t{1} << 32); bits += 4999) {
    const float v = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    const Snapped snapped = snap(v);
    const bool fits = v >= -8388608.0f && v < 8388608.0f;
    ASSERT_EQ(snapped.valid, fits) << v;
    // The product is exact in long double, and llrint rounds ties to even.
    if (fits) {
      ASSERT_EQ(snapped.value, std::llrint(static_cast<long double>(v) * 256)) << v;
    }
  }
}

TEST(FixedPoint, ReportsWhatDoesNotFit) {
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(snap(std::numeric_limits<float>::quiet_NaN()).valid);
  EXPECT_EQ(snap(std::numeric_limits<float>::quiet_NaN()).value, 0);
  EXPECT_FALSE(snap(infinity).valid);
  EXPECT_EQ(snap(infinity).value, INT32_MAX);
  EXPECT_FALSE(snap(-infinity).valid);
  EXPECT_EQ(snap(-infinity).value, INT32_MIN);
  EXPECT_FALSE(snap(8388608.0f).valid);
  EXPECT_TRUE(snap(8388607.5f).valid);
  EXPECT_EQ(snap(8388607.5f).value, 8388607 * 256 + 128);
  EXPECT_TRUE(snap(-8388608.0f).valid);
  EXPECT_EQ(snap(-8388608.0f).value, INT32_MIN);
}

TEST(FixedPoint, FindsPixels) {
  EXPECT_EQ(fixed_floor(snap(-0.25f).value), -1);
  EXPECT_EQ(fixed_ceil(snap(-0.25f).value), 0);
  EXPECT_EQ(fixed_floor(snap(3.0f).value), 3);
  EXPECT_EQ(fixed_ceil(snap(3.0f).value), 3);
  EXPECT_EQ(fixed_ceil(INT32_MAX), 8388608);
  EXPECT_EQ(fixed_floor(INT32_MIN), -8388608);
  EXPECT_EQ(fixed_fraction(snap(-0.25f).value), 192);
  EXPECT_EQ(pixel_center(2), 640);
  EXPECT_EQ(pixel_center(-1), -128);
  EXPECT_EQ(fixed_to_float(640), 2.5f);
  EXPECT_EQ(fixed_to_double(-1), -1.0 / 256);
}

}  // namespace
}  // namespace lapilli
