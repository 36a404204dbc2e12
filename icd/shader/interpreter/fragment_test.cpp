// Tests of single ops: vertex fetch, built-ins, interpolation, depth test, colours.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "shader/fixed_function.h"
#include "shader/interpreter/fragment_fixture.h"

namespace lapilli {
namespace {

template <class Check>
void for_all(Check&& check) {
  for (SimdTarget target : supported_simd_targets()) {
    for (Quads quads : {Quads::many_triangles, Quads::one_triangle, Quads::block, Quads::block_of_many, Quads::lanes,
                        Quads::shared_by_lanes})
      check(target, quads);
  }
}

TEST(Op, frag_linear) {
  for_all([](SimdTarget target, Quads quads) {
    FragmentTest t(target, quads);
    const Lanes l1 = t.run(Opcode::frag_linear, operands(4));
    const Lanes l2 = t.result_of(5);
    for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
      EXPECT_EQ(l1[lane], u(static_cast<float>(t.lambda(lane, 1))));
      EXPECT_EQ(l2[lane], u(static_cast<float>(t.lambda(lane, 2))));
    }
  });
}

TEST(Op, frag_linear_at) {
  for_all([](SimdTarget target, Quads quads) {
    FragmentTest t(target, quads);
    std::mt19937 random(9);
    std::uniform_real_distribution<float> offset(-0.5f, 0.5f);
    Lanes right, down;
    for (uint32_t lane = 0; lane < kBatchLanes; ++lane) right[lane] = u(offset(random)), down[lane] = u(offset(random));
    t.test.write(0, right);
    t.test.write(1, down);
    const Lanes l1 = t.run(Opcode::frag_linear_at, operands(4, 0, 1));
    const Lanes l2 = t.result_of(5);
    for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
      const TriangleSetup& triangle = t.triangle(lane);
      const double x = static_cast<double>(f(right[lane])), y = static_cast<double>(f(down[lane]));
      const auto expected = [&](int e) {
        const double step = triangle.edge_a[e] * x + triangle.edge_b[e] * y;
        return u(static_cast<float>((t.edge_value(lane, e) + step) * triangle.inverse_area2));
      };
      EXPECT_EQ(l1[lane], expected(1));
      EXPECT_EQ(l2[lane], expected(2));
    }
  });
}

TEST(Op, frag_depth) {
  for_all([](SimdTarget target, Quads quads) {
    if (quads >= Quads::lanes) return;  // not for programs that read depth
    FragmentTest t(target, quads);
    const Lanes got = t.run(Opcode::frag_depth, operands(4));
    for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
      const DepthPlane& plane = t.triangle(lane).depth;
      const float depth =
          static_cast<float>((t.edge_value(lane, 1) * plane.k1 + t.edge_value(lane, 2) * plane.k2) + plane.z0);
      EXPECT_EQ(f(got[lane]), std::min(std::max(depth, 0.125f), 0.875f));
    }
  });
}

Lanes fractions(uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> reals(0, 0.5f);
  Lanes lanes;
  for (uint32_t& lane : lanes) lane = u(reals(random));
  return lanes;
}

TEST(Op, frag_perspective) {
  for_all([](SimdTarget target, Quads quads) {
    FragmentTest t(target, quads);
    const Lanes a = fractions(1), b = fractions(2);
    t.test.write(0, a);
    t.test.write(1, b);
    const Lanes l1 = t.run(Opcode::frag_perspective, operands(4, 0, 1));
    const Lanes l2 = t.result_of(5), inverse_w = t.result_of(6);
    for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
      const float* w = t.triangle(lane).inverse_w;
      const float t0 = ((1.0f - f(a[lane])) - f(b[lane])) * w[0];
      const float t1 = f(a[lane]) * w[1];
      const float t2 = f(b[lane]) * w[2];
      const float sum = (t0 + t1) + t2;
      EXPECT_EQ(f(inverse_w[lane]), sum);
      EXPECT_EQ(f(l1[lane]), t1 / sum);
      EXPECT_EQ(f(l2[lane]), t2 / sum);
    }
  });
}

