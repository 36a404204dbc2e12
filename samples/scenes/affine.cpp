// Three equations [x y 1] * M = [x' y'], solved by Gaussian elimination with partial pivoting.
#include "scenes/affine.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lapilli::samples {
namespace {

constexpr double kDegenerate = 1e-12;  // a pivot relative to the largest coefficient

using Row = std::array<double, 5>;  // x, y, 1 | x', y'

}  // namespace

std::optional<AffineMap> solve_affine(const Triangle& source, const Triangle& target) {
  std::array<Row, 3> rows;
  double largest = 0;
  for (size_t i = 0; i < 3; ++i) {
    rows[i] = {source[i].x, source[i].y, 1.0, target[i].x, target[i].y};
    largest = std::max({largest, std::abs(source[i].x), std::abs(source[i].y)});
  }
  // Scaling the constant column by the size of the coordinates makes the pivots comparable.
  for (Row& row : rows) row[2] = largest;

  for (size_t column = 0; column < 3; ++column) {
    // The sign must not decide: (-5, 0, 0) is as good a pivot as (5, 0, 0).
    const auto pivot =
        std::max_element(rows.begin() + static_cast<std::ptrdiff_t>(column), rows.end(),
                         [&](const Row& a, const Row& b) { return std::abs(a[column]) < std::abs(b[column]); });
    std::swap(*pivot, rows[column]);
    const double divisor = rows[column][column];
    if (!(std::abs(divisor) > kDegenerate * largest) || !std::isfinite(divisor)) return std::nullopt;
    for (double& value : rows[column]) value /= divisor;
    for (size_t other = 0; other < 3; ++other) {
      if (other == column) continue;
      const double factor = rows[other][column];
      for (size_t k = column; k < rows[other].size(); ++k) rows[other][k] -= factor * rows[column][k];
    }
  }
  return AffineMap{rows[0][3], rows[1][3], rows[2][3] * largest, rows[0][4], rows[1][4], rows[2][4] * largest};
}

}  // namespace lapilli::samples
