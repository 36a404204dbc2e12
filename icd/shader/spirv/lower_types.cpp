// Lowering: types with their sizes in scalars.
#include <algorithm>

#include "shader/spirv/lowering.h"

namespace lapilli::spirv {
namespace {
constexpr uint64_t kManyComponents = uint64_t{1} << 32;  // absurd, but far from overflow
uint64_t saturated(uint64_t count) { return std::min(count, kManyComponents); }
}  // namespace

const Type& Lowering::type(uint32_t id) {
  if (types_of_[id] == nullptr) types_of_[id] = &types_.emplace_back(resolve(id));
  return *types_of_[id];
}

// The depth of types is limited by the reader, and so is the recursion.
Type Lowering::resolve(uint32_t id) {
  Type t;
  t.id = id;
  if (id == 0) return t;
  const SpirvInst inst = m_.definition(id);
  switch (inst.op) {
    case spv::Op::OpTypeBool:
      t.kind = Kind::boolean;
      break;
    case spv::Op::OpTypeInt:
      t.kind = inst[3] != 0 ? Kind::sint : Kind::uint;
      break;
    case spv::Op::OpTypeFloat:
      t.kind = Kind::real;
      break;
    case spv::Op::OpTypeVector:
    case spv::Op::OpTypeMatrix:
      t.kind = inst.op == spv::Op::OpTypeVector ? Kind::vector : Kind::matrix;
      t.element = inst[2];
      t.count = inst[3];
      t.components = t.count * type(t.element).components;
      break;
    case spv::Op::OpTypeArray: {
      t.kind = Kind::array;
      t.element = inst[2];
      const std::vector<uint32_t>* length = constant_data(inst[3]);
      t.count = length != nullptr && length->size() == 1 ? (*length)[0] : 0;
      if (t.count == 0) fail("an array has no elements");
      t.components = saturated(t.count * type(t.element).components);
      break;
    }
    case spv::Op::OpTypeRuntimeArray:
      t.kind = Kind::runtime_array;
      t.element = inst[2];
      t.components = kManyComponents;
      break;
    case spv::Op::OpTypeStruct:
      t.kind = Kind::structure;
      t.count = inst.count - 2;
      for (uint32_t i = 2; i < inst.count; ++i) {
        t.members.push_back(inst[i]);
        t.member_first.push_back(t.components);
        t.components = saturated(t.components + type(inst[i]).components);
      }
      break;
    case spv::Op::OpTypePointer:
      t.kind = Kind::pointer;
      t.element = inst[3];
      break;
    case spv::Op::OpTypeImage:
      t.kind = Kind::image;
      t.element = inst[2];
      break;
    case spv::Op::OpTypeSampledImage:
      t.kind = Kind::sampled_image;
      t.element = inst[2];
      break;
    case spv::Op::OpTypeSampler:
      t.kind = Kind::sampler;
      break;
    default:
      break;
  }
  if (t.is_scalar()) t.components = t.count = 1;
  return t;
}

spv::Dim Lowering::dimension(const Type& image) const {
  return static_cast<spv::Dim>(m_.definition(image.kind == Kind::sampled_image ? image.element : image.id)[3]);
}

Kind Lowering::scalar_kind(const Type& of) {
  if (of.is_scalar()) return of.kind;
  return of.kind == Kind::vector ? type(of.element).kind : Kind::none;
}

Lowering::Element Lowering::element(uint32_t composite, uint32_t index) {
  const Type& whole = type(composite);
  if (whole.kind == Kind::structure && index < whole.count) return {whole.members[index], whole.member_first[index]};
  const bool indexed = whole.kind == Kind::vector || whole.kind == Kind::matrix || whole.kind == Kind::array;
  if (indexed && index < whole.count) return {whole.element, index * type(whole.element).components};
  fail("takes element " + std::to_string(index) + " of a composite that has none");
  return {};
}

void Lowering::collect_scalar_kinds(uint32_t id, std::vector<Kind>& kinds) {
  const Type& whole = type(id);
  if (whole.components == 0) return;
  if (whole.is_scalar()) {
    kinds.push_back(whole.kind);
  } else if (whole.kind == Kind::structure) {
    steps_ += whole.count;  // members may be nothing
    if (!within_limits()) return;
    for (const uint32_t member : whole.members) collect_scalar_kinds(member, kinds);
  } else {
    for (uint32_t i = 0; i < whole.count; ++i) collect_scalar_kinds(whole.element, kinds);
  }
}

}  // namespace lapilli::spirv
