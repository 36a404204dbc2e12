// The tests' shaders from other compilers: LAPILLI_SHADER_VARIANT names a folder that variants.py made.
#pragma once

#include <cstdint>
#include <span>

namespace lapilli::conformance {

// The module to use for an embedded one: itself, or what the variant has in its place.
std::span<const uint32_t> in_variant(std::span<const uint32_t> module);

// False if a variant was asked for and no module was replaced by another: then nothing new was tested.
bool variant_was_used();

}  // namespace lapilli::conformance
