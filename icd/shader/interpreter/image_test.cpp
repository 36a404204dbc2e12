// Tests of single ops: sampling, fetching, storing and asking images.
#include <gtest/gtest.h>

#include "shader/interpreter/fragment_fixture.h"

namespace lapilli {
namespace {

// Two textures of 2x2 texels and one that was never written, in an array of three descriptors.
struct ImageTest {
  FragmentTest t;
  uint32_t texels[2][4] = {{0x000000FF, 0x0000FF00, 0x00FF0000, 0xFF000000},
                           {0x01010101, 0x02020202, 0x03030303, 0x04040404}};
  TextureView views[2];
  SamplerState sampler;
  Descriptor descriptors[3];
  ResourceTable table;
  ResourceRef ref = {0, 0, 3, -1};
  uint16_t list[8] = {0, kNoOperand, 1, 2, kNoOperand, kNoOperand, kNoOperand, kNoOperand};

  explicit ImageTest(SimdTarget target) : t(target, Quads::one_triangle) {
    for (int i = 0; i < 2; ++i) {
      views[i].format = find_format(VK_FORMAT_R8G8B8A8_UNORM);
      views[i].level_count = views[i].layer_count = 1;
      views[i].levels[0] = {reinterpret_cast<std::byte*>(texels[i]), 2, 2, 8};
      descriptors[i].texture = &views[i];
      descriptors[i].sampler = &sampler;
    }
    table.sets[0] = descriptors;
    Frame& frame = t.test.frame();
    frame.resources = &table;
    frame.refs = &ref;
    frame.lists = list;
  }
  // Descriptor by lane, out of range in the last ones; texel (lane & 1, lane >> 1 & 1).
  static uint32_t element(uint32_t lane) { return lane >= 60 ? 0xFFFFFFFFu : lane / 4 % 3; }
  uint32_t expected(uint32_t lane, uint32_t component) const {
    return element(lane) < 2 ? texels[element(lane)][lane & 3] >> (8 * component) & 255 : 0;
  }
  void run(Opcode op, bool floats) {
    Lanes index, x, y;
    for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
      const uint32_t tx = lane & 1, ty = lane >> 1 & 1;
      index[lane] = element(lane);
      x[lane] = floats ? u(0.25f + 0.5f * static_cast<float>(tx)) : tx;
      y[lane] = floats ? u(0.25f + 0.5f * static_cast<float>(ty)) : ty;
    }
    t.test.write(0, index);
    t.test.write(1, x);
    t.test.write(2, y);
    t.test.add(op, kStore, operands(4));
    t.test.run();
    for (uint32_t c = 0; c < 4; ++c) {
      const Lanes got = t.result_of(4 + c);
      for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
        EXPECT_EQ(f(got[lane]), static_cast<float>(expected(lane, c)) / 255.0f)
            << op_info(op).name << ' ' << lane << ' ' << c;
      }
    }
  }
};
TEST(Op, sample_2d) {
  for (SimdTarget target : supported_simd_targets()) ImageTest(target).run(Opcode::sample_2d, true);
}
TEST(Op, sample_2d_lod) {
  for (SimdTarget target : supported_simd_targets()) ImageTest(target).run(Opcode::sample_2d_lod, true);
}
TEST(Op, fetch_2d) {
  for (SimdTarget target : supported_simd_targets()) ImageTest(target).run(Opcode::fetch_2d, false);
}
// All four texels of each texture.
TEST(Op, gather_2d) {
  for (SimdTarget target : supported_simd_targets()) {
    ImageTest test(target);
    test.sampler.address_u = test.sampler.address_v = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    Lanes index, centre, component;
    for (uint32_t lane = 0; lane < kBatchLanes; ++lane) index[lane] = ImageTest::element(lane);
    centre.fill(u(0.5f));
    component.fill(2);
    test.t.test.write(0, index);
    test.t.test.write(1, centre);
    test.t.test.write(3, component);
    const uint16_t list[8] = {0, kNoOperand, 1, 1, 3, kNoOperand, kNoOperand, kNoOperand};
    test.t.test.frame().lists = list;
    test.t.test.add(Opcode::gather_2d, kStore, operands(4));
    test.t.test.run();
    constexpr uint32_t kOrder[] = {2, 3, 1, 0};
    for (uint32_t c = 0; c < 4; ++c) {
      const Lanes got = test.t.result_of(4 + c);
      for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
        const uint32_t element = ImageTest::element(lane);
        const uint32_t code = element < 2 ? test.texels[element][kOrder[c]] >> 16 & 255 : 0;
        EXPECT_EQ(f(got[lane]), static_cast<float>(code) / 255.0f) << lane;
      }
    }
  }
}

