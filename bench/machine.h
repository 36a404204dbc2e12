// What the machine can do at best, measured beside the drivers: the limit of a frame. Small kernels on all CPUs.
#pragma once

#include <string>

#include "scenes/scene.h"

namespace lapilli::bench {

// Of all CPUs together; each the best of many short measurements, because others can only slow them down.
struct Rates {
  double operations = 0;  // fma on float32, a second
  double loads = 0;       // of 8 bytes at computed places in 4 MB, a second
  double cached = 0;      // bytes read and written within 16 KB, a second
  double draws = 0;       // commands of small draws, read and set up one after the other on one CPU, a second
};

// What two CPUs do in the same time, for one alone: what a scene can gain by a second thread. Two threads of one core
// give 1 where the core is busy.
struct Scaling {
  double operations = 0, loads = 0, cached = 0;  // as in Rates
  double memory = 0;                             // bytes written and read in 64 MB
};

class Machine {
 public:
  Machine();
  // Measures again and keeps what is better; takes about 40 ms.
  void measure();
  const Rates& rates() const { return rates_; }
  int threads() const { return threads_; }
  // All zero where there is one CPU. Takes about half a second.
  Scaling scaling() const;

  struct Limit {
    double ms = 0;
    const char* resource = "";  // which of the times it is
  };
  // The longest of what the parts of `work` take. Memory is measured with buffers of just this size, because a picture
  // that stays in a cache is written faster than one that does not.
  Limit limit_of(const Work& work) const;

 private:
  int threads_ = 1;
  Rates rates_;
};

}  // namespace lapilli::bench
