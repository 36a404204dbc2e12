// Lets drivers take turns on a scene and takes the medians.
#pragma once

#include <string>
#include <vector>

#include "machine.h"
#include "run/common.h"
#include "scenes/scene.h"

namespace lapilli::bench {

struct Plan {
  std::string program;  // this executable
  int starts = 3;       // fresh processes for pipelines and first frames
  int rounds = 4;       // turns of each driver
  double turn_ms = 100;
  int frames_per_turn = 200;  // at most
  std::string pictures;       // directory for PNGs of the last frames; empty: none
};

// A driver and how many threads it may use.
struct Contestant {
  std::string label;
  std::string manifest;
  int threads = 0;  // 0: as many as there are CPUs
};
std::vector<Contestant> contestants_of(const std::vector<run::Driver>& drivers, int threads = 0);

// A scene at a size on a driver; all times in ms, medians.
struct Result {
  std::string driver;
  std::string device;
  std::string absent;  // why there is nothing: what the device lacks, or how the process ended
  double frame = 0;
  double record = 0;
  double cpu = 0;  // of all threads, recording included
  double pipelines = 0;
  double first_frame = 0;                                 // recording and submission to fence, after the pipelines
  double resident_kb = 0, anonymous_kb = 0, peak_kb = 0;  // after the last frame
  std::vector<double> turns, cpu_turns;                   // frame and CPU of each turn: its median frame, its mean CPU
  double others = 0;       // the median turn's share of all CPUs that other processes used
  double waited = 0;       // the median turn's share of the time that its own threads waited for a CPU
  bool disturbed = false;  // at least half of the turns were
  int colors = 0;          // in the picture, if one was asked for
};
// A turn counts as disturbed if others used more than this share of the CPUs and threads of its own waited for longer
// than this share of the time. Drivers with more threads than CPUs wait for themselves; and what others do on a CPU
// that a driver leaves idle does not matter.
constexpr double kDisturbance = 0.1;

struct Series {
  std::string scene;
  SceneOptions options;
  Machine::Limit limit;
  std::vector<Result> results;  // in the order of the contestants

  // How many times faster the first one is than the best of the others: the median over the rounds of turns of what the
  // other took in the round over what the first took in it, since the speed of a shared machine changes from second to
  // second. 0 if either has nothing. `turns`: frame or CPU.
  double ratio(std::vector<double> Result::*turns = &Result::turns) const;
  std::string size() const;  // "1280x720"
};

// File name of a picture in Plan::pictures.
std::string picture_name(const Series& series, const Result& result);

Series measure(const SceneEntry& entry, const SceneOptions& options, const std::vector<Contestant>& contestants,
               const Plan& plan);

}  // namespace lapilli::bench
