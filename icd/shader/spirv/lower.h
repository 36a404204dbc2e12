// SPIR-V to Code: one entry point with everything it calls, scalarized. The stage around it (vertex_stage.cpp,
// fragment_stage.cpp, stage.cpp) adds what feeds the inputs and takes the outputs.
#pragma once

#include <spirv/unified1/spirv.hpp11>
#include <vector>

#include "shader/ir.h"
#include "shader/stage.h"

namespace lapilli {

// Where the distances of a fragment shader's input would lie: behind all Locations.
constexpr uint32_t kClipDistanceLocation = 64, kCullDistanceLocation = kClipDistanceLocation + kMaxDistances;

// One scalar of an input or output variable with a Location.
struct InterfaceComponent {
  uint32_t location = 0;
  uint32_t component = 0;
  Reg reg = kNoReg;
  bool integer = false;
  Interpolation interpolation = Interpolation::perspective;
};

struct InterfaceBuiltIn {
  spv::BuiltIn built_in{};
  std::vector<Reg> regs;
  uint32_t word = 0;  // of the variable
};

struct LoweredShader {
  Code code;  // without prologue and epilogue; goes on behind its last instruction with the lanes that have returned
  std::vector<InterfaceComponent> inputs;  // value registers that the prologue has to write, consecutive in a variable
  std::vector<InterfaceBuiltIn> built_in_inputs;
  std::vector<InterfaceComponent> outputs;  // registers that hold the results
  std::vector<InterfaceBuiltIn> built_in_outputs;
  std::vector<InterfaceComponent> distances;  // to clip and cull planes: outputs too
  uint32_t end_label = 0;                     // to be placed before `end`: where batches without lanes go
  bool kills = false;
  bool stores = false;  // has side effects beside its outputs
  bool early_fragment_tests = false;
};

Result<LoweredShader> lower_shader(const ShaderStage& stage, VkShaderStageFlagBits which, const ResourceLayout& layout);

}  // namespace lapilli
