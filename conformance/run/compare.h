// How far pictures are from each other and from the oracle.
#pragma once

#include <string>

#include "common/target.h"
#include "oracle/scene.h"

namespace lapilli::run {

// Two pictures of the same size.
struct Difference {
  int64_t pixels = 0;    // whose 8-bit colour differs
  int largest = 0;       // 8-bit steps, over all components
  int64_t coverage = 0;  // pixels that one has drawn on (depth not cleared) and the other has not
  double depth = 0;      // largest |difference|
};
Difference difference(const samples::Frame& a, const samples::Frame& b, float clear_depth);

// One picture against float64. Pixels that the oracle calls undecidable are left out.
struct OracleError {
  double largest = 0;    // 8-bit steps; rounding alone gives up to 0.5
  double mean = 0;       // 8-bit steps; rounding alone gives 0.25 where values are spread evenly
  int64_t beyond = 0;    // pixels off by more than one step
  int64_t coverage = 0;  // pixels covered by one and not by the other; -1: the scene writes no depth to tell
  double depth = 0;      // largest |difference|
};
OracleError oracle_error(const oracle::Expected& expected, const samples::Frame& frame, bool writes_depth,
                         float clear_depth);

// |a - b|, `amplification` times, opaque.
std::vector<uint8_t> difference_picture(const samples::Frame& a, const samples::Frame& b, int amplification);

// Whether every pixel has the same colour.
bool is_empty(const samples::Frame& frame);

}  // namespace lapilli::run
