// See snippet.h.
#include "spirv/snippet.h"

#include <bit>

#include "common/pipeline.h"
#include "harness/canvas.h"
#include "harness/compute.h"
#include "harness/descriptors.h"
#include "harness/graphics.h"

namespace lapilli::conformance::spirv {
namespace {

constexpr uint32_t kWidth = 64;  // of the canvas: element i is pixel (i % kWidth, i / kWidth)

// A runtime array of uint in a storage buffer. Stages of a graphics pipeline may not write without a feature, and say
// so.
Id words_buffer(Module& m, uint32_t binding, bool writable = true) {
  const Id array = m.type(spv::Op::OpTypeRuntimeArray, {m.uint_type()});
  const bool first = binding == 0;
  if (first) m.decorate({array, uint32_t(spv::Decoration::ArrayStride), 4});
  const Id block = m.type(spv::Op::OpTypeStruct, {array});
  if (first) {
    m.decorate({block, uint32_t(spv::Decoration::BufferBlock)});
    m.decorate_member({block, 0, uint32_t(spv::Decoration::Offset), 0});
    if (!writable) m.decorate_member({block, 0, uint32_t(spv::Decoration::NonWritable)});
  }
  const Id variable = m.variable(spv::StorageClass::Uniform, block);
  m.decorate({variable, uint32_t(spv::Decoration::DescriptorSet), 0});
  m.decorate({variable, uint32_t(spv::Decoration::Binding), binding});
  return variable;
}

Id word_at(Module& m, Id buffer, Id index) {
  const Id pointer = m.pointer_type(spv::StorageClass::Uniform, m.uint_type());
  return m.emit(spv::Op::OpAccessChain, pointer, {buffer, m.constant_uint(0), index});
}

Id add(Module& m, Id a, uint32_t b) {
  return b == 0 ? a : m.emit(spv::Op::OpIAdd, m.uint_type(), {a, m.constant_uint(b)});
}
Id times(Module& m, Id a, uint32_t b) {
  return b == 1 ? a : m.emit(spv::Op::OpIMul, m.uint_type(), {a, m.constant_uint(b)});
}

Id built_in(Module& m, spv::StorageClass storage, Id of_type, spv::BuiltIn which) {
  const Id variable = m.variable(storage, of_type);
  m.decorate({variable, uint32_t(spv::Decoration::BuiltIn), uint32_t(which)});
  return variable;
}

// Two words as four floats, each of half a word.
Id located(Module& m, spv::StorageClass storage) {
  const Id variable = m.variable(storage, m.vector_type(m.float_type(), 4));
  m.decorate({variable, uint32_t(spv::Decoration::Location), 0});
  return variable;
}

// Number of the element that this invocation computes.
Id element(Module& m, Stage stage) {
  const Id uint = m.uint_type();
  if (stage == Stage::compute) {
    const Id three = m.vector_type(uint, 3);
    return m.extract(uint,
                     m.load(three, built_in(m, spv::StorageClass::Input, three, spv::BuiltIn::GlobalInvocationId)), 0);
  }
  if (stage == Stage::vertex) {
    const Id index =
        m.load(m.int_type(), built_in(m, spv::StorageClass::Input, m.int_type(), spv::BuiltIn::VertexIndex));
    return m.emit(spv::Op::OpUDiv, uint, {m.emit(spv::Op::OpBitcast, uint, {index}), m.constant_uint(3)});
  }
  const Id four = m.vector_type(m.float_type(), 4);
  const Id place = m.load(four, built_in(m, spv::StorageClass::Input, four, spv::BuiltIn::FragCoord));
  const Id x = m.emit(spv::Op::OpConvertFToU, uint, {m.extract(m.float_type(), place, 0)});
  const Id y = m.emit(spv::Op::OpConvertFToU, uint, {m.extract(m.float_type(), place, 1)});
  return m.emit(spv::Op::OpIAdd, uint, {times(m, y, kWidth), x});
}

// A vertex of a triangle around the centre of the element's pixel; `rows` is the canvas' height.
void put_position(Module& m, Id index, uint32_t rows) {
  const Id f = m.float_type(), uint = m.uint_type(), position_type = m.vector_type(f, 4);
  const auto constant = [&](float value) { return m.constant(f, std::bit_cast<uint32_t>(value)); };
  const Id vertex =
      m.load(m.int_type(), built_in(m, spv::StorageClass::Input, m.int_type(), spv::BuiltIn::VertexIndex));
  const Id corner = m.emit(spv::Op::OpUMod, uint, {m.emit(spv::Op::OpBitcast, uint, {vertex}), m.constant_uint(3)});
  // Corners (-1, -1), (3, -1), (-1, 3) eighths of a pixel beside the centre.
  const auto place = [&](Id pixel, uint32_t which, uint32_t size) {
    const Id far = m.emit(spv::Op::OpIEqual, m.bool_type(), {corner, m.constant_uint(which)});
    const Id beside = m.emit(spv::Op::OpSelect, f, {far, constant(0.875f), constant(0.375f)});
    const Id at = m.emit(spv::Op::OpFAdd, f, {m.emit(spv::Op::OpConvertUToF, f, {pixel}), beside});
    const Id scaled = m.emit(spv::Op::OpFMul, f, {at, constant(2.0f / float(size))});
    return m.emit(spv::Op::OpFSub, f, {scaled, constant(1.0f)});
  };
  const Id x = place(m.emit(spv::Op::OpUMod, uint, {index, m.constant_uint(kWidth)}), 1, kWidth);
  const Id y = place(m.emit(spv::Op::OpUDiv, uint, {index, m.constant_uint(kWidth)}), 2, rows);
  m.store(built_in(m, spv::StorageClass::Output, position_type, spv::BuiltIn::Position),
          m.composite(position_type, {x, y, constant(0.5f), constant(1)}));
}

void load_push_constants(Module& m, uint32_t count, Words& to) {
  const Id uint = m.uint_type(), array = m.type(spv::Op::OpTypeArray, {uint, m.constant_uint(count)});
  m.decorate({array, uint32_t(spv::Decoration::ArrayStride), 4});
  const Id block = m.type(spv::Op::OpTypeStruct, {array});
  m.decorate({block, uint32_t(spv::Decoration::Block)});
  m.decorate_member({block, 0, uint32_t(spv::Decoration::Offset), 0});
  const Id variable = m.variable(spv::StorageClass::PushConstant, block);
  const Id pointer = m.pointer_type(spv::StorageClass::PushConstant, uint);
  for (uint32_t i = 0; i < count; ++i) {
    const Id element = m.emit(spv::Op::OpAccessChain, pointer, {variable, m.constant_uint(0), m.constant_uint(i)});
    to.push_back(m.load(uint, element));
  }
}

Words shader_for(const Snippet& snippet, Stage stage, uint32_t rows) {
  Module m;
  m.begin_main();
  const Id uint = m.uint_type(), index = element(m, stage), in = words_buffer(m, 0, stage == Stage::compute);
  const Id first = times(m, index, snippet.inputs);
  Words inputs;
  for (uint32_t i = 0; i < snippet.inputs; ++i) inputs.push_back(m.load(uint, word_at(m, in, add(m, first, i))));
  if (!snippet.push.empty()) load_push_constants(m, uint32_t(snippet.push.size()), inputs);
  Words outputs = snippet.emit(m, inputs);
  if (stage == Stage::compute) {
    const Id out = words_buffer(m, 1), base = times(m, index, snippet.outputs);
    for (uint32_t i = 0; i < snippet.outputs; ++i) m.store(word_at(m, out, add(m, base, i)), outputs[i]);
    return m.finish(spv::ExecutionModel::GLCompute);
  }
  const Id out = located(m, spv::StorageClass::Output);
  Words halves;
  for (const Id word : outputs) {
    const Id low = m.emit(spv::Op::OpBitwiseAnd, uint, {word, m.constant_uint(0xFFFF)});
    const Id high = m.emit(spv::Op::OpShiftRightLogical, uint, {word, m.constant_uint(16)});
    for (const Id half : {low, high}) halves.push_back(m.emit(spv::Op::OpConvertUToF, m.float_type(), {half}));
  }
  halves.resize(4, m.constant(m.float_type(), 0));
  m.store(out, m.composite(m.vector_type(m.float_type(), 4), halves));
  if (stage == Stage::fragment) return m.finish(spv::ExecutionModel::Fragment);
  m.decorate({out, uint32_t(spv::Decoration::Flat)});
  put_position(m, index, rows);
  return m.finish(spv::ExecutionModel::Vertex);
}

// The other stage of a graphics pipeline: one triangle over everything, or the value of the vertices.
Words full_screen_vertex() {
  Module m;
  m.begin_main();
  const Id f = m.float_type(), four = m.vector_type(f, 4);
  const auto constant = [&](float value) { return m.constant(f, std::bit_cast<uint32_t>(value)); };
  const Id vertex =
      m.load(m.int_type(), built_in(m, spv::StorageClass::Input, m.int_type(), spv::BuiltIn::VertexIndex));
  const auto place = [&](uint32_t which) {
    const Id far = m.emit(spv::Op::OpIEqual, m.bool_type(), {vertex, m.constant(m.int_type(), which)});
    return m.emit(spv::Op::OpSelect, f, {far, constant(3), constant(-1)});
  };
  const Id x = place(1), y = place(2);
  m.store(built_in(m, spv::StorageClass::Output, four, spv::BuiltIn::Position),
          m.composite(four, {x, y, constant(0.5f), constant(1)}));
  return m.finish(spv::ExecutionModel::Vertex);
}
Words pass_through_fragment() {
  Module m;
  m.begin_main();
  const Id in = located(m, spv::StorageClass::Input), out = located(m, spv::StorageClass::Output);
  m.decorate({in, uint32_t(spv::Decoration::Flat)});
  m.store(out, m.load(m.vector_type(m.float_type(), 4), in));
  return m.finish(spv::ExecutionModel::Fragment);
}

Words run_graphics(const samples::Context& context, const Snippet& snippet, Stage stage, const Words& operands) {
  const auto elements = uint32_t(operands.size() / snippet.inputs);
  const uint32_t rows = (elements + kWidth - 1) / kWidth;
  const Canvas canvas(context, {.width = kWidth, .height = rows, .color_format = VK_FORMAT_R32G32B32A32_SFLOAT});
  const samples::Buffer buffer(context, std::span<const uint32_t>(operands), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const DescriptorSlot slot = {0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, {buffer.get(), 0, VK_WHOLE_SIZE}};
  const Descriptors descriptors(context, {&slot, 1});
  const VkDescriptorSetLayout set_layout = descriptors.layout();
  const samples::PipelineLayout layout = create_layout(context, {&set_layout, 1}, uint32_t(4 * snippet.push.size()));
  const bool in_vertex = stage == Stage::vertex;
  const Words shader = shader_for(snippet, stage, rows),
              other = in_vertex ? pass_through_fragment() : full_screen_vertex();
  PipelineState state;
  state.vertex_shader = in_vertex ? shader : other;
  state.fragment_shader = in_vertex ? other : shader;
  state.bindings.clear();
  state.attributes.clear();
  state.layout = layout.get();
  state.render_pass = canvas.render_pass();
  const samples::Pipeline pipeline = create_pipeline(context, state);
  VkCommandBuffer commands = context.begin_commands();
  canvas.begin(commands, {});
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline.get());
  const VkDescriptorSet set = descriptors.get();
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout.get(), 0, 1, &set, 0, nullptr);
  if (!snippet.push.empty()) {
    vkCmdPushConstants(commands, layout.get(),
                       VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT, 0,
                       uint32_t(4 * snippet.push.size()), snippet.push.data());
  }
  vkCmdDraw(commands, in_vertex ? 3 * elements : 3, 1, 0, 0);
  Canvas::end(commands);
  context.submit_and_wait(commands);
  const std::vector<float> texels = canvas.read_color<float>();
  Words out;
  for (uint32_t i = 0; i < elements; ++i) {
    for (uint32_t k = 0; k < snippet.outputs; ++k) {
      const float* const halves = &texels[size_t{4} * i + size_t{2} * k];
      out.push_back(uint32_t(halves[0]) | uint32_t(halves[1]) << 16);
    }
  }
  return out;
}

}  // namespace

const char* name_of(Stage stage) {
  return stage == Stage::compute ? "compute" : stage == Stage::fragment ? "fragment" : "vertex";
}

Words make_shader(const Snippet& snippet, Stage stage) { return shader_for(snippet, stage, 1); }

Words run(const samples::Context& context, const Snippet& snippet, Stage stage, const Words& operands) {
  if (stage != Stage::compute) return run_graphics(context, snippet, stage, operands);
  const size_t elements = operands.size() / snippet.inputs;
  const Words shader = shader_for(snippet, stage, 1);
  ComputeRun job;
  job.shader = shader;
  job.buffers = {to_bytes(operands), Bytes(elements * snippet.outputs * sizeof(uint32_t))};
  job.groups[0] = uint32_t((elements + 63) / 64);
  job.push_constants = to_bytes(snippet.push);
  return from_bytes<uint32_t>(run_compute(context, job)[1]);
}

}  // namespace lapilli::conformance::spirv
