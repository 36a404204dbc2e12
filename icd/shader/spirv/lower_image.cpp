// Lowering: images, sampled (combined with or separate from their sampler) and storage ones.
// Specification: chapter "Image Operations"; SPIR-V, "Image Operands" and "Image Instructions".
#include <array>
#include <bit>

#include "shader/spirv/grammar.h"
#include "shader/spirv/lowering.h"

namespace lapilli::spirv {
namespace {

constexpr uint32_t bit(spv::ImageOperandsShift shift) { return 1u << static_cast<uint32_t>(shift); }
constexpr uint32_t kBias = bit(spv::ImageOperandsShift::Bias);
constexpr uint32_t kLod = bit(spv::ImageOperandsShift::Lod);
constexpr uint32_t kGrad = bit(spv::ImageOperandsShift::Grad);
constexpr uint32_t kConstOffset = bit(spv::ImageOperandsShift::ConstOffset);
constexpr uint32_t kOffset = bit(spv::ImageOperandsShift::Offset);
constexpr uint32_t kConstOffsets = bit(spv::ImageOperandsShift::ConstOffsets);
constexpr uint32_t kKnownOperands = kBias | kLod | kGrad | kConstOffset | kOffset | kConstOffsets;

// What distinguishes the instructions that read through a sampler; the first operand behind the coordinate is there
// for those with a reference and for gathers.
struct SampleForm {
  bool is_sample = false, explicit_lod = false, reference = false, projective = false, gather = false;
};
SampleForm sample_form(spv::Op op) {
  constexpr uint32_t kFirst = static_cast<uint32_t>(spv::Op::OpImageSampleImplicitLod);
  const uint32_t number = static_cast<uint32_t>(op) - kFirst;
  if (op == spv::Op::OpImageGather || op == spv::Op::OpImageDrefGather)
    return {true, false, op == spv::Op::OpImageDrefGather, false, true};
  if (number > static_cast<uint32_t>(spv::Op::OpImageSampleProjDrefExplicitLod) - kFirst) return {};
  return {true, (number & 1) != 0, (number & 2) != 0, (number & 4) != 0, false};  // in this order since SPIR-V 1.0
}

}  // namespace

const Value* Lowering::image_value(uint32_t id) {
  const Value* image = find_value(id);
  if (image != nullptr && image->shape == Value::Shape::handle &&
      (type_of(id).kind == Kind::image || type_of(id).kind == Kind::sampled_image))
    return image;
  fail(m_.name(id) + " is no image that has a value here");
  return nullptr;
}

// `operands`: those of the op's list behind the descriptor indices; what is missing at the end is left out.
std::span<const Reg> Lowering::emit_image(Opcode op, const Value& image, std::span<const Reg> operands) {
  std::vector<Reg> list{image.regs[0], image.regs[1]};
  list.insert(list.end(), operands.begin(), operands.end());
  list.resize(image_list(op).count, kNoReg);
  const uint32_t results = static_cast<uint32_t>(op_info(op).results);
  Instruction& instruction = code_.append(op, results);
  instruction.imm = image.texture;
  instruction.imm2 = image.sampler;
  code_.set_list(instruction, list);
  const Reg first = code_.instructions.back().dst;
  const std::span<Reg> regs = allocate(results);
  for (uint32_t i = 0; i < results; ++i) regs[i] = first + i;
  return regs;
}

// log2 of the longer of the two derivatives, in texels of the base level (the ideal ellipse's approximation that the
// specification allows).
Reg Lowering::gradient_lod(const Value& image, std::span<const Reg> dx, std::span<const Reg> dy) {
  const std::span<const Reg> size = emit_image(Opcode::size_2d, image, {});
  const Reg width = emit(Opcode::s_to_f, size[0]), height = emit(Opcode::s_to_f, size[1]);
  const auto length2 = [&](std::span<const Reg> d) {
    const Reg texels[] = {emit(Opcode::fmul, d[0], width), emit(Opcode::fmul, d[1], height)};
    return dot(texels, texels);
  };
  const Reg longer = emit(Opcode::fmax, length2(dx), length2(dy));
  return emit(Opcode::fmul, emit(Opcode::flog2, longer), constant_f(0.5f));
}

// The image operands from word `at` on: a mask, then values in the order of its bits.
Lowering::ImageOperands Lowering::read_image_operands(const SpirvInst& inst, uint32_t at, uint32_t allowed) {
  ImageOperands out;
  if (inst.count <= at) return out;
  const uint32_t mask = inst[at++];
  const uint32_t refused = mask & ~(allowed & kKnownOperands);
  const uint32_t offsets = mask & (kConstOffset | kOffset | kConstOffsets);
  if (refused != 0) {
    fail("its image operand " + spirv_enum_name(SpirvEnum::ImageOperands, refused & -refused) + " is not supported");
  } else if (std::popcount(offsets) > 1 || std::popcount(mask & (kBias | kLod | kGrad)) > 1) {
    fail("its image operands contradict each other");
  } else if ((offsets & (kOffset | kConstOffsets)) != 0 && !m_.declares(spv::Capability::ImageGatherExtended)) {
    fail("its image operands need the capability ImageGatherExtended");
  } else if (inst.count != at + static_cast<uint32_t>(std::popcount(mask)) + ((mask & kGrad) != 0 ? 1 : 0)) {
    fail("its image operands are not as many as their mask says");
  }
  if (failed()) return out;
  if ((mask & (kBias | kLod)) != 0) out.lod = inst[at++];
  if ((mask & kGrad) != 0) out.dx = inst[at++], out.dy = inst[at++];
  if (offsets == 0) return out;
  out.offsets = data(inst[at], (offsets & kConstOffsets) != 0 ? 8 : 2);
  if ((offsets & kOffset) == 0 && constant_data(inst[at]) == nullptr) fail("its offset is no constant");
  return out;
}

void Lowering::lower_sample(const SpirvInst& inst) {
  const SampleForm form = sample_form(inst.op);
  const Value* image = image_value(inst[3]);
  if (image == nullptr) return;
  if (type_of(inst[3]).kind != Kind::sampled_image || dimension(type_of(inst[3])) != spv::Dim::Dim2D)
    return fail("its image has the wrong type");
  const std::span<const Reg> coordinate = data(inst[4]);
  if (coordinate.size() < (form.projective ? 3 : 2)) return fail("its coordinate has too few components");
  if (scalar_kind(type_of(inst[4])) != Kind::real) return fail("its coordinate has the wrong type");
  const uint32_t lods = form.gather ? kConstOffsets : form.explicit_lod ? kLod | kGrad : kBias;
  const ImageOperands given =
      read_image_operands(inst, form.reference || form.gather ? 6 : 5, lods | kConstOffset | kOffset);
  if (failed()) return;
  if (form.explicit_lod && given.lod == 0 && given.dx == 0) return fail("has neither Lod nor Grad");

  enum : uint32_t { kU, kV, kLodOrComponent, kReference, kX, kY, kCount };
  std::array<Reg, kCount> list;
  list.fill(kNoReg);
  list[kU] = coordinate[0];
  list[kV] = coordinate[1];
  if (form.reference) list[kReference] = scalar(inst[5]);
  if (form.projective) {
    for (Reg& reg : list) {
      if (reg != kNoReg) reg = emit(Opcode::fdiv, reg, coordinate[2]);
    }
  }
  if (form.gather && !form.reference) list[kLodOrComponent] = scalar(inst[5]);
  if (given.lod != 0) {
    Reg lod = scalar(given.lod);
    // The constant 0 of an integer type is the same register as 0.0; other integers are not meant as a level here.
    if (type_of(given.lod).kind != Kind::real) lod = emit(Opcode::s_to_f, lod);
    list[kLodOrComponent] = lod;
  }
  if (given.dx != 0) {
    const std::span<const Reg> dx = data(given.dx, 2), dy = data(given.dy, 2);
    if (failed()) return;
    list[kLodOrComponent] = gradient_lod(*image, dx, dy);
  }
  if (failed()) return;
  if (form.gather) {
    std::array<Reg, 4> texels;
    if (given.offsets.size() < 8) {
      if (!given.offsets.empty()) list[kX] = given.offsets[0], list[kY] = given.offsets[1];
      return bind(inst[2], emit_image(Opcode::gather_2d, *image, list));
    }
    for (size_t i = 0; i < 4; ++i) {  // each of the four is the upper left one of its own footprint
      list[kX] = given.offsets[2 * i];
      list[kY] = given.offsets[2 * i + 1];
      texels[i] = emit_image(Opcode::gather_2d, *image, list)[3];
    }
    return bind(inst[2], texels);
  }
  if (!given.offsets.empty()) list[kX] = given.offsets[0], list[kY] = given.offsets[1];
  // Outside of fragment shaders the implicit level is the first one.
  const bool derivatives = !form.explicit_lod && which_ == VK_SHADER_STAGE_FRAGMENT_BIT;
  if (!form.explicit_lod && !derivatives) list[kLodOrComponent] = kNoReg;
  const std::span<const Reg> texel = emit_image(derivatives ? Opcode::sample_2d : Opcode::sample_2d_lod, *image, list);
  bind(inst[2], form.reference ? texel.first(1) : texel);
}

void Lowering::lower_fetch(const SpirvInst& inst) {
  const Value* image = image_value(inst[3]);
  const bool fetch = inst.op == spv::Op::OpImageFetch;
  const ImageOperands given = read_image_operands(inst, 5, fetch ? kLod | kConstOffset | kOffset : 0);
  const std::array<Reg, 2> texel = texel_coordinate(type_of(inst[3]), inst[4]);
  if (failed()) return;
  if (given.lod != 0 && !type_of(given.lod).is_integer()) return fail("its level is no integer");
  Reg list[] = {texel[0], texel[1], given.lod != 0 ? scalar(given.lod) : kNoReg};
  for (size_t i = 0; i < given.offsets.size(); ++i) list[i] = emit(Opcode::iadd, list[i], given.offsets[i]);
  const uint64_t components = type(inst[1]).components;
  if (components > 4) return fail("its result has too many components");
  if (!failed()) bind(inst[2], emit_image(Opcode::fetch_2d, *image, list).first(components));
}

void Lowering::lower_image_write(const SpirvInst& inst) {
  const Value* image = image_value(inst[1]);
  read_image_operands(inst, 4, 0);
  const std::array<Reg, 2> texel = texel_coordinate(type_of(inst[1]), inst[2]);
  const std::span<const Reg> value = data(inst[3]);
  if (failed()) return;
  if (value.size() > 4) return fail("its texel has too many components");
  Reg list[6] = {texel[0], texel[1], constant(0), constant(0), constant(0), constant(0)};
  std::copy(value.begin(), value.end(), list + 2);
  emit_image(Opcode::store_2d, *image, list);
  out_.stores = true;
}

// What the atomic instructions take (lower_atomics.cpp).
void Lowering::lower_texel_pointer(const SpirvInst& inst) {
  const Pointer* image = pointer(inst[3]);
  if (image == nullptr) return;
  if (image->space != Space::handle || type(image->type).kind != Kind::image || type(inst[1]).kind != Kind::pointer ||
      !type(type(inst[1]).element).is_integer())
    return fail("points to no integer texel of an image");
  Value value;
  value.shape = Value::Shape::pointer;
  value.pointer = *image;
  value.pointer.space = Space::texel;
  value.pointer.type = type(inst[1]).element;
  value.pointer.texel = texel_coordinate(type(image->type), inst[4]);
  if (!failed()) bind(inst[2], value);
}

// x and y of a texel of an image without a sampler; texel buffers are one row.
std::array<Reg, 2> Lowering::texel_coordinate(const Type& image, uint32_t id) {
  const std::span<const Reg> coordinate = data(id);
  if (failed()) return {};
  if (image.kind != Kind::image) {
    fail("its image has the wrong type");
    return {};
  }
  const size_t dimensions = dimension(image) == spv::Dim::Buffer ? 1 : 2;
  const Kind kind = scalar_kind(type_of(id));
  if (coordinate.size() < dimensions) fail("its coordinate has too few components");
  if (kind != Kind::sint && kind != Kind::uint) fail("its coordinate has the wrong type");
  if (failed()) return {};
  return {coordinate[0], dimensions == 2 ? coordinate[1] : constant(0)};
}

void Lowering::lower_image_query(const SpirvInst& inst) {
  const Value* image = image_value(inst[3]);
  if (image == nullptr) return;
  if (inst.op == spv::Op::OpImageQueryLod) {
    if (which_ != VK_SHADER_STAGE_FRAGMENT_BIT) return fail("is for fragment shaders");
    const std::span<const Reg> coordinate = data(inst[4]);
    if (coordinate.size() < 2) return fail("its coordinate has too few components");
    return bind(inst[2], emit_image(Opcode::query_lod_2d, *image, coordinate.first(2)));
  }
  Reg level = kNoReg;
  if (inst.op == spv::Op::OpImageQuerySizeLod) level = scalar(inst[4]);
  if (failed()) return;
  const std::span<const Reg> size = emit_image(Opcode::size_2d, *image, {&level, 1});
  const bool one_row = dimension(type_of(inst[3])) == spv::Dim::Buffer;
  bind(inst[2], inst.op == spv::Op::OpImageQueryLevels ? size.last(1) : size.first(one_row ? 1 : 2));
}

bool Lowering::lower_image(const SpirvInst& inst) {
  switch (inst.op) {
    case spv::Op::OpSampledImage: {
      const Value* image = image_value(inst[3]);
      const Value* sampler = find_value(inst[4]);
      if (image == nullptr || sampler == nullptr || type_of(inst[3]).kind != Kind::image ||
          type_of(inst[4]).kind != Kind::sampler || sampler->shape != Value::Shape::handle) {
        fail("is not made of an image and a sampler");
        return true;
      }
      Value both = *image;
      both.sampler = sampler->sampler;
      const std::span<Reg> regs = allocate(2);
      regs[0] = image->regs[0];
      regs[1] = sampler->regs[1];
      both.regs = regs;
      bind(inst[2], both);
      return true;
    }
    case spv::Op::OpImage: {
      const Value* image = image_value(inst[3]);
      if (image == nullptr || type(inst[1]).kind != Kind::image) {
        fail("its operand is no sampled image");
        return true;
      }
      bind(inst[2], *image);
      return true;
    }
    case spv::Op::OpImageFetch:
    case spv::Op::OpImageRead:
      lower_fetch(inst);
      return true;
    case spv::Op::OpImageTexelPointer:
      lower_texel_pointer(inst);
      return true;
    case spv::Op::OpImageWrite:
      lower_image_write(inst);
      return true;
    case spv::Op::OpImageQuerySizeLod:
    case spv::Op::OpImageQuerySize:
    case spv::Op::OpImageQueryLevels:
    case spv::Op::OpImageQueryLod:
      lower_image_query(inst);
      return true;
    default:
      if (!sample_form(inst.op).is_sample) return false;
      lower_sample(inst);
      return true;
  }
}

}  // namespace lapilli::spirv