TEST(Op, interpolate) {
  for_all([](SimdTarget target, Quads quads) {
    FragmentTest t(target, quads);
    const Lanes a = fractions(1), b = fractions(2);
    t.test.write(0, a);
    t.test.write(1, b);
    t.run(Opcode::interpolate, operands(4, 0, 1, 2, 1));
    for (uint32_t k = 0; k < 2; ++k) {
      const Lanes got = t.result_of(4 + k);
      for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
        const float* v = t.triangle(lane).varyings + 3 * (1 + k);
        EXPECT_EQ(f(got[lane]), std::fma(f(b[lane]), v[2], std::fma(f(a[lane]), v[1], v[0])));
      }
    }
  });
}

// What the three ops that it stands for give.
void expect_fused_interpolation(FragmentTest& t) {
  t.run(Opcode::frag_linear, operands(0));
  t.run(Opcode::frag_perspective, operands(2, 0, 1));
  t.run(Opcode::interpolate, operands(5, 2, 3, 2, 1));
  t.run(Opcode::interpolate_perspective, operands(8, 0, 0, 2, 1));
  EXPECT_EQ(t.result_of(8), t.result_of(5));
  EXPECT_EQ(t.result_of(9), t.result_of(6));
}

TEST(Op, interpolate_perspective) {
  for_all([](SimdTarget target, Quads quads) {
    FragmentTest t(target, quads);
    expect_fused_interpolation(t);
  });
}

// Without perspective the sum of the coordinates is nearly 1, and there is no division. Varyings that are the
// coordinates themselves show each bit.
TEST(Op, InterpolateWithoutPerspective) {
  for (SimdTarget target : supported_simd_targets()) {
    FragmentTest t(target, Quads::block);
    std::mt19937_64 random(3);
    const float coordinates[] = {0, 0, 0, 0, 1, 0, 0, 0, 1};
    std::copy(std::begin(coordinates), std::end(coordinates), t.varyings[0]);
    TriangleSetup& triangle = t.triangles[0];
    std::fill_n(triangle.inverse_w, 3, 1.0f);
    for (int round = 0; round < 4000; ++round) {
      // A triangle around the block, a little larger than that or much.
      const int64_t area2 = int64_t{1} << (12 + random() % 36) | static_cast<int64_t>(random() % 4096);
      const int64_t step = area2 / (int64_t{64} << random() % 24);
      int64_t room = area2 - 56 * step;
      for (int e = 1; e < 3; ++e) {
        const auto any_step = [&] { return static_cast<int64_t>(random()) % (step + 1); };
        const int64_t a = any_step(), b = any_step();
        const int64_t inside = static_cast<int64_t>(random() >> 1) % (room + 1) >> random() % 24;
        const int64_t c = 14 * step + inside - a * t.batch.x[0] - b * t.batch.y[0];
        room -= inside;
        triangle.edge_a[e] = static_cast<double>(a);
        triangle.edge_b[e] = static_cast<double>(b);
        triangle.edge_c[e] = static_cast<double>(c);
      }
      triangle.inverse_area2 = 1.0 / static_cast<double>(area2);
      expect_fused_interpolation(t);
    }
  }
}

// A second triangle in the same place, with other varyings; then another block, and the first one of another tile.
TEST(Op, InterpolateInTheSamePlace) {
  for (SimdTarget target : supported_simd_targets()) {
    for (const bool affine : {false, true}) {
      FragmentTest t(target, Quads::block);
      const auto coordinates = std::make_unique<TileCoordinates>();
      TriangleSetup& triangle = t.triangles[0];
      if (affine) std::fill_n(triangle.inverse_w, 3, 1.0f);
      for (const uint32_t block : {37u, 37u, 5u, 37u, 5u, 63u, 0u}) {
        t.use_block(1232 + block % 8 * 8, 4048 + block / 8 * 8, block);
        for (float& v : t.varyings[0]) v = v * 1.5f + 0.25f;
        std::array<Lanes, 2> results[2];
        for (const bool kept : {false, true}) {
          triangle.coordinates = kept ? coordinates.get() : nullptr;
          results[kept][0] = t.run(Opcode::interpolate_perspective, operands(4, 0, 0, 2, 1));
          results[kept][1] = t.result_of(5);
        }
        EXPECT_EQ(results[0], results[1]) << block;
        EXPECT_NE(coordinates->known >> block & 1, 0u);
      }
      EXPECT_EQ(std::popcount(coordinates->known), 4);
    }
  }
}

