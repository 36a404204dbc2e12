// See random_operations.h. Floats are whole numbers in [0, 256) wherever an operation ends: sums, differences and
// products of them are exact, and `reduced` brings them back.
#include "spirv/random_operations.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace lapilli::conformance::spirv {
namespace {

float f(uint32_t bits) { return std::bit_cast<float>(bits); }
uint32_t u(float value) { return std::bit_cast<uint32_t>(value); }
int32_t s(uint32_t bits) { return std::bit_cast<int32_t>(bits); }
uint32_t reduced(float x) { return u(x - 256.0f * std::floor(x * (1.0f / 256))); }

Id real_constant(Module& m, float value) { return m.constant(m.float_type(), u(value)); }
Id reduce(Module& m, Id x) {
  const Id real = m.float_type();
  const Id whole = m.ext(GLSLstd450Floor, real, {m.emit(spv::Op::OpFMul, real, {x, real_constant(m, 1.0f / 256)})});
  return m.emit(spv::Op::OpFSub, real, {x, m.emit(spv::Op::OpFMul, real, {whole, real_constant(m, 256)})});
}
Id reduce3(Module& m, Id x) {
  Words parts;
  for (uint32_t i = 0; i < 3; ++i) parts.push_back(reduce(m, m.extract(m.float_type(), x, i)));
  return m.composite(type_id(m, Type::real3), parts);
}

template <spv::Op kOp, Type kType>
Id plain(Module& m, const Words& x) {
  return m.emit(kOp, type_id(m, kType), x);
}
template <spv::Op kOp>
Id masked_shift(Module& m, const Words& x) {
  const Id count = m.emit(spv::Op::OpBitwiseAnd, m.uint_type(), {x[1], m.constant_uint(31)});
  return m.emit(kOp, m.uint_type(), {x[0], count});
}
template <spv::Op kOp>
Id odd_division(Module& m, const Words& x) {
  const Id divisor = m.emit(spv::Op::OpBitwiseOr, m.uint_type(), {x[1], m.constant_uint(1)});
  return m.emit(kOp, m.uint_type(), {x[0], divisor});
}
template <spv::Op kOp>
Id reduced_op(Module& m, const Words& x) {
  return reduce(m, m.emit(kOp, m.float_type(), x));
}
template <uint32_t kInstruction, Type kType>
Id extended(Module& m, const Words& x) {
  return m.ext(kInstruction, type_id(m, kType), x);
}

#define VALUE(...) [](const Value* x) -> Value { return {__VA_ARGS__}; }
#define EMIT(expression) [](Module& m, const Words& x) -> Id { return expression; }

constexpr Type kB = Type::boolean, kU = Type::uint, kI = Type::integer, kF = Type::real, kV = Type::real3,
               kW = Type::uint2;

const std::vector<Operation>& table() {
  static const std::vector<Operation> all = {
      {"add", kU, {kU, kU}, VALUE(x[0][0] + x[1][0]), plain<spv::Op::OpIAdd, kU>},
      {"sub", kU, {kU, kU}, VALUE(x[0][0] - x[1][0]), plain<spv::Op::OpISub, kU>},
      {"mul", kU, {kU, kU}, VALUE(x[0][0] * x[1][0]), plain<spv::Op::OpIMul, kU>},
      {"and", kU, {kU, kU}, VALUE(x[0][0] & x[1][0]), plain<spv::Op::OpBitwiseAnd, kU>},
      {"xor", kU, {kU, kU}, VALUE(x[0][0] ^ x[1][0]), plain<spv::Op::OpBitwiseXor, kU>},
      {"not", kU, {kU}, VALUE(~x[0][0]), plain<spv::Op::OpNot, kU>},
      {"shl", kU, {kU, kU}, VALUE(x[0][0] << (x[1][0] & 31)), masked_shift<spv::Op::OpShiftLeftLogical>},
      {"shr", kU, {kU, kU}, VALUE(x[0][0] >> (x[1][0] & 31)), masked_shift<spv::Op::OpShiftRightLogical>},
      {"div", kU, {kU, kU}, VALUE(x[0][0] / (x[1][0] | 1)), odd_division<spv::Op::OpUDiv>},
      {"mod", kU, {kU, kU}, VALUE(x[0][0] % (x[1][0] | 1)), odd_division<spv::Op::OpUMod>},
      {"popcount", kU, {kU}, VALUE(uint32_t(std::popcount(x[0][0]))), plain<spv::Op::OpBitCount, kU>},
      {"min", kU, {kU, kU}, VALUE(std::min(x[0][0], x[1][0])), extended<GLSLstd450UMin, kU>},
      {"of int", kU, {kI}, VALUE(x[0][0]), plain<spv::Op::OpBitcast, kU>},
      {"of float", kU, {kF}, VALUE(uint32_t(f(x[0][0]))), plain<spv::Op::OpConvertFToU, kU>},
      {"of uint2", kU, {kW}, VALUE(x[0][1]), EMIT(m.extract(m.uint_type(), x[0], 1))},
      {"select", kU, {kB, kU, kU}, VALUE(x[0][0] != 0 ? x[1][0] : x[2][0]), plain<spv::Op::OpSelect, kU>},

      {"add", kI, {kI, kI}, VALUE(x[0][0] + x[1][0]), plain<spv::Op::OpIAdd, kI>},
      {"negate", kI, {kI}, VALUE(0 - x[0][0]), plain<spv::Op::OpSNegate, kI>},
      {"max", kI, {kI, kI}, VALUE(s(x[0][0]) < s(x[1][0]) ? x[1][0] : x[0][0]), extended<GLSLstd450SMax, kI>},
      {"of uint", kI, {kU}, VALUE(x[0][0]), plain<spv::Op::OpBitcast, kI>},
      {"half",
       kI,
       {kI},
       VALUE(uint32_t(s(x[0][0]) >> 1)),
       EMIT(m.emit(spv::Op::OpShiftRightArithmetic, m.int_type(), {x[0], m.constant_uint(1)}))},

      {"add", kF, {kF, kF}, VALUE(reduced(f(x[0][0]) + f(x[1][0]))), reduced_op<spv::Op::OpFAdd>},
      {"sub", kF, {kF, kF}, VALUE(reduced(f(x[0][0]) - f(x[1][0]))), reduced_op<spv::Op::OpFSub>},
      {"mul", kF, {kF, kF}, VALUE(reduced(f(x[0][0]) * f(x[1][0]))), reduced_op<spv::Op::OpFMul>},
      {"max", kF, {kF, kF}, VALUE(u(std::max(f(x[0][0]), f(x[1][0])))), extended<GLSLstd450FMax, kF>},
      {"of uint",
       kF,
       {kU},
       VALUE(u(float(x[0][0] & 255))),
       EMIT(m.emit(spv::Op::OpConvertUToF, m.float_type(),
                   {m.emit(spv::Op::OpBitwiseAnd, m.uint_type(), {x[0], m.constant_uint(255)})}))},
      {"dot",
       kF,
       {kV, kV},
       VALUE(reduced(f(x[0][0]) * f(x[1][0]) + f(x[0][1]) * f(x[1][1]) + f(x[0][2]) * f(x[1][2]))),
       reduced_op<spv::Op::OpDot>},
      {"z", kF, {kV}, VALUE(x[0][2]), EMIT(m.extract(m.float_type(), x[0], 2))},
      {"select", kF, {kB, kF, kF}, VALUE(x[0][0] != 0 ? x[1][0] : x[2][0]), plain<spv::Op::OpSelect, kF>},

      {"less", kB, {kU, kU}, VALUE(x[0][0] < x[1][0]), plain<spv::Op::OpULessThan, kB>},
      {"less", kB, {kI, kI}, VALUE(s(x[0][0]) < s(x[1][0])), plain<spv::Op::OpSLessThan, kB>},
      {"less", kB, {kF, kF}, VALUE(f(x[0][0]) < f(x[1][0])), plain<spv::Op::OpFOrdLessThan, kB>},
      {"equal", kB, {kU, kU}, VALUE(x[0][0] == x[1][0]), plain<spv::Op::OpIEqual, kB>},
      {"odd",
       kB,
       {kU},
       VALUE((x[0][0] & 1) != 0),
       EMIT(m.emit(spv::Op::OpINotEqual, m.bool_type(),
                   {m.emit(spv::Op::OpBitwiseAnd, m.uint_type(), {x[0], m.constant_uint(1)}), m.constant_uint(0)}))},
      {"and", kB, {kB, kB}, VALUE(x[0][0] & x[1][0]), plain<spv::Op::OpLogicalAnd, kB>},
      {"or", kB, {kB, kB}, VALUE(x[0][0] | x[1][0]), plain<spv::Op::OpLogicalOr, kB>},
      {"not", kB, {kB}, VALUE(1 - x[0][0]), plain<spv::Op::OpLogicalNot, kB>},

      {"vec3", kV, {kF, kF, kF}, VALUE(x[0][0], x[1][0], x[2][0]), plain<spv::Op::OpCompositeConstruct, kV>},
      {"add",
       kV,
       {kV, kV},
       VALUE(reduced(f(x[0][0]) + f(x[1][0])), reduced(f(x[0][1]) + f(x[1][1])), reduced(f(x[0][2]) + f(x[1][2]))),
       EMIT(reduce3(m, m.emit(spv::Op::OpFAdd, type_id(m, kV), x)))},
      {"scale",
       kV,
       {kV, kF},
       VALUE(reduced(f(x[0][0]) * f(x[1][0])), reduced(f(x[0][1]) * f(x[1][0])), reduced(f(x[0][2]) * f(x[1][0]))),
       EMIT(reduce3(m, m.emit(spv::Op::OpVectorTimesScalar, type_id(m, kV), x)))},
      {"zxy",
       kV,
       {kV},
       VALUE(x[0][2], x[0][0], x[0][1]),
       EMIT(m.emit(spv::Op::OpVectorShuffle, type_id(m, kV), {x[0], x[0], 2, 0, 4}))},

      {"uvec2", kW, {kU, kU}, VALUE(x[0][0], x[1][0]), plain<spv::Op::OpCompositeConstruct, kW>},
      {"add", kW, {kW, kW}, VALUE(x[0][0] + x[1][0], x[0][1] + x[1][1]), plain<spv::Op::OpIAdd, kW>},
      {"insert",
       kW,
       {kW, kU},
       VALUE(x[0][0], x[1][0]),
       EMIT(m.emit(spv::Op::OpCompositeInsert, type_id(m, kW), {x[1], x[0], 1}))},
  };
  return all;
}

}  // namespace

