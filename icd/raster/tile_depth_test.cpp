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

void include_once(TileDepth& depth, float z) {
  *depth.plane(kBlock) = z;
  depth.include(kBlock, z);
}

// The range grows with each depth; that it is made anew now and then is counted from the tile's beginning.
TEST(TileDepth, ATileBeginsToCountAnew) {
  Plane plane;
  uint64_t valid[64];
  std::fill_n(valid, 64, kAllBits);
  for (const bool cleared : {true, false}) {
    TileDepth depth;
    const auto begin = [&] {
      std::fill_n(plane.depths, kTileTexels, 1.0f);
      if (!cleared) return depth.begin_loaded(plane.depths, valid);
      depth.begin_cleared(plane.depths, 1);
      depth.fill(kBlock);
    };
    begin();
    for (int i = 0; i < 31; ++i) include_once(depth, 0.25f);
    EXPECT_EQ(depth.range(kBlock).min, 0.25f);
    begin();
    std::fill_n(depth.plane(kBlock), kBlockTexels, 0.75f);  // a range made anew would show it
    include_once(depth, 0.5f);
    EXPECT_EQ(depth.range(kBlock).min, 0.5f);
    EXPECT_EQ(depth.range(kBlock).max, 1.0f);
    EXPECT_EQ(depth.changed(), uint64_t{1} << kBlock);
  }
}

TEST(TileDepth, TheRangeIsMadeAnewNowAndThen) {
  Plane plane;
  TileDepth depth;
  depth.begin_cleared(plane.depths, 1);
  depth.fill(kBlock);
  std::fill_n(depth.plane(kBlock), kBlockTexels, 0.5f);
  for (int i = 0; i < 31; ++i) include_once(depth, 0.5f);
  EXPECT_EQ(depth.range(kBlock).max, 1.0f);
  include_once(depth, 0.5f);
  EXPECT_EQ(depth.range(kBlock).min, 0.5f);
  EXPECT_EQ(depth.range(kBlock).max, 0.5f);
}

}  // namespace
}  // namespace lapilli
