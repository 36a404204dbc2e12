// Lowering: sampled 2D images, combined or separate from their sampler.
// Specification: chapter "Image Operations".
#include <bit>

#include "shader/spirv/lowering.h"

namespace lapilli::spirv {
namespace {

constexpr uint32_t bit(spv::ImageOperandsShift shift) { return 1u << static_cast<uint32_t>(shift); }
constexpr uint32_t kBias = bit(spv::ImageOperandsShift::Bias);
constexpr uint32_t kLod = bit(spv::ImageOperandsShift::Lod);
constexpr uint32_t kGrad = bit(spv::ImageOperandsShift::Grad);

}  // namespace

std::span<const Reg> Lowering::emit_image(Opcode op, const Value& image, std::span<const Reg> operands) {
  std::vector<Reg> list{image.regs[0], image.regs[1]};
  list.insert(list.end(), operands.begin(), operands.end());
  const uint32_t results = op == Opcode::size_2d ? 2 : 4;
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
  const Reg zero[] = {constant(0)};
  const std::span<const Reg> size = emit_image(Opcode::size_2d, image, zero);
  const Reg width = emit(Opcode::s_to_f, size[0]), height = emit(Opcode::s_to_f, size[1]);
  const auto length2 = [&](std::span<const Reg> d) {
    const Reg texels[] = {emit(Opcode::fmul, d[0], width), emit(Opcode::fmul, d[1], height)};
    return dot(texels, texels);
  };
  const Reg longer = emit(Opcode::fmax, length2(dx), length2(dy));
  return emit(Opcode::fmul, emit(Opcode::flog2, longer), constant_f(0.5f));
}

void Lowering::lower_sample(const SpirvInst& inst) {
  const bool fetch = inst.op == spv::Op::OpImageFetch;
  const bool explicit_lod = inst.op == spv::Op::OpImageSampleExplicitLod;
  const Value* image = find_value(inst[3]);
  if (image == nullptr || image->shape != Value::Shape::handle) return fail("its image has no value here");
  if (type_of(inst[3]).kind != (fetch ? Kind::image : Kind::sampled_image)) return fail("its image has the wrong type");
  const std::span<const Reg> coordinate = data(inst[4]);
  if (coordinate.size() != 2) return fail("its coordinate has not two components");
  if ((scalar_kind(type_of(inst[4])) == Kind::real) == fetch) return fail("its coordinate has the wrong type");
  const uint32_t mask = inst.count > 5 ? inst[5] : 0;
  const uint32_t allowed = explicit_lod ? kLod | kGrad : fetch ? kLod : kBias;
  if ((mask & ~allowed) != 0) return fail("its image operands (mask " + std::to_string(mask) + ") are not supported");
  if (std::popcount(mask) > 1 || (explicit_lod && mask == 0)) return fail("its image operands contradict each other");
  const uint32_t needed = mask == 0 ? 0 : mask == kGrad ? 2 : 1;
  if (inst.count < (mask == 0 ? 5 : 6) + needed) return fail("its image operands are missing");
  Opcode op = fetch ? Opcode::fetch_2d : explicit_lod ? Opcode::sample_2d_lod : Opcode::sample_2d;
  if (op == Opcode::sample_2d && which_ != VK_SHADER_STAGE_FRAGMENT_BIT) op = Opcode::sample_2d_lod;  // level 0
  Reg last = constant(0);
  if (mask == kGrad) {
    const std::span<const Reg> dx = data(inst[6], 2), dy = data(inst[7], 2);
    if (!failed()) last = gradient_lod(*image, dx, dy);
  } else if (mask != 0) {
    last = scalar(inst[6]);
    if (fetch && !type_of(inst[6]).is_integer()) return fail("its level is no integer");
    // The constant 0 of an integer type is the same register as 0.0; other integers are not meant as a level here.
    if (!fetch && type_of(inst[6]).kind != Kind::real) last = emit(Opcode::s_to_f, last);
  }
  if (failed()) return;
  const Reg operands[] = {coordinate[0], coordinate[1], last};
  bind(inst[2], emit_image(op, *image, operands));
}

bool Lowering::lower_image(const SpirvInst& inst) {
  switch (inst.op) {
    case spv::Op::OpSampledImage: {
      const Value* image = find_value(inst[3]);
      const Value* sampler = find_value(inst[4]);
      if (image == nullptr || sampler == nullptr || type_of(inst[3]).kind != Kind::image ||
          type_of(inst[4]).kind != Kind::sampler || image->shape != Value::Shape::handle ||
          sampler->shape != Value::Shape::handle) {
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
      const Value* image = find_value(inst[3]);
      if (image == nullptr || image->shape != Value::Shape::handle || type(inst[1]).kind != Kind::image) {
        fail("its operand is no sampled image");
        return true;
      }
      bind(inst[2], *image);
      return true;
    }
    case spv::Op::OpImageSampleImplicitLod:
    case spv::Op::OpImageSampleExplicitLod:
    case spv::Op::OpImageFetch:
      lower_sample(inst);
      return true;
    case spv::Op::OpImageQuerySizeLod: {
      const Value* image = find_value(inst[3]);
      if (image == nullptr || image->shape != Value::Shape::handle) {
        fail("its image has no value here");
        return true;
      }
      const Reg level[] = {scalar(inst[4])};
      if (!failed()) bind(inst[2], emit_image(Opcode::size_2d, *image, level));
      return true;
    }
    default:
      return false;
  }
}

}  // namespace lapilli::spirv