TEST(Op, interpolate_flat) {
  for_all([](SimdTarget target, Quads quads) {
    FragmentTest t(target, quads);
    for (auto& v : t.varyings) v[3] = f(0x7F812345);  // any bits: a signalling NaN stays one
    if (quads >= Quads::lanes) t.use_lanes(quads == Quads::lanes);
    t.run(Opcode::interpolate_flat, operands(4, 0, 0, 2, 1));
    const Lanes first = t.result_of(4), second = t.result_of(5);
    for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
      EXPECT_EQ(first[lane], 0x7F812345u);
      EXPECT_EQ(f(second[lane]), t.triangle(lane).varyings[6]);
    }
  });
}

bool passes(uint32_t compare, float a, float b) {
  const bool results[] = {false, a<b, a == b, a <= b, a> b, a != b, a >= b, true};
  return results[compare];
}

TEST(Op, depth_test) {
  constexpr uint64_t kCovered = 0xFFF0700F1234FFFF;
  for (SimdTarget target : supported_simd_targets()) {
    for (uint32_t flags = 0; flags < 32; ++flags) {
      FragmentTest t(target, flags < 16 ? Quads::one_triangle : Quads::block);
      std::mt19937 random(flags);
      for (float& depth : t.depth) depth = static_cast<float>(random() % 4) * 0.25f;
      std::array<float, 4096> expected;
      std::copy(std::begin(t.depth), std::end(t.depth), expected.begin());
      Lanes z;
      for (uint32_t& lane : z) lane = random() % 16 == 0 ? 0x7FC00000 : u(static_cast<float>(random() % 4) * 0.25f);
      t.test.write(0, z);
      t.test.frame().write = kCovered;
      uint64_t write = 0, exec = 0;
      for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
        if ((kCovered >> lane & 1) == 0 || !passes(flags & 7, f(z[lane]), t.depth[t.texel(lane)])) continue;
        write |= uint64_t{1} << lane;
        exec |= uint64_t{15} << (lane & ~3u);
        // A NaN passes where the test is ALWAYS or NOT_EQUAL.
        if ((flags & 8) != 0) expected[t.texel(lane)] = f(z[lane]);
      }
      t.test.add(Opcode::depth_test, kStore, operands(0, 0, 0, 0, flags & 15, 1));
      t.test.run();
      EXPECT_EQ(t.test.frame().write, write) << flags;
      EXPECT_EQ(t.test.frame().exec, exec) << flags;
      for (size_t i = 0; i < 4096; ++i) EXPECT_EQ(u(t.depth[i]), u(expected[i])) << flags << ' ' << i;
    }
    // Nothing left: jumps.
    FragmentTest t(target, Quads::one_triangle);
    t.test.write(4, fractions(1));
    t.test.write(5, fractions(2));
    t.test.add(Opcode::depth_test, kStore, operands(0, 0, 0, 0, VK_COMPARE_OP_NEVER, 2));
    t.test.add(Opcode::mov, kStore, 4, 5);
    t.test.run();
    EXPECT_EQ(t.result_of(4), fractions(1));
  }
}

TEST(Op, count_samples) {
  for_all([](SimdTarget target, Quads quads) {
    FragmentTest t(target, quads);
    t.counter = 1000;
    t.test.frame().write = 0xF0F00000000000FF;
    t.test.add(Opcode::count_samples, kStore, Op{});
    t.test.run();
    EXPECT_EQ(t.counter, 1016u);
    t.batch.samples_passed = nullptr;
    t.test.add(Opcode::count_samples, kStore, Op{});
    t.test.run();
  });
}

