// Procedural textures of the scenes, with mip levels where asked for.
#pragma once

#include <vector>

#include "common/resources.h"

namespace lapilli::bench {

// RGBA8 squares of `size` texels a side, each with a pattern of its own; all levels down to 1x1 if `mip_levels`.
// Uploaded in one submission, ready to be sampled by fragment shaders.
std::vector<samples::Image> upload_patterns(const samples::Context& context, uint32_t count, uint32_t size,
                                            bool mip_levels);

// Linear within a level and between levels, repeating.
samples::Sampler create_trilinear_sampler(const samples::Context& context);

}  // namespace lapilli::bench
