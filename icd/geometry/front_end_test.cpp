// The whole front end against a plain computation, one triangle after the other; reuse, order, memory.
#include "geometry/front_end.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <map>
#include <random>

#include "base/simd_dispatch.h"
#include "geometry/geometry_fixture.h"

namespace lapilli {
namespace {

constexpr uint32_t kWidth = 1280, kHeight = 720;
constexpr PixelRect kArea = {0, 0, kWidth, kHeight};

// A triangle that came out, vertex by vertex in the order of the bins, and where it lies.
struct Result {
  uint32_t draw;
  bool front;
  std::array<std::array<uint64_t, 7>, 3> vertices;  // x, y, bits of z, 1/w and the varyings
  PixelRect bounds;
  bool operator==(const Result&) const = default;
};

struct Collected {
  std::vector<Result> triangles;
  uint64_t vertices = 0;
  uint32_t sets = 0;
};

Collected collect(std::span<const DrawCall> draws, unsigned threads = 1, const PixelRect& area = kArea) {
  ThreadPool pool(threads);
  FrontEnd front_end(pool);
  ExecutionLimits limits;
  front_end.begin(draws, tiles_of(kWidth, kHeight), area, limits);
  Collected all;
  BinSet set;
  do {
    EXPECT_TRUE(front_end.next(set));
    ++all.sets;
    for (const BinChunk& chunk : set.chunks) {
      all.vertices += chunk.vertices.size();
      for (const BinTriangle& triangle : chunk.triangles) {
        const BinRun& run = chunk.run_of(triangle);
        Result result{run.draw, triangle.front_facing(), {}, triangle.bounds()};
        for (size_t i = 0; i < 3; ++i) {
          const BinVertex& vertex = chunk.vertices[triangle.v[i]];
          result.vertices[i] = {static_cast<uint32_t>(vertex.x), static_cast<uint32_t>(vertex.y),
                                std::bit_cast<uint64_t>(vertex.z), std::bit_cast<uint32_t>(vertex.inverse_w)};
          for (size_t k = 0; k < run.varyings.size(); ++k) {
            result.vertices[i][4 + k] = std::bit_cast<uint32_t>(chunk.varyings[vertex.varyings + k]);
          }
        }
        all.triangles.push_back(result);
      }
    }
  } while (!set.last);
  return all;
}

// What a triangle of vertices inside of the clip volume has to give: the rules of the specification, with doubles and
// 64-bit integers, and every pixel of the bounds looked at.
struct Expected {
  bool has_pixel = false;  // after culling
  Result result;
};
int64_t edge(const int64_t (&a)[2], const int64_t (&b)[2], int64_t x, int64_t y) {
  return (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
}
Expected expect_triangle(const TestProgram& program, uint32_t draw, const MeshVertex (&in)[3]) {
  Expected out;
  out.result.draw = draw;
  int64_t p[3][2];
  std::array<std::array<uint64_t, 7>, 3> vertices;
  for (size_t v = 0; v < 3; ++v) {
    const float half_width = program.state.viewport.width / 2, half_height = program.state.viewport.height / 2;
    const float x = in[v].x * half_width + (program.state.viewport.x + half_width);
    const float y = in[v].y * half_height + (program.state.viewport.y + half_height);
    p[v][0] = std::lrint(static_cast<double>(x) * 256);
    p[v][1] = std::lrint(static_cast<double>(y) * 256);
    vertices[v] = {static_cast<uint32_t>(p[v][0]), static_cast<uint32_t>(p[v][1]),
                   std::bit_cast<uint64_t>(static_cast<double>(in[v].z)), std::bit_cast<uint32_t>(1.0f)};
    for (size_t k = 0; k < 3; ++k) vertices[v][4 + k] = std::bit_cast<uint32_t>(in[v].varying[k]);
  }
  const int64_t area = edge(p[0], p[1], p[2][0], p[2][1]);
  if (area == 0) return out;
  const RasterState& raster = program.state.raster;
  out.result.front = (area > 0) == (raster.front_face == VK_FRONT_FACE_CLOCKWISE);
  if ((raster.cull_mode & (out.result.front ? VK_CULL_MODE_FRONT_BIT : VK_CULL_MODE_BACK_BIT)) != 0) return out;
  if (area < 0) {
    std::swap(p[1], p[2]);
    std::swap(vertices[1], vertices[2]);
  }
  out.result.vertices = vertices;
  const auto centres_from = [](int64_t v) { return (v + 127) >> 8; };
  const auto centres_to = [](int64_t v) { return (v + 128) >> 8; };
  const VkRect2D& scissor = program.state.scissor;
  const PixelRect limits = {scissor.offset.x, scissor.offset.y,
                            scissor.offset.x + static_cast<int32_t>(scissor.extent.width),
                            scissor.offset.y + static_cast<int32_t>(scissor.extent.height)};
  const PixelRect around = {static_cast<int32_t>(centres_from(std::min({p[0][0], p[1][0], p[2][0]}))),
                            static_cast<int32_t>(centres_from(std::min({p[0][1], p[1][1], p[2][1]}))),
                            static_cast<int32_t>(centres_to(std::max({p[0][0], p[1][0], p[2][0]}))),
                            static_cast<int32_t>(centres_to(std::max({p[0][1], p[1][1], p[2][1]})))};
  out.result.bounds = intersect(around, intersect(limits, kArea));
  for (int64_t y = out.result.bounds.y0; y < out.result.bounds.y1; ++y) {
    for (int64_t x = out.result.bounds.x0; x < out.result.bounds.x1; ++x) {
      bool inside = true;
      for (int i = 0; i < 3; ++i) {
        const auto& from = p[i];
        const auto& to = p[(i + 1) % 3];
        const int64_t value = edge(from, to, 256 * x + 128, 256 * y + 128);
        const bool left = to[1] < from[1], top = to[1] == from[1] && to[0] > from[0];
        inside = inside && (value > 0 || (value == 0 && (left || top)));
      }
      out.has_pixel = out.has_pixel || inside;
    }
  }
  return out;
}

std::vector<MeshVertex> random_mesh(uint32_t triangles, float size, std::mt19937& random) {
  std::uniform_real_distribution<float> place(-1.1f, 1.1f), offset(-size, size), depth(0, 1);
  std::vector<MeshVertex> vertices;
  for (uint32_t i = 0; i < triangles; ++i) {
    const float x = place(random), y = place(random);
    for (uint32_t v = 0; v < 3; ++v) {
      vertices.push_back({x + offset(random), y + offset(random), depth(random), {x, y, static_cast<float>(v)}});
    }
  }
  return vertices;
}

bool is_small(const PixelRect& bounds) { return bounds.x1 - bounds.x0 <= 2 && bounds.y1 - bounds.y0 <= 2; }

class FrontEndTargets : public testing::TestWithParam<SimdTarget> {
 protected:
  void SetUp() override { ASSERT_TRUE(set_simd_target(GetParam())); }
  void TearDown() override {
    set_simd_target(best_simd_target());
    set_kept_removals(0);
  }
};

// Nothing that has a pixel is lost; small triangles without one are left out, larger ones may stay.
TEST_P(FrontEndTargets, TrianglesAreThoseOfThePlainRules) {
  std::mt19937 random(7);
  for (const float size : {0.0005f, 0.002f, 0.01f, 0.3f}) {
    for (const VkCullModeFlags cull : {VK_CULL_MODE_NONE, VK_CULL_MODE_BACK_BIT}) {
      const uint32_t count = size < 0.1f ? 1500 : 200;
      std::vector<MeshVertex> vertices = random_mesh(count, size, random);
      vertices[4] = vertices[3];                       // no area
      vertices[6].x = vertices[7].x = 5 / 640.0f - 1;  // an edge through pixel corners
      TestProgram program;
      program.bind(vertices);
      program.state.raster.cull_mode = cull;
      program.state.raster.front_face = size < 0.005f ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE;
      program.state.scissor = {{3, 2}, {1201, 700}};
      DrawLedger ledger;
      DrawCall draw = program.draw(3 * count);
      draw.ledger = &ledger;
      const Collected found = collect({&draw, 1});
      size_t next = 0;
      for (uint32_t i = 0; i < count; ++i) {
        const MeshVertex corners[3] = {vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]};
        const Expected expected = expect_triangle(program, 0, corners);
        const bool here = next < found.triangles.size() && found.triangles[next] == expected.result;
        if (expected.has_pixel) {
          ASSERT_TRUE(here) << i << " " << size;
        }
        if (here) {
          EXPECT_TRUE(expected.has_pixel || !is_small(expected.result.bounds)) << i;
          ++next;
        }
      }
      EXPECT_EQ(next, found.triangles.size());
      EXPECT_EQ(ledger.lines[static_cast<size_t>(Removal::triangles)].count, count - found.triangles.size());
    }
  }
}

// LAPILLI_KEEP=triangles: what merely has no pixel is binned, with bounds inside of the scissor.
TEST_P(FrontEndTargets, KeptTrianglesAreBinned) {
  std::mt19937 random(8);
  const std::vector<MeshVertex> vertices = random_mesh(1000, 0.001f, random);
  TestProgram program;
  program.bind(vertices);
  program.state.scissor = {{3, 2}, {1201, 700}};
  const DrawCall draw = program.draw(3000);
  set_kept_removals(1u << static_cast<uint32_t>(Removal::triangles));
  const Collected found = collect({&draw, 1});
  EXPECT_GT(found.triangles.size(), 950u);  // some have no area
  for (const Result& result : found.triangles) {
    EXPECT_FALSE(result.bounds.empty());
    EXPECT_EQ(intersect(result.bounds, {3, 2, 1204, 702}), result.bounds);
  }
}

// A clipped triangle among others keeps its place, and is the same on every target.
TEST_P(FrontEndTargets, ClippedTrianglesStayInOrder) {
  std::mt19937 random(9);
  std::vector<MeshVertex> vertices = random_mesh(100, 0.2f, random);
  for (size_t i = 0; i < vertices.size(); i += 7) vertices[i].z = -0.5f;
  for (size_t i = 0; i < vertices.size(); i += 31) vertices[i].x = 100;
  vertices[30].x = std::numeric_limits<float>::quiet_NaN();
  for (size_t i = 60; i < 63; ++i) vertices[i].z = 1.5f;  // all beyond the far plane
  TestProgram program;
  program.bind(vertices);
  const DrawCall draw = program.draw(300);
  const Collected found = collect({&draw, 1});
  ASSERT_TRUE(set_simd_target(SimdTarget::kBaseline));
  EXPECT_EQ(collect({&draw, 1}).triangles, found.triangles);
  size_t last = 0;
  for (const Result& result : found.triangles) {
    // The first varying is the x of the triangle's centre, for all vertices.
    const float x = std::bit_cast<float>(static_cast<uint32_t>(result.vertices[0][4]));
    while (last < 100 && std::fabs(vertices[3 * last].varying[0] - x) > 1e-5f) ++last;
    ASSERT_LT(last, 100u);
    EXPECT_NE(last, 10u);
    EXPECT_NE(last, 20u);
  }
}

INSTANTIATE_TEST_SUITE_P(AllTargets, FrontEndTargets, testing::ValuesIn(supported_simd_targets()),
                         [](const auto& target) { return std::string(simd_target_name(target.param)); });

class FrontEndTest : public testing::Test {
 protected:
  void TearDown() override { set_kept_removals(0); }
};

uint64_t saved_vertices(const DrawLedger& ledger) { return ledger.lines[static_cast<size_t>(Removal::vertices)].count; }

TEST_F(FrontEndTest, VerticesRunOnce) {
  const GridMesh mesh(10, 10);
  TestProgram program;
  program.bind(mesh.vertices);
  DrawLedger ledger;
  DrawCall draw = program.draw_indexed(mesh.indices);
  draw.ledger = &ledger;
  const Collected found = collect({&draw, 1});
  EXPECT_EQ(found.vertices, 11u * 11u);
  EXPECT_EQ(saved_vertices(ledger), 600u - 11 * 11);

  ledger = {};
  set_kept_removals(1u << static_cast<uint32_t>(Removal::vertices));
  const Collected kept = collect({&draw, 1});
  EXPECT_EQ(kept.vertices, 600u);
  EXPECT_EQ(saved_vertices(ledger), 0u);
  EXPECT_EQ(kept.triangles, found.triangles);
}

// Indices that fall on the same entry of the table.
TEST_F(FrontEndTest, VerticesFarApartAreNotMixedUp) {
  std::vector<MeshVertex> vertices(3 * VertexStage::kMostVertices);
  std::minstd_rand random(3);
  for (MeshVertex& vertex : vertices) vertex.varying[0] = static_cast<float>(random() % 1000);
  std::vector<uint32_t> indices;
  for (uint32_t i = 0; i < 300; ++i) {
    const uint32_t index = static_cast<uint32_t>(random() % 4 + random() % 3 * VertexStage::kMostVertices);
    indices.push_back(index);
    vertices[index].x = static_cast<float>(index % 97) / 100;
    vertices[index].y = static_cast<float>(index % 89) / 100;
  }
  TestProgram program;
  program.bind(vertices);
  const DrawCall draw = program.draw_indexed(indices);
  const Collected found = collect({&draw, 1});
  set_kept_removals(1u << static_cast<uint32_t>(Removal::vertices));
  EXPECT_EQ(collect({&draw, 1}).triangles, found.triangles);
  EXPECT_FALSE(found.triangles.empty());
}

// Draws that share their blocks share batches and vertices; those with other blocks do not.
TEST_F(FrontEndTest, DrawsShareVerticesWhereNothingCanTell) {
  const GridMesh mesh(2, 2);
  TestProgram program;
  program.bind(mesh.vertices);
  std::vector<DrawCall> draws(3, program.draw_indexed(mesh.indices));
  Collected found = collect(draws);
  EXPECT_EQ(found.vertices, 9u);
  ASSERT_EQ(found.triangles.size(), 24u);
  for (uint32_t i = 0; i < 24; ++i) EXPECT_EQ(found.triangles[i].draw, i / 8);

  draws[1].first_instance = 5;
  EXPECT_EQ(collect(draws).vertices, 27u);
  draws[1].first_instance = 0;
  const ResourceTable other;
  draws[1].resources = &other;
  EXPECT_EQ(collect(draws).vertices, 27u);
}

// The third draw has the second one's instance, and the vertices of the first one are of another.
TEST_F(FrontEndTest, ListsBetweenIndexedDrawsOfOtherInstances) {
  const GridMesh mesh(2, 2);
  TestProgram program;
  program.bind(mesh.vertices);
  std::vector<DrawCall> draws = {program.draw_indexed(mesh.indices), program.draw(3),
                                 program.draw_indexed(mesh.indices)};
  EXPECT_EQ(collect(draws).vertices, 9u + 3);
  draws[1].first_instance = draws[2].first_instance = 5;
  EXPECT_EQ(collect(draws).vertices, 9u + 3 + 9);
}

// Draws of 1 to 90 triangles, so that batches hold several draws and draws need several batches; vertices that two
// draws have in common have other varyings in each.
TEST_P(FrontEndTargets, DrawsWithOtherPushConstantsKeepTheirs) {
  TestProgram program(kWidth, kHeight, true);
  const GridMesh grid(40, 30);
  program.bind(grid.vertices);
  constexpr uint32_t kDraws = 60;
  float pushed[kDraws][4];
  ResourceTable tables[kDraws];
  std::vector<std::vector<uint32_t>> indices(kDraws);
  std::vector<DrawCall> draws;
  std::mt19937 random(7);
  const auto below = [&](uint32_t n) { return static_cast<uint32_t>(random() % n); };
  for (uint32_t i = 0; i < kDraws; ++i) {
    for (float& value : pushed[i]) value = static_cast<float>(below(1000));
    tables[i].push_constants = reinterpret_cast<const std::byte*>(pushed[i]);
    tables[i].push_constant_bytes = sizeof pushed[i];
    const uint32_t first = below(1000), count = 1 + below(90);
    indices[i].assign(grid.indices.begin() + 3 * first, grid.indices.begin() + 3 * (first + count));
    draws.push_back(below(3) == 0 ? program.draw(3 * count) : program.draw_indexed(indices[i]));
    draws[i].resources = &tables[below(4) == 0 && i > 0 ? i - 1 : i];
  }
  std::vector<Result> alone;
  for (uint32_t i = 0; i < kDraws; ++i) {
    for (Result& each : collect(std::span(draws).subspan(i, 1)).triangles) {
      each.draw = i;
      alone.push_back(each);
    }
  }
  program.programs.vertices_read_resources = false;
  EXPECT_TRUE(collect(draws).triangles == alone);
  EXPECT_TRUE(collect(draws, 3).triangles == alone);
  program.programs.vertices_read_resources = true;
  EXPECT_TRUE(collect(draws).triangles == alone);
}

TEST_F(FrontEndTest, OrderDoesNotDependOnThreadsOrChunks) {
  std::mt19937 random(5);
  std::minstd_rand pick(5);
  const std::vector<MeshVertex> vertices = random_mesh(3000, 0.02f, random);
  TestProgram program, strips;
  program.bind(vertices);
  strips.bind(vertices);
  strips.state.raster.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP;
  strips.state.raster.primitive_restart = true;
  std::vector<uint32_t> indices;
  for (uint32_t i = 0; i < 9000; ++i)
    indices.push_back(pick() % 11 == 0 ? 0xFFFFFFFFu : static_cast<uint32_t>(pick() % 9000));
  std::vector<DrawCall> draws;
  for (uint32_t i = 0; i < 40; ++i) {
    draws.push_back(i % 3 == 0 ? strips.draw_indexed(indices) : program.draw(i % 5 * 1000));
    draws.back().instance_count = i % 4;
  }
  const Collected one = collect(draws, 1);
  EXPECT_EQ(collect(draws, 3).triangles, one.triangles);
  for (size_t i = 1; i < one.triangles.size(); ++i) ASSERT_LE(one.triangles[i - 1].draw, one.triangles[i].draw);

  // Each alone gives what they give together, and instances follow one another.
  std::vector<Result> apart;
  for (uint32_t i = 0; i < draws.size(); ++i) {
    DrawCall draw = draws[i];
    draw.instance_count = 1;
    std::vector<Result> alone = collect({&draw, 1}).triangles;
    for (Result& result : alone) result.draw = i;
    for (uint32_t k = 0; k < draws[i].instance_count; ++k) apart.insert(apart.end(), alone.begin(), alone.end());
  }
  EXPECT_EQ(apart, one.triangles);
}

TEST_F(FrontEndTest, DrawsWithoutEffectAreSkipped) {
  const GridMesh mesh(5, 5);
  TestProgram program;
  program.bind(mesh.vertices);
  DrawLedger ledger;
  DrawCall draw = program.draw_indexed(mesh.indices);
  draw.ledger = &ledger;
  draw.instance_count = 3;
  const auto vertices = [&] { return collect({&draw, 1}).vertices; };
  EXPECT_EQ(vertices(), 3 * 36u);
  ledger = {};
  program.state.scissor = {{kWidth, 0}, {100, 100}};
  EXPECT_EQ(vertices(), 0u);
  EXPECT_EQ(ledger.lines[static_cast<size_t>(Removal::triangles)].count, 150u);
  set_kept_removals(1u << static_cast<uint32_t>(Removal::triangles));
  EXPECT_EQ(vertices(), 3 * 36u);
  set_kept_removals(0);
  program.state.scissor = {{0, 0}, {100, 100}};
  program.state.raster.cull_mode = VK_CULL_MODE_FRONT_AND_BACK;
  EXPECT_EQ(vertices(), 0u);
  program.state.raster.cull_mode = VK_CULL_MODE_NONE;
  program.state.raster.rasterizer_discard = true;
  EXPECT_EQ(vertices(), 0u);
  program.state.raster.rasterizer_discard = false;
  program.programs.fragment_reads_nothing = true;  // and it writes no depth
  EXPECT_EQ(vertices(), 0u);
  uint64_t samples = 0;
  draw.samples_passed = &samples;
  EXPECT_EQ(vertices(), 3 * 36u);
  draw.samples_passed = nullptr;
  program.programs.depth_write = true;
  EXPECT_EQ(vertices(), 3 * 36u);
}

// Each tile lists, in order, the triangles whose bounds reach it; those that lie in one row or column of tiles all of
// them, larger ones not where an edge leaves the tile out.
TEST_F(FrontEndTest, TilesListTheirTriangles) {
  std::mt19937 random(11);
  std::vector<MeshVertex> vertices = random_mesh(600, 0.02f, random);
  const std::vector<MeshVertex> large = random_mesh(100, 0.4f, random);
  vertices.insert(vertices.begin() + 900, large.begin(), large.end());
  TestProgram program;
  program.bind(vertices);
  const DrawCall draw = program.draw(2100);
  ThreadPool pool(1);
  FrontEnd front_end(pool);
  ExecutionLimits limits;
  const TileGrid grid = tiles_of(kWidth, kHeight);
  front_end.begin({&draw, 1}, grid, kArea, limits);
  BinSet set;
  ASSERT_TRUE(front_end.next(set));
  size_t left_out = 0;
  for (const BinChunk& chunk : set.chunks) {
    for (uint32_t tile = 0; tile < grid.count(); ++tile) {
      const int32_t x = static_cast<int32_t>(tile % grid.columns * kTileSize);
      const int32_t y = static_cast<int32_t>(tile / grid.columns * kTileSize);
      const int32_t size = static_cast<int32_t>(kTileSize);
      const std::span<const uint32_t> list = chunk.tile(tile);
      size_t next = 0;
      for (uint32_t t = 0; t < chunk.triangles.size(); ++t) {
        const PixelRect bounds = chunk.triangles[t].bounds();
        const bool reaches = !intersect(bounds, {x, y, x + size, y + size}).empty();
        const bool listed = next < list.size() && list[next] == t;
        const bool one_column = bounds.x0 / size == (bounds.x1 - 1) / size;
        const bool one_row = bounds.y0 / size == (bounds.y1 - 1) / size;
        if (reaches && (one_column || one_row)) {
          ASSERT_TRUE(listed) << tile << " " << t;
        }
        ASSERT_TRUE(reaches || !listed) << tile << " " << t;
        left_out += reaches && !listed;
        next += listed;
      }
      ASSERT_EQ(next, list.size());
    }
  }
  EXPECT_GT(left_out, 0u);
}

// A draw of no triangle at all, 2^32 - 1 times.
TEST_F(FrontEndTest, EmptyDrawsOfManyInstancesEnd) {
  const GridMesh mesh(1, 1);
  TestProgram program;
  program.bind(mesh.vertices);
  DrawCall draws[2] = {program.draw(2), program.draw_indexed(mesh.indices)};
  draws[0].instance_count = UINT32_MAX;
  EXPECT_EQ(collect(draws).triangles.size(), 2u);
}

}  // namespace
}  // namespace lapilli