TEST(Op, load_color) {
  for (SimdTarget target : supported_simd_targets()) {
    FragmentTest t(target, Quads::one_triangle);
    for (uint32_t i = 0; i < 4096; ++i) t.color[i] = i * 0x01030507;
    t.run(Opcode::load_color, operands(4));
    for (uint32_t c = 0; c < 4; ++c) {
      const Lanes got = t.result_of(4 + c);
      for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
        EXPECT_EQ(f(got[lane]), static_cast<float>(t.color[t.texel(lane)] >> (8 * c) & 255) / 255.0f);
      }
    }
  }
}

TEST(Op, store_color) {
  constexpr uint64_t kWrite = 0xFF0F1234567890AB;
  for (SimdTarget target : supported_simd_targets()) {
    FragmentTest t(target, Quads::one_triangle);
    std::fill(std::begin(t.color), std::end(t.color), 0x11223344u);
    const uint16_t list[] = {kNoOperand, 0, kNoOperand, 1};
    t.test.frame().lists = list;
    t.test.frame().write = kWrite;
    Lanes green, alpha;
    for (uint32_t i = 0; i < kBatchLanes; ++i) green[i] = u(static_cast<float>(i) / 255.0f);
    alpha.fill(u(1.0f));
    t.test.write(0, green);
    t.test.write(1, alpha);
    t.test.add(Opcode::store_color, kStore, operands(0, 0, 0, 0, 0, 2 | 8));
    t.test.run();
    uint32_t changed = 0;
    for (uint32_t i = 0; i < 4096; ++i) changed += t.color[i] != 0x11223344u ? 1 : 0;
    EXPECT_EQ(changed, static_cast<uint32_t>(std::popcount(kWrite)));
    for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
      const bool written = (kWrite >> lane & 1) != 0;
      EXPECT_EQ(t.color[t.texel(lane)], written ? 0xFF220044u | lane << 8 : 0x11223344u);
    }
  }
}

// As fixed_function.h and the header of fixed_function.cpp have it, a component at a time.
float blended(uint32_t word, bool is_alpha, float source, float source_alpha, float destination) {
  const auto factor = [&](uint32_t term) {
    const float factors[] = {0.0f, 1.0f, source_alpha, 1.0f - source_alpha};
    return factors[term];
  };
  const uint32_t shift = is_alpha ? 8 : 4;
  const float by = factor(word >> shift & 3), destination_by = factor(word >> (shift + 2) & 3);
  const float s = source * by;
  switch (word >> (is_alpha ? 14 : 12) & 3) {
    case VK_BLEND_OP_ADD:
      return std::fma(destination, destination_by, s);
    case VK_BLEND_OP_SUBTRACT:
      return std::fma(-destination, destination_by, s);
    default:
      return std::fma(destination, destination_by, -s);
  }
}

// NaN, infinity, outside of 0 .. 1, and many values inside.
float some_color(std::mt19937& random) {
  const float special[] = {NAN, INFINITY, -INFINITY, -0.5f, 1.5f, 0, 1, -0.0f};
  return random() % 8 == 0 ? special[random() % 8] : static_cast<float>(random() % 65537) / 65536.0f;
}

