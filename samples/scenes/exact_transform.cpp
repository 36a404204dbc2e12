// Matrix * vertex without a rounding error, or not at all.
#include "scenes/exact_transform.h"

#include <cmath>
#include <stdexcept>

namespace lapilli::samples {
namespace {

float snap(float value, float step) { return std::round(value / step) * step; }

void require_on_grid(float value, float step) {
  if (snap(value, step) != value) throw std::logic_error("exact_transform: a value is not on its grid");
}

}  // namespace

glm::mat4 snap_matrix(const glm::mat4& matrix) {
  glm::mat4 snapped;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) snapped[column][row] = snap(matrix[column][row], kMatrixStep);
  }
  return snapped;
}

glm::vec3 snap_position(const glm::vec3& position) {
  return {snap(position.x, kPositionStep), snap(position.y, kPositionStep), snap(position.z, kPositionStep)};
}

Position exact_transform(const glm::mat4& matrix, const glm::vec3& position) {
  const glm::vec4 vertex(position, 1.0f);
  Position result = {};
  for (int row = 0; row < 4; ++row) {
    float sum = 0;
    float magnitude = 0;  // bounds every partial sum, whatever the order
    for (int column = 0; column < 4; ++column) {
      require_on_grid(matrix[column][row], kMatrixStep);
      require_on_grid(vertex[column], kPositionStep);
      sum += matrix[column][row] * vertex[column];
      magnitude += std::abs(matrix[column][row] * vertex[column]);
    }
    if (!(magnitude <= kExactLimit)) throw std::logic_error("exact_transform: a sum may be rounded");
    result[static_cast<size_t>(row)] = sum;
  }
  return result;
}

}  // namespace lapilli::samples
