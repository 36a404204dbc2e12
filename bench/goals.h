// What has to be true of the first driver beside the others, computed from a found.
#pragma once

#include "growth.h"
#include "start.h"

namespace lapilli::bench {

// Everything that a run measured.
struct Findings {
  std::vector<run::Driver> drivers;
  Plan plan;
  Rates rates;
  int threads = 0;  // of the limits' kernels
  std::vector<Series> series;
  std::vector<Start> starts;
  std::vector<TwoThreads> two_threads;
  Scaling scaling;  // of the machine itself, beside two_threads
  std::vector<Curve> growth;
};

enum class Verdict { holds, fails, unknown };

struct Goal {
  std::string what;
  std::string required;
  std::string measured;  // empty if nothing of it was measured
  Verdict verdict = Verdict::unknown;
  std::string detail = {};  // which scenes it fails on, with their figures
};
// All at 1280x720.
std::vector<Goal> goals_of(const Findings& found);

// Why a scene is further from its limit than four times, in a sentence; empty if nobody has said so.
std::string reason_for_distance(std::string_view scene);

}  // namespace lapilli::bench
