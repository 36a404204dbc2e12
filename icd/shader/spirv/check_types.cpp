// Which type declarations are supported, and that they are well formed.
// Specification: SPIR-V, "Type-Declaration Instructions".
#include "shader/spirv/grammar.h"
#include "shader/spirv/module.h"

namespace lapilli {
namespace {

bool is_scalar(spv::Op op) {
  return op == spv::Op::OpTypeBool || op == spv::Op::OpTypeInt || op == spv::Op::OpTypeFloat;
}

// What a composite may hold.
bool is_member(spv::Op op) {
  return is_scalar(op) || op == spv::Op::OpTypeVector || op == spv::Op::OpTypeMatrix || op == spv::Op::OpTypeArray ||
         op == spv::Op::OpTypeStruct;
}

bool is_handle(spv::Op op) {
  return op == spv::Op::OpTypeImage || op == spv::Op::OpTypeSampler || op == spv::Op::OpTypeSampledImage;
}

bool is_constant(spv::Op op) { return op >= spv::Op::OpConstantTrue && op <= spv::Op::OpSpecConstantOp; }

Result<void> check_image(const SpirvModule& module, const SpirvInst& inst) {
  // Sampled type, Dim, Depth, Arrayed, MS, Sampled, Format.
  const spv::Op sampled_type = module.op(inst[2]);
  if (static_cast<spv::Dim>(inst[3]) != spv::Dim::Dim2D && static_cast<spv::Dim>(inst[3]) != spv::Dim::Buffer)
    return module.error(inst.word,
                        "images of dimension " + spirv_enum_name(SpirvEnum::Dim, inst[3]) + " are not supported");
  if (inst[5] != 0) return module.error(inst.word, "arrayed images are not supported");
  if (inst[6] != 0) return module.error(inst.word, "multisampled images are not supported");
  if (inst[7] != 1 && inst[7] != 2) return module.error(inst.word, "it is not known if the image is sampled");
  if (sampled_type != spv::Op::OpTypeFloat && sampled_type != spv::Op::OpTypeInt)
    return module.error(inst.word, "its sampled type is no number");
  return {};
}

Result<void> check_pointer(const SpirvModule& module, const SpirvInst& inst) {
  switch (static_cast<spv::StorageClass>(inst[2])) {
    case spv::StorageClass::UniformConstant:
    case spv::StorageClass::Image:
    case spv::StorageClass::Input:
    case spv::StorageClass::Uniform:
    case spv::StorageClass::Workgroup:
    case spv::StorageClass::Output:
    case spv::StorageClass::Private:
    case spv::StorageClass::Function:
    case spv::StorageClass::PushConstant:
    case spv::StorageClass::StorageBuffer:
      break;
    default:
      return module.error(inst.word,
                          "storage class " + spirv_enum_name(SpirvEnum::StorageClass, inst[2]) + " is not supported");
  }
  const spv::Op to = module.op(inst[3]);
  // Compilers leave pointers to nothing and to pointers behind; there can be no variable for them.
  if (is_member(to) || is_handle(to) || to == spv::Op::OpTypeRuntimeArray || to == spv::Op::OpTypeVoid ||
      to == spv::Op::OpTypePointer)
    return {};
  return module.error(inst.word, "points to what has no value");
}

}  // namespace

Result<void> check_type(const SpirvModule& module, const SpirvInst& inst) {
  const auto fail = [&](const char* what) { return Result<void>(module.error(inst.word, what)); };
  switch (inst.op) {
    case spv::Op::OpTypeVoid:
    case spv::Op::OpTypeBool:
    case spv::Op::OpTypeSampler:
      return {};
    case spv::Op::OpTypeInt:
      if (inst[2] != 32) return module.error(inst.word, std::to_string(inst[2]) + "-bit integers are not supported");
      return {};
    case spv::Op::OpTypeFloat:
      if (inst[2] != 32) return module.error(inst.word, std::to_string(inst[2]) + "-bit floats are not supported");
      return {};
    case spv::Op::OpTypeVector:
      if (!is_scalar(module.op(inst[2]))) return fail("its components are no scalars");
      if (inst[3] < 2 || inst[3] > 4) return fail("has not 2 to 4 components");
      return {};
    case spv::Op::OpTypeMatrix:
      if (module.op(inst[2]) != spv::Op::OpTypeVector ||
          module.op(module.definition(inst[2])[2]) != spv::Op::OpTypeFloat)
        return fail("its columns are no vectors of floats");
      if (inst[3] < 2 || inst[3] > 4) return fail("has not 2 to 4 columns");
      return {};
    case spv::Op::OpTypeArray: {
      if (!is_member(module.op(inst[2])) && !is_handle(module.op(inst[2]))) return fail("has elements without a value");
      const uint32_t length = inst[3];
      if (!is_constant(module.op(length)) || module.ids[length].type == 0 ||
          module.op(module.ids[length].type) != spv::Op::OpTypeInt)
        return fail("its length is no constant integer");
      return {};
    }
    case spv::Op::OpTypeRuntimeArray:
      if (!is_member(module.op(inst[2]))) return fail("has elements without a value");
      return {};
    case spv::Op::OpTypeStruct:
      for (uint32_t i = 2; i < inst.count; ++i) {
        const spv::Op member = module.op(inst[i]);
        if (!is_member(member) && !(member == spv::Op::OpTypeRuntimeArray && i + 1 == inst.count))
          return fail("a member has no value, or a runtime array is not the last one");
      }
      return {};
    case spv::Op::OpTypeImage:
      return check_image(module, inst);
    case spv::Op::OpTypeSampledImage:
      if (module.op(inst[2]) != spv::Op::OpTypeImage) return fail("is made of what is no image");
      return {};
    case spv::Op::OpTypePointer:
      return check_pointer(module, inst);
    case spv::Op::OpTypeFunction:
      return {};
    default:
      return fail("is not supported");
  }
}

}  // namespace lapilli
