// Set-ups of a block's triangles for batches in which each pixel may have its own (shader/batch.h, LaneTriangles).
#pragma once

#include <span>

#include "raster/visibility.h"
#include "shader/batch.h"

namespace lapilli {

// For the `pixels` of the block whose first pixel is (x, y); they see the triangles with these numbers. `modes`: of the
// draw's varyings.
void set_up_lanes(const Visibility& visibility, const uint32_t* numbers, uint64_t pixels, uint32_t x, uint32_t y,
                  std::span<const Interpolation> modes, LaneTriangles& out);

}  // namespace lapilli
