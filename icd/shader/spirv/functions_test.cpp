// Functions that are made of several ops, run in the interpreter and compared with float64 or integers.
#include <array>
#include <bit>
#include <cmath>
#include <random>

#include "shader/spirv/test/run_shader.h"
#include "shaders/functions.comp.h"

namespace lapilli {
namespace {

constexpr uint32_t kInvocations = 256;
constexpr size_t kFloats = 40, kWords = 12;

using Vec = std::array<double, 4>;

double dot(const Vec& a, const Vec& b, size_t n = 4) {
  double sum = 0;
  for (size_t i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

Vec unit(const Vec& a) {
  const double length = std::sqrt(dot(a, a, 3));
  return {a[0] / length, a[1] / length, a[2] / length, 0};
}

// Determinant by Gauss, [column][row].
double determinant(std::array<Vec, 4> m, size_t n) {
  double result = 1;
  for (size_t i = 0; i < n; ++i) {
    size_t best = i;
    for (size_t k = i; k < n; ++k) {
      if (std::abs(m[k][i]) > std::abs(m[best][i])) best = k;
    }
    if (best != i) result = -result;
    std::swap(m[i], m[best]);
    if (m[i][i] == 0) return 0;
    result *= m[i][i];
    for (size_t k = i + 1; k < n; ++k) {
      const double factor = m[k][i] / m[i][i];
      for (size_t c = i; c < n; ++c) m[k][c] -= factor * m[i][c];
    }
  }
  return result;
}

double clamp(double x, double low, double high) { return std::min(std::max(x, low), high); }

class SpirvFunctions : public testing::Test {
 protected:
  void SetUp() override {
    results = run.buffer<float>(0, kInvocations * kFloats);
    float* inputs = run.buffer<float>(1, kInvocations * 8);
    bits = run.buffer<uint32_t>(2, kInvocations * kWords);
    std::mt19937 random(7);
    std::uniform_real_distribution<float> value(-2.0f, 2.0f);
    for (uint32_t i = 0; i < kInvocations * 8; ++i) inputs[i] = value(random);
    for (uint32_t n = 0; n < kInvocations; ++n) {
      for (size_t i = 0; i < 4; ++i) {
        xf[n][i] = inputs[n * 8 + i];
        yf[n][i] = inputs[n * 8 + 4 + i];
        x[n][i] = xf[n][i];
        y[n][i] = yf[n][i];
      }
    }
    run.run(shaders::kFunctionsComp, kInvocations / kBatchLanes);
  }

  ComputeRun run;
  float* results = nullptr;
  uint32_t* bits = nullptr;
  std::array<float, 4> xf[kInvocations], yf[kInvocations];
  Vec x[kInvocations], y[kInvocations];
};

TEST_F(SpirvFunctions, Geometry) {
  for (uint32_t n = 0; n < kInvocations; ++n) {
    const float* got = results + n * kFloats;
    const Vec &a = x[n], &b = y[n];
    const double close = 2e-6;
    EXPECT_NEAR(got[4], std::sqrt(dot(a, a)), close);
    const Vec d{a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]};
    EXPECT_NEAR(got[5], std::sqrt(dot(d, d)), close);
    const Vec u = unit(a), v = unit(b);
    EXPECT_NEAR(got[6], u[0], close);
    EXPECT_NEAR(got[7], u[2], close);
    for (size_t i = 0; i < 3; ++i) {
      const size_t j = (i + 1) % 3, k = (i + 2) % 3;
      EXPECT_NEAR(got[8 + i], a[j] * b[k] - b[j] * a[k], close);
    }
    EXPECT_NEAR(got[11], a[0] - 2 * dot(b, a, 2) * b[0], 8e-6);
    const double cosine = dot(v, u, 3), eta = 0.75, k = 1 - eta * eta * (1 - cosine * cosine);
    EXPECT_NEAR(got[12], eta * u[1] - (eta * cosine + std::sqrt(k)) * v[1], close);
    const Vec reversed{a[3], a[2], a[1], a[0]};
    EXPECT_EQ(got[13], dot(reversed, b) < 0 ? a[2] : -a[2]) << n;
    EXPECT_NEAR(got[25], a[1] * b[2], close);
    // (row vector * matrix)[1] is the product with column 1, which is y.
    EXPECT_NEAR(got[28], dot(a, b, 3), close);
  }
}

TEST_F(SpirvFunctions, Components) {
  for (uint32_t n = 0; n < kInvocations; ++n) {
    const float* got = results + n * kFloats;
    const Vec &a = x[n], &b = y[n];
    EXPECT_EQ(got[1], std::trunc(xf[n][0]));
    EXPECT_EQ(got[0], xf[n][0] - std::trunc(xf[n][0]));
    EXPECT_EQ(std::signbit(got[0]), std::signbit(xf[n][0]));
    int exponent = 0;
    EXPECT_EQ(got[2], std::frexp(xf[n][1], &exponent));
    EXPECT_EQ(got[3], static_cast<float>(exponent));
    EXPECT_NEAR(got[14], a[0] * 0.75 + b[0] * 0.25, 1e-6);
    const double t = clamp((a[2] + 1) / 3, 0, 1);
    EXPECT_NEAR(got[15], t * t * (3 - 2 * t), 1e-6);
    EXPECT_EQ(got[16], b[0] < a[0] ? 0.0f : 1.0f);
    EXPECT_EQ(got[17], static_cast<float>(clamp(a[1], -0.5, 0.75)));
    EXPECT_NEAR(got[23], a[0] * 0.017453292519943295, 1e-8);
    EXPECT_NEAR(got[24], a[0] * 57.29577951308232, 1e-5);
    EXPECT_EQ(got[26], std::fma(xf[n][0], yf[n][0], xf[n][1]));
    EXPECT_EQ(got[27], xf[n][0] * 8.0f);
    // y may be tiny: the remainder is far from continuous there.
    if (std::abs(b[1]) > 0.1 && std::abs(std::remainder(a[0], b[1])) > 1e-4) {
      EXPECT_NEAR(got[30], a[0] - b[1] * std::floor(a[0] / b[1]), 1e-5);
    }
  }
}

TEST_F(SpirvFunctions, Matrices) {
  for (uint32_t n = 0; n < kInvocations; ++n) {
    const float* got = results + n * kFloats;
    const Vec &a = x[n], &b = y[n];
    const std::array<Vec, 4> m{a, b, Vec{a[1] * 2, a[2] * 2, a[3] * 2, a[0] * 2}, Vec{1, 2, 3, 5}};
    const double det = determinant(m, 4);
    EXPECT_NEAR(got[18], det, 2e-4);
    if (std::abs(det) > 1) {
      EXPECT_NEAR(got[19], 4, 1e-3);
      EXPECT_NEAR(got[20], 0, 1e-3);
    }
    const std::array<Vec, 4> m3{a, b, Vec{1, -2, 3, 0}, Vec{}};
    // inverse[column 1][row 2] * determinant is the cofactor of row 1, column 2: - (m00 m21 - m01 m20).
    if (std::abs(determinant(m3, 3)) > 0.5) {
      EXPECT_NEAR(got[21], -(a[0] * b[2] - b[0] * a[2]), 1e-3);
    }
    if (std::abs(a[0] * b[1] - a[1] * b[0]) > 0.1) {
      EXPECT_NEAR(got[22], -b[0], 1e-4);
    }
    EXPECT_NEAR(got[29], a[2] * b[0] + b[2] * b[1] + 2 * a[3] * b[2] + 3 * b[3], 1e-5);
  }
}

TEST_F(SpirvFunctions, PackingAndBits) {
  for (uint32_t n = 0; n < kInvocations; ++n) {
    const float* got = results + n * kFloats;
    const uint32_t* word = bits + n * kWords;
    // In float32 like the specification's formula: a product may round to a tie.
    const auto rounded = [&](size_t i, float low, float scale) {
      return static_cast<uint32_t>(static_cast<int>(std::nearbyint(std::clamp(xf[n][i], low, 1.0f) * scale)));
    };
    uint32_t unorm8 = 0, snorm8 = 0, unorm16 = 0, snorm16 = 0;
    for (uint32_t i = 0; i < 4; ++i) {
      unorm8 |= rounded(i, 0, 255) << (8 * i);
      snorm8 |= (rounded(i, -1, 127) & 0xFF) << (8 * i);
    }
    for (uint32_t i = 0; i < 2; ++i) {
      unorm16 |= rounded(2 + i, 0, 65535) << (16 * i);
      snorm16 |= (rounded(2 + i, -1, 32767) & 0xFFFF) << (16 * i);
    }
    EXPECT_EQ(word[0], unorm8);
    EXPECT_EQ(word[1], snorm8);
    EXPECT_EQ(word[2], unorm16);
    EXPECT_EQ(word[3], snorm16);
    const uint32_t w = std::bit_cast<uint32_t>(xf[n][0]) * 2654435761u, other = 0x90000000u, sum = w + other;
    EXPECT_EQ(got[31], static_cast<float>(w >> 8 & 0xFF) / 255.0f);
    EXPECT_EQ(got[32], std::max(static_cast<float>(static_cast<int8_t>(w >> 24)) / 127.0f, -1.0f));
    EXPECT_EQ(got[33], std::max(static_cast<float>(static_cast<int16_t>(w)) / 32767.0f, -1.0f));
    EXPECT_NEAR(got[34], y[n][1], std::abs(y[n][1]) / 2048 + 1e-7);
    EXPECT_EQ(word[5], (sum < w ? 1u : 0u) + (w < other ? 2u : 0u));
    EXPECT_EQ(word[6], static_cast<uint32_t>(uint64_t{w} * w >> 32));
    EXPECT_EQ(word[7], (w & ~(0x1FFu << 5)) | (sum & 0x1FF) << 5);
    EXPECT_EQ(word[8], w >> 7 & 0x1FFF);
    EXPECT_EQ(word[9], static_cast<uint32_t>(static_cast<int32_t>(w) >> 20));
    const uint32_t magnitude = w >> 31 != 0 ? ~w : w;
    const int msb = 31 - std::countl_zero(magnitude);
    EXPECT_EQ(word[10], static_cast<uint32_t>(msb + std::countr_zero(w) * 100 + std::popcount(w) * 10000));
    EXPECT_EQ(word[11], w - other);
  }
}

}  // namespace
}  // namespace lapilli
