// Lowering: uniform and storage buffers and push constants; offsets and strides come from the decorations. And the
// workgroup's memory, where a variable's scalars lie one behind the other.
// Specification: chapter "Shader Interfaces", "Offset and Stride Assignment".
#include <tuple>

#include "shader/batch.h"
#include "shader/spirv/lowering.h"

namespace lapilli::spirv {
namespace {
constexpr uint32_t kBufferResults = 4;    // components of one load_buffer
constexpr uint32_t kUniformResults = 16;  // of one load_uniform or load_push
}  // namespace

// Byte offset and kind of each scalar behind a pointer; wraps like the addresses.
void Lowering::collect_offsets(const Pointer& from, std::vector<uint64_t>& offsets, std::vector<Kind>& kinds) {
  const Type& whole = type(from.type);
  if (from.space == Space::shared) {
    collect_scalar_kinds(from.type, kinds);
    for (size_t i = 0; i < kinds.size(); ++i) offsets.push_back(from.offset + 4 * i);
    return;
  }
  if (whole.is_scalar()) {
    if (whole.kind == Kind::boolean) return fail("booleans have no layout in memory");
    offsets.push_back(from.offset);
    kinds.push_back(whole.kind);
    return;
  }
  if (whole.kind == Kind::runtime_array) return fail("is no value of a known size");
  if (whole.components == 0 && whole.has_value()) return;
  if (whole.kind == Kind::structure) steps_ += whole.count;  // members may be nothing
  if (!within_limits()) return;
  for (uint32_t i = 0; i < whole.count && !failed(); ++i) {
    Pointer part = from;
    switch (whole.kind) {
      case Kind::structure: {
        const auto offset = m_.decoration(whole.id, i, spv::Decoration::Offset);
        if (!offset) return fail("a member has no Offset");
        part.type = whole.members[i];
        part.offset += *offset;
        part.component_stride = 4;
        part.matrix_stride = m_.decoration(whole.id, i, spv::Decoration::MatrixStride).value_or(0);
        part.row_major = m_.decoration(whole.id, i, spv::Decoration::RowMajor).has_value();
        break;
      }
      case Kind::array: {
        const auto stride = m_.decoration(whole.id, SpirvModule::kWhole, spv::Decoration::ArrayStride);
        if (!stride) return fail("an array has no ArrayStride");
        part.type = whole.element;
        part.offset += i * *stride;
        break;
      }
      case Kind::matrix:
        if (from.matrix_stride == 0) return fail("a matrix has no MatrixStride");
        part.type = whole.element;
        part.offset += i * (from.row_major ? 4 : from.matrix_stride);
        part.component_stride = from.row_major ? from.matrix_stride : 4;
        break;
      case Kind::vector:
        part.type = whole.element;
        part.offset += i * from.component_stride;
        break;
      default:
        return fail("has no layout in memory");
    }
    collect_offsets(part, offsets, kinds);
  }
}

// Resource of a descriptor, and the register with its index in an array that is indexed at run time.
std::pair<uint32_t, Reg> Lowering::resolve_descriptor(const BindingSlot* slot, uint32_t offset, Reg dynamic,
                                                      bool uniform) {
  if (slot == nullptr) {
    fail("a descriptor's binding is not in the pipeline layout");
    return {add_resource({}), kNoReg};
  }
  ResourceRef ref{slot->set, slot->first, slot->count, slot->dynamic_offset, uniform};
  if (dynamic != kNoReg)
    return {add_resource(ref), offset == 0 ? dynamic : emit(Opcode::iadd, dynamic, constant(offset))};
  if (offset >= slot->count) fail("the binding has no descriptor " + std::to_string(offset));
  ref.first += offset;
  ref.count = 1;
  if (ref.dynamic_offset >= 0) ref.dynamic_offset += static_cast<int32_t>(offset);
  return {add_resource(ref), kNoReg};
}

// Code::add_resource compares with each one that is there; here there may be thousands.
uint32_t Lowering::add_resource(const ResourceRef& ref) {
  const std::array<uint32_t, 5> key = {ref.set, ref.first, ref.count, static_cast<uint32_t>(ref.dynamic_offset),
                                       ref.uniform};
  const auto [at, added] = resources_.try_emplace(key, static_cast<uint32_t>(code_.resources.size()));
  if (added) code_.resources.push_back(ref);
  return at->second;
}

// The memory behind a pointer: a descriptor, or a variable of the workgroup, which gets its place when it is first
// used.
std::pair<uint32_t, Reg> Lowering::resource_of(const Pointer& pointer) {
  if (pointer.space != Space::shared)
    return resolve_descriptor(pointer.slot, pointer.descriptor_offset, pointer.descriptor, pointer.uniform);
  if (which_ != VK_SHADER_STAGE_COMPUTE_BIT) fail("shared memory is for compute shaders");
  Variable& variable = *pointer.variable;
  const uint32_t bytes = 4 * variable.count;
  if (variable.first == kNoReg) {
    variable.first = code_.shared_bytes;
    code_.shared_bytes += bytes;
    if (code_.shared_bytes > kMaxSharedBytes) fail("the shared memory is larger than maxComputeSharedMemorySize");
  }
  return {add_resource({kSharedMemory, variable.first, bytes}), kNoReg};
}

std::vector<Reg> Lowering::load_memory(const Pointer& from) {
  std::vector<uint64_t> offsets;
  std::vector<Kind> kinds;
  collect_offsets(from, offsets, kinds);
  std::vector<Reg> regs(offsets.size(), constant(0));
  if (failed()) return regs;
  const bool push = from.space == Space::push;
  uint32_t resource = 0;
  Reg descriptor = kNoReg;
  if (!push) std::tie(resource, descriptor) = resource_of(from);
  const bool fixed = from.dynamic == kNoReg && (push || (from.uniform && descriptor == kNoReg));
  const size_t most = fixed ? kUniformResults : kBufferResults;
  for (size_t i = 0; i < offsets.size() && !failed();) {
    const uint32_t offset = static_cast<uint32_t>(offsets[i]);
    if (push && offset % 4 != 0) fail("a push constant is not aligned to 4 bytes");
    if (push && offset >= kMaxPushConstantBytes) {  // reads 0
      ++i;
      continue;
    }
    uint32_t run = 1;
    while (i + run < offsets.size() && run < most && offsets[i + run] == offsets[i] + 4 * run &&
           (!push || offset + 4 * run < kMaxPushConstantBytes))
      ++run;
    Reg first;
    if (push) {
      first = fixed ? code_.emit_n(Opcode::load_push, run, kNoReg, kNoReg, kNoReg, 0, offset)
                    : code_.emit_n(Opcode::load_push_indexed, run, from.dynamic, kNoReg, kNoReg, 0, offset);
    } else if (fixed) {
      first = code_.emit_n(Opcode::load_uniform, run, kNoReg, kNoReg, kNoReg, resource, offset);
    } else {
      const Reg address = from.dynamic == kNoReg ? constant(0) : from.dynamic;
      first = code_.emit_n(Opcode::load_buffer, run, address, descriptor, kNoReg, resource, offset);
    }
    for (uint32_t n = 0; n < run; ++n) regs[i + n] = first + n;
    i += run;
  }
  return regs;
}

void Lowering::store_memory(const Pointer& to, std::span<const Reg> values) {
  if (to.uniform) return fail("stores to a uniform block");
  std::vector<uint64_t> offsets;
  std::vector<Kind> kinds;
  collect_offsets(to, offsets, kinds);
  if (failed()) return;
  const auto [resource, descriptor] = resource_of(to);
  const Reg address = to.dynamic == kNoReg ? constant(0) : to.dynamic;
  for (size_t i = 0; i < offsets.size() && i < values.size(); ++i) {
    const Reg value = kinds[i] == Kind::real ? canonical(values[i]) : values[i];
    code_.emit_void(Opcode::store_buffer, address, value, descriptor, resource, static_cast<uint32_t>(offsets[i]));
  }
  out_.stores = true;
}

void Lowering::lower_array_length(const SpirvInst& inst) {
  const Pointer* block = pointer(inst[3]);
  if (block == nullptr) return;
  const Type& whole = type(block->type);
  if (block->space != Space::buffer || whole.kind != Kind::structure || inst[4] >= whole.count ||
      type(whole.members[inst[4]]).kind != Kind::runtime_array)
    return fail("asks for the length of what is no runtime array in a buffer");
  const auto offset = m_.decoration(whole.id, inst[4], spv::Decoration::Offset);
  const auto stride = m_.decoration(whole.members[inst[4]], SpirvModule::kWhole, spv::Decoration::ArrayStride);
  if (!offset || !stride || *stride == 0) return fail("the array has no Offset or ArrayStride");
  const auto [resource, descriptor] = resolve_descriptor(block->slot, block->descriptor_offset, block->descriptor);
  const Reg size = code_.emit(Opcode::buffer_size, kNoReg, descriptor, kNoReg, resource);
  const Reg start = constant(block->offset + *offset);
  const Reg bytes = emit(Opcode::isub, emit(Opcode::umax, size, start), start);
  const Reg length = emit(Opcode::udiv, bytes, constant(*stride));
  bind(inst[2], {&length, 1});
}

}  // namespace lapilli::spirv
