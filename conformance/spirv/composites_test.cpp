// Instructions on vectors, matrices, structures and arrays, and those with several results, against float64 and
// integers; in compute, fragment and vertex shaders.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <random>

#include "harness/devices.h"
#include "oracle/ulp.h"
#include "spirv/snippet.h"

namespace lapilli::conformance::spirv {
namespace {

// One word of a result: bits, or a float near a value.
struct Want {
  uint32_t bits = 0;
  double value = 0;
  double tolerance = -1;  // absolute; below 0: the bits count
};
Want exactly(uint32_t bits) { return {bits}; }
Want near(double value, double tolerance) { return {0, value, tolerance}; }

bool agrees(uint32_t got, const Want& want) {
  if (want.tolerance < 0) return got == want.bits;
  return std::abs(double(std::bit_cast<float>(got)) - want.value) <= want.tolerance;
}

using Emit = std::function<Words(Module&, const Words&)>;
using Expect = std::function<std::vector<Want>(const uint32_t*)>;

float f(uint32_t bits) { return std::bit_cast<float>(bits); }
double d(uint32_t bits) { return double(f(bits)); }

Id as_float(Module& m, Id word) { return m.emit(spv::Op::OpBitcast, m.float_type(), {word}); }
Id as_int(Module& m, Id word) { return m.emit(spv::Op::OpBitcast, m.int_type(), {word}); }
Id as_word(Module& m, Id value) { return m.emit(spv::Op::OpBitcast, m.uint_type(), {value}); }

Id float_vector(Module& m, const Words& words, uint32_t first, uint32_t count) {
  Words parts;
  for (uint32_t i = 0; i < count; ++i) parts.push_back(as_float(m, words[first + i]));
  return m.composite(m.vector_type(m.float_type(), count), parts);
}
Id float_matrix(Module& m, const Words& words, uint32_t first, uint32_t columns, uint32_t rows) {
  Words parts;
  for (uint32_t c = 0; c < columns; ++c) parts.push_back(float_vector(m, words, first + c * rows, rows));
  return m.composite(m.matrix_type(m.vector_type(m.float_type(), rows), columns), parts);
}
void append_vector(Module& m, Words& out, Id vector, uint32_t count) {
  for (uint32_t i = 0; i < count; ++i) out.push_back(as_word(m, m.extract(m.float_type(), vector, i)));
}
Words vector_words(Module& m, Id vector, uint32_t count) {
  Words out;
  append_vector(m, out, vector, count);
  return out;
}
Words matrix_words(Module& m, Id matrix, uint32_t columns, uint32_t rows) {
  Words out;
  for (uint32_t c = 0; c < columns; ++c)
    append_vector(m, out, m.extract(m.vector_type(m.float_type(), rows), matrix, c), rows);
  return out;
}

// Sum of products and how far a float32 computation in any order, with or without fma, may be from it.
class Sum {
 public:
  void add(double a, double b) {
    value_ += a * b;
    magnitude_ += std::abs(a * b);
    ++terms_;
  }
  Want want() const { return near(value_, magnitude_ * (terms_ + 1) * 0x1p-24); }

