// What functions give at the edges, where the specification asks little: Lapilli's answers, the same on every machine.
#pragma once

#include <span>
#include <vector>

namespace lapilli::precision {

struct Edge {
  const char* text;
  int number;  // in precision.comp
  std::vector<float> operands;
  std::vector<float> result;  // NaN stands for any
};

std::span<const Edge> edges();

}  // namespace lapilli::precision
