// The seam between geometry and rasterization. geometry/ fills a BinSet: set-up triangles in the order of the API, and
// for each tile the list of those that may touch it. raster/ consumes it tile by tile and asks for the next one
// (FrontEnd::next).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "geometry/draw_call.h"
#include "image/tile.h"
#include "shader/batch.h"

namespace lapilli {

// x and y of a BinVertex are clipped to this, so that 24.8 fixed point fits the edge functions.
constexpr double kGuardBand = 32768.0;  // pixels from framebuffer (0, 0)

// Pixels [x0, x1) x [y0, y1) in framebuffer space; empty where x1 <= x0 or y1 <= y0.
struct PixelRect {
  int32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool empty() const { return x1 <= x0 || y1 <= y0; }
  friend bool operator==(const PixelRect&, const PixelRect&) = default;
};
PixelRect intersect(const PixelRect& a, const PixelRect& b);

// A growing array of plain data that neither clears what it adds nor gives memory back before release().
template <class T>
class BinArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }
  T& operator[](size_t i) { return data_[i]; }
  const T& operator[](size_t i) const { return data_[i]; }
  const T* begin() const { return data_.get(); }
  const T* end() const { return data_.get() + size_; }
  uint64_t capacity_bytes() const { return capacity_ * sizeof(T); }

  void clear() { size_ = 0; }
  void release() { *this = BinArray(); }
  void reserve(size_t size) {
    if (size <= capacity_) return;
    const size_t capacity = std::max(size, capacity_ + capacity_ / 2);
    std::unique_ptr<T[]> data(new T[capacity]);
    std::copy_n(data_.get(), size_, data.get());
    data_ = std::move(data);
    capacity_ = capacity;
  }
  // What is new has no value yet.
  void resize(size_t size) {
    reserve(size);
    size_ = size;
  }
  void push_back(const T& value) {
    if (size_ == capacity_) reserve(size_ + 64);
    data_[size_++] = value;
  }

 private:
  std::unique_ptr<T[]> data_;
  size_t size_ = 0, capacity_ = 0;
};

// A vertex in framebuffer space. Triangles that share it share this.
struct BinVertex {
  int32_t x, y;  // 24.8 fixed point, at most kGuardBand pixels from (0, 0); those of no triangle may hold anything
  double z;      // without depth bias
  float inverse_w;
  uint32_t varyings;  // its first component in BinChunk::varyings
};

// The triangles of one draw in a chunk: what they have in common.
struct BinRun {
  uint32_t draw = 0;  // index into the pass's draws
  std::span<const Interpolation> varyings;
  float min_depth = 0, max_depth = 1;
  bool depth_bias = false;
  float bias_constant = 0, bias_clamp = 0, bias_slope = 0;
};

struct BinTriangle {
  uint16_t v[3];            // in BinChunk::vertices, clockwise on the screen (y down); v[0] has the flat varyings
  uint16_t run;             // in BinChunk::runs; kFrontFacing may be set
  uint16_t x0, y0, x1, y1;  // pixels [x0, x1) x [y0, y1): clipped to scissor, viewport and render area; never empty

  static constexpr uint16_t kFrontFacing = 0x8000;
  bool front_facing() const { return (run & kFrontFacing) != 0; }
  uint32_t run_index() const { return run & (kFrontFacing - 1u); }
  PixelRect bounds() const { return {x0, y0, x1, y1}; }
};
static_assert(sizeof(BinTriangle) == 16);

// The triangles of some consecutive primitives.
struct BinChunk {
  std::vector<BinRun> runs;
  BinArray<BinVertex> vertices;
  BinArray<float> varyings;
  BinArray<BinTriangle> triangles;
  std::vector<uint32_t> tile_first;  // [tile] first entry of the tile in `references`; one more at the end
  BinArray<uint32_t> references;     // indices into triangles, grouped by tile, in primitive order

  std::span<const uint32_t> tile(uint32_t index) const {
    return {references.begin() + tile_first[index], references.begin() + tile_first[index + 1]};
  }
  const BinRun& run_of(const BinTriangle& triangle) const { return runs[triangle.run_index()]; }
};

// The three edge functions for coverage, as integers in units of 1/256 of TriangleSetup's: with the top-left rule
// folded into c, pixel (x, y) is covered where a*x + b*y + c >= 0 for all three. |a|, |b| <= 2^24, so that inside a
// tile which an edge crosses the value fits 32 bits.
struct CoverageEdges {
  int32_t a[3], b[3];
  int64_t c[3];
};
CoverageEdges make_edges(const BinChunk& chunk, const BinTriangle& triangle);

// The same in TriangleSetup's units, E(x, y) = a*x + b*y + c for the centre of pixel (x, y), as integers. `owns`: a
// centre with E = 0 belongs to the triangle (top-left rule).
struct EdgeFunction {
  int64_t a, b, c;
  bool owns;
};
using EdgeFunctions = std::array<EdgeFunction, 3>;
// Through q -> r, positive on the other vertex's side. The interior of an edge that goes up lies at greater x, that of
// one to the right at greater y.
inline EdgeFunction make_edge_function(const BinVertex& q, const BinVertex& r) {
  const int64_t dx = int64_t{r.x} - q.x;
  const int64_t dy = int64_t{r.y} - q.y;
  return {-dy * 256, dx * 256, dx * (128 - int64_t{q.y}) - dy * (128 - int64_t{q.x}), dy < 0 || (dy == 0 && dx > 0)};
}
inline EdgeFunctions make_edge_functions(const BinChunk& chunk, const BinTriangle& triangle) {
  const BinVertex& p = chunk.vertices[triangle.v[0]];
  const BinVertex& q = chunk.vertices[triangle.v[1]];
  const BinVertex& r = chunk.vertices[triangle.v[2]];
  return {make_edge_function(q, r), make_edge_function(r, p), make_edge_function(p, q)};
}
DepthPlane make_depth_plane(const BinChunk& chunk, const BinTriangle& triangle, const EdgeFunctions& edges);

// What a triangle needs to be depth tested and shaded; `varyings` is left alone.
TriangleSetup make_triangle_setup(const BinChunk& chunk, const BinTriangle& triangle);
// TriangleSetup::varyings: writes 3 floats for each component of the run.
void make_varying_planes(const BinChunk& chunk, const BinTriangle& triangle, float* planes);

struct TileGrid {
  uint32_t columns = 0, rows = 0;
  uint32_t count() const { return columns * rows; }
};

struct BinSet {
  std::span<const BinChunk> chunks;  // in primitive order
  bool last = false;                 // no further set follows
};

}  // namespace lapilli
