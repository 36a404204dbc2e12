// From SPIR-V and fixed-function state to programs: what pipeline creation calls.
// A draw is one vertex and one fragment program; the fragment program decides what the vertex program computes.
#pragma once

#include <vulkan/vulkan_core.h>

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "shader/program.h"
#include "shader/resources.h"

namespace lapilli {

// A parsed and checked SPIR-V module (shader/spirv/). Immutable; shared by all pipelines made of it.
class SpirvModule;
// Fails with VK_ERROR_UNKNOWN (the specification names no code for invalid SPIR-V), naming the instruction and its
// word.
Result<std::shared_ptr<const SpirvModule>> parse_spirv(std::span<const uint32_t> words);

struct SpecializationEntry {
  uint32_t constant_id = 0;
  uint64_t bits = 0;  // value, zero-extended
  uint32_t size = 4;  // bytes given
};

struct ShaderStage {
  std::shared_ptr<const SpirvModule> module;
  std::string_view entry_point;
  std::span<const SpecializationEntry> specialization;
};

// Fixed-function state that becomes ops.
struct GraphicsState {
  std::span<const VertexAttribute> attributes;
  bool depth_test = false, depth_write = false;  // false too where the pass has no depth attachment
  VkCompareOp depth_compare = VK_COMPARE_OP_ALWAYS;
  bool counts_removals = false;             // fill RemovedWork
  std::span<const VkFormat> color_formats;  // by attachment index of the subpass; VK_FORMAT_UNDEFINED: unused
  std::span<const VkPipelineColorBlendAttachmentState> blend;  // same length
};

// What raster/ has to know of a draw before it shades.
struct FragmentPlan {
  bool depth_test = false;   // there is a depth test, or a write at least
  bool early_depth = false;  // it comes before the program, in the order of the API
  bool depth_write = false;
  VkCompareOp depth_compare = VK_COMPARE_OP_ALWAYS;
  bool writes_color = false;
  // Nobody can tell whether a pixel that a later draw covers was shaded: every colour attachment is written in full,
  // and nothing else happens but the early depth test.
  bool deferrable = false;
  // Deferrable, and the program neither looks at other lanes nor reads depth: pixels may be shaded without their quads.
  bool pixels_alone = false;
};

// What linking took out, for the ledger: lane-ops (cost of ops.def) of each lane.
struct RemovedWork {
  uint32_t vertex_values = 0;  // components that the vertex shader writes and the fragment shader does not read
  uint32_t vertex_cost = 0;    // of computing them
  uint32_t input_values = 0;   // components of fragment inputs that are not interpolated
  uint32_t input_cost = 0;
  uint32_t output_ops = 0;  // whose result only a masked or missing attachment would take
  uint32_t output_cost = 0;
};

struct GraphicsPrograms : FragmentPlan {
  RemovedWork removed;
  ProgramPtr vertex;
  ProgramPtr fragment;                              // null: nothing would be written (no fragment stage, no depth)
  std::vector<Interpolation> varyings;              // one per varying component, from kSlotVaryings on
  uint32_t output_slots = 0;                        // slots of VertexBatch::outputs
  uint32_t clip_distances = 0, cull_distances = 0;  // the slots behind the varyings: first these, then those
  bool fragment_reads_nothing = false;              // depth only
  // Whether a ResourceTable makes a difference to the fragment program; and to the vertex program beyond what it
  // computes once per draw.
  bool fragment_reads_resources = true, vertices_read_resources = true;
  bool vertices_read_draw = false;  // draws cannot share vertices, nor batches of them
  bool vertices_store = false;      // every vertex of a draw has to be run, whatever becomes of it
};

Result<GraphicsPrograms> build_graphics(const ShaderStage& vertex, const ShaderStage* fragment,
                                        const GraphicsState& state, const ResourceLayout& layout);

Result<ProgramPtr> build_compute(const ShaderStage& stage, const ResourceLayout& layout);

}  // namespace lapilli
