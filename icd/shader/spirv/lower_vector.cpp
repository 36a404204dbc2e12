// Lowering: vectors and matrices. A sum of products is a chain of fma in index order: fma(a3, b3, fma(a2, b2, fma(a1,
// b1, a0 * b0))).
#include <algorithm>

#include "shader/spirv/lowering.h"

namespace lapilli::spirv {

Reg Lowering::dot(std::span<const Reg> a, std::span<const Reg> b) {
  Reg sum = emit(Opcode::fmul, a[0], b[0]);
  for (size_t i = 1; i < a.size(); ++i) sum = emit(Opcode::fma, a[i], b[i], sum);
  return sum;
}

// Element of a short vector by an index known at run time; outside the bounds the last one.
Reg Lowering::select_dynamic(std::span<const Reg> values, Reg index) {
  if (const auto bits = constant_bits(index)) return values[std::min<size_t>(*bits, values.size() - 1)];
  Reg reg = values.back();
  for (size_t i = values.size() - 1; i-- > 0;)
    reg = emit(Opcode::select, emit(Opcode::ieq, index, constant(static_cast<uint32_t>(i))), values[i], reg);
  return reg;
}

bool Lowering::lower_vector(const SpirvInst& inst) {
  std::vector<Reg> regs;
  switch (inst.op) {
    case spv::Op::OpVectorExtractDynamic: {
      const std::span<const Reg> vector = data(inst[3]);
      const Reg index = scalar(inst[4]);
      if (vector.empty() || failed()) break;
      regs = {select_dynamic(vector, index)};
      break;
    }
    case spv::Op::OpVectorInsertDynamic: {
      const std::span<const Reg> vector = data(inst[3]);
      const Reg value = scalar(inst[4]), index = scalar(inst[5]);
      for (size_t i = 0; i < vector.size(); ++i) {
        const Reg here = emit(Opcode::ieq, index, constant(static_cast<uint32_t>(i)));
        regs.push_back(emit(Opcode::select, here, value, vector[i]));
      }
      break;
    }
    case spv::Op::OpVectorShuffle: {
      const std::span<const Reg> first = data(inst[3]), second = data(inst[4]);
      for (uint32_t i = 5; i < inst.count; ++i) {
        const uint32_t n = inst[i];
        if (n < first.size()) {
          regs.push_back(first[n]);
        } else if (n - first.size() < second.size()) {
          regs.push_back(second[n - first.size()]);
        } else {
          if (n != 0xFFFFFFFF) fail("takes a component that does not exist");
          regs.push_back(constant(0));  // undefined
        }
      }
      break;
    }
    case spv::Op::OpDot: {
      const std::span<const Reg> a = data(inst[3]), b = data(inst[4], a.size());
      if (a.empty() || failed()) break;
      regs = {dot(a, b)};
      break;
    }
    case spv::Op::OpVectorTimesScalar:
    case spv::Op::OpMatrixTimesScalar: {
      const Reg factor = scalar(inst[4]);
      for (const Reg reg : data(inst[3])) regs.push_back(emit(Opcode::fmul, reg, factor));
      break;
    }
    case spv::Op::OpTranspose: {
      const std::span<const Reg> matrix = data(inst[3]);
      const uint32_t columns = type_of(inst[3]).count;
      if (type_of(inst[3]).kind != Kind::matrix) fail("its operand is no matrix");
      const size_t rows = failed() ? 0 : matrix.size() / columns;
      for (size_t row = 0; row < rows; ++row) {
        for (size_t column = 0; column < columns; ++column) regs.push_back(matrix[column * rows + row]);
      }
      if (!failed() && type(inst[1]).count != rows) fail("its result has another type");
      break;
    }
    case spv::Op::OpOuterProduct: {
      const std::span<const Reg> column = data(inst[3]), row = data(inst[4]);
      if (type(inst[1]).kind != Kind::matrix || type(inst[1]).count != row.size()) fail("its result has another type");
      for (const Reg b : row) {
        for (const Reg a : column) regs.push_back(emit(Opcode::fmul, a, b));
      }
      break;
    }
    case spv::Op::OpMatrixTimesVector:
    case spv::Op::OpVectorTimesMatrix:
    case spv::Op::OpMatrixTimesMatrix:
      lower_matrix_product(inst);
      return true;
    default:
      return false;
  }
  if (!failed()) bind(inst[2], regs);
  return true;
}

// Rows of the left operand with columns of the right one; a vector is one column or one row.
void Lowering::lower_matrix_product(const SpirvInst& inst) {
  const std::span<const Reg> left = data(inst[3]), right = data(inst[4]);
  const bool row_vector = inst.op == spv::Op::OpVectorTimesMatrix;
  const bool column_vector = inst.op == spv::Op::OpMatrixTimesVector;
  const Type& a = type_of(inst[3]);
  const Type& b = type_of(inst[4]);
  if (failed()) return;
  if (a.kind != (row_vector ? Kind::vector : Kind::matrix) || b.kind != (column_vector ? Kind::vector : Kind::matrix))
    return fail("its operands are not a matrix and what it says");
  const size_t inner = a.count;
  const size_t rows = row_vector ? 1 : left.size() / inner;
  const size_t columns = column_vector ? 1 : b.count;
  if (right.size() != inner * columns) return fail("its operands do not fit each other");
  std::vector<Reg> regs, row(inner);
  for (size_t column = 0; column < columns; ++column) {
    for (size_t r = 0; r < rows; ++r) {
      for (size_t i = 0; i < inner; ++i) row[i] = left[i * rows + r];
      regs.push_back(dot(row, right.subspan(column * inner, inner)));
    }
  }
  bind(inst[2], regs);
}

}  // namespace lapilli::spirv
