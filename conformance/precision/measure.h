// Runs the functions of a driver and compares them with what is exact and what is allowed.
#pragma once

#include <string>
#include <vector>

#include "common/context.h"
#include "precision/edges.h"
#include "precision/functions.h"

namespace lapilli::precision {

struct Worst {
  double value = 0;
  std::vector<float> operands;  // where
};

struct Measured {
  std::string name;
  std::string bound;
  double promised = 0;
  uint64_t calls = 0;
  uint64_t judged = 0;    // results for which the specification has a bound
  Worst ulp = {};         // largest error; of functions of several operands, where there is a bound
  Worst share = {};       // largest error in parts of what is allowed; above 1 it is too large
  uint64_t specials = 0;  // exact results that are infinite or NaN
  Worst special = {};     // 1 if one of them came out differently
};

// What counts: everything, or what the specification has a bound for and no denormal is part of (a driver may flush
// them).
enum class Judge { everything, specified };

// Every `stride`-th of the 2^32 operands, beginning with the smallest.
Measured measure(const samples::Context& context, Judge judge, const OneOperand& function, uint32_t stride);
Measured measure(const samples::Context& context, Judge judge, const SeveralOperands& function, size_t calls,
                 uint32_t seed);

// The results at an edge.
std::vector<float> run_edge(const samples::Context& context, const Edge& edge);
// Bit by bit, but any NaN is the same.
bool same(std::span<const float> got, std::span<const float> want);

}  // namespace lapilli::precision
