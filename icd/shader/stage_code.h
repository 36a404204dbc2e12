// The programs of a pipeline as Code: what stage.h's functions hand to assemble(), and what tests look at.
#pragma once

#include <vector>

#include "shader/stage.h"

namespace lapilli {

struct GraphicsCode : FragmentPlan {
  RemovedWork removed;
  Code vertex, fragment;
  std::vector<Interpolation> varyings;
  uint32_t output_slots = 0;
  uint32_t clip_distances = 0, cull_distances = 0;
  bool fragment_reads_nothing = false;
};

Result<GraphicsCode> make_graphics_code(const ShaderStage& vertex, const ShaderStage* fragment,
                                        const GraphicsState& state, const ResourceLayout& layout);
Result<Code> make_compute_code(const ShaderStage& stage, const ResourceLayout& layout);

}  // namespace lapilli
