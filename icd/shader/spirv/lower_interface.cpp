// Lowering: the variables outside functions (inputs, outputs, resources, Private) and the entry point's execution
// modes. Specification: chapter "Shader Interfaces".
#include <algorithm>
#include <iterator>

#include "shader/batch.h"
#include "shader/spirv/grammar.h"
#include "shader/spirv/lowering.h"

namespace lapilli::spirv {
namespace {

constexpr uint32_t kMaxLocations = kClipDistanceLocation;

struct BuiltInRow {
  spv::BuiltIn built_in;
  VkShaderStageFlagBits stage;
  bool output;
  uint32_t components;
};
constexpr BuiltInRow kBuiltIns[] = {
    {spv::BuiltIn::VertexIndex, VK_SHADER_STAGE_VERTEX_BIT, false, 1},
    {spv::BuiltIn::InstanceIndex, VK_SHADER_STAGE_VERTEX_BIT, false, 1},
    {spv::BuiltIn::BaseVertex, VK_SHADER_STAGE_VERTEX_BIT, false, 1},
    {spv::BuiltIn::BaseInstance, VK_SHADER_STAGE_VERTEX_BIT, false, 1},
    {spv::BuiltIn::DrawIndex, VK_SHADER_STAGE_VERTEX_BIT, false, 1},
    {spv::BuiltIn::Position, VK_SHADER_STAGE_VERTEX_BIT, true, 4},
    {spv::BuiltIn::PointSize, VK_SHADER_STAGE_VERTEX_BIT, true, 1},
    {spv::BuiltIn::FragCoord, VK_SHADER_STAGE_FRAGMENT_BIT, false, 4},
    {spv::BuiltIn::FrontFacing, VK_SHADER_STAGE_FRAGMENT_BIT, false, 1},
    {spv::BuiltIn::HelperInvocation, VK_SHADER_STAGE_FRAGMENT_BIT, false, 1},
    {spv::BuiltIn::SampleId, VK_SHADER_STAGE_FRAGMENT_BIT, false, 1},
    {spv::BuiltIn::SamplePosition, VK_SHADER_STAGE_FRAGMENT_BIT, false, 2},
    {spv::BuiltIn::PointCoord, VK_SHADER_STAGE_FRAGMENT_BIT, false, 2},
    {spv::BuiltIn::SampleMask, VK_SHADER_STAGE_FRAGMENT_BIT, false, 1},
    {spv::BuiltIn::SampleMask, VK_SHADER_STAGE_FRAGMENT_BIT, true, 1},
    {spv::BuiltIn::FragDepth, VK_SHADER_STAGE_FRAGMENT_BIT, true, 1},
    {spv::BuiltIn::NumWorkgroups, VK_SHADER_STAGE_COMPUTE_BIT, false, 3},
    {spv::BuiltIn::WorkgroupId, VK_SHADER_STAGE_COMPUTE_BIT, false, 3},
    {spv::BuiltIn::LocalInvocationId, VK_SHADER_STAGE_COMPUTE_BIT, false, 3},
    {spv::BuiltIn::GlobalInvocationId, VK_SHADER_STAGE_COMPUTE_BIT, false, 3},
    {spv::BuiltIn::LocalInvocationIndex, VK_SHADER_STAGE_COMPUTE_BIT, false, 1},
};

}  // namespace

void Lowering::declare_globals(const SpirvEntryPoint& entry) {
  std::vector<uint32_t> interface = entry.interface;
  std::ranges::sort(interface);
  for (const uint32_t word : m_.globals) {
    const SpirvInst inst = m_.at(word);
    if (inst.op != spv::Op::OpVariable) continue;
    word_ = word;
    if (type(inst[1]).kind != Kind::pointer || m_.definition(inst[1])[2] != inst[3])
      return fail("its type is no pointer of its storage class");
    switch (static_cast<spv::StorageClass>(inst[3])) {
      case spv::StorageClass::Input:
      case spv::StorageClass::Output:
        if (std::ranges::binary_search(interface, inst[2]))
          declare_interface(inst, static_cast<spv::StorageClass>(inst[3]) == spv::StorageClass::Output);
        break;
      case spv::StorageClass::Private:
        lower_variable(inst);
        break;
      case spv::StorageClass::PushConstant: {
        Value value;
        value.shape = Value::Shape::pointer;
        value.pointer.space = Space::push;
        value.pointer.type = type(inst[1]).element;
        bind(inst[2], value);
        break;
      }
      case spv::StorageClass::UniformConstant:
        declare_resource(inst, true);
        break;
      case spv::StorageClass::Uniform:
      case spv::StorageClass::StorageBuffer:
        declare_resource(inst, false);
        break;
      case spv::StorageClass::Workgroup:
        declare_shared(inst);
        break;
      default:
        return fail("its storage class is not supported here");
    }
    if (failed()) return;
  }
}

// A binding that the pipeline layout does not have matters only if the descriptor is used.
void Lowering::declare_resource(const SpirvInst& inst, bool handle) {
  Value value;
  value.shape = Value::Shape::pointer;
  value.pointer.type = type(inst[1]).element;
  value.pointer.space = handle ? Space::handle : Space::buffer;
  uint32_t base = value.pointer.type;
  while (type(base).kind == Kind::array) base = type(base).element;
  if (handle != type(base).is_handle() || (!handle && type(base).kind != Kind::structure))
    return fail("its type is not one of its storage class");
  const bool storage = static_cast<spv::StorageClass>(inst[3]) == spv::StorageClass::StorageBuffer ||
                       m_.has(base, spv::Decoration::BufferBlock);
  if (!handle && !storage && !m_.has(base, spv::Decoration::Block)) return fail("its type is no Block");
  value.pointer.uniform = !handle && !storage;
  const uint32_t set = m_.decoration(inst[2], SpirvModule::kWhole, spv::Decoration::DescriptorSet).value_or(0);
  const uint32_t binding = m_.decoration(inst[2], SpirvModule::kWhole, spv::Decoration::Binding).value_or(0);
  for (const BindingSlot& slot : layout_.slots) {
    if (slot.set == set && slot.binding == binding && slot.count != 0) value.pointer.slot = &slot;
  }
  bind(inst[2], value);
}

void Lowering::declare_shared(const SpirvInst& inst) {
  Value value;
  value.shape = Value::Shape::pointer;
  value.pointer.space = Space::shared;
  value.pointer.type = type(inst[1]).element;
  const uint64_t count = type(value.pointer.type).components;
  if (!type(value.pointer.type).has_value() || count > kMaxVariableComponents)
    return fail("is a variable of a size that is not supported");
  if (inst.count > 4 && m_.op(inst[4]) != spv::Op::OpConstantNull) return fail("its initializer is not null");
  variables_.push_back({kNoReg, static_cast<uint32_t>(count)});
  value.pointer.variable = &variables_.back();
  bind(inst[2], value);
}

void Lowering::declare_interface(const SpirvInst& inst, bool output) {
  const uint32_t id = inst[2], pointee = type(inst[1]).element;
  Value value;
  value.shape = Value::Shape::pointer;
  value.pointer.space = Space::registers;
  value.pointer.type = pointee;
  if (output) {
    lower_variable(inst);
    if (failed()) return;
    value = *find_value(id);
  } else {
    const uint64_t count = type(pointee).components;
    if (!type(pointee).has_value() || count > kMaxVariableComponents)
      return fail("is an input of a size that is not supported");
    variables_.push_back({code_.new_value(static_cast<uint32_t>(count)), static_cast<uint32_t>(count), kNoReg, true});
    value.pointer.variable = &variables_.back();
    bind(id, value);
  }
  const Type& whole = type(pointee);
  Reg next = value.pointer.variable->first;
  if (const auto built_in = m_.decoration(id, SpirvModule::kWhole, spv::Decoration::BuiltIn))
    return declare_built_in(inst, *built_in, pointee, next, output);
  if (m_.decoration(id, SpirvModule::kWhole, spv::Decoration::Index).value_or(0) != 0)
    return fail("a second colour for blending is not supported");
  Place place;
  place.output = output;
  if (whole.kind != Kind::structure) {
    if (!m_.has(id, spv::Decoration::Location)) return fail("has neither Location nor BuiltIn");
    place = place_of(id, SpirvModule::kWhole, place);
    return declare_located(pointee, place, next);
  }
  place = place_of(id, SpirvModule::kWhole, place);
  for (uint32_t i = 0; i < whole.count && !failed(); ++i) {
    next = value.pointer.variable->first + static_cast<Reg>(whole.member_first[i]);
    if (const auto built_in = m_.decoration(whole.id, i, spv::Decoration::BuiltIn)) {
      declare_built_in(inst, *built_in, whole.members[i], next, output);
      continue;
    }
    Place member = place_of(whole.id, i, place);
    declare_located(whole.members[i], member, next);
    place.location = member.location;
  }
}

// Distances to clip or cull planes. Where the capability is missing, members of an output gl_PerVertex are only
// declared.
void Lowering::declare_distances(bool cull, uint32_t of, Reg first, bool output) {
  if (output && !m_.declares(cull ? spv::Capability::CullDistance : spv::Capability::ClipDistance)) return;
  const Type& array = type(of);
  if (array.kind != Kind::array || type(array.element).kind != Kind::real)
    return fail("clip and cull distances are arrays of floats");
  if (array.count > kMaxDistances || which_ == VK_SHADER_STAGE_COMPUTE_BIT ||
      output == (which_ == VK_SHADER_STAGE_FRAGMENT_BIT))
    return fail("has distances that are not supported here, or more than " + std::to_string(kMaxDistances));
  const uint32_t location = cull ? kCullDistanceLocation : kClipDistanceLocation;
  for (uint32_t i = 0; i < array.count; ++i) {
    InterfaceComponent entry{location + i, 0, first + i};
    (output ? out_.distances : out_.inputs).push_back(entry);
  }
}

void Lowering::declare_built_in(const SpirvInst& inst, uint32_t built_in, uint32_t of, Reg first, bool output) {
  const auto which = static_cast<spv::BuiltIn>(built_in);
  if (which == spv::BuiltIn::ClipDistance || which == spv::BuiltIn::CullDistance)
    return declare_distances(which == spv::BuiltIn::CullDistance, of, first, output);
  const auto row = std::find_if(std::begin(kBuiltIns), std::end(kBuiltIns), [&](const BuiltInRow& each) {
    return each.built_in == which && each.stage == which_ && each.output == output;
  });
  if (row == std::end(kBuiltIns))
    return fail("built-in " + spirv_enum_name(SpirvEnum::BuiltIn, built_in) + " is not supported here");
  if (type(of).components != row->components)
    return fail("built-in " + spirv_enum_name(SpirvEnum::BuiltIn, built_in) + " has the wrong type");
  if (!output && declare_sample_input(which, first, row->components)) return;
  const auto earlier = std::ranges::find(out_.built_in_inputs, which, &InterfaceBuiltIn::built_in);
  if (!output && earlier != out_.built_in_inputs.end()) {  // another variable has it, too
    for (uint32_t i = 0; i < row->components; ++i) code_.emit_to(Opcode::mov, first + i, earlier->regs[i]);
    return;
  }
  InterfaceBuiltIn entry;
  entry.built_in = which;
  entry.word = inst.word;
  for (uint32_t i = 0; i < row->components; ++i) entry.regs.push_back(first + i);
  const bool mask = output && which == spv::BuiltIn::SampleMask;
  if (which == spv::BuiltIn::PointSize || mask) {  // what it is where the shader does not write it
    const Reg value = mask ? constant(~0u) : constant_f(1.0f);
    code_.emit_to(Opcode::mov, first, value);
    set_known(first, value);
  }
  out_.kills |= mask;
  (output ? out_.built_in_outputs : out_.built_in_inputs).push_back(std::move(entry));
}

Lowering::Place Lowering::place_of(uint32_t id, uint32_t member, Place place) const {
  place.location = m_.decoration(id, member, spv::Decoration::Location).value_or(place.location);
  place.component = m_.decoration(id, member, spv::Decoration::Component).value_or(0);
  if (m_.decoration(id, member, spv::Decoration::NoPerspective)) place.interpolation = Interpolation::linear;
  if (m_.decoration(id, member, spv::Decoration::Flat)) place.interpolation = Interpolation::flat;
  return place;
}

// Vectors take one location, arrays and matrices one for each element or column.
void Lowering::declare_located(uint32_t id, Place& place, Reg& next) {
  const Type& whole = type(id);
  if (place.location >= kMaxLocations) return fail("its Location is too large");
  const Kind kind = scalar_kind(whole);
  if (whole.components == 0) return;
  if (kind == Kind::none) {
    if (whole.kind == Kind::structure) {
      for (uint32_t i = 0; i < whole.count && !failed(); ++i) declare_located(whole.members[i], place, next);
    } else {
      for (uint32_t i = 0; i < whole.count && !failed(); ++i) declare_located(whole.element, place, next);
    }
    return;
  }
  if (kind == Kind::boolean) return fail("booleans do not go from stage to stage");
  if (which_ == VK_SHADER_STAGE_COMPUTE_BIT) return fail("compute shaders have no Locations");
  if (place.component + whole.components > 4) return fail("its components leave its Location");
  for (uint32_t i = 0; i < whole.components; ++i) {
    InterfaceComponent entry{place.location, place.component + i, next++, kind != Kind::real, place.interpolation};
    if (entry.integer) entry.interpolation = Interpolation::flat;
    (place.output ? out_.outputs : out_.inputs).push_back(entry);
  }
  ++place.location;
}

void Lowering::read_modes(const SpirvEntryPoint& entry) {
  for (const SpirvModule::Mode& mode : m_.modes) {
    if (mode.function != entry.function) continue;
    word_ = mode.word;
    const SpirvInst inst = m_.at(mode.word);
    switch (mode.mode) {
      case spv::ExecutionMode::OriginUpperLeft:
      case spv::ExecutionMode::DepthReplacing:
      case spv::ExecutionMode::DepthGreater:
      case spv::ExecutionMode::DepthLess:
      case spv::ExecutionMode::DepthUnchanged:
        break;
      case spv::ExecutionMode::EarlyFragmentTests:
        out_.early_fragment_tests = true;
        break;
      case spv::ExecutionMode::LocalSize:
        if (inst.count != 6) return fail("LocalSize has not three sizes");
        for (uint32_t i = 0; i < 3; ++i) code_.workgroup_size[i] = inst[3 + i];
        break;
      case spv::ExecutionMode::LocalSizeId:
        if (inst.count != 6) return fail("LocalSizeId has not three sizes");
        for (uint32_t i = 0; i < 3; ++i) {
          const std::vector<uint32_t>* size = constant_data(inst[3 + i]);
          if (size == nullptr || size->size() != 1) return fail("LocalSizeId has a size that is no constant");
          code_.workgroup_size[i] = size->front();
        }
        break;
      default:
        return fail(spirv_enum_name(SpirvEnum::ExecutionMode, static_cast<uint32_t>(mode.mode)) + " is not supported");
    }
  }
  for (const SpirvModule::Decoration& decoration : m_.decorations) {
    if (decoration.decoration != spv::Decoration::BuiltIn || decoration.member != SpirvModule::kWhole ||
        decoration.literal != static_cast<uint32_t>(spv::BuiltIn::WorkgroupSize))
      continue;
    const std::vector<uint32_t>* size = constant_data(decoration.id);
    if (size == nullptr || size->size() != 3) return fail("WorkgroupSize is no constant of three numbers");
    std::copy(size->begin(), size->end(), code_.workgroup_size);
  }
  uint64_t invocations = 1;
  for (const uint32_t size : code_.workgroup_size)
    invocations *= std::min<uint64_t>(size, kMaxWorkgroupInvocations + 1);
  if (invocations == 0 || invocations > kMaxWorkgroupInvocations)
    fail("a workgroup has from 1 to " + std::to_string(kMaxWorkgroupInvocations) + " invocations");
}

}  // namespace lapilli::spirv
