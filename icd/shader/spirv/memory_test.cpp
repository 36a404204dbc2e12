// Buffers with all their layouts, push constants, arrays in registers and specialization constants, run in the
// interpreter.
#include <bit>
#include <cmath>
#include <random>

#include "shader/spirv/test/run_shader.h"
#include "shaders/empty.comp.h"
#include "shaders/memory.comp.h"
#include "shaders/quantize.comp.h"
#include "shaders/special.comp.h"

namespace lapilli {
namespace {

constexpr uint32_t kInvocations = 64;
constexpr size_t kPerInvocation = 24;

// std140 as the specification lays it out, in floats.
struct Uniforms {
  float first[4];
  float rows[3][4];     // [row][column]
  float columns[2][4];  // [column][row]
  struct {
    float a[3], b;
    float c[3][4];  // [column][row]
  } items[3];
  float spaced[4][4];
};

TEST(SpirvMemory, LayoutsAndIndices) {
  ComputeRun run;
  float* results = run.buffer<float>(0, kInvocations * kPerInvocation);
  auto* u = reinterpret_cast<Uniforms*>(run.buffer<float>(1, sizeof(Uniforms) / 4));
  float* tables[3];
  for (uint32_t t = 0; t < 3; ++t) {
    tables[t] = run.buffer<float>(2, 9 + t);
    for (uint32_t i = 0; i < 9 + t; ++i) tables[t][i] = static_cast<float>(1000 * t + i);
  }
  float* both = run.buffer<float>(3, 64);
  float* const all = reinterpret_cast<float*>(u);
  for (size_t i = 0; i < sizeof(Uniforms) / 4; ++i) all[i] = static_cast<float>(i) + 0.5f;
  float push[8];
  for (uint32_t i = 0; i < 8; ++i) push[i] = static_cast<float>(i * i);
  std::memcpy(run.push.data(), push, sizeof(push));
  run.run(shaders::kMemoryComp);
  for (uint32_t n = 0; n < kInvocations; ++n) {
    const float* got = results + n * kPerInvocation;
    const uint32_t i = n % 3;
    EXPECT_EQ(got[0], u->rows[(i + 1) % 3][i]) << n;
    EXPECT_EQ(got[1], u->columns[n & 1][i]) << n;
    EXPECT_EQ(got[2], u->items[i].a[i] + u->items[2 - i].b) << n;
    EXPECT_EQ(got[3], u->items[i].c[i][n & 1]) << n;
    EXPECT_EQ(got[4], u->spaced[n & 3][0]) << n;
    const float* row = u->rows[i];
    EXPECT_EQ(got[5], std::fma(row[2], 3.0f, std::fma(row[1], 2.0f, row[0]))) << n;
    EXPECT_EQ(got[6], tables[i][1 + (n & 7)] + tables[1][0]) << n;
    EXPECT_EQ(got[7], static_cast<float>(8 + i)) << n;
    EXPECT_EQ(got[8], push[2 + n % 6] + push[1]) << n;
    float local[5];
    for (uint32_t k = 0; k < 5; ++k) local[k] = static_cast<float>(k * k) + u->first[0];
    local[(i + 2) % 5] += 100.0f;
    EXPECT_EQ(got[9], local[i] + local[i + 2]) << n;
    EXPECT_EQ(got[10], local[4 - i]) << n;
    const float constants[4] = {2, 3, 5, 7};
    EXPECT_EQ(got[11], constants[n & 3]) << n;
    EXPECT_EQ(got[12], u->items[i].a[1] + u->items[i].b + u->items[i].c[2][0]) << n;
    // The transposed matrix has the rows as columns.
    float middle[3];
    for (uint32_t c = 0; c < 3; ++c) middle[c] = c == i ? -1.0f : u->rows[c][1];
    EXPECT_EQ(got[13], middle[0] + middle[1] * 10.0f + middle[2] * 100.0f) << n;
    float v[4];
    std::copy(u->first, u->first + 4, v);
    v[n & 3] = 50.0f;
    EXPECT_EQ(got[14], std::fma(v[3], 1000.0f, std::fma(v[2], 100.0f, std::fma(v[1], 10.0f, v[0])))) << n;
    EXPECT_EQ(got[15], u->first[3 - (n & 3)]) << n;
  }
  // mat4 m at 0, row-major mat2x4 r (4 rows of 2) at 64, Item at 96: vec3 a, float b, mat3x2 c with a stride of 8
  // bytes.
  for (uint32_t c = 0; c < 4; ++c) EXPECT_EQ(both[8 + c], static_cast<float>(9 + c));
  EXPECT_EQ(both[12 + 5 % 3], 13.0f);
  for (uint32_t row = 0; row < 4; ++row) {
    EXPECT_EQ(both[16 + row * 2], static_cast<float>(1 + row));
    EXPECT_EQ(both[16 + row * 2 + 1], static_cast<float>(5 + row));
  }
  for (uint32_t c = 0; c < 3; ++c) EXPECT_EQ(both[24 + c], u->items[1].a[c]);
  EXPECT_EQ(both[27], u->items[1].b);
  for (uint32_t c = 0; c < 3; ++c) {
    EXPECT_EQ(both[28 + c * 2], u->items[1].c[c][0]);
    EXPECT_EQ(both[28 + c * 2 + 1], u->items[1].c[c][1]);
  }
}

TEST(SpirvMemory, SpecializationConstants) {
  ComputeRun run;
  float* results = run.buffer<float>(0, 4);
  run.specialization = {{0, 16, 4}, {1, 5, 4}, {2, 0x40000000, 4}, {3, 1, 4}};
  run.run(shaders::kSpecialComp);
  EXPECT_EQ(results[0], 1000.0f + 2.0f * 55.0f);  // 2 * (0 + .. + 10)
  EXPECT_EQ(results[1], 11.0f);
  EXPECT_EQ(results[2], 16.0f);
  EXPECT_EQ(results[3], 2.0f);
  EXPECT_EQ(run.workgroup_size[0], 16u);
  EXPECT_EQ(run.workgroup_size[1], 2u);
}

TEST(SpirvMemory, DefaultsOfSpecializationConstants) {
  ComputeRun run;
  float* results = run.buffer<float>(0, 4);
  run.run(shaders::kSpecialComp);
  EXPECT_EQ(results[0], 1.5f * 21.0f);
  EXPECT_EQ(results[1], 7.0f);
  EXPECT_EQ(results[2], 1.0f);
}

// When the pipeline is made as in lanes.
TEST(SpirvMemory, QuantizedSpecializationConstants) {
  struct Case {
    float number, quantized;
  };
  constexpr Case kCases[] = {{1 + 0x1p-11f, 1},
                             {1 + 0x3p-11f, 1 + 0x1p-9f},
                             {-65519.996f, -65504},
                             {65520, INFINITY},
                             {-INFINITY, -INFINITY},
                             {0x1p-14f, 0x1p-14f},
                             {-0x1.FFBFFEp-15f, -0.0f},
                             {0x1.FFCp-15f, 0x1p-14f},
                             {0x1p-149f, 0},
                             {-0.0f, -0.0f}};
  ComputeRun run;
  float* results = run.buffer<float>(0, 2);
  const auto quantize = [&](uint32_t bits) {
    run.specialization = {{0, bits, 4}};
    results[1] = std::bit_cast<float>(bits);
    run.run(shaders::kQuantizeComp);
    EXPECT_EQ(std::bit_cast<uint32_t>(results[0]), std::bit_cast<uint32_t>(results[1])) << bits;
  };
  for (const Case& each : kCases) {
    quantize(std::bit_cast<uint32_t>(each.number));
    EXPECT_EQ(std::bit_cast<uint32_t>(results[0]), std::bit_cast<uint32_t>(each.quantized)) << each.number;
  }
  for (const uint32_t nan : {0x7F800001u, 0xFFFFFFFFu}) quantize(nan);
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    // Mostly near the ends of the range, and near halves and what lies half-way between them.
    const uint32_t power = i % 3 == 0   ? 0x38000000u
                           : i % 3 == 1 ? 0x47000000u
                                        : static_cast<uint32_t>(random()) & 0x7F800000u;
    const uint32_t fraction = (static_cast<uint32_t>(random()) & 0xFFF000u) + static_cast<uint32_t>(random()) % 3 - 1;
    quantize((power + fraction) | (static_cast<uint32_t>(random()) & 0x80000000u));
  }
}

TEST(SpirvMemory, StructuresWithoutMembers) {
  ComputeRun run;
  const uint32_t* const results = run.buffer<uint32_t>(0, kBatchLanes);
  run.run(shaders::kEmptyComp);
  for (uint32_t n = 0; n < kBatchLanes; ++n) EXPECT_EQ(results[n], n);
}

}  // namespace
}  // namespace lapilli
