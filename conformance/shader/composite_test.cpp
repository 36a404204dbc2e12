// Vectors, matrices, structures, arrays and function parameters against GLM in double; specialization constants and
// compute built-ins.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <random>

#include "harness/compute.h"
#include "harness/devices.h"
#include "shaders/builtins.comp.h"
#include "shaders/specialized.comp.h"
#include "shaders/vectors.comp.h"

namespace lapilli::conformance {
namespace {

using glm::dmat2, glm::dmat3, glm::dmat4, glm::dvec2, glm::dvec3, glm::dvec4;

constexpr int kCases = 16;
using Numbers = std::array<double, 16>;

// What one case of vectors.comp writes.
class Expected {
 public:
  Numbers values = {};
  void put(int at, double v) { values[size_t(at)] = v; }
  void put(int at, bool v) { values[size_t(at)] = v ? 1 : 0; }
  template <int N>
  void put(int at, const glm::vec<N, double>& v) {
    for (int i = 0; i < N; ++i) values[size_t(at + i)] = v[i];
  }
  template <int C, int R>
  void put(int at, const glm::mat<C, R, double>& m) {
    for (int i = 0; i < C; ++i) put(at + i * R, m[i]);
  }
};

template <int N>
glm::vec<N, double> ones(const glm::vec<N, bool>& v) {
  return glm::vec<N, double>(v);
}

Numbers expected(int which, const std::array<float, 16>& x) {
  const auto at = [&](size_t i) { return double(x[i]); };
  const dvec4 a(at(0), at(1), at(2), at(3)), b(at(4), at(5), at(6), at(7));
  const dmat4 m(a, b, dvec4(at(8), at(9), at(10), at(11)), dvec4(at(12), at(13), at(14), at(15)));
  const dmat3 m3(m);
  const dmat2 m2(m);
  const dvec3 a3(a), b3(b);
  Expected e;
  switch (which) {
    case 0:
      e.put(0, a + b), e.put(4, a - b), e.put(8, a * b), e.put(12, a * 2.5);
      break;
    case 1:
      e.put(0, glm::dot(a, b)), e.put(1, glm::length(a)), e.put(2, glm::distance(a, b));
      e.put(3, glm::normalize(a)), e.put(7, glm::cross(a3, b3)), e.put(10, -a);
      break;
    case 2:
      e.put(0, m * a), e.put(4, a * m), e.put(8, m3 * a3), e.put(11, b3 * m3), e.put(14, m2 * dvec2(a));
      break;
    case 3:
      e.put(0, m * glm::transpose(m));
      break;
    case 4:
      e.put(0, glm::inverse(m));
      break;
    case 5:
      e.put(0, glm::determinant(m)), e.put(1, glm::determinant(m3)), e.put(2, glm::determinant(m2));
      e.put(3, glm::inverse(m3)), e.put(12, glm::inverse(m2));
      break;
    case 6:
      e.put(0, glm::outerProduct(a, b));
      break;
    case 7:
      e.put(0, glm::matrixCompMult(m, m + m));
      break;
    case 8: {
      const glm::dmat2x3 p(a3, b3);
      const glm::dmat3x2 q = glm::transpose(p);
      e.put(0, p * q), e.put(9, q * p), e.put(13, p * dvec2(a));
      break;
    }
    case 9:
      e.put(0, dvec4(a.w, a.z, a.y, a.x)), e.put(4, dvec4(a.x, a.x, a.z, a.z)), e.put(8, dvec4(b.y, b.x, a.w, a.z));
      e.put(12, dvec4(b.y, a.y, b.x, a.w + 3));
      break;
    case 10:
      for (int i = 0; i < 4; ++i) {
        e.put(i, a[(i * 3 + int(x[15])) & 3]);
        dvec4 c = b;
        c[i] = 7;
        e.put(4 + i, glm::dot(c, dvec4(1, 10, 100, 1000)));
        e.put(8 + i, m[i][3 - i]);
        dmat4 d = m;
        d[3 - i] = a;
        e.put(12 + i, d[3][i] + d[0][1]);
      }
      break;
    case 11:
      e.put(0, at(1)), e.put(1, at(0)), e.put(2, at(3)), e.put(3, at(2)), e.put(4, dvec3(5, 6, 7)), e.put(7, 5.0);
      e.put(8, dvec4(a.w, a.y, a.z, a.x));
      break;
    case 12: {
      const double s = at(0);
      const int element = int(x[15]) & 1;
      e.put(0, s * 2 + 2), e.put(1, -1.0), e.put(2, dvec3(0, s, 0)), e.put(5, dvec3(at(1))), e.put(8, 0.0);
      e.put(9, 1.0), e.put(10, dvec2(s, 0)), e.put(12, double(int(s * 4))), e.put(13, s * (element + 1) + 1);
      e.put(14, dvec2(s, element));
      break;
    }
    case 13:
      e.put(0, glm::reflect(a3, glm::normalize(b3)));
      e.put(3, glm::refract(glm::normalize(a3), glm::normalize(b3), 0.7));
      e.put(6, glm::faceforward(a3, b3, dvec3(0.3, -2, 1)));
      e.put(9, glm::mix(a, b, 0.25)), e.put(13, glm::length(dvec2(a))), e.put(14, 3.5), e.put(15, 3.0);
      break;
    case 14:
      e.put(0, ones(glm::lessThan(a, b))), e.put(4, ones(glm::greaterThanEqual(a, b)));
      e.put(8, ones(glm::equal(glm::ivec4(a), glm::ivec4(a + 0.25))));
      e.put(12, glm::any(glm::lessThan(a, b))), e.put(13, glm::all(glm::lessThan(a, b)));
      e.put(14, !(a.x < b.x)), e.put(15, false);
      break;
    default:
      e.put(0, dvec4(std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z), std::max(a.w, b.w)));
      e.put(4, glm::min(a, b)), e.put(8, glm::clamp(a, 0.5, 2.0)), e.put(12, glm::mod(a, 1.5));
      break;
  }
  return e.values;
}

TEST(Composites, VectorsMatricesStructuresAndParameters) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> number(-3, 3);
  for (int round = 0; round < 20; ++round) {
    std::array<float, 16> x;
    for (float& v : x) v = number(random);
    for (size_t i = 0; i < 16; i += 5) x[i] += 6;  // far from singular
    x[15] = std::floor(x[15]);
    ComputeRun run;
    run.shader = shaders::kVectorsComp;
    run.buffers = {to_bytes(std::vector<float>(x.begin(), x.end())), Bytes(kCases * 16 * 4)};
    run.push_constants = to_bytes(std::vector<int>{kCases});
    const std::vector<float> got = from_bytes<float>(run_compute(subject(), run)[1]);
    for (int which = 0; which < kCases; ++which) {
      const Numbers want = expected(which, x);
      for (size_t i = 0; i < 16; ++i) {
        const double value = double(got[size_t(which) * 16 + i]);
        EXPECT_NEAR(value, want[i], 2e-5 * (1 + std::abs(want[i]))) << "case " << which << ", number " << i;
      }
    }
    if (HasFailure()) return;
  }
}

