// Runs a piece of SPIR-V over many operands as a compute, a fragment and a vertex shader.
#pragma once

#include <functional>
#include <string>

#include "common/context.h"
#include "spirv/module.h"

namespace lapilli::conformance::spirv {

// From the words of one element to the words of its result, all of type uint.
struct Snippet {
  uint32_t inputs = 1;
  uint32_t outputs = 1;                                            // at most 2 but in compute shaders
  std::function<Words(Module& module, const Words& inputs)> emit;  // inputs, then the push constants
  Words push = {};                                                 // values of push constants
};

enum class Stage { compute, fragment, vertex };
constexpr Stage kStages[] = {Stage::compute, Stage::fragment, Stage::vertex};
const char* name_of(Stage stage);

// The snippet as a shader of its own: operands in the storage buffer at set 0, binding 0 (`inputs` words for each
// element), results in binding 1 or in a colour attachment.
Words make_shader(const Snippet& snippet, Stage stage);

// Runs it for operands.size() / inputs elements; `outputs` words for each.
Words run(const samples::Context& context, const Snippet& snippet, Stage stage, const Words& operands);

}  // namespace lapilli::conformance::spirv
