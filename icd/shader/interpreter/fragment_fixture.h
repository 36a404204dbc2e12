// A fragment batch with triangles, depth and colour planes, for tests and benchmarks of single ops.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

#include "image/format.h"
#include "image/sampling.h"
#include "image/texel.h"
#include "shader/interpreter/test_frame.h"

namespace lapilli {

using Lanes = std::array<uint32_t, kBatchLanes>;
inline float f(uint32_t bits) { return std::bit_cast<float>(bits); }
inline uint32_t u(float value) { return std::bit_cast<uint32_t>(value); }

inline Op operands(uint16_t dst, uint16_t a = 0, uint16_t b = 0, uint16_t c = 0, uint32_t imm = 0, uint32_t imm2 = 0) {
  return Op{nullptr, dst, a, b, c, imm, imm2};
}

// Whose quads a batch has: of four triangles in turn or of one, at random even places or in one block; or the lanes of
// a block have triangles of their own, each once or several times.
enum class Quads { many_triangles, one_triangle, block, block_of_many, lanes, shared_by_lanes };

struct FragmentTest {
  TestFrame test;
  FragmentBatch batch = {};
  TriangleSetup triangles[4] = {};
  float varyings[4][9] = {};
  alignas(64) float depth[4096] = {};
  alignas(64) uint32_t color[4096] = {};
  const TexelFunctions* colors[1] = {};
  uint64_t counter = 0;
  LaneTriangles lane_triangles = {};

  FragmentTest(SimdTarget target, Quads quads) : test(target) {
    const bool one_triangle = quads == Quads::one_triangle || quads == Quads::block;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> reals(-2, 2);
    for (TriangleSetup& t : triangles) {
      const size_t index = static_cast<size_t>(&t - triangles);
      for (int e = 0; e < 3; ++e) {
        t.edge_a[e] = static_cast<double>(static_cast<int64_t>(random() % 2000001) - 1000000) * 256;
        t.edge_b[e] = static_cast<double>(static_cast<int64_t>(random() % 2000001) - 1000000) * 256;
        t.edge_c[e] = static_cast<double>(static_cast<int64_t>(random())) * 1024 - 1e12;
        t.inverse_w[e] = std::fabs(reals(random)) + 0.125f;
      }
      t.inverse_area2 = 1.0 / (t.edge_c[0] + t.edge_c[1] + t.edge_c[2] + 0.5);
      for (double* each : {&t.depth.z0, &t.depth.k1, &t.depth.k2}) *each = static_cast<double>(reals(random));
      t.depth.k1 *= t.inverse_area2;
      t.depth.k2 *= t.inverse_area2;
      t.depth.min = 0.125f;
      t.depth.max = 0.875f;
      t.front_facing = index % 2 == 0 ? 0xFFFFFFFFu : 0;
      for (float& v : varyings[index]) v = reals(random);
      t.varyings = varyings[index];
    }
    for (uint32_t q = 0; q < kBatchQuads; ++q) {
      batch.triangle[q] = &triangles[one_triangle ? 0 : q % 4];
      batch.x[q] = static_cast<uint16_t>(random() % 4096 * 2);
      batch.y[q] = static_cast<uint16_t>(random() % 4096 * 2);
      batch.quad_in_tile[q] = static_cast<uint16_t>(q * 61 % 1024);
    }
    if (quads == Quads::block || quads >= Quads::block_of_many) use_block(1232, 4048, 37);
    if (quads >= Quads::lanes) use_lanes(quads == Quads::lanes);
    batch.one_triangle = one_triangle;
    batch.planes.depth = reinterpret_cast<std::byte*>(depth);
    batch.planes.color[0] = reinterpret_cast<std::byte*>(color);
    batch.samples_passed = &counter;
    for (int i = 0; i < 4; ++i) batch.blend_constants[i] = 0.25f * static_cast<float>(i);
    Frame& frame = test.frame();
    frame.fragments = &batch;
    frame.depth = &texel_functions(*find_format(VK_FORMAT_D32_SFLOAT), target);
    colors[0] = &texel_functions(*find_format(VK_FORMAT_R8G8B8A8_UNORM), target);
    frame.colors = colors;
    frame.sampling = &sampling_functions(target);
  }

  // Block `number` of the tile, its first pixel at (x, y).
  void use_block(uint32_t first_x, uint32_t first_y, uint32_t number) {
    for (uint32_t q = 0; q < kBatchQuads; ++q) {
      batch.x[q] = static_cast<uint16_t>(first_x + q % 4 * 2);
      batch.y[q] = static_cast<uint16_t>(first_y + q / 4 * 2);
      batch.quad_in_tile[q] = static_cast<uint16_t>(number * kBatchQuads + q);
    }
    batch.whole_block = true;
  }

  void use_lanes(bool by_lane) {
    lane_triangles.by_lane = by_lane;
    for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
      const uint32_t slot = by_lane ? lane : (lane * 5 + 3) % LaneTriangles::kMostShared;
      lane_triangles.slot[lane] = slot;
      const TriangleSetup& t = triangles[slot % 4];
      for (size_t e = 0; e < 2; ++e) {
        lane_triangles.edge_a[e][slot] = t.edge_a[e + 1];
        lane_triangles.edge_b[e][slot] = t.edge_b[e + 1];
        lane_triangles.edge_c[e][slot] = t.edge_a[e + 1] * batch.x[0] + t.edge_b[e + 1] * batch.y[0] + t.edge_c[e + 1];
      }
      lane_triangles.inverse_area2[slot] = t.inverse_area2;
      for (size_t v = 0; v < 3; ++v) lane_triangles.inverse_w[v][slot] = t.inverse_w[v];
      lane_triangles.front_facing[slot] = t.front_facing;
      for (size_t i = 0; i < 9; ++i) lane_triangles.varyings[i / 3][i % 3][slot] = varyings[slot % 4][i];
    }
    batch.lane_triangles = &lane_triangles;
    std::fill_n(batch.triangle, kBatchQuads, nullptr);
  }

  const TriangleSetup& triangle(uint32_t lane) const {
    return batch.lane_triangles != nullptr ? triangles[lane_triangles.slot[lane] % 4] : *batch.triangle[lane / 4];
  }
  uint32_t x(uint32_t lane) const { return batch.x[lane / 4] + (lane & 1); }
  uint32_t y(uint32_t lane) const { return batch.y[lane / 4] + (lane >> 1 & 1); }
  // In integers.
  double edge_value(uint32_t lane, int edge) const {
    const TriangleSetup& t = triangle(lane);
    const int64_t e = static_cast<int64_t>(t.edge_a[edge]) * x(lane) + static_cast<int64_t>(t.edge_b[edge]) * y(lane) +
                      static_cast<int64_t>(t.edge_c[edge]);
    return static_cast<double>(e);
  }
  // As the equation says.
  double lambda(uint32_t lane, int edge) const { return edge_value(lane, edge) * triangle(lane).inverse_area2; }
  size_t texel(uint32_t lane) const { return batch.quad_in_tile[lane / 4] * 4u + (lane & 3); }
  Lanes run(Opcode op, Op operands, uint32_t result = 4) {
    test.add(op, kStore, operands);
    test.run();
    return result_of(result);
  }
  Lanes result_of(uint32_t reg) {
    Lanes lanes;
    test.read(reg, lanes);
    return lanes;
  }
};

}  // namespace lapilli
