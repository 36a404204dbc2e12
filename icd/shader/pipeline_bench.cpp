// What it costs to make the programs of a pipeline, from a module that is parsed already and from its words.
#include <benchmark/benchmark.h>

#include <cstdlib>

#include "shader/passes/passes.h"
#include "shader/stage_code.h"
#include "shaders/corpus.h"

namespace lapilli {
namespace {

struct Setting {
  std::vector<BindingSlot> slots;
  std::vector<VertexAttribute> attributes;
  std::vector<VkFormat> formats = std::vector<VkFormat>(1, VK_FORMAT_B8G8R8A8_UNORM);
  std::vector<VkPipelineColorBlendAttachmentState> blend = std::vector<VkPipelineColorBlendAttachmentState>(1);
  GraphicsState state;

  Setting() {
    for (uint32_t set = 0; set < 4; ++set) {
      for (uint32_t binding = 0; binding < 8; ++binding)
        slots.push_back({set, binding, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, VK_SHADER_STAGE_ALL, binding, 2, -1});
    }
    for (uint32_t location = 0; location < 8; ++location)
      attributes.push_back({location, 0, 16 * location, VK_FORMAT_R32G32B32A32_SFLOAT});
    blend[0].colorWriteMask = 0xF;
    state.attributes = attributes;
    state.color_formats = formats;
    state.blend = blend;
    state.depth_test = state.depth_write = true;
    state.depth_compare = VK_COMPARE_OP_LESS;
  }
  ResourceLayout layout() const { return {slots, kMaxPushConstantBytes}; }
};

std::shared_ptr<const SpirvModule> parsed(std::span<const uint32_t> words) {
  Result<std::shared_ptr<const SpirvModule>> module = parse_spirv(words);
  return module.ok() ? *module : nullptr;
}

void parse(benchmark::State& bench, const CorpusShader& shader) {
  for (auto _ : bench) benchmark::DoNotOptimize(parse_spirv(shader.words));
}

void build(benchmark::State& bench, const CorpusShader& vertex_shader, const CorpusShader& fragment_shader) {
  const Setting setting;
  const ShaderStage vertex{parsed(vertex_shader.words), "main", {}};
  const ShaderStage fragment{parsed(fragment_shader.words), "main", {}};
  if (std::getenv("LAPILLI_DUMP") != nullptr) {
    set_dump_passes(true);
    (void)build_graphics(vertex, &fragment, setting.state, setting.layout());
    set_dump_passes(false);
  }
  for (auto _ : bench) {
    const Result<GraphicsPrograms> programs = build_graphics(vertex, &fragment, setting.state, setting.layout());
    if (!programs.ok()) bench.SkipWithError(programs.error().message.c_str());
  }
}

// A worker goes over to another draw of the same pipeline, and runs one batch of it with one vertex.
void prepare(benchmark::State& bench, const CorpusShader& vertex_shader, bool run) {
  const Setting setting;
  const ShaderStage vertex{parsed(vertex_shader.words), "main", {}};
  const Result<GraphicsPrograms> programs = build_graphics(vertex, nullptr, setting.state, setting.layout());
  if (!programs.ok()) return bench.SkipWithError(programs.error().message.c_str());
  std::vector<float> numbers(1024, 0.5f);
  Descriptor descriptors[8];
  for (Descriptor& each : descriptors) {
    each.data = reinterpret_cast<std::byte*>(numbers.data());
    each.size = each.room = numbers.size() * sizeof(float);
  }
  ResourceTable tables[2];
  for (ResourceTable& table : tables) std::fill(std::begin(table.sets), std::end(table.sets), descriptors);
  VertexBatch batch = {};
  const VertexBinding bindings[kMaxVertexBindings] = {};
  alignas(64) static float outputs[kMaxVaryingComponents + kSlotVaryings][kBatchLanes];
  batch.bindings = bindings;
  batch.outputs = outputs[0];
  ExecutionLimits limits;
  Execution execution;
  size_t draw = 0;
  for (auto _ : bench) {
    benchmark::DoNotOptimize(execution.prepare(*programs->vertex, tables[draw++ % 2], &limits));
    if (run) execution.run_vertices(batch, 1);
  }
}

const CorpusShader& find(std::string_view name) {
  for (const CorpusShader& shader : kCorpus) {
    if (shader.name == name) return shader;
  }
  std::abort();
}

}  // namespace
}  // namespace lapilli

int main(int argc, char** argv) {
  using namespace lapilli;
  for (const CorpusShader& shader : kCorpus) {
    benchmark::RegisterBenchmark(("parse/" + std::string(shader.name)).c_str(),
                                 [&](benchmark::State& state) { parse(state, shader); });
    if (!shader.is(".frag")) continue;
    const std::string base(shader.name.substr(0, shader.name.size() - 5));
    const CorpusShader* vertex = &find("full_screen.vert");
    for (const CorpusShader& other : kCorpus) {
      if (other.name == base + ".vert") vertex = &other;
    }
    benchmark::RegisterBenchmark(("build/" + base).c_str(),
                                 [&shader, vertex](benchmark::State& state) { build(state, *vertex, shader); });
  }
  for (const char* const name : {"phong.vert", "material.vert", "transform.vert"}) {
    const CorpusShader& shader = find(name);
    for (const bool run : {false, true}) {
      benchmark::RegisterBenchmark(((run ? "prepare_and_run/" : "prepare/") + std::string(name)).c_str(),
                                   [&shader, run](benchmark::State& state) { prepare(state, shader, run); });
    }
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