 private:
  double value_ = 0, magnitude_ = 0;
  int terms_ = 0;
};

// Runs in all stages; graphics stages return the first two words only.
void check(const char* name, uint32_t inputs, uint32_t outputs, const Emit& emit, const Expect& expect,
           const Words& operands) {
  for (const Stage stage : kStages) {
    const uint32_t kept = stage == Stage::compute ? outputs : std::min(outputs, 2u);
    const Snippet snippet = {inputs, kept, [&](Module& m, const Words& words) {
                               Words all = emit(m, words);
                               all.resize(kept);
                               return all;
                             }};
    const Words got = run(subject(), snippet, stage, operands);
    int wrong = 0;
    for (size_t element = 0; element < operands.size() / inputs && wrong < 3; ++element) {
      const std::vector<Want> want = expect(&operands[element * inputs]);
      ASSERT_EQ(want.size(), outputs);
      for (uint32_t i = 0; i < kept; ++i) {
        const uint32_t result = got[element * kept + i];
        if (agrees(result, want[i])) continue;
        ++wrong;
        ADD_FAILURE() << name << " (" << name_of(stage) << "), element " << element << ", word " << i << ": "
                      << std::hex << result << ' ' << f(result) << ", expected " << want[i].bits << ' '
                      << want[i].value;
      }
    }
  }
}

Words random_words(uint32_t count, uint32_t seed) {
  std::mt19937 random(seed);
  Words out;
  for (uint32_t i = 0; i < 256 * count; ++i) out.push_back(i % 7 == 0 ? uint32_t(random()) % 5 : uint32_t(random()));
  return out;
}
Words random_floats(uint32_t count, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> moderate(-10, 10);
  Words out;
  for (uint32_t i = 0; i < 256 * count; ++i) out.push_back(std::bit_cast<uint32_t>(moderate(random)));
  return out;
}

TEST(Composites, Products) {
  for (uint32_t n = 2; n <= 4; ++n) {
    SCOPED_TRACE(n);
    check(
        "OpDot", 2 * n, 1,
        [n](Module& m, const Words& w) -> Words {
          return {
              as_word(m, m.emit(spv::Op::OpDot, m.float_type(), {float_vector(m, w, 0, n), float_vector(m, w, n, n)}))};
        },
        [n](const uint32_t* x) -> std::vector<Want> {
          Sum sum;
          for (uint32_t i = 0; i < n; ++i) sum.add(d(x[i]), d(x[n + i]));
          return {sum.want()};
        },
        random_floats(2 * n, n));
    check(
        "OpVectorTimesScalar", n + 1, n,
        [n](Module& m, const Words& w) {
          const Id type = m.vector_type(m.float_type(), n);
          return vector_words(
              m, m.emit(spv::Op::OpVectorTimesScalar, type, {float_vector(m, w, 0, n), as_float(m, w[n])}), n);
        },
        [n](const uint32_t* x) {
          std::vector<Want> want;
          for (uint32_t i = 0; i < n; ++i) want.push_back(exactly(std::bit_cast<uint32_t>(f(x[i]) * f(x[n]))));
          return want;
        },
        random_floats(n + 1, n));
  }
}

// All shapes: a matrix of `columns` columns of `rows` elements.
TEST(Composites, Matrices) {
  for (uint32_t columns = 2; columns <= 4; ++columns) {
    for (uint32_t rows = 2; rows <= 4; ++rows) {
      SCOPED_TRACE(testing::Message() << columns << " columns of " << rows);
      const uint32_t size = columns * rows;
      const auto matrix_type = [](Module& m, uint32_t c, uint32_t r) {
        return m.matrix_type(m.vector_type(m.float_type(), r), c);
      };
      check(
          "OpMatrixTimesScalar", size + 1, size,
          [=](Module& m, const Words& w) {
            const Id matrix = float_matrix(m, w, 0, columns, rows), scalar = as_float(m, w[size]);
            const Id type = matrix_type(m, columns, rows);
            return matrix_words(m, m.emit(spv::Op::OpMatrixTimesScalar, type, {matrix, scalar}), columns, rows);
          },
          [=](const uint32_t* x) {
            std::vector<Want> want;
            for (uint32_t i = 0; i < size; ++i) want.push_back(exactly(std::bit_cast<uint32_t>(f(x[i]) * f(x[size]))));
            return want;
          },
          random_floats(size + 1, size));
      check(
          "OpMatrixTimesVector", size + columns, rows,
          [=](Module& m, const Words& w) {
            const Id matrix = float_matrix(m, w, 0, columns, rows), vector = float_vector(m, w, size, columns);
            const Id type = m.vector_type(m.float_type(), rows);
            return vector_words(m, m.emit(spv::Op::OpMatrixTimesVector, type, {matrix, vector}), rows);
          },
          [=](const uint32_t* x) {
            std::vector<Want> want;
            for (uint32_t r = 0; r < rows; ++r) {
              Sum sum;
              for (uint32_t c = 0; c < columns; ++c) sum.add(d(x[c * rows + r]), d(x[size + c]));
              want.push_back(sum.want());
            }
            return want;
          },
          random_floats(size + columns, size));
      check(
          "OpVectorTimesMatrix", size + rows, columns,
          [=](Module& m, const Words& w) {
            const Id matrix = float_matrix(m, w, 0, columns, rows), vector = float_vector(m, w, size, rows);
            const Id type = m.vector_type(m.float_type(), columns);
            return vector_words(m, m.emit(spv::Op::OpVectorTimesMatrix, type, {vector, matrix}), columns);
          },
          [=](const uint32_t* x) {
            std::vector<Want> want;
            for (uint32_t c = 0; c < columns; ++c) {
              Sum sum;
              for (uint32_t r = 0; r < rows; ++r) sum.add(d(x[c * rows + r]), d(x[size + r]));
              want.push_back(sum.want());
            }
            return want;
          },
          random_floats(size + rows, size));
      check(
          "OpMatrixTimesMatrix", size + columns * 3, rows * 3,
          [=](Module& m, const Words& w) {
            const Id left = float_matrix(m, w, 0, columns, rows), right = float_matrix(m, w, size, 3, columns);
            const Id type = matrix_type(m, 3, rows);
            return matrix_words(m, m.emit(spv::Op::OpMatrixTimesMatrix, type, {left, right}), 3, rows);
          },
          [=](const uint32_t* x) {
            std::vector<Want> want;
            for (uint32_t c = 0; c < 3; ++c) {
              for (uint32_t r = 0; r < rows; ++r) {
                Sum sum;
                for (uint32_t k = 0; k < columns; ++k) sum.add(d(x[k * rows + r]), d(x[size + c * columns + k]));
                want.push_back(sum.want());
              }
            }
            return want;
          },
          random_floats(size + columns * 3, size));
      check(
          "OpTranspose", size, size,
          [=](Module& m, const Words& w) {
            const Id matrix = float_matrix(m, w, 0, columns, rows);
            return matrix_words(m, m.emit(spv::Op::OpTranspose, matrix_type(m, rows, columns), {matrix}), rows,
                                columns);
          },
          [=](const uint32_t* x) {
            std::vector<Want> want;
            for (uint32_t c = 0; c < rows; ++c) {
              for (uint32_t r = 0; r < columns; ++r) want.push_back(exactly(x[r * rows + c]));
            }
            return want;
          },
          random_floats(size, size));
      check(
          "OpOuterProduct", columns + rows, size,
          [=](Module& m, const Words& w) {
            const Id column = float_vector(m, w, 0, rows), row = float_vector(m, w, rows, columns);
            const Id type = matrix_type(m, columns, rows);
            return matrix_words(m, m.emit(spv::Op::OpOuterProduct, type, {column, row}), columns, rows);
          },
          [=](const uint32_t* x) {
            std::vector<Want> want;
            for (uint32_t c = 0; c < columns; ++c) {
              for (uint32_t r = 0; r < rows; ++r)
                want.push_back(exactly(std::bit_cast<uint32_t>(f(x[r]) * f(x[rows + c]))));
            }
            return want;
          },
          random_floats(columns + rows, size));
    }
  }
}

TEST(Composites, Vectors) {
  check(
      "OpVectorShuffle", 5, 4,
      [](Module& m, const Words& w) -> Words {
        const Id uint = m.uint_type(), two = m.vector_type(uint, 2), three = m.vector_type(uint, 3);
        const Id a = m.composite(two, {w[0], w[1]}), b = m.composite(three, {w[2], w[3], w[4]});
        const Id r = m.emit(spv::Op::OpVectorShuffle, m.vector_type(uint, 4), {a, b, 4, 0, 3, 3});
        return {m.extract(uint, r, 0), m.extract(uint, r, 1), m.extract(uint, r, 2), m.extract(uint, r, 3)};
      },
      [](const uint32_t* x) -> std::vector<Want> {
        return {exactly(x[4]), exactly(x[0]), exactly(x[3]), exactly(x[3])};
      },
      random_words(5, 1));
  check(
      "OpVectorExtractDynamic, OpVectorInsertDynamic", 6, 4,
      [](Module& m, const Words& w) -> Words {
        const Id uint = m.uint_type(), three = m.vector_type(uint, 3);
        const Id vector = m.composite(three, {w[0], w[1], w[2]});
        const Id index = m.emit(spv::Op::OpUMod, uint, {w[3], m.constant_uint(3)});
        const Id inserted = m.emit(spv::Op::OpVectorInsertDynamic, three, {vector, w[5], index});
        return {m.emit(spv::Op::OpVectorExtractDynamic, uint, {vector, index}), m.extract(uint, inserted, 0),
                m.extract(uint, inserted, 1), m.extract(uint, inserted, 2)};
      },
      [](const uint32_t* x) -> std::vector<Want> {
        const uint32_t index = x[3] % 3;
        std::vector<Want> want = {exactly(x[index]), exactly(x[0]), exactly(x[1]), exactly(x[2])};
        want[1 + index] = exactly(x[5]);
        return want;
      },
      random_words(6, 2));
  check(
      "OpAny, OpAll", 3, 2,
      [](Module& m, const Words& w) -> Words {
        Words parts;
        for (uint32_t i = 0; i < 3; ++i) {
          const Id odd = m.emit(spv::Op::OpBitwiseAnd, m.uint_type(), {w[i], m.constant_uint(1)});
          parts.push_back(m.emit(spv::Op::OpIEqual, m.bool_type(), {odd, m.constant_uint(1)}));
        }
        const Id vector = m.composite(m.vector_type(m.bool_type(), 3), parts);
        const auto word = [&](Id b) {
          return m.emit(spv::Op::OpSelect, m.uint_type(), {b, m.constant_uint(1), m.constant_uint(0)});
        };
        return {word(m.emit(spv::Op::OpAny, m.bool_type(), {vector})),
                word(m.emit(spv::Op::OpAll, m.bool_type(), {vector}))};
      },
      [](const uint32_t* x) -> std::vector<Want> {
        return {exactly((x[0] | x[1] | x[2]) & 1), exactly(x[0] & x[1] & x[2] & 1)};
      },
      random_words(3, 3));
}

TEST(Composites, PairsOfResults) {
  const auto pair = [](spv::Op op, bool is_signed) {
    return [op, is_signed](Module& m, const Words& w) -> Words {
      const Id number = is_signed ? m.int_type() : m.uint_type();
      const Id type = m.type(spv::Op::OpTypeStruct, {number, number});
      const Id a = is_signed ? as_int(m, w[0]) : w[0], b = is_signed ? as_int(m, w[1]) : w[1];
      const Id r = m.emit(op, type, {a, b});
      const Id low = m.extract(number, r, 0), high = m.extract(number, r, 1);
      return is_signed ? Words{as_word(m, low), as_word(m, high)} : Words{low, high};
    };
  };
  const Words operands = random_words(2, 4);
  check(
      "OpIAddCarry", 2, 2, pair(spv::Op::OpIAddCarry, false),
      [](const uint32_t* x) -> std::vector<Want> {
        return {exactly(x[0] + x[1]), exactly(x[0] + x[1] < x[0])};
      },
      operands);
  check(
      "OpISubBorrow", 2, 2, pair(spv::Op::OpISubBorrow, false),
      [](const uint32_t* x) -> std::vector<Want> {
        return {exactly(x[0] - x[1]), exactly(x[0] < x[1])};
      },
      operands);
  check(
      "OpUMulExtended", 2, 2, pair(spv::Op::OpUMulExtended, false),
      [](const uint32_t* x) -> std::vector<Want> {
        const uint64_t product = uint64_t{x[0]} * x[1];
        return {exactly(uint32_t(product)), exactly(uint32_t(product >> 32))};
      },
      operands);
  check(
      "OpSMulExtended", 2, 2, pair(spv::Op::OpSMulExtended, true),
      [](const uint32_t* x) -> std::vector<Want> {
        const auto product = uint64_t(int64_t{int32_t(x[0])} * int32_t(x[1]));
        return {exactly(uint32_t(product)), exactly(uint32_t(product >> 32))};
      },
      operands);
}

TEST(Composites, StructuresAndArrays) {
  // { vec2, float[3], { uint, mat2 } }: built, taken apart, a part replaced, through a variable with dynamic indices.
  check(
      "OpCompositeInsert and access chains", 12, 6,
      [](Module& m, const Words& w) -> Words {
        const Id real = m.float_type(), two = m.vector_type(real, 2), uint = m.uint_type();
        const Id array = m.type(spv::Op::OpTypeArray, {real, m.constant_uint(3)}), matrix = m.matrix_type(two, 2);
        const Id inner = m.type(spv::Op::OpTypeStruct, {uint, matrix}),
                 outer = m.type(spv::Op::OpTypeStruct, {two, array, inner});
        const Id built =
            m.composite(outer, {float_vector(m, w, 0, 2),
                                m.composite(array, {as_float(m, w[2]), as_float(m, w[3]), as_float(m, w[4])}),
                                m.composite(inner, {w[5], float_matrix(m, w, 6, 2, 2)})});
        const Id replaced = m.emit(spv::Op::OpCompositeInsert, outer, {as_float(m, w[10]), built, 2, 1, 1, 0});
        const Id variable = m.local(outer), copy = m.local(outer);
        m.store(variable, replaced);
        m.emit_void(spv::Op::OpCopyMemory, {copy, variable});
        const Id index = m.emit(spv::Op::OpUMod, uint, {w[11], m.constant_uint(3)});
        const Id which = m.emit(spv::Op::OpUMod, uint, {w[11], m.constant_uint(2)});
        const Id pointer = m.pointer_type(spv::StorageClass::Function, real);
        const Id element = m.emit(spv::Op::OpInBoundsAccessChain, pointer, {copy, m.constant_uint(1), index});
        const Id before = m.load(real, element);
        m.store(element, as_float(m, w[0]));
        const Id corner = m.emit(spv::Op::OpAccessChain, pointer,
                                 {copy, m.constant_uint(2), m.constant_uint(1), which, m.constant_uint(0)});
        const Id whole = m.load(outer, copy);
        const auto part = [&](Id of, std::initializer_list<uint32_t> path) {
          Words operands = {of};
          operands.insert(operands.end(), path.begin(), path.end());
          return m.emit(spv::Op::OpCompositeExtract, real, operands);
        };
        return {as_word(m, before),
                as_word(m, m.load(real, corner)),
                as_word(m, part(whole, {1, 0})),
                as_word(m, part(whole, {1, 2})),
                as_word(m, part(whole, {0, 1})),
                as_word(m, part(built, {2, 1, 1, 0}))};
      },
      [](const uint32_t* x) -> std::vector<Want> {
        const uint32_t index = x[11] % 3, which = x[11] % 2;
        uint32_t array[] = {x[2], x[3], x[4]};
        const uint32_t before = array[index];
        array[index] = x[0];
        return {exactly(before),   exactly(which == 0 ? x[6] : x[10]),
                exactly(array[0]), exactly(array[2]),
                exactly(x[1]),     exactly(x[8])};
      },
      random_floats(12, 5));
}

TEST(Composites, PartsOfFloats) {
  const auto fraction = [](uint32_t x) { return std::bit_cast<uint32_t>(f(x) - std::trunc(f(x))); };
  const auto whole = [](uint32_t x) { return std::bit_cast<uint32_t>(std::trunc(f(x))); };
  const auto split = [=](const uint32_t* x) -> std::vector<Want> {
    return {near(d(fraction(x[0])), 0), near(d(whole(x[0])), 0)};
  };
  check(
      "ModfStruct", 1, 2,
      [](Module& m, const Words& w) -> Words {
        const Id type = m.type(spv::Op::OpTypeStruct, {m.float_type(), m.float_type()});
        const Id r = m.ext(GLSLstd450ModfStruct, type, {as_float(m, w[0])});
        return {as_word(m, m.extract(m.float_type(), r, 0)), as_word(m, m.extract(m.float_type(), r, 1))};
      },
      split, random_floats(1, 6));
  check(
      "Modf", 1, 2,
      [](Module& m, const Words& w) -> Words {
        const Id to = m.local(m.float_type()), part = m.ext(GLSLstd450Modf, m.float_type(), {as_float(m, w[0]), to});
        return {as_word(m, part), as_word(m, m.load(m.float_type(), to))};
      },
      split, random_floats(1, 7));
  const auto exponent = [](const uint32_t* x) -> std::vector<Want> {
    int e = 0;
    const float significand = std::frexp(f(x[0]), &e);
    return {exactly(std::bit_cast<uint32_t>(significand)), exactly(uint32_t(e))};
  };
  check(
      "FrexpStruct", 1, 2,
      [](Module& m, const Words& w) -> Words {
        const Id type = m.type(spv::Op::OpTypeStruct, {m.float_type(), m.int_type()});
        const Id r = m.ext(GLSLstd450FrexpStruct, type, {as_float(m, w[0])});
        return {as_word(m, m.extract(m.float_type(), r, 0)), as_word(m, m.extract(m.int_type(), r, 1))};
      },
      exponent, random_floats(1, 8));
  check(
      "Frexp", 1, 2,
      [](Module& m, const Words& w) -> Words {
        const Id to = m.local(m.int_type()), part = m.ext(GLSLstd450Frexp, m.float_type(), {as_float(m, w[0]), to});
        return {as_word(m, part), as_word(m, m.load(m.int_type(), to))};
      },
      exponent, random_floats(1, 9));
}

// Packing of normalized numbers: any float, rounded to nearest even after clamping; and back.
TEST(Composites, Packing) {
  struct Packing {
    const char* name;
    uint32_t pack, unpack;
    uint32_t count;
    double low, scale;  // numbers are clamped to [low, 1] and multiplied
  };
  const Packing kPackings[] = {
      {"Snorm4x8", GLSLstd450PackSnorm4x8, GLSLstd450UnpackSnorm4x8, 4, -1, 127},
      {"Unorm4x8", GLSLstd450PackUnorm4x8, GLSLstd450UnpackUnorm4x8, 4, 0, 255},
      {"Snorm2x16", GLSLstd450PackSnorm2x16, GLSLstd450UnpackSnorm2x16, 2, -1, 32767},
      {"Unorm2x16", GLSLstd450PackUnorm2x16, GLSLstd450UnpackUnorm2x16, 2, 0, 65535},
  };
  for (const Packing& p : kPackings) {
    const uint32_t bits = 32 / p.count, mask = p.count == 4 ? 0xFF : 0xFFFF;
    Words operands = random_floats(p.count + 1, 10);
    for (uint32_t& word : operands) word = std::bit_cast<uint32_t>(f(word) / 8);  // most of them in [-1, 1]
    check(
        p.name, p.count + 1, p.count + 1,
        [p](Module& m, const Words& w) {
          Words out = {m.ext(p.pack, m.uint_type(), {float_vector(m, w, 0, p.count)})};
          const Id type = m.vector_type(m.float_type(), p.count);
          append_vector(m, out, m.ext(p.unpack, type, {w[p.count]}), p.count);
          return out;
        },
        [=](const uint32_t* x) {
          uint32_t packed = 0;
          std::vector<Want> want(1);
          for (uint32_t i = 0; i < p.count; ++i) {
            const float scaled = float(std::clamp(d(x[i]), p.low, 1.0)) * float(p.scale);
            packed |= (uint32_t(int32_t(std::nearbyint(scaled))) & mask) << (bits * i);
            uint32_t code = x[p.count] >> (bits * i) & mask;
            if (p.low < 0 && (code >> (bits - 1)) != 0) code |= ~mask;
            const double value = p.low < 0 ? std::max(int32_t(code) / p.scale, -1.0) : code / p.scale;
            want.push_back(near(value, oracle::ulp(value)));
          }
          want[0] = exactly(packed);
          return want;
        },
        operands);
  }
  check(
      "Half2x16", 3, 3,
      [](Module& m, const Words& w) {
        Words out = {m.ext(GLSLstd450PackHalf2x16, m.uint_type(), {float_vector(m, w, 0, 2)})};
        append_vector(m, out, m.ext(GLSLstd450UnpackHalf2x16, m.vector_type(m.float_type(), 2), {out[0]}), 2);
        return out;
      },
      [](const uint32_t* x) -> std::vector<Want> {
        // Numbers of [-10, 10]: no overflow; a half has 11 bits.
        uint32_t packed = 0;
        std::vector<Want> want(1);
        for (uint32_t i = 0; i < 2; ++i) {
          const double value = d(x[i]), last = std::ldexp(1.0, std::max(std::ilogb(value), -14) - 10);
          const double rounded = std::nearbyint(value / last) * last;
          int e;
          const auto fraction = uint32_t(std::abs(std::frexp(rounded, &e)) * 2048);
          const uint32_t bits =
              e < -13 ? uint32_t(std::abs(rounded) * 0x1p24) : uint32_t(e + 14) << 10 | (fraction & 1023);
          packed |= (bits | (std::signbit(rounded) ? 0x8000u : 0)) << (16 * i);
          want.push_back(near(rounded, 0));
        }
        want[0] = exactly(packed);
        return want;
      },
      random_floats(3, 11));
}

// Of both kinds, without a value given from outside: their defaults.
TEST(Composites, BooleanConstants) {
  check(
      "OpConstantFalse, OpSpecConstantTrue, OpSpecConstantFalse", 1, 2,
      [](Module& m, const Words& w) -> Words {
        const Id yes = m.type_with_result(spv::Op::OpSpecConstantTrue, m.bool_type(), {});
        const Id no = m.type_with_result(spv::Op::OpSpecConstantFalse, m.bool_type(), {});
        m.decorate({yes, uint32_t(spv::Decoration::SpecId), 1});
        m.decorate({no, uint32_t(spv::Decoration::SpecId), 2});
        const Id never = m.emit(spv::Op::OpLogicalOr, m.bool_type(), {m.constant_bool(false), no});
        const auto word = [&](Id b) { return m.emit(spv::Op::OpSelect, m.uint_type(), {b, w[0], m.constant_uint(5)}); };
        return {word(yes), word(never)};
      },
      [](const uint32_t* x) -> std::vector<Want> {
        return {exactly(x[0]), exactly(5)};
      },
      random_words(1, 13));
}

TEST(Composites, ConstantsNullAndUndefined) {
  check(
      "OpConstantComposite, OpConstantNull, OpUndef", 1, 4,
      [](Module& m, const Words& w) -> Words {
        const Id uint = m.uint_type(), two = m.vector_type(uint, 2);
        const Id array = m.type(spv::Op::OpTypeArray, {two, m.constant_uint(2)});
        const Id first =
            m.type_with_result(spv::Op::OpConstantComposite, two, {m.constant_uint(7), m.constant_uint(9)});
        const Id null = m.type_with_result(spv::Op::OpConstantNull, two, {});
        const Id all = m.type_with_result(spv::Op::OpConstantComposite, array, {first, null});
        const Id undefined = m.emit(spv::Op::OpUndef, uint, {});
        const auto at = [&](uint32_t i, uint32_t k) { return m.emit(spv::Op::OpCompositeExtract, uint, {all, i, k}); };
        const Id zero = m.emit(spv::Op::OpBitwiseAnd, uint, {undefined, m.constant_uint(0)});
        return {at(0, 1), m.emit(spv::Op::OpIAdd, uint, {at(1, 1), w[0]}), at(0, 0), zero};
      },
      [](const uint32_t* x) -> std::vector<Want> {
        return {exactly(9), exactly(x[0]), exactly(7), exactly(0)};
      },
      random_words(1, 12));
}

}  // namespace
}  // namespace lapilli::conformance::spirv
