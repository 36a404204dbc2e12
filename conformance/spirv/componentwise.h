// Instructions that work on each component by itself: what they give, written apart from the driver.
#pragma once

#include <cstdint>
#include <span>

#include "spirv/module.h"

namespace lapilli::conformance::spirv {

struct Componentwise {
  const char* name;
  uint32_t number;  // spv::Op, or of GLSL.std.450
  bool extended;    // of GLSL.std.450
  const char*
      types;  // of the result and of the operands: f float, i int, u uint, b bool, o a scalar uint of at most 16
  uint32_t (*value)(const uint32_t* operands);  // of one component, as bits; booleans are 0 and 1
  double ulp = 0;                               // error allowed of floats; Lapilli's promise
  double peer_ulp = 0;  // the same of other drivers (absolute 2^-11 besides where it is above 100)
  // Operands for which the specification says what comes out (all if null). Lapilli gives `value` for the others, too.
  bool (*defined)(const uint32_t* operands) = nullptr;
  // Operands of which even `value` says nothing (none if null).
  bool (*open)(const uint32_t* operands) = nullptr;
};

std::span<const Componentwise> componentwise_instructions();

}  // namespace lapilli::conformance::spirv
