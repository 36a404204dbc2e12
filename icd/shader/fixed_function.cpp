// Blend equations: result = source * factor (op) destination * factor, fused as fma(destination, factor, source *
// factor). Attachments of fixed-point formats clamp source, constants and thereby the destination's factors to [0, 1]
// first; float ones do not.
#include "shader/fixed_function.h"

#include <algorithm>
#include <optional>

#include "image/format.h"

namespace lapilli {
namespace {

constexpr uint32_t kAlpha = 3;

class Blender {
 public:
  Blender(Code& code, uint32_t index, bool clamps, std::array<Reg, 4> source)
      : code_(code), index_(index), clamps_(clamps), source_(source) {}

  Reg component(uint32_t c, const VkPipelineColorBlendAttachmentState& state) {
    const bool alpha = c == kAlpha;
    const VkBlendOp op = alpha ? state.alphaBlendOp : state.colorBlendOp;
    if (op == VK_BLEND_OP_MIN) return code_.emit(Opcode::fmin, source(c), destination(c));
    if (op == VK_BLEND_OP_MAX) return code_.emit(Opcode::fmax, source(c), destination(c));
    const VkBlendFactor source_factor = alpha ? state.srcAlphaBlendFactor : state.srcColorBlendFactor;
    const VkBlendFactor destination_factor = alpha ? state.dstAlphaBlendFactor : state.dstColorBlendFactor;
    const Reg s = source_factor == VK_BLEND_FACTOR_ZERO ? kNoReg : times(source(c), source_factor, c);
    if (destination_factor == VK_BLEND_FACTOR_ZERO) {
      if (s == kNoReg) return code_.constant(0);
      return op == VK_BLEND_OP_REVERSE_SUBTRACT ? code_.emit(Opcode::fneg, s) : s;
    }
    const Reg d = destination(c);
    if (s == kNoReg) {
      const Reg product = times(d, destination_factor, c);
      return op == VK_BLEND_OP_SUBTRACT ? code_.emit(Opcode::fneg, product) : product;
    }
    if (destination_factor == VK_BLEND_FACTOR_ONE) {
      if (op == VK_BLEND_OP_ADD) return code_.emit(Opcode::fadd, s, d);
      return op == VK_BLEND_OP_SUBTRACT ? code_.emit(Opcode::fsub, s, d) : code_.emit(Opcode::fsub, d, s);
    }
    const Reg f = factor(destination_factor, c);
    if (op == VK_BLEND_OP_ADD) return code_.emit(Opcode::fma, d, f, s);
    if (op == VK_BLEND_OP_SUBTRACT) return code_.emit(Opcode::fma, code_.emit(Opcode::fneg, d), f, s);
    return code_.emit(Opcode::fma, d, f, code_.emit(Opcode::fneg, s));
  }

 private:
  // To [0, 1]; a NaN becomes 0.
  Reg clamp(Reg reg) {
    return code_.emit(Opcode::fmin, code_.constant_f(1.0f), code_.emit(Opcode::fmax, code_.constant(0), reg));
  }

  Reg once(Reg& kept, Reg value) {
    kept = clamps_ ? clamp(value) : value;
    return kept;
  }

  Reg source(uint32_t c) { return clamped_[c] != kNoReg ? clamped_[c] : once(clamped_[c], source_[c]); }

  Reg constant(uint32_t c) {
    if (constants_[c] != kNoReg) return constants_[c];
    const uint32_t imm = static_cast<uint32_t>(BuiltIn::blend_constant_r) + c;
    return once(constants_[c], code_.emit(Opcode::builtin, kNoReg, kNoReg, kNoReg, imm));
  }

  Reg destination(uint32_t c) {
    if (destination_ == kNoReg) destination_ = code_.emit_n(Opcode::load_color, 4, kNoReg, kNoReg, kNoReg, index_);
    return destination_ + c;
  }

  Reg one_minus(Reg reg) { return code_.emit(Opcode::fsub, code_.constant_f(1.0f), reg); }

  Reg times(Reg value, VkBlendFactor by, uint32_t c) {
    if (by == VK_BLEND_FACTOR_ONE || (by == VK_BLEND_FACTOR_SRC_ALPHA_SATURATE && c == kAlpha)) return value;
    return code_.emit(Opcode::fmul, value, factor(by, c));
  }

  Reg factor(VkBlendFactor which, uint32_t c) {
    switch (which) {
      case VK_BLEND_FACTOR_SRC_COLOR:
        return source(c);
      case VK_BLEND_FACTOR_ONE_MINUS_SRC_COLOR:
        return one_minus(source(c));
      case VK_BLEND_FACTOR_DST_COLOR:
        return destination(c);
      case VK_BLEND_FACTOR_ONE_MINUS_DST_COLOR:
        return one_minus(destination(c));
      case VK_BLEND_FACTOR_SRC_ALPHA:
        return source(kAlpha);
      case VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA:
        return one_minus(source(kAlpha));
      case VK_BLEND_FACTOR_DST_ALPHA:
        return destination(kAlpha);
      case VK_BLEND_FACTOR_ONE_MINUS_DST_ALPHA:
        return one_minus(destination(kAlpha));
      case VK_BLEND_FACTOR_CONSTANT_COLOR:
        return constant(c);
      case VK_BLEND_FACTOR_ONE_MINUS_CONSTANT_COLOR:
        return one_minus(constant(c));
      case VK_BLEND_FACTOR_CONSTANT_ALPHA:
        return constant(kAlpha);
      case VK_BLEND_FACTOR_ONE_MINUS_CONSTANT_ALPHA:
        return one_minus(constant(kAlpha));
      case VK_BLEND_FACTOR_SRC_ALPHA_SATURATE:
        if (c == kAlpha) return code_.constant_f(1.0f);
        return code_.emit(Opcode::fmin, source(kAlpha), one_minus(destination(kAlpha)));
      case VK_BLEND_FACTOR_ZERO:
        return code_.constant(0);
      default:
        return code_.constant_f(1.0f);
    }
  }