TEST(Op, query_lod_2d) {
  for (SimdTarget target : supported_simd_targets()) {
    ImageTest test(target);
    test.sampler.max_lod = 8;
    Lanes index, x, y;
    for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
      index[lane] = ImageTest::element(lane);
      x[lane] = u(static_cast<float>(lane & 1) * 2.0f);  // 4 texels from pixel to pixel
      y[lane] = 0;
    }
    test.t.test.write(0, index);
    test.t.test.write(1, x);
    test.t.test.write(2, y);
    test.t.test.add(Opcode::query_lod_2d, kStore, operands(4));
    test.t.test.run();
    const Lanes level = test.t.result_of(4), lod = test.t.result_of(5);
    for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
      EXPECT_EQ(f(level[lane]), 0.0f);  // there is one level
      EXPECT_EQ(f(lod[lane]), ImageTest::element(lane) < 2 ? 2.0f : 0.0f) << lane;
    }
  }
}

// Lanes that may write, of both textures; nothing where there is none or no texel.
TEST(Op, store_2d) {
  for (SimdTarget target : supported_simd_targets()) {
    ImageTest test(target);
    Lanes index, x, y;
    for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
      index[lane] = lane < 8 ? lane / 4 : ImageTest::element(lane);
      x[lane] = lane < 8 ? lane & 1 : lane % 3 == 0 ? 2 : 0xFFFFFFFF;
      y[lane] = lane >> 1 & 1;
    }
    Lanes one;
    one.fill(u(1.0f));
    test.t.test.write(0, index);
    test.t.test.write(1, x);
    test.t.test.write(2, y);
    test.t.test.write(3, one);
    const uint16_t list[8] = {0, kNoOperand, 1, 2, 3, 3, 3, 3};
    Frame& frame = test.t.test.frame();
    frame.lists = list;
    frame.write = ~uint64_t{1};
    frame.exec = ~uint64_t{2};
    uint32_t expected[2][4] = {{test.texels[0][0], test.texels[0][1], ~0u, ~0u}, {~0u, ~0u, ~0u, ~0u}};
    test.t.test.add(Opcode::store_2d, kStore, operands(0));
    test.t.test.run();
    for (int i = 0; i < 8; ++i) EXPECT_EQ(test.texels[i / 4][i % 4], expected[i / 4][i % 4]) << i;
  }
}

// All lanes of a texture count on one texel, one after the other; other formats and texels outside have no words.
TEST(Op, atomic_2d) {
  for (SimdTarget target : supported_simd_targets()) {
    ImageTest test(target);
    test.views[0].format = find_format(VK_FORMAT_R32_UINT);
    test.texels[0][3] = 100;
    Lanes index, x, y, value;
    for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
      index[lane] = ImageTest::element(lane);
      x[lane] = lane % 8 == 0 ? 2 : 1;
      y[lane] = 1;
      value[lane] = lane;
    }
    test.t.test.write(0, index);
    test.t.test.write(1, x);
    test.t.test.write(2, y);
    test.t.test.write(3, value);
    const uint16_t list[6] = {0, kNoOperand, 1, 2, 3, kNoOperand};
    Frame& frame = test.t.test.frame();
    frame.lists = list;
    frame.write = 0x0FFFFFFFFFFFFFFF;
    frame.exec = ~uint64_t{2};
    const uint32_t other = test.texels[1][3];
    Op op = operands(4);
    op.imm2 = static_cast<uint32_t>(AtomicOp::add);
    test.t.test.add(Opcode::atomic_2d, kStore, op);
    test.t.test.run();
    const Lanes old = test.t.result_of(4);
    uint32_t expected = 100;
    for (uint32_t lane = 0; lane < kBatchLanes; ++lane) {
      const bool counts = lane != 1 && lane < 60 && ImageTest::element(lane) == 0 && lane % 8 != 0;
      EXPECT_EQ(old[lane], counts ? expected : 0) << lane;
      if (counts) expected += lane;
    }
    EXPECT_EQ(test.texels[0][3], expected);
    EXPECT_EQ(test.texels[1][3], other);
  }
}

TEST(Op, size_2d) {
  for (SimdTarget target : supported_simd_targets()) {
    ImageTest test(target);
    Lanes index, level;
    index.fill(0);
    for (uint32_t i = 0; i < kBatchLanes; ++i) level[i] = i;
    test.t.test.write(0, index);
    test.t.test.write(1, level);
    test.t.test.add(Opcode::size_2d, kStore, operands(4));
    test.t.test.run();
    const Lanes width = test.t.result_of(4), height = test.t.result_of(5), levels = test.t.result_of(6);
    EXPECT_EQ(width[0], 2u);
    EXPECT_EQ(height[0], 2u);
    EXPECT_EQ(width[1], 0u);
    EXPECT_EQ(levels[1], 1u);
  }
}

}  // namespace
}  // namespace lapilli
