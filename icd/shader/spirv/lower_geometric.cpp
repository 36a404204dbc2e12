// Lowering: geometric and matrix functions of GLSL.std.450.
//   length(x)       sqrt(dot(x, x)), |x| of a scalar         normalize(x)   x * inversesqrt(dot(x, x))
//   cross(a, b)     a1 * b2 - b1 * a2 … without fma          reflect(i, n)  i - (2 * dot(n, i)) * n
//   refract         k = 1 - eta * eta * (1 - dot(n, i)^2); k < 0 ? 0 : eta * i - (eta * dot(n, i) + sqrt(k)) * n
//   determinant     by 2x2 minors, products without fma      inverse        adjugate / determinant
#include <spirv/unified1/GLSL.std.450.h>

#include "shader/spirv/lowering.h"

namespace lapilli::spirv {
namespace {
constexpr uint32_t kFirstOperand = 5;
}

bool Lowering::lower_ext_geometric(const SpirvInst& inst) {
  const uint32_t number = inst[4];
  const auto operand = [&](uint32_t i) { return data(inst[kFirstOperand + i]); };
  const auto mul = [&](Reg a, Reg b) { return emit(Opcode::fmul, a, b); };
  const auto sub = [&](Reg a, Reg b) { return emit(Opcode::fsub, a, b); };
  std::vector<Reg> regs;
  switch (number) {
    case GLSLstd450Length:
    case GLSLstd450Distance: {
      const std::span<const Reg> to = operand(0);
      std::vector<Reg> x(to.begin(), to.end());
      if (number == GLSLstd450Distance) {
        const std::span<const Reg> from = data(inst[kFirstOperand + 1], x.size());
        for (size_t i = 0; i < x.size(); ++i) x[i] = sub(x[i], from[i]);
      }
      if (x.empty() || failed()) return true;
      regs = {x.size() == 1 ? emit(Opcode::fabs, x[0]) : emit(Opcode::fsqrt, dot(x, x))};
      break;
    }
    case GLSLstd450Normalize: {
      const std::span<const Reg> x = operand(0);
      if (x.empty() || failed()) return true;
      const Reg inverse = emit(Opcode::frsqrt, dot(x, x));
      for (const Reg reg : x) regs.push_back(mul(reg, inverse));
      break;
    }
    case GLSLstd450Cross: {
      const std::span<const Reg> a = data(inst[kFirstOperand], 3), b = data(inst[kFirstOperand + 1], 3);
      for (size_t i = 0; i < 3; ++i) {
        const size_t j = (i + 1) % 3, k = (i + 2) % 3;
        regs.push_back(sub(mul(a[j], b[k]), mul(b[j], a[k])));
      }
      break;
    }
    case GLSLstd450FaceForward: {  // N, I, Nref
      const std::span<const Reg> n = operand(0);
      const std::span<const Reg> i = data(inst[kFirstOperand + 1], n.size());
      const std::span<const Reg> reference = data(inst[kFirstOperand + 2], n.size());
      if (n.empty() || failed()) return true;
      const Reg towards = emit(Opcode::flt, dot(reference, i), constant(0));
      for (const Reg reg : n) regs.push_back(emit(Opcode::select, towards, reg, emit(Opcode::fneg, reg)));
      break;
    }
    case GLSLstd450Reflect: {  // I, N
      const std::span<const Reg> i = operand(0), n = data(inst[kFirstOperand + 1], i.size());
      if (i.empty() || failed()) return true;
      const Reg factor = mul(constant_f(2.0f), dot(n, i));
      for (size_t c = 0; c < i.size(); ++c) regs.push_back(sub(i[c], mul(factor, n[c])));
      break;
    }
    case GLSLstd450Refract: {  // I, N, eta
      const std::span<const Reg> i = operand(0), n = data(inst[kFirstOperand + 1], i.size());
      const Reg eta = scalar(inst[kFirstOperand + 2]);
      if (i.empty() || failed()) return true;
      const Reg one = constant_f(1.0f), zero = constant(0);
      const Reg d = dot(n, i);
      const Reg k = sub(one, mul(mul(eta, eta), sub(one, mul(d, d))));
      const Reg total = emit(Opcode::flt, k, zero);  // total reflection
      const Reg factor = emit(Opcode::fadd, mul(eta, d), emit(Opcode::fsqrt, k));
      for (size_t c = 0; c < i.size(); ++c)
        regs.push_back(emit(Opcode::select, total, zero, sub(mul(eta, i[c]), mul(factor, n[c]))));
      break;
    }
    default:
      return false;
  }
  if (!failed()) bind(inst[2], regs);
  return true;
}

namespace {

// Determinants of square matrices up to 4x4, column by column like SPIR-V; `skip` leaves out one row and column.
class Minors {
 public:
  Minors(Code& code, std::span<const Reg> matrix, size_t size) : code_(code), matrix_(matrix), size_(size) {}