TEST(Op, blend_color) {
  const uint16_t list[] = {0, 1, 2, 3};
  for (SimdTarget target : supported_simd_targets()) {
    std::mt19937 random(1);
    // Every equation, and several times the one that has code of its own.
    std::vector<uint32_t> words(8, 0xDEF);
    for (uint32_t word = 15; word < 1u << 16; word += 16) {
      if (is_blend_word(word) && (target != SimdTarget::kBaseline || word % 112 == 15)) words.push_back(word);
    }
    for (const uint32_t word : words) {
      FragmentTest t(target, word % 32 == 15 ? Quads::block : Quads::one_triangle);
      t.test.frame().lists = list;
      for (uint32_t& texel : t.color) texel = static_cast<uint32_t>(random());
      uint32_t before[4096];
      std::copy(std::begin(t.color), std::end(t.color), before);
      Lanes source[4];
      const uint32_t same_color = random() % 4 == 0 ? kBlendSameColor : 0;
      for (auto& lanes : source) {
        for (uint32_t& lane : lanes) lane = u(some_color(random));
        if (same_color != 0 && &lanes != &source[3]) lanes.fill(lanes[0]);
      }
      for (uint32_t c = 0; c < 4; ++c) t.test.write(c, source[c]);
      const uint64_t write = word % 48 == 15 ? ~uint64_t{0} : uint64_t{random()} << 32 | uint64_t{random()};
      const uint32_t mask = word % 64 == 15 ? 15 : static_cast<uint32_t>(random() % 16);
      t.test.frame().write = write;
      const BlendEquation blends[] = {{}, blend_equation((word & ~15u) | mask | same_color)};
      t.test.frame().blends = blends;
      t.test.add(Opcode::blend_color, kStore, operands(0, 0, 0, 0, 0, 1));
      t.test.run();
      for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
        uint32_t expected = before[t.texel(lane)];
        const auto clamped = [&](uint32_t c) {
          return f(source[c][lane]) > 0 ? std::min(f(source[c][lane]), 1.0f) : 0;
        };
        for (uint32_t c = 0; c < 4 && (write >> lane & 1) != 0; ++c) {
          if ((mask >> c & 1) == 0) continue;
          const float stored = static_cast<float>(before[t.texel(lane)] >> (8 * c) & 255) / 255.0f;
          const float result = std::clamp(blended(word, c == 3, clamped(c), clamped(3), stored), 0.0f, 1.0f);
          const auto code = static_cast<uint32_t>(std::nearbyint(result * 255.0f));
          expected = (expected & ~(255u << (8 * c))) | code << (8 * c);
        }
        ASSERT_EQ(t.color[t.texel(lane)], expected) << word << ' ' << lane;
      }
    }
  }
}

TEST(Op, builtin) {
  for_all([](SimdTarget target, Quads quads) {
    FragmentTest t(target, quads);
    VertexBatch vertices = {};
    for (uint32_t i = 0; i < kBatchLanes; ++i) vertices.vertex_index[i] = 3 * i, vertices.instance_index[i] = 5 * i;
    for (uint32_t i = 0; i < 3; ++i) vertices.draw_parameters[i] = 70 + i;
    ComputeBatch compute = {{2, 3, 4}, {5, 6, 7}, 64};
    Frame& frame = t.test.frame();
    frame.vertices = &vertices;
    frame.invocations = &compute;
    frame.workgroup_size[0] = 3;
    frame.workgroup_size[1] = 5;
    frame.workgroup_size[2] = 9;
    frame.lanes = 0xFFFFFFFF0000FF01;
    for (uint32_t which = 0; which < static_cast<uint32_t>(BuiltIn::kCount); ++which) {
      const Lanes got = t.run(Opcode::builtin, operands(4, 0, 0, 0, which));
      for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
        const uint32_t index = 64 + lane;
        const uint32_t local[] = {index % 3, index / 3 % 5, index / 15};
        uint32_t expected = 0;
        const auto axis = [&](BuiltIn first) { return which - static_cast<uint32_t>(first); };
        switch (static_cast<BuiltIn>(which)) {
          case BuiltIn::vertex_index:
            expected = 3 * lane;
            break;
          case BuiltIn::instance_index:
            expected = 5 * lane;
            break;
          case BuiltIn::frag_coord_x:
            expected = u(static_cast<float>(t.x(lane)) + 0.5f);
            break;
          case BuiltIn::frag_coord_y:
            expected = u(static_cast<float>(t.y(lane)) + 0.5f);
            break;
          case BuiltIn::front_facing:
            expected = t.triangle(lane).front_facing;
            break;
          case BuiltIn::local_invocation_x:
          case BuiltIn::local_invocation_y:
          case BuiltIn::local_invocation_z:
            expected = local[axis(BuiltIn::local_invocation_x)];
            break;
          case BuiltIn::local_invocation_index:
            expected = index;
            break;
          case BuiltIn::workgroup_x:
          case BuiltIn::workgroup_y:
          case BuiltIn::workgroup_z:
            expected = 2 + axis(BuiltIn::workgroup_x);
            break;
          case BuiltIn::num_workgroups_x:
          case BuiltIn::num_workgroups_y:
          case BuiltIn::num_workgroups_z:
            expected = 5 + axis(BuiltIn::num_workgroups_x);
            break;
          case BuiltIn::global_invocation_x:
            expected = 2 * 3 + local[0];
            break;
          case BuiltIn::global_invocation_y:
            expected = 3 * 5 + local[1];
            break;
          case BuiltIn::global_invocation_z:
            expected = 4 * 9 + local[2];
            break;
          case BuiltIn::blend_constant_r:
          case BuiltIn::blend_constant_g:
          case BuiltIn::blend_constant_b:
          case BuiltIn::blend_constant_a:
            expected = u(0.25f * static_cast<float>(axis(BuiltIn::blend_constant_r)));
            break;
          case BuiltIn::helper_invocation:
            expected = (frame.lanes >> lane & 1) != 0 ? 0 : 0xFFFFFFFFu;
            break;
          case BuiltIn::base_vertex:
          case BuiltIn::base_instance:
          case BuiltIn::draw_index:
            expected = 70 + axis(BuiltIn::base_vertex);
            break;
          case BuiltIn::lane_index:
            expected = lane;
            break;
          case BuiltIn::kCount:
            break;
        }
        EXPECT_EQ(got[lane], expected) << which << ' ' << lane;
      }
    }
  });
}

