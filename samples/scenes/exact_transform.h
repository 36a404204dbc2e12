// Matrices and vertices on a grid that makes matrix * vertex exact in float32. Vulkan leaves open in which order
// OpMatrixTimesVector adds and whether it fuses; on this grid no product and no partial sum is ever rounded, so every
// driver gets the same gl_Position, and coverage and depth can be compared bit for bit. The grid moves a vertex by less
// than a quarter of a pixel.
#pragma once

#include <glm/glm.hpp>

#include "scenes/geometry.h"

namespace lapilli::samples {

// Steps of the grids. A product is a multiple of 2^-21, so sums of magnitude up to 2^(24 - 21) = 8 fit 24 bits.
constexpr float kMatrixStep = 0x1p-11f;
constexpr float kPositionStep = 0x1p-10f;
constexpr float kExactLimit = 8.0f;

glm::mat4 snap_matrix(const glm::mat4& matrix);
glm::vec3 snap_position(const glm::vec3& position);

// matrix * vec4(position, 1). Throws std::logic_error if an argument is off its grid or a sum could be rounded.
Position exact_transform(const glm::mat4& matrix, const glm::vec3& position);

}  // namespace lapilli::samples