  Reg determinant() {
    std::vector<size_t> all(size_);
    for (size_t i = 0; i < size_; ++i) all[i] = i;
    return determinant(all, all);
  }

  // Determinant without a row and a column, with the sign of its place.
  Reg cofactor(size_t row, size_t column) {
    std::vector<size_t> rows, columns;
    for (size_t i = 0; i < size_; ++i) {
      if (i != row) rows.push_back(i);
      if (i != column) columns.push_back(i);
    }
    const Reg minor = determinant(rows, columns);
    return (row + column) % 2 == 0 ? minor : code_.emit(Opcode::fneg, minor);
  }

 private:
  Reg at(size_t row, size_t column) const { return matrix_[column * size_ + row]; }

  Reg determinant(const std::vector<size_t>& rows, const std::vector<size_t>& columns) {
    if (rows.size() == 1) return at(rows[0], columns[0]);
    Reg sum = kNoReg;
    for (size_t i = 0; i < columns.size(); ++i) {
      std::vector<size_t> rest = columns;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
      const Reg minor = determinant({rows.begin() + 1, rows.end()}, rest);
      const Reg term = code_.emit(Opcode::fmul, at(rows[0], columns[i]), minor);
      if (sum == kNoReg) {
        sum = term;
      } else {
        sum = code_.emit(i % 2 == 0 ? Opcode::fadd : Opcode::fsub, sum, term);
      }
    }
    return sum;
  }

  Code& code_;
  std::span<const Reg> matrix_;
  size_t size_;
};

}  // namespace

void Lowering::lower_matrix_function(const SpirvInst& inst) {
  const Type& matrix_type = type_of(inst[kFirstOperand]);
  const std::span<const Reg> matrix = data(inst[kFirstOperand]);
  const size_t size = matrix_type.count;
  if (matrix_type.kind != Kind::matrix || matrix.size() != size * size) return fail("its operand is no square matrix");
  Minors minors(code_, matrix, size);
  if (inst[4] == GLSLstd450Determinant) {
    const Reg determinant = minors.determinant();
    return bind(inst[2], {&determinant, 1});
  }
  std::vector<Reg> cofactors(size * size);  // [row][column]
  for (size_t row = 0; row < size; ++row) {
    for (size_t column = 0; column < size; ++column) cofactors[row * size + column] = minors.cofactor(row, column);
  }
  std::vector<Reg> row(size), first(size), regs;
  for (size_t column = 0; column < size; ++column) {
    row[column] = matrix[column * size];
    first[column] = cofactors[column];
  }
  const Reg determinant = dot(row, first);
  // The inverse is the transposed matrix of cofactors: its column c, row r is the cofactor of row c, column r.
  for (size_t column = 0; column < size; ++column) {
    for (size_t r = 0; r < size; ++r) regs.push_back(emit(Opcode::fdiv, cofactors[column * size + r], determinant));
  }
  bind(inst[2], regs);
}

}  // namespace lapilli::spirv
