// Lowering: constants, specialization constants and OpSpecConstantOp, evaluated before any code is made.
#include <bit>

#include "shader/spirv/grammar.h"
#include "shader/spirv/lowering.h"

namespace lapilli::spirv {
namespace {

constexpr size_t kMaxConstantWords = 1 << 22;
constexpr uint32_t kTrue = 0xFFFFFFFF;

uint32_t truth(bool b) { return b ? kTrue : 0; }

// As f_to_half, half_to_f and the zero of what no normalized half is give it in lanes.
uint32_t quantize_to_half(uint32_t bits) {
  constexpr uint32_t kInfinity = 0x7F800000, kNaN = 0x7FC00000, kSmallest = 0x38800000;  // 2^-14
  const uint32_t magnitude = bits & ~0x80000000, sign = bits - magnitude;
  if (magnitude > kInfinity) return kNaN;
  // Half-way between the largest denormal half and 2^-14 lies 0x387FE000.
  if (magnitude < kSmallest) return magnitude >= 0x387FE000 ? sign | kSmallest : sign;
  const uint32_t rounded = (magnitude + 0xFFF + (magnitude >> 13 & 1)) & ~uint32_t{0x1FFF};  // to nearest even
  return sign | (rounded >= 0x47800000 ? kInfinity : rounded);                               // from 2^16 on
}

// Operations on scalars; integer division follows ops.def at its edges. Empty: not one of them.
std::optional<uint32_t> fold(spv::Op op, uint32_t a, uint32_t b, uint32_t c) {
  const int32_t sa = static_cast<int32_t>(a), sb = static_cast<int32_t>(b);
  const auto divide = [&](bool remainder, bool sign_of_b) -> uint32_t {
    if (sb == 0) return remainder ? a : kTrue;
    if (sb == -1) return remainder ? 0 : 0 - a;
    if (!remainder) return static_cast<uint32_t>(sa / sb);
    const int32_t rest = sa % sb;
    return static_cast<uint32_t>(sign_of_b && rest != 0 && (rest < 0) != (sb < 0) ? rest + sb : rest);
  };
  switch (op) {
    case spv::Op::OpQuantizeToF16:
      return quantize_to_half(a);
    case spv::Op::OpSNegate:
      return 0 - a;
    case spv::Op::OpNot:
    case spv::Op::OpLogicalNot:
      return ~a;
    case spv::Op::OpIAdd:
      return a + b;
    case spv::Op::OpISub:
      return a - b;
    case spv::Op::OpIMul:
      return a * b;
    case spv::Op::OpUDiv:
      return b == 0 ? kTrue : a / b;
    case spv::Op::OpUMod:
      return b == 0 ? a : a % b;
    case spv::Op::OpSDiv:
      return divide(false, false);
    case spv::Op::OpSRem:
      return divide(true, false);
    case spv::Op::OpSMod:
      return divide(true, true);
    case spv::Op::OpShiftLeftLogical:
      return a << (b & 31);
    case spv::Op::OpShiftRightLogical:
      return a >> (b & 31);
    case spv::Op::OpShiftRightArithmetic:
      return static_cast<uint32_t>(sa >> (b & 31));
    case spv::Op::OpBitwiseOr:
    case spv::Op::OpLogicalOr:
      return a | b;
    case spv::Op::OpBitwiseXor:
    case spv::Op::OpLogicalNotEqual:
      return a ^ b;
    case spv::Op::OpBitwiseAnd:
    case spv::Op::OpLogicalAnd:
      return a & b;
    case spv::Op::OpLogicalEqual:
      return ~(a ^ b);
    case spv::Op::OpIEqual:
      return truth(a == b);
    case spv::Op::OpINotEqual:
      return truth(a != b);
    case spv::Op::OpULessThan:
      return truth(a < b);
    case spv::Op::OpSLessThan:
      return truth(sa < sb);
    case spv::Op::OpUGreaterThan:
      return truth(a > b);
    case spv::Op::OpSGreaterThan:
      return truth(sa > sb);
    case spv::Op::OpULessThanEqual:
      return truth(a <= b);
    case spv::Op::OpSLessThanEqual:
      return truth(sa <= sb);
    case spv::Op::OpUGreaterThanEqual:
      return truth(a >= b);
    case spv::Op::OpSGreaterThanEqual:
      return truth(sa >= sb);
    case spv::Op::OpSelect:
      return a != 0 ? b : c;
    default:
      return std::nullopt;
  }
}

}  // namespace

const std::vector<uint32_t>* Lowering::constant_data(uint32_t id) const {
  return id < constants_of_.size() ? constants_of_[id] : nullptr;
}

uint32_t Lowering::specialized(uint32_t id, uint32_t bits) const {
  const std::optional<uint32_t> constant_id = m_.decoration(id, SpirvModule::kWhole, spv::Decoration::SpecId);
  if (!constant_id) return bits;
  for (const SpecializationEntry& entry : stage_.specialization) {
    if (entry.constant_id == *constant_id) return static_cast<uint32_t>(entry.bits);
  }
  return bits;
}

void Lowering::evaluate_constants() {
  for (const uint32_t word : m_.globals) {
    const SpirvInst inst = m_.at(word);
    if (inst.op == spv::Op::OpVariable) continue;
    word_ = word;
    evaluate_constant(inst);
    if (failed()) return;
  }
}

void Lowering::evaluate_constant(const SpirvInst& inst) {
  const Type& result = type(inst[1]);
  // No value: who uses it is refused.
  if (inst.op == spv::Op::OpUndef && (result.is_handle() || result.kind == Kind::runtime_array)) return;
  if (!result.has_value() || result.components > kMaxValueComponents) return fail("has no value of a sane size");
  constant_words_ += static_cast<size_t>(result.components);
  if (constant_words_ > kMaxConstantWords) return fail("the constants are too many");
  std::vector<uint32_t> bits;
  switch (inst.op) {
    case spv::Op::OpConstantTrue:
    case spv::Op::OpConstantFalse:
      bits = {truth(inst.op == spv::Op::OpConstantTrue)};
      break;
    case spv::Op::OpSpecConstantTrue:
    case spv::Op::OpSpecConstantFalse:
      bits = {truth(specialized(inst[2], inst.op == spv::Op::OpSpecConstantTrue) != 0)};
      break;
    case spv::Op::OpConstant:
    case spv::Op::OpSpecConstant:
      if (inst.count != 4 || result.kind == Kind::boolean || !result.is_scalar()) return fail("is no 32-bit number");
      bits = {inst.op == spv::Op::OpSpecConstant ? specialized(inst[2], inst[3]) : inst[3]};
      break;
    case spv::Op::OpConstantNull:
    case spv::Op::OpUndef:
      bits.assign(static_cast<size_t>(result.components), 0);
      break;
    case spv::Op::OpConstantComposite:
    case spv::Op::OpSpecConstantComposite:
      for (uint32_t i = 3; i < inst.count; ++i) {
        const std::vector<uint32_t>* part = constant_data(inst[i]);
        if (part == nullptr) return fail(m_.name(inst[i]) + " is no constant");
        bits.insert(bits.end(), part->begin(), part->end());
        if (bits.size() > result.components) break;
      }
      break;
    case spv::Op::OpSpecConstantOp:
      bits = evaluate_spec_op(inst);
      break;
    default:
      return fail("is not supported");
  }
  if (!failed() && bits.size() != result.components) return fail("its parts do not fit its type");
  if (constants_of_[inst[2]] == nullptr) constants_of_[inst[2]] = &constants_.emplace_back(std::move(bits));
}

std::vector<uint32_t> Lowering::evaluate_spec_op(const SpirvInst& inst) {
  const spv::Op op = static_cast<spv::Op>(inst[3]);
  const auto operand = [&](uint32_t i) -> std::vector<uint32_t> {
    const std::vector<uint32_t>* bits = i < inst.count ? constant_data(inst[i]) : nullptr;
    if (bits == nullptr) fail("operand " + std::to_string(i - 3) + " is no constant");
    return bits != nullptr ? *bits : std::vector<uint32_t>{};
  };
  const size_t count = static_cast<size_t>(type(inst[1]).components);
  std::vector<uint32_t> result;
  if (op == spv::Op::OpVectorShuffle) {
    std::vector<uint32_t> both = operand(4);
    const std::vector<uint32_t> second = operand(5);
    both.insert(both.end(), second.begin(), second.end());
    for (uint32_t i = 6; i < inst.count; ++i) result.push_back(inst[i] < both.size() ? both[inst[i]] : 0);
    return result;
  }
  if (op == spv::Op::OpCompositeExtract || op == spv::Op::OpCompositeInsert) {
    const bool insert = op == spv::Op::OpCompositeInsert;
    const uint32_t composite = insert ? 5 : 4;
    std::vector<uint32_t> whole = operand(composite);
    if (failed()) return {};
    uint32_t part = m_.ids[inst[composite]].type;
    uint64_t first = 0;
    for (uint32_t i = composite + 1; i < inst.count && !failed(); ++i) {
      const Element step = element(part, inst[i]);
      part = step.type;
      first += step.first;
    }
    const std::vector<uint32_t> object = insert ? operand(4) : std::vector<uint32_t>{};
    const uint64_t size = type(part).components;
    if (failed() || first + size > whole.size() || (insert && object.size() != size)) {
      fail("takes a part that does not exist");
      return {};
    }
    const auto at = whole.begin() + static_cast<std::ptrdiff_t>(first);
    if (!insert) return {at, at + static_cast<std::ptrdiff_t>(size)};
    std::copy(object.begin(), object.end(), at);
    return whole;
  }
  const std::vector<uint32_t> a = operand(4);
  const std::vector<uint32_t> b = inst.count > 5 ? operand(5) : std::vector<uint32_t>(count);
  const std::vector<uint32_t> c = inst.count > 6 ? operand(6) : std::vector<uint32_t>(count);
  const bool one_condition = op == spv::Op::OpSelect && a.size() == 1;
  if (failed()) return {};
  if ((a.size() != count && !one_condition) || b.size() != count || c.size() != count) {
    fail("its operands have another number of components");
    return {};
  }
  for (size_t i = 0; i < count; ++i) {
    const std::optional<uint32_t> bits = fold(op, a[one_condition ? 0 : i], b[i], c[i]);
    if (!bits) {
      const SpirvOpInfo* info = find_spirv_op(inst[3]);
      fail(std::string(info != nullptr ? info->name : "the operation") +
           " is not supported in a specialization constant");
      return {};
    }
    result.push_back(*bits);
  }
  return result;
}

}  // namespace lapilli::spirv