  Code& code_;
  uint32_t index_;
  bool clamps_;
  std::array<Reg, 4> source_;
  std::array<Reg, 4> clamped_{kNoReg, kNoReg, kNoReg, kNoReg};
  std::array<Reg, 4> constants_{kNoReg, kNoReg, kNoReg, kNoReg};
  Reg destination_ = kNoReg;
};

bool is_supported(VkBlendFactor factor) {
  return factor >= VK_BLEND_FACTOR_ZERO && factor <= VK_BLEND_FACTOR_SRC_ALPHA_SATURATE;
}

bool is_unorm8(const FormatInfo* format) {
  return format != nullptr &&
         std::all_of(format->components.begin(), format->components.end(),
                     [](const ComponentLayout& c) { return c.kind == ComponentKind::unorm && c.bits == 8; });
}

std::optional<uint32_t> blend_term(VkBlendFactor factor) {
  switch (factor) {
    case VK_BLEND_FACTOR_ZERO:
      return static_cast<uint32_t>(BlendTerm::zero);
    case VK_BLEND_FACTOR_ONE:
      return static_cast<uint32_t>(BlendTerm::one);
    case VK_BLEND_FACTOR_SRC_ALPHA:
      return static_cast<uint32_t>(BlendTerm::source_alpha);
    case VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA:
      return static_cast<uint32_t>(BlendTerm::one_minus_source_alpha);
    default:
      return std::nullopt;
  }
}

// The imm2 of blend_color; none where the equation is not of its kind or does not read the destination.
std::optional<uint32_t> blend_word(const VkPipelineColorBlendAttachmentState& state, uint32_t mask) {
  const VkBlendFactor factors[] = {state.srcColorBlendFactor, state.dstColorBlendFactor, state.srcAlphaBlendFactor,
                                   state.dstAlphaBlendFactor};
  if (state.colorBlendOp > VK_BLEND_OP_REVERSE_SUBTRACT || state.alphaBlendOp > VK_BLEND_OP_REVERSE_SUBTRACT) return {};
  if (factors[1] == VK_BLEND_FACTOR_ZERO && factors[3] == VK_BLEND_FACTOR_ZERO) return {};
  uint32_t word = mask;
  for (uint32_t i = 0; i < 4; ++i) {
    const std::optional<uint32_t> term = blend_term(factors[i]);
    if (!term) return {};
    word |= *term << (4 + 2 * i);
  }
  return word | static_cast<uint32_t>(state.colorBlendOp) << 12 | static_cast<uint32_t>(state.alphaBlendOp) << 14;
}

}  // namespace

Result<void> emit_color(Code& code, uint32_t index, const VkPipelineColorBlendAttachmentState& state,
                        std::array<Reg, 4> source) {
  constexpr VkColorComponentFlags kAllComponents = 0xF;
  const VkColorComponentFlags mask = state.colorWriteMask & kAllComponents;
  if (mask == 0) return {};
  if (state.blendEnable == VK_TRUE) {
    if (state.colorBlendOp > VK_BLEND_OP_MAX || state.alphaBlendOp > VK_BLEND_OP_MAX)
      return Error{VK_ERROR_UNKNOWN, "blend operations beyond Vulkan 1.0 are not supported"};
    if (!is_supported(state.srcColorBlendFactor) || !is_supported(state.dstColorBlendFactor) ||
        !is_supported(state.srcAlphaBlendFactor) || !is_supported(state.dstAlphaBlendFactor))
      return Error{VK_ERROR_UNKNOWN, "blending with a second source colour is not supported"};
    const FormatInfo* format = find_format(code.color_formats[index]);
    if (const std::optional<uint32_t> word = blend_word(state, mask); word && is_unorm8(format)) {
      Instruction& blend = code.append(Opcode::blend_color);
      blend.imm = index;
      blend.imm2 = *word;
      code.set_list(blend, source);
      return {};
    }
    const bool clamps = format != nullptr && format->components[0].kind == ComponentKind::unorm;
    Blender blender(code, index, clamps, source);
    std::array<Reg, 4> blended{kNoReg, kNoReg, kNoReg, kNoReg};
    for (uint32_t c = 0; c < 4; ++c) {
      if ((mask >> c & 1) != 0) blended[c] = blender.component(c, state);
    }
    source = blended;
  }
  for (uint32_t c = 0; c < 4; ++c) {
    if ((mask >> c & 1) == 0) source[c] = kNoReg;
  }
  Instruction& store = code.append(Opcode::store_color);
  store.imm = index;
  store.imm2 = mask;
  code.set_list(store, source);
  return {};
}

}  // namespace lapilli
