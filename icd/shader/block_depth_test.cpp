// The depth of blocks against the equation in integers and against the ops frag_depth and depth_test.
#include "shader/block_depth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "shader/interpreter/fragment_fixture.h"

namespace lapilli {
namespace {

// A block of one triangle; its depths cross the clamp range, unless they are all NaN.
struct BlockTest : FragmentTest {
  static constexpr uint32_t kX = 1232, kY = 4048;
  static constexpr uint32_t kBlock = 37;
  float* stored = depth + kBlock * 64;

  explicit BlockTest(SimdTarget target, bool nan = false) : FragmentTest(target, Quads::block) {
    TriangleSetup& t = triangles[0];
    t.edge_c[1] = -(t.edge_a[1] * (kX + 3) + t.edge_b[1] * (kY + 3)) + 77777;
    t.edge_c[2] = -(t.edge_a[2] * (kX + 2) + t.edge_b[2] * (kY + 5)) + 12345;
    t.depth = {nan ? std::nan("") : 0.5, 1.7e-10, -0.9e-9, 0.125f, 0.875f};
    use_block(kX, kY, kBlock);
    std::mt19937 random(3);
    for (uint32_t lane = 0; lane < 64; ++lane) {
      // Some equal to the fragment's depth.
      stored[lane] = random() % 4 == 0 ? expected(lane) : static_cast<float>(random() % 9) * 0.125f;
    }
  }
  float expected(uint32_t lane) const {
    const TriangleSetup& t = triangles[0];
    int64_t e[3];
    for (int i = 1; i < 3; ++i) {
      e[i] = static_cast<int64_t>(t.edge_a[i]) * x(lane) + static_cast<int64_t>(t.edge_b[i]) * y(lane) +
             static_cast<int64_t>(t.edge_c[i]);
    }
    const double z = (static_cast<double>(e[1]) * t.depth.k1 + static_cast<double>(e[2]) * t.depth.k2) + t.depth.z0;
    const float rounded = static_cast<float>(z);
    return std::isnan(rounded) ? rounded : std::clamp(rounded, t.depth.min, t.depth.max);
  }
};

Op operands(uint16_t dst, uint16_t a, uint32_t imm, uint32_t imm2) { return {nullptr, dst, a, 0, 0, imm, imm2}; }

TEST(BlockDepth, IsTheEquationAndTheOp) {
  for (SimdTarget target : supported_simd_targets()) {
    for (bool nan : {false, true}) {
      BlockTest t(target, nan);
      alignas(64) float z[64];
      block_depth_functions(target).depth(triangle_depth(t.triangles[0]), BlockTest::kX, BlockTest::kY, z);
      const Lanes op = t.run(Opcode::frag_depth, operands(4, 0, 0, 0));
      uint32_t clamped = 0;
      for (uint32_t lane = 0; lane < 64; ++lane) {
        if (nan) {
          EXPECT_TRUE(std::isnan(z[lane]) && std::isnan(f(op[lane])));
          continue;
        }
        EXPECT_EQ(u(z[lane]), u(t.expected(lane))) << lane;
        EXPECT_EQ(u(z[lane]), op[lane]) << lane;
        clamped += z[lane] == 0.125f || z[lane] == 0.875f ? 1 : 0;
      }
      EXPECT_TRUE(nan || (clamped > 4 && clamped < 60)) << clamped;
    }
  }
}

TEST(BlockDepth, TestsAndWritesLikeTheOp) {
  for (SimdTarget target : supported_simd_targets()) {
    for (uint32_t flags = 0; flags < 32; ++flags) {
      for (uint64_t lanes : {~uint64_t{0}, uint64_t{0xFFF0700F1234FFFF}, uint64_t{0}}) {
        const bool nan = flags >= 16, write = (flags & 8) != 0;
        BlockTest t(target, nan);
        alignas(64) float block[64];
        std::copy_n(t.stored, 64, block);
        const DepthRange before = {-3, 3};
        DepthRange range = before;
        const BlockDepthFunctions& functions = block_depth_functions(target);
        const uint64_t passed = functions.test[flags & 7](triangle_depth(t.triangles[0]), BlockTest::kX, BlockTest::kY,
                                                          lanes, write, block, range);
        t.test.frame().write = lanes;
        t.test.add(Opcode::frag_depth, kStore, operands(4, 0, 0, 0));
        t.test.add(Opcode::depth_test, kStore, operands(0, 4, flags & 15, 1));
        t.test.run();
        EXPECT_EQ(passed, t.test.frame().write) << flags;
        EXPECT_EQ(std::memcmp(block, t.stored, sizeof block), 0) << flags;
        DepthRange expected = before;
        if (write && passed != 0) {
          const auto [low, high] = std::minmax_element(block, block + 64);
          expected = {*low, *high};
          if (nan) expected = {-INFINITY, INFINITY};
          const DepthRange whole = functions.range(block);
          EXPECT_EQ(whole.min, expected.min);
          EXPECT_EQ(whole.max, expected.max);
        }
        EXPECT_EQ(range.min, expected.min) << flags;
        EXPECT_EQ(range.max, expected.max) << flags;
      }
    }
  }
}

}  // namespace
}  // namespace lapilli