TEST(Op, fetch) {
  for (SimdTarget target : supported_simd_targets()) {
    TestFrame test(target);
    float data[30];
    for (int i = 0; i < 30; ++i) data[i] = static_cast<float>(i);
    VertexBinding bindings[2];
    bindings[0] = {reinterpret_cast<const std::byte*>(data), sizeof data, 16, false};
    bindings[1] = {reinterpret_cast<const std::byte*>(data), sizeof data, 0, true};
    VertexBatch batch = {};
    batch.bindings = bindings;
    for (uint32_t i = 0; i < kBatchLanes; ++i)
      batch.vertex_index[i] = i == 9 ? 0xFFFFFFFFu : i, batch.instance_index[i] = i;
    const TexelFunctions* const two = &texel_functions(*find_format(VK_FORMAT_R32G32_SFLOAT), target);
    const Attribute attributes[] = {{0, 4, 8, two}, {1, 8, 8, two}};
    test.frame().vertices = &batch;
    test.frame().attributes = attributes;
    test.add(Opcode::fetch, kStore, operands(4, 0, 0, 4, 0));
    test.add(Opcode::fetch, kStore, operands(8, 0, 0, 1, 1));
    test.run();
    Lanes got[5];
    for (uint32_t k = 0; k < 5; ++k) test.read(4 + k, got[k]);
    for (uint32_t i = 0; i < kBatchLanes; ++i) {
      const uint64_t end = uint64_t{batch.vertex_index[i]} * 16 + 12;
      const bool inside = end <= sizeof data;
      EXPECT_EQ(f(got[0][i]), inside ? static_cast<float>(4 * i + 1) : 0) << i;
      EXPECT_EQ(f(got[1][i]), inside ? static_cast<float>(4 * i + 2) : 0);
      EXPECT_EQ(f(got[2][i]), 0);
      EXPECT_EQ(f(got[3][i]), 1);
      EXPECT_EQ(f(got[4][i]), 2);
    }
    bindings[0].data = nullptr;
    bindings[0].size = 0;
    test.add(Opcode::fetch, kStore, operands(4, 0, 0, 4, 0));
    test.run();
    test.read(4, got[0]);
    test.read(7, got[3]);
    EXPECT_EQ(f(got[0][0]), 0);
    EXPECT_EQ(f(got[3][0]), 1);
  }
}

}  // namespace
}  // namespace lapilli
