// See try_module.h.
#include "shader/spirv/test/try_module.h"

#include <algorithm>

#include "shader/program.h"
#include "shader/spirv/module.h"
#include "shader/stage_code.h"
#include "shaders/interface.vert.h"

namespace lapilli {
namespace {

std::vector<BindingSlot> some_slots() {
  constexpr VkDescriptorType kTypes[] = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                                         VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE};
  std::vector<BindingSlot> slots;
  for (uint32_t set = 0; set < 2; ++set) {
    for (uint32_t binding = 0; binding < 4; ++binding) {
      const VkDescriptorType type = set == 0 ? kTypes[0] : kTypes[binding];
      slots.push_back({set, binding, type, VK_SHADER_STAGE_ALL, binding * 4, 4, -1});
    }
  }
  return slots;
}

std::string try_code(Code code) {
  if (std::string wrong = verify(code); !wrong.empty()) return "verify: " + wrong;
  const Result<ProgramPtr> program = assemble(std::move(code));
  return program.ok() ? "" : program.error().message;
}

std::string try_graphics(const ShaderStage& vertex, const ShaderStage* fragment, const ResourceLayout& layout) {
  const VkFormat formats[] = {VK_FORMAT_R8G8B8A8_UNORM};
  VkPipelineColorBlendAttachmentState blend[1] = {};
  blend[0].colorWriteMask = 0xF;
  GraphicsState state;
  state.color_formats = formats;
  state.blend = blend;
  Result<GraphicsCode> code = make_graphics_code(vertex, fragment, state, layout);
  if (!code) return code.error().message;
  std::string text = try_code(std::move(code->vertex));
  return text.empty() ? try_code(std::move(code->fragment)) : text;
}

std::string try_entry(const ShaderStage& shader, spv::ExecutionModel model, const ResourceLayout& layout) {
  if (model == spv::ExecutionModel::GLCompute) {
    Result<Code> code = make_compute_code(shader, layout);
    return code.ok() ? try_code(std::move(*code)) : code.error().message;
  }
  if (model == spv::ExecutionModel::Vertex) return try_graphics(shader, nullptr, layout);
  if (model != spv::ExecutionModel::Fragment) return "";
  const Result<std::shared_ptr<const SpirvModule>> vertex = parse_spirv(shaders::kInterfaceVert);
  return try_graphics({*vertex, "main", {}}, &shader, layout);
}

}  // namespace

std::string try_module(std::span<const uint32_t> words) {
  static const std::vector<BindingSlot> slots = some_slots();
  const ResourceLayout layout{slots, 128};
  const Result<std::shared_ptr<const SpirvModule>> module = parse_spirv(words);
  if (!module) return module.error().message;
  constexpr size_t kEntries = 4;  // a module may have thousands
  for (size_t i = 0; i < std::min((*module)->entry_points.size(), kEntries); ++i) {
    const SpirvEntryPoint& entry = (*module)->entry_points[i];
    if (std::string text = try_entry({*module, entry.name, {}}, entry.model, layout); !text.empty()) return text;
  }
  return "";
}

bool is_refusal(const std::string& text) {
  return text.starts_with("SPIR-V: ") || text.starts_with("the fragment shader reads more than");
}

}  // namespace lapilli
