// The ranges of a tile's depths, which may not depend on what the same thread worked on before.
#include "raster/tile_depth.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "image/tile.h"

namespace lapilli {
namespace {

constexpr uint32_t kBlock = 9;

struct Plane {
  alignas(64) float depths[kTileTexels] = {};
};

TEST(TileDepth, ATouchedBlocksRangeIsMadeWhenSomebodyAsks) {
  Plane plane;
  TileDepth depth;
  depth.begin_cleared(plane.depths, 1);
  EXPECT_EQ(depth.changed(), 0u);
  *depth.fill(kBlock) = 0.5f;
  depth.touch(kBlock);
  EXPECT_EQ(depth.changed(), uint64_t{1} << kBlock);
  EXPECT_EQ(depth.range().min, 0.5f);
  EXPECT_EQ(depth.range().max, 1.0f);
  std::fill_n(depth.plane(kBlock), kBlockTexels, 0.25f);
  depth.touch(kBlock);
  EXPECT_EQ(depth.ranges().min[kBlock], 0.25f);
  EXPECT_EQ(depth.ranges().max[kBlock], 0.25f);
  EXPECT_EQ(depth.ranges().min[kBlock + 1], 1.0f);
}

// What was touched in the tile before is forgotten: its plane is another one's.
TEST(TileDepth, ATileBeginsAnew) {
  Plane plane;
  uint64_t valid[64];
  std::fill_n(valid, 64, kAllBits);
  for (const bool cleared : {true, false}) {
    TileDepth depth;
    const auto begin = [&] {
      std::fill_n(plane.depths, kTileTexels, 1.0f);
      return cleared ? depth.begin_cleared(plane.depths, 1) : depth.begin_loaded(plane.depths, valid);
    };
    begin();
    std::fill_n(depth.plane(kBlock), kBlockTexels, 0.5f);
    depth.touch(kBlock);
    begin();
    std::fill_n(depth.plane(kBlock), kBlockTexels, 0.75f);  // a range made now would show it
    EXPECT_EQ(depth.range().min, 1.0f);
    EXPECT_EQ(depth.changed(), 0u);
  }
}

}  // namespace
}  // namespace lapilli