std::span<const Operation> operations() { return table(); }

Id type_id(Module& m, Type type) {
  switch (type) {
    case Type::boolean:
      return m.bool_type();
    case Type::uint:
      return m.uint_type();
    case Type::integer:
      return m.int_type();
    case Type::real:
      return m.float_type();
    case Type::real3:
      return m.vector_type(m.float_type(), 3);
    case Type::uint2:
      return m.vector_type(m.uint_type(), 2);
  }
  return 0;
}

uint32_t word_of(Type type, const Value& value) {
  switch (type) {
    case Type::real:
      return uint32_t(f(value[0]));
    case Type::real3:
      return uint32_t(f(value[0])) + 256 * uint32_t(f(value[1])) + 65536 * uint32_t(f(value[2]));
    case Type::uint2:
      return value[0] + 31 * value[1];
    default:
      return value[0];
  }
}

Id word_id(Module& m, Type type, Id value) {
  const Id uint = m.uint_type();
  const auto whole = [&](Id real) { return m.emit(spv::Op::OpConvertFToU, uint, {real}); };
  const auto times = [&](Id x, uint32_t factor) { return m.emit(spv::Op::OpIMul, uint, {x, m.constant_uint(factor)}); };
  const auto add = [&](Id a, Id b) { return m.emit(spv::Op::OpIAdd, uint, {a, b}); };
  switch (type) {
    case Type::boolean:
      return m.emit(spv::Op::OpSelect, uint, {value, m.constant_uint(1), m.constant_uint(0)});
    case Type::uint:
      return value;
    case Type::integer:
      return m.emit(spv::Op::OpBitcast, uint, {value});
    case Type::real:
      return whole(value);
    case Type::real3: {
      const auto part = [&](uint32_t i) { return whole(m.extract(m.float_type(), value, i)); };
      return add(add(part(0), times(part(1), 256)), times(part(2), 65536));
    }
    case Type::uint2:
      return add(m.extract(uint, value, 0), times(m.extract(uint, value, 1), 31));
  }
  return 0;
}

Value constant_value(Type type, uint32_t bits) {
  switch (type) {
    case Type::boolean:
      return {bits & 1};
    case Type::real:
      return {u(float(bits & 255))};
    case Type::real3:
      return {u(float(bits & 255)), u(float(bits >> 8 & 255)), u(float(bits >> 16 & 255))};
    case Type::uint2:
      return {bits, bits >> 5};
    default:
      return {bits};
  }
}

Id constant_id(Module& m, Type type, uint32_t bits) {
  const Value value = constant_value(type, bits);
  switch (type) {
    case Type::boolean:
      return m.constant_bool(value[0] != 0);
    case Type::real3:
      return m.type_with_result(spv::Op::OpConstantComposite, type_id(m, type),
                                {m.constant(m.float_type(), value[0]), m.constant(m.float_type(), value[1]),
                                 m.constant(m.float_type(), value[2])});
    case Type::uint2:
      return m.type_with_result(spv::Op::OpConstantComposite, type_id(m, type),
                                {m.constant_uint(value[0]), m.constant_uint(value[1])});
    default:
      return m.constant(type_id(m, type), value[0]);
  }
}

}  // namespace lapilli::conformance::spirv
