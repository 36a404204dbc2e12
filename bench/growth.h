// How the time of a frame grows with what there is to do, and shrinks with threads.
#pragma once

#include <string>
#include <vector>

#include "measure.h"

namespace lapilli::bench {

struct Curve {
  std::string title;
  std::string x_label;
  struct Point {
    std::string driver;
    double x;
    double ms;
  };
  std::vector<Point> points;
};

// Resolution, triangles, draws, layers and threads, at 1280x720 but for the first.
std::vector<Curve> measure_growth(const std::vector<run::Driver>& drivers, const Plan& plan);

// A scene at 1280x720 on one driver with one thread and with two, in turns; nothing where it cannot be drawn.
struct TwoThreads {
  std::string scene;
  double one_ms = 0, two_ms = 0;
};
std::vector<TwoThreads> measure_two_threads(const std::vector<const SceneEntry*>& scenes, const run::Driver& driver,
                                            const Plan& plan);

}  // namespace lapilli::bench
