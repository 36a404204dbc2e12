// See measure.h.
#include "measure.h"

#include <algorithm>
#include <memory>

#include "child.h"
#include "run/process.h"

namespace lapilli::bench {
namespace {

using nlohmann::json;

// What a driver's turns and starts have given so far.
struct Taken {
  std::unique_ptr<run::Process> process;
  std::vector<double> pipelines, first_frames;
  std::vector<double> frames, records, cpu, others, waited;  // one for each turn
  std::vector<bool> disturbed;
};

run::Launch launch_of(const Contestant& contestant, const ChildOptions& options, const Plan& plan) {
  run::Launch launch = {plan.program, arguments_of(options), contestant.manifest, {}};
  if (contestant.threads == 0) return launch;
  // Lapilli is told; the peers are given fewer CPUs, so that what they run beside their workers is limited as well.
  if (contestant.label.starts_with("Lapilli")) {
    launch.environment = {{"LAPILLI_THREADS", std::to_string(contestant.threads)}};
  } else {
    launch.environment = {{"LP_NUM_THREADS", std::to_string(contestant.threads)}};
    launch.cpus = contestant.threads;
  }
  return launch;
}

void start(Result& result, Taken& taken, const run::Launch& launch) {
  taken.process.reset();
  taken.process = std::make_unique<run::Process>(launch);
  const auto hello = taken.process->answer();
  if (!hello) {
    result.absent = "no first frame: " + taken.process->ended();
  } else if (hello->contains("failure")) {
    result.absent = hello->at("failure");
  } else if (hello->contains("missing")) {
    result.absent = "needs " + hello->at("missing").get<std::string>();
  } else {
    result.device = hello->at("device");
    taken.pipelines.push_back(hello->at("pipelines"));
    taken.first_frames.push_back(hello->at("first_record").get<double>() + hello->at("first_frame").get<double>());
  }
}

void take_turn(Result& result, Taken& taken, double milliseconds, int frames, bool counts) {
  std::optional<json> reply;
  if (taken.process->tell("turn " + std::to_string(milliseconds) + " " + std::to_string(frames))) {
    reply = taken.process->answer();
  }
  if (!reply || !reply->contains("frames")) {
    result.absent = "ended while drawing: " + (reply ? reply->dump() : taken.process->ended());
  } else if (counts) {
    taken.frames.push_back(run::median(reply->at("frames")));
    taken.records.push_back(run::median(reply->at("records")));
    taken.cpu.push_back(reply->at("cpu"));
    taken.others.push_back(reply->at("others"));
    taken.waited.push_back(reply->at("waited"));
    taken.disturbed.push_back(taken.others.back() > kDisturbance && taken.waited.back() > kDisturbance);
  }
}

bool mostly(const std::vector<bool>& disturbed) {
  return 2 * std::count(disturbed.begin(), disturbed.end(), true) >= static_cast<std::ptrdiff_t>(disturbed.size());
}

// The median of the turns; those in which others took the machine are left out, unless most are such.
double calm_median(const std::vector<double>& values, const std::vector<bool>& disturbed) {
  if (mostly(disturbed)) return run::median(values);
  std::vector<double> calm;
  for (size_t i = 0; i < values.size(); ++i) {
    if (!disturbed[i]) calm.push_back(values[i]);
  }
  return run::median(calm);
}

void finish(Result& result, Taken& taken, const std::string& picture) {
  result.pipelines = run::median(taken.pipelines);
  result.first_frame = run::median(taken.first_frames);
  result.turns = taken.frames;
  result.cpu_turns = taken.cpu;
  result.frame = calm_median(taken.frames, taken.disturbed);
  result.record = calm_median(taken.records, taken.disturbed);
  result.cpu = calm_median(taken.cpu, taken.disturbed);
  result.others = run::median(taken.others);
  result.waited = run::median(taken.waited);
  result.disturbed = mostly(taken.disturbed);
  if (taken.process->tell("memory")) {
    if (const auto memory = taken.process->answer()) {
      result.resident_kb = memory->at("resident_kb");
      result.anonymous_kb = memory->at("anonymous_kb");
      result.peak_kb = memory->at("peak_kb");
    }
  }
  if (!picture.empty() && taken.process->tell("picture " + picture)) {
    if (const auto saved = taken.process->answer()) result.colors = saved->at("colors");
  }
}

}  // namespace

std::vector<Contestant> contestants_of(const std::vector<run::Driver>& drivers, int threads) {
  std::vector<Contestant> contestants;
  for (const run::Driver& driver : drivers) contestants.push_back({driver.label, driver.manifest, threads});
  return contestants;
}

double Series::ratio(std::vector<double> Result::*turns) const {
  if (!results.front().absent.empty()) return 0;
  const std::vector<double>& ours = results.front().*turns;
  double least = 0;
  for (size_t i = 1; i < results.size(); ++i) {
    const std::vector<double>& theirs = results[i].*turns;
    std::vector<double> ratios;
    for (size_t turn = 0; turn < std::min(ours.size(), theirs.size()); ++turn) {
      if (ours[turn] > 0) ratios.push_back(theirs[turn] / ours[turn]);
    }
    if (!results[i].absent.empty() || ratios.empty()) continue;
    const double ratio = run::median(ratios);
    if (least == 0 || ratio < least) least = ratio;
  }
  return least;
}

std::string Series::size() const {
  return std::to_string(options.extent.width) + "x" + std::to_string(options.extent.height);
}

Series measure(const SceneEntry& entry, const SceneOptions& options, const std::vector<Contestant>& contestants,
               const Plan& plan) {
  Series series = {std::string(entry.name), options, {}, std::vector<Result>(contestants.size())};
  if (series.options.count == 0) series.options.count = entry.count;
  std::vector<Taken> taken(contestants.size());
  std::vector<run::Launch> launches;
  for (size_t i = 0; i < contestants.size(); ++i) {
    series.results[i].driver = contestants[i].label;
    launches.push_back(launch_of(contestants[i], {series.scene, series.options}, plan));
  }
  const auto each = [&](auto&& act) {
    for (size_t i = 0; i < contestants.size(); ++i) {
      if (series.results[i].absent.empty()) act(series.results[i], taken[i], i);
    }
  };
  for (int s = 0; s < plan.starts; ++s) {
    each([&](Result& result, Taken& t, size_t i) { start(result, t, launches[i]); });
  }
  // The second frame may still make things that the first one left for later.
  each([&](Result& result, Taken& t, size_t) { take_turn(result, t, plan.turn_ms / 4, 3, false); });
  for (int round = 0; round < plan.rounds; ++round) {
    each([&](Result& result, Taken& t, size_t) { take_turn(result, t, plan.turn_ms, plan.frames_per_turn, true); });
  }
  each([&](Result& result, Taken& t, size_t) {
    const std::string file = plan.pictures + "/" + picture_name(series, result);
    finish(result, t, plan.pictures.empty() ? "" : file);
  });
  return series;
}

std::string picture_name(const Series& series, const Result& result) {
  return series.scene + "." + series.size() + "." + result.driver + ".png";
}

}  // namespace lapilli::bench