TEST(Composites, SpecializationConstants) {
  struct Constants {
    int32_t i = 3;
    float f = 0.5f;
    VkBool32 b = VK_FALSE;
    uint32_t size = 2, x = 4, y = 3;
  };
  const VkSpecializationMapEntry entries[] = {{0, offsetof(Constants, i), 4},
                                              {1, offsetof(Constants, f), 4},
                                              {2, offsetof(Constants, b), 4},
                                              {3, offsetof(Constants, size), 4},
                                              {10, offsetof(Constants, x), 4},
                                              {11, offsetof(Constants, y), 4},
                                              {77, 0, 4}};  // a constant that the shader does not have
  const Constants cases[] = {{}, {-7, 2.25f, VK_TRUE, 5, 8, 1}, {100, -1, VK_TRUE, 1, 1, 16}};
  for (const Constants& c : cases) {
    const VkSpecializationInfo info = {7, entries, sizeof(c), &c};
    ComputeRun run;
    run.shader = shaders::kSpecializedComp;
    run.buffers = {Bytes(2 * c.x * c.y * 4)};
    run.groups[0] = 2;
    run.specialization = &info;
    double sum = 0;
    for (uint32_t i = 0; i < c.size; ++i) sum += i + double(c.f);
    const double want = (c.i * 10 + 1) * 1000.0 + sum + (c.b ? 0.25 : 0) + (c.x * 100 + c.y) * 100000.0;
    for (const float v : from_bytes<float>(run_compute(subject(), run)[0])) EXPECT_EQ(v, float(want));
  }
}

TEST(Composites, ComputeBuiltIns) {
  ComputeRun run;
  run.shader = shaders::kBuiltinsComp;
  constexpr uint32_t kGroups[3] = {5, 4, 3}, kLocal[3] = {3, 2, 2};
  std::copy_n(kGroups, 3, run.groups);
  const uint32_t total[3] = {15, 8, 6};
  run.buffers = {Bytes(15 * 8 * 6 * 16)};
  const auto got = from_bytes<std::array<uint32_t, 4>>(run_compute(subject(), run)[0]);
  for (uint32_t z = 0; z < total[2]; ++z) {
    for (uint32_t y = 0; y < total[1]; ++y) {
      for (uint32_t x = 0; x < total[0]; ++x) {
        const uint32_t local[3] = {x % 3, y % 2, z % 2};
        const std::array<uint32_t, 4> want = {
            x / 3 | (y / 2) << 8 | (z / 2) << 16, local[0] | local[1] << 8 | local[2] << 16,
            (local[2] * kLocal[1] + local[1]) * kLocal[0] + local[0], 5u | 4u << 8 | 3u << 16};
        ASSERT_EQ(got[(z * total[1] + y) * total[0] + x], want) << x << "," << y << "," << z;
      }
    }
  }
}

}  // namespace
}  // namespace lapilli::conformance
