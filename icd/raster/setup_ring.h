// The triangle set-ups that batches point to: made when a triangle is shaded, overwritten when kCount more have been
// made. Whoever makes them runs what is pending before that (TileWorker::keep_pending_setups).
#pragma once

#include <algorithm>

#include "raster/visibility.h"
#include "shader/batch.h"

namespace lapilli {

class SetupRing {
 public:
  // Of the tile; so many more may be made or asked for while a batch is pending.
  static constexpr uint32_t kMostWhilePending = 64;

  void begin_tile() {
    made_ = 0;
    coordinates_.known = 0;
  }
  uint32_t made() const { return made_; }

  // `setup`: the triangle's, if somebody has made it already.
  const TriangleSetup& make(const BinChunk& chunk, const BinTriangle& triangle, const TriangleSetup* setup) {
    const uint32_t place = made_++ % kCount;
    setups_[place] = setup != nullptr ? *setup : make_triangle_setup(chunk, triangle);
    make_varying_planes(chunk, triangle, varyings_[place]);
    setups_[place].varyings = varyings_[place];
    return setups_[place];
  }
  // Of a triangle that is shaded before the next one is: if it lies where the last such one did, it has its
  // coordinates.
  const TriangleSetup& make_in_order(const BinChunk& chunk, const BinTriangle& triangle, const TriangleSetup* setup) {
    make(chunk, triangle, setup);
    TriangleSetup& made = setups_[(made_ - 1) % kCount];
    if (lie_alike(made, last_in_order_)) {
      made.coordinates = &coordinates_;
    } else {
      last_in_order_ = made;
      coordinates_.known = 0;
    }
    return made;
  }
  // The triangle's, which may be there from the last time.
  const TriangleSetup& of(TileTriangle& triangle) {
    if (triangle.setup == 0 || made_ - triangle.setup >= kUsable) {
      make(*triangle.chunk, triangle.chunk->triangles[triangle.index], nullptr);
      triangle.setup = made_;
    }
    return setups_[(triangle.setup - 1) % kCount];
  }

 private:
  static bool lie_alike(const TriangleSetup& a, const TriangleSetup& b) {
    return std::equal(a.edge_a, a.edge_a + 3, b.edge_a) && std::equal(a.edge_b, a.edge_b + 3, b.edge_b) &&
           std::equal(a.edge_c, a.edge_c + 3, b.edge_c) && std::equal(a.inverse_w, a.inverse_w + 3, b.inverse_w);
  }

  static constexpr uint32_t kCount = 128;
  // One that is as old as this is made anew, so that what is handed out outlives kMostWhilePending others.
  static constexpr uint32_t kUsable = 32;
  static_assert(kUsable + kMostWhilePending < kCount);
  TriangleSetup setups_[kCount];
  float varyings_[kCount][3 * kMaxVaryingComponents];
  uint32_t made_ = 0;
  TriangleSetup last_in_order_ = {};
  TileCoordinates coordinates_;
};

}  // namespace lapilli
