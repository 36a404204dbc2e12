// The procedural picture of triangle_blit (a volcano throwing lapilli at dusk) and masks for cutting it.
#pragma once

#include "scenes/affine.h"
#include "scenes/texture.h"

namespace lapilli::samples {

Texture volcano_picture(uint32_t width, uint32_t height);

// White inside the triangle (corners in texels), black outside; the edge is a ramp `softness` texels wide, centred on
// it.
Texture triangle_mask(uint32_t width, uint32_t height, const Triangle& triangle, double softness);

}  // namespace lapilli::samples
