// Bounds of depth, 64 blocks at once, for every SIMD target.
#include "raster/hierarchical_depth.h"

#include <array>
#include <cmath>

#include "base/simd_targets.h"
#include "raster/coverage.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/hierarchical_depth.cpp"
#include <hwy/foreach_target.h>

#include "base/lanes-inl.h"

#ifndef LAPILLI_RASTER_HIERARCHICAL_DEPTH_ONCE
#define LAPILLI_RASTER_HIERARCHICAL_DEPTH_ONCE
namespace lapilli {
namespace {

// The first pixel of the block of each bit.
struct BlockPositions {
  std::array<double, 64> x{}, y{};
};
constexpr BlockPositions kBlockPositions = [] {
  BlockPositions positions;
  for (uint32_t bit = 0; bit < 64; ++bit) {
    positions.x[bit] = kBlockSize * column_of_bit(bit);
    positions.y[bit] = kBlockSize * row_of_bit(bit);
  }
  return positions;
}();

}  // namespace
}  // namespace lapilli
#endif

HWY_BEFORE_NAMESPACE();
namespace lapilli {
namespace HWY_NAMESPACE {
namespace {

void relate(const BlockSlopes& slopes, const BlockRanges& stored, BlockRanges& triangle, DepthRelations& out) {
  const D low = broadcast(slopes.low);
  const D high = broadcast(slopes.high);
  const D dx = broadcast(slopes.dx);
  const D dy = broadcast(slopes.dy);
  const F least = broadcast(slopes.min);
  const F most = broadcast(slopes.max);
  DepthRelations is;
  for (int i = 0; i < kLanes; i += kVectorLanes) {
    const D step = load_d(&kBlockPositions.x[static_cast<size_t>(i)]) * dx +
                   load_d(&kBlockPositions.y[static_cast<size_t>(i)]) * dy;
    const F z_min = min(max(to_float(low + step), least), most);
    const F z_max = min(max(to_float(high + step), least), most);
    const F stored_min = load<F>(stored.min + i);
    const F stored_max = load<F>(stored.max + i);
    is.below |= bits_of(lt(z_max, stored_min)) << i;
    is.at_most |= bits_of(le(z_max, stored_min)) << i;
    is.above |= bits_of(lt(stored_max, z_min)) << i;
    is.at_least |= bits_of(le(stored_max, z_min)) << i;
    is.same |= bits_of(eq(z_min, z_max) & eq(stored_min, stored_max) & eq(z_min, stored_min)) << i;
    store(z_min, triangle.min + i);
    store(z_max, triangle.max + i);
  }
  out = is;
}

DepthRange range(const BlockRanges& blocks) {
  F low = load<F>(blocks.min);
  F high = load<F>(blocks.max);
  for (int i = kVectorLanes; i < kLanes; i += kVectorLanes) {
    low = min(low, load<F>(blocks.min + i));
    high = max(high, load<F>(blocks.max + i));
  }
  alignas(64) float lows[kVectorLanes], highs[kVectorLanes];
  store(low, lows);
  store(high, highs);
  DepthRange all{lows[0], highs[0]};
  for (int i = 1; i < kVectorLanes; ++i) {
    all.min = lows[i] < all.min ? lows[i] : all.min;
    all.max = highs[i] > all.max ? highs[i] : all.max;
  }
  return all;
}

void copy(BlockRanges& to, const BlockRanges& from, uint64_t blocks) {
  for (int i = 0; i < kVectorsPerBatch; ++i) {
    const int at = i * kVectorLanes;
    const M taken = mask_of(blocks, i);
    store(select(taken, load<F>(from.min + at), load<F>(to.min + at)), to.min + at);
    store(select(taken, load<F>(from.max + at), load<F>(to.max + at)), to.max + at);
  }
}

}  // namespace

extern const HierarchicalDepthFunctions kHierarchicalDepth;
const HierarchicalDepthFunctions kHierarchicalDepth = {relate, range, copy};

}  // namespace HWY_NAMESPACE
}  // namespace lapilli
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lapilli {
namespace {

constexpr PerTarget<const HierarchicalDepthFunctions> kTables = LAPILLI_PER_TARGET(kHierarchicalDepth);

float clamped(double z, const DepthBounds& bounds) {
  const float rounded = static_cast<float>(z);
  const float above = rounded < bounds.min ? bounds.min : rounded;
  return above > bounds.max ? bounds.max : above;
}

// The lowest and highest value of a rectangle of pixels relative to its first one.
struct Spread {
  double low, high;
  Spread(const DepthBounds& bounds, int32_t width, int32_t height) : low(-bounds.error), high(bounds.error) {
    const double x = (width - 1) * bounds.dx;
    const double y = (height - 1) * bounds.dy;
    (x < 0 ? low : high) += x;
    (y < 0 ? low : high) += y;
  }
};

BlockVerdicts verdicts(VkCompareOp compare, const DepthRelations& is) {
  switch (compare) {
    case VK_COMPARE_OP_NEVER:
      return {kAllBits, 0};
    case VK_COMPARE_OP_LESS:
      return {is.at_least, is.below};
    case VK_COMPARE_OP_EQUAL:
      return {is.below | is.above, is.same};
    case VK_COMPARE_OP_LESS_OR_EQUAL:
      return {is.above, is.at_most};
    case VK_COMPARE_OP_GREATER:
      return {is.at_most, is.above};
    case VK_COMPARE_OP_NOT_EQUAL:
      return {is.same, is.below | is.above};
    case VK_COMPARE_OP_GREATER_OR_EQUAL:
      return {is.below, is.at_least};
    default:
      return {0, kAllBits};
  }
}

}  // namespace

DepthBounds depth_bounds(const TriangleDepth& triangle, uint32_t tile_x, uint32_t tile_y) {
  const double k[2] = {triangle.plane.k1, triangle.plane.k2};
  DepthBounds bounds{triangle.plane.z0, 0, 0, 0, triangle.plane.min, triangle.plane.max, false};
  double magnitude = std::fabs(triangle.plane.z0);
  for (int i = 0; i < 2; ++i) {
    const double edge = triangle.a[i] * tile_x + triangle.b[i] * tile_y + triangle.c[i];
    bounds.z += edge * k[i];
    bounds.dx += triangle.a[i] * k[i];
    bounds.dy += triangle.b[i] * k[i];
    magnitude +=
        std::fabs(k[i]) * (std::fabs(edge) + kTileSize * (std::fabs(triangle.a[i]) + std::fabs(triangle.b[i])));
  }
  bounds.error = magnitude * 0x1p-47;
  bounds.known = magnitude < 1e30;  // also false for NaN
  return bounds;
}

DepthRange range_in_rect(const DepthBounds& bounds, const PixelRect& rect) {
  const Spread spread(bounds, rect.x1 - rect.x0, rect.y1 - rect.y0);
  const double first = bounds.z + rect.x0 * bounds.dx + rect.y0 * bounds.dy;
  return {clamped(first + spread.low, bounds), clamped(first + spread.high, bounds)};
}

BlockVerdicts judge(VkCompareOp compare, DepthRange triangle, DepthRange stored) {
  DepthRelations is;
  is.below = triangle.max < stored.min;
  is.at_most = triangle.max <= stored.min;
  is.above = triangle.min > stored.max;
  is.at_least = triangle.min >= stored.max;
  is.same = triangle.min == triangle.max && stored.min == stored.max && triangle.min == stored.min;
  return verdicts(compare, is);
}

BlockVerdicts judge(VkCompareOp compare, const DepthBounds& bounds, const BlockRanges& stored, BlockRanges& triangle) {
  const Spread spread(bounds, kBlockSize, kBlockSize);
  const BlockSlopes slopes = {
      bounds.z + spread.low, bounds.z + spread.high, bounds.dx, bounds.dy, bounds.min, bounds.max};
  DepthRelations is;
  hierarchical_depth_functions().relate(slopes, stored, triangle, is);
  return verdicts(compare, is);
}

const HierarchicalDepthFunctions& hierarchical_depth_functions() { return for_target(kTables); }

}  // namespace lapilli
#endif
