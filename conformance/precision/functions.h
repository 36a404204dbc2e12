// What docs/precision.md lists: each function's exact value in float64, and the error that the specification allows at
// these operands. Numbers are those of shaders/conformance/precision.comp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "oracle/inexact.h"

namespace lapilli::precision {

using oracle::Inexact;

constexpr uint32_t kFirstOfSeveral = 50;
constexpr uint32_t kMaxOperands = 16;
constexpr uint32_t kMaxResults = 16;

// Of one operand of 32 bits; all 2^32 can be tried.
struct OneOperand {
  int number;
  const char* name;
  bool bits;  // x is the operand's bits as an unsigned number, otherwise its value as a float32
  double (*exact)(double x);
  Inexact (*allowed)(double x, double exact);
  const char* bound;  // the specification's, in words
  double promised;    // largest error of ours in ULP, over all operands
};

struct SeveralOperands {
  int number;
  const char* name;
  uint32_t operands;
  uint32_t results;
  void (*exact)(const double* x, double* y);
  void (*allowed)(const double* x, Inexact* y);
  const char* bound;
  double promised;  // infinity: where terms cancel, an error has no measure in ULP; the specification's bound counts
};

std::span<const OneOperand> functions_of_one();
std::span<const SeveralOperands> functions_of_several();

// Operands of `count` calls, one after the other: special values in all combinations at the first two places, then any
// bits, moderate numbers and numbers in [0, 1], in turns. The same for the same seed.
std::vector<float> operands_for(const SeveralOperands& function, size_t count, uint32_t seed);

}  // namespace lapilli::precision
