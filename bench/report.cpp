// See report.h.
#include "report.h"

#include <algorithm>
#include <cstdio>

namespace lapilli::bench {
namespace {

using nlohmann::json;
using run::number;
using Cells = std::vector<std::vector<std::string>>;

template <typename... Values>
std::string format(const char* pattern, Values... values) {
  char text[256];
  std::snprintf(text, sizeof(text), pattern, values...);
  return text;
}

std::string milliseconds(double value) { return number(value, value < 1 ? 3 : value < 100 ? 2 : 0); }

const char* word(Verdict verdict) {
  return verdict == Verdict::holds ? "holds" : verdict == Verdict::fails ? "does not hold" : "not measured";
}

json block_of(Cells cells) {
  const std::vector<std::string> columns = cells.front();
  cells.erase(cells.begin());
  return {{"type", "table"}, {"columns", columns}, {"rows", cells}};
}

Cells goal_cells(const std::vector<Goal>& goals) {
  Cells cells = {{"what must be true at 1280x720", "at least", "measured", "", "where not"}};
  for (const Goal& goal : goals)
    cells.push_back({goal.what, goal.required, goal.measured, word(goal.verdict), goal.detail});
  return cells;
}

std::vector<const Series*> of_size(const Findings& found, const std::string& size) {
  std::vector<const Series*> chosen;
  for (const Series& series : found.series) {
    if (series.size() == size) chosen.push_back(&series);
  }
  return chosen;
}

// One row for each scene, one column of `value` for each driver, then what `more` adds.
template <typename Value, typename More>
Cells table_of(const std::vector<const Series*>& scenes, const std::vector<run::Driver>& drivers, const char* unit,
               std::vector<std::string> more_columns, Value value, More more) {
  Cells cells = {{"scene"}};
  for (const run::Driver& driver : drivers) cells[0].push_back(driver.label + " " + unit);
  cells[0].insert(cells[0].end(), more_columns.begin(), more_columns.end());
  for (const Series* series : scenes) {
    std::vector<std::string> row = {series->scene};
    for (const Result& result : series->results) row.push_back(result.absent.empty() ? value(result) : "");
    const std::vector<std::string> rest = more(*series);
    row.insert(row.end(), rest.begin(), rest.end());
    cells.push_back(row);
  }
  return cells;
}

json bars(const std::string& title, const std::string& label, const std::vector<const Series*>& scenes,
          const std::vector<run::Driver>& drivers, const std::function<double(const Result&)>& value) {
  json groups = json::array();
  json series = json::object();
  json order = json::array();
  for (const Series* scene : scenes) groups.push_back(scene->scene);
  for (size_t i = 0; i < drivers.size(); ++i) {
    json values = json::array();
    for (const Series* scene : scenes) {
      const Result& result = scene->results[i];
      values.push_back(result.absent.empty() ? json(value(result)) : json());
    }
    series[drivers[i].label] = values;
    order.push_back(drivers[i].label);
  }
  return {{"type", "bars"}, {"title", title},   {"y_label", label}, {"y_log", true},
          {"wide", true},   {"groups", groups}, {"series", series}, {"order", order}};
}

json frames_section(const Findings& found, const std::string& size) {
  const auto scenes = of_size(found, size);
  const bool alone = found.drivers.size() < 2;
  Cells frames = table_of(
      scenes, found.drivers, "ms",
      {"best peer / ours", "limit ms", "limited by", "ours / limit", "CPU ms", "recording ms", "marked"},
      [](const Result& r) { return milliseconds(r.frame); },
      [&](const Series& s) -> std::vector<std::string> {
        const Result& ours = s.results.front();
        std::string marked;
        for (const Result& result : s.results) {
          if (result.disturbed) marked += (marked.empty() ? "others ran beside " : ", ") + result.driver;
        }
        if (!ours.absent.empty()) return {"", milliseconds(s.limit.ms), s.limit.resource, "", "", "", marked};
        return {alone ? "" : number(s.ratio(), 2),
                milliseconds(s.limit.ms),
                s.limit.resource,
                number(ours.frame / s.limit.ms, 1),
                milliseconds(ours.cpu),
                milliseconds(ours.record),
                marked};
      });
  return {{"heading", "Frames at " + size},
          {"blocks",
           {bars("Frame, submission to fence", "ms", scenes, found.drivers, [](const Result& r) { return r.frame; }),
            block_of(frames)}}};
}

json pipelines_section(const Findings& found) {
  const auto scenes = of_size(found, "1280x720");
  const auto total = [](const Result& r) { return r.pipelines + r.first_frame; };
  const Cells cells = table_of(
      scenes, found.drivers, "ms", {"ours: pipelines ms", "ours: first frame ms"},
      [&](const Result& r) { return milliseconds(total(r)); },
      [](const Series& s) -> std::vector<std::string> {
        const Result& ours = s.results.front();
        if (!ours.absent.empty()) return {"", ""};
        return {milliseconds(ours.pipelines), milliseconds(ours.first_frame)};
      });
  return {{"heading", "Pipelines and first frame"},
          {"text",
           "What it takes from shader modules to the first finished frame, the device and all resources being there; "
           "shader caches off; 1280x720."},
          {"blocks", {bars("Pipelines + first frame", "ms", scenes, found.drivers, total), block_of(cells)}}};
}

json starts_section(const Findings& found) {
  Cells cells = {{"driver", "instance + device ms", "resident MB", "of these its own (anonymous) MB"}};
  for (const Start& start : found.starts) {
    if (!start.absent.empty()) {
      cells.push_back({start.driver, start.absent});
      continue;
    }
    cells.push_back({start.driver, milliseconds(start.instance_device), number(start.resident_kb / 1024, 1),
                     number(start.anonymous_kb / 1024, 1)});
  }
  const Cells memory = table_of(
      of_size(found, "1280x720"), found.drivers, "MB", {}, [](const Result& r) { return number(r.peak_kb / 1024, 0); },
      [](const Series&) { return std::vector<std::string>(); });
  return {{"heading", "Instance, device and memory"},
          {"text",
           "The process right after its device was made, loader included; \"nothing\" is a driver that does nothing. "
           "Below: the most that each process held while it drew at 1280x720, its own buffers included."},
          {"blocks", {block_of(cells), block_of(memory)}}};
}

json growth_section(const Findings& found) {
  json blocks = json::array();
  for (const Curve& curve : found.growth) {
    json points = json::array();
    for (const Curve::Point& point : curve.points) {
      points.push_back({{"series", point.driver}, {"label", "frame"}, {"x", point.x}, {"y", point.ms}});
    }
    blocks.push_back({{"type", "scatter"},
                      {"title", curve.title},
                      {"x_label", curve.x_label},
                      {"x_log", true},
                      {"y_label", "ms"},
                      {"y_log", true},
                      {"lines", true},
                      {"points", points}});
  }
  Cells cells = {{"scene", "one thread ms", "two threads ms", "ratio"}};
  for (const TwoThreads& scene : found.two_threads) {
    cells.push_back(
        {scene.scene, milliseconds(scene.one_ms), milliseconds(scene.two_ms), number(scene.one_ms / scene.two_ms, 2)});
  }
  const Scaling& machine = found.scaling;
  for (const auto& [what, value] :
       {std::pair("the machine: arithmetic", machine.operations), std::pair("the machine: loads", machine.loads),
        std::pair("the machine: cache", machine.cached), std::pair("the machine: memory, 64 MB", machine.memory)}) {
    cells.push_back({what, "", "", number(value, 2)});
  }
  blocks.push_back(block_of(cells));
  return {{"heading", "Growth"},
          {"text", "Last: " + found.drivers.front().label +
                       " with one thread and with two; the rows of the machine say what two CPUs do at best in the "
                       "time that one takes."},
          {"blocks", blocks}};
}

json absences_section(const Findings& found) {
  Cells cells = {{"scene", "driver", "why it is not there"}};
  for (const Series* series : of_size(found, found.series.front().size())) {
    for (const Result& result : series->results) {
      if (!result.absent.empty()) cells.push_back({series->scene, result.driver, result.absent});
    }
  }
  Cells distances = {{"scene", "ours / limit", "why"}};
  for (const Series* series : of_size(found, "1280x720")) {
    const std::string reason = reason_for_distance(series->scene);
    if (reason.empty() || !series->results.front().absent.empty()) continue;
    distances.push_back({series->scene, number(series->results.front().frame / series->limit.ms, 1), reason});
  }
  return {{"heading", "Not there, and far from the limit"}, {"blocks", {block_of(cells), block_of(distances)}}};
}

json pictures_section(const Findings& found) {
  json images = json::array();
  for (const Series* series : of_size(found, "256x256")) {
    const Result& ours = series->results.front();
    if (ours.colors > 0)
      images.push_back({{"file", "bench/" + picture_name(*series, ours)}, {"caption", series->scene}});
  }
  json blocks = json::array();
  if (!images.empty()) blocks.push_back({{"type", "images"}, {"images", images}});
  std::string text;
  for (const SceneEntry& entry : scenes()) {
    text += (text.empty() ? "" : "; ") + std::string(entry.name) + ": " + std::string(entry.summary);
    if (entry.count > 0) text += " (" + std::to_string(entry.count) + " " + std::string(entry.counted) + ")";
  }
  return {{"heading", "The scenes"}, {"text", text + "."}, {"blocks", blocks}};
}

json results(const Findings& found, const std::vector<Goal>& goals) {
  json series = json::array();
  for (const Series& s : found.series) {
    for (const Result& r : s.results) {
      json entry = {{"scene", s.scene},
                    {"width", s.options.extent.width},
                    {"height", s.options.extent.height},
                    {"count", s.options.count},
                    {"driver", r.driver},
                    {"limit_ms", s.limit.ms},
                    {"limited_by", s.limit.resource}};
      if (r.absent.empty()) {
        entry.update({{"device", r.device},
                      {"frame_ms", r.frame},
                      {"turns_ms", r.turns},
                      {"record_ms", r.record},
                      {"cpu_ms", r.cpu},
                      {"pipelines_ms", r.pipelines},
                      {"first_frame_ms", r.first_frame},
                      {"resident_kb", r.resident_kb},
                      {"anonymous_kb", r.anonymous_kb},
                      {"peak_kb", r.peak_kb},
                      {"others", r.others},
                      {"waited", r.waited},
                      {"disturbed", r.disturbed},
                      {"frame_over_limit", r.frame / s.limit.ms}});
      } else {
        entry["absent"] = r.absent;
      }
      if (&r == &s.results.front() && s.ratio() > 0) entry["best_peer_over_this"] = s.ratio();
      series.push_back(entry);
    }
  }
  json starts = json::array();
  for (const Start& s : found.starts) {
    starts.push_back({{"driver", s.driver},
                      {"instance_device_ms", s.instance_device},
                      {"resident_kb", s.resident_kb},
                      {"anonymous_kb", s.anonymous_kb}});
  }
  json threads = json::array();
  for (const TwoThreads& t : found.two_threads) {
    threads.push_back({{"scene", t.scene}, {"one_ms", t.one_ms}, {"two_ms", t.two_ms}, {"ratio", t.one_ms / t.two_ms}});
  }
  json growth = json::array();
  for (const Curve& curve : found.growth) {
    json points = json::array();
    for (const Curve::Point& p : curve.points) points.push_back({{"driver", p.driver}, {"x", p.x}, {"ms", p.ms}});
    growth.push_back({{"title", curve.title}, {"x", curve.x_label}, {"points", points}});
  }
  json lines = json::array();
  for (const Goal& goal : goals) {
    lines.push_back({{"what", goal.what},
                     {"required", goal.required},
                     {"measured", goal.measured},
                     {"verdict", word(goal.verdict)},
                     {"detail", goal.detail}});
  }
  return {{"machine",
           {{"cpu", run::cpu_name()},
            {"threads", found.threads},
            {"operations_per_s", found.rates.operations},
            {"loads_per_s", found.rates.loads},
            {"cached_bytes_per_s", found.rates.cached},
            {"draws_per_s", found.rates.draws},
            {"two_threads_over_one",
             {{"operations", found.scaling.operations},
              {"loads", found.scaling.loads},
              {"cached", found.scaling.cached},
              {"memory", found.scaling.memory}}}}},
          {"goals", lines},
          {"series", series},
          {"starts", starts},
          {"two_threads", threads},
          {"growth", growth}};
}

}  // namespace

std::string heading(const std::vector<run::Driver>& drivers) {
  std::string text = format("%-13s %-9s", "frames in ms", "");
  for (const run::Driver& driver : drivers) text += format(" %11s", driver.label.c_str());
  text += format(" %7s %7s | CPU", "ratio", "/limit");
  for (const run::Driver& driver : drivers) text += format(" %11s", driver.label.c_str());
  return text + format(" %7s | others\n", "ratio");
}

std::string line(const Series& series) {
  std::string text = format("%-13s %-9s", series.scene.c_str(), series.size().c_str());
  const Result& ours = series.results.front();
  const auto columns = [&](double Result::*value, std::vector<double> Result::*turns) {
    for (const Result& result : series.results) {
      text += format(" %11s", result.absent.empty() ? number(result.*value, 3).c_str() : "-");
    }
    text += format(" %7s", series.ratio(turns) > 0 ? number(series.ratio(turns), 2).c_str() : "-");
  };
  columns(&Result::frame, &Result::turns);
  text += format(" %7s |    ", ours.absent.empty() ? number(ours.frame / series.limit.ms, 1).c_str() : "-");
  columns(&Result::cpu, &Result::cpu_turns);
  double others = 0;
  for (const Result& result : series.results) others = std::max(others, result.others);
  const bool marked =
      std::any_of(series.results.begin(), series.results.end(), [](const Result& r) { return r.disturbed; });
  text += format(" | %3.0f %%%s\n", 100 * others, marked ? " disturbed" : "");
  for (const Result& result : series.results) {
    if (!result.absent.empty()) text += "    " + result.driver + ": " + result.absent + "\n";
  }
  return text;
}

std::string table(const std::vector<Goal>& goals) {
  Cells cells = goal_cells(goals);
  for (std::vector<std::string>& row : cells) row.pop_back();
  std::string text = run::aligned(cells, 4);
  for (const Goal& goal : goals) {
    if (!goal.detail.empty()) text += "\n" + goal.what + "\n    " + goal.detail + "\n";
  }
  return text;
}

json page(const Findings& found) {
  const std::vector<Goal> goals = goals_of(found);
  std::string devices;
  for (const Result& result : found.series.front().results) {
    if (!result.device.empty()) devices += (devices.empty() ? "" : "; ") + result.driver + ": " + result.device;
  }
  const auto giga = [](double value) { return number(1e-9 * value, 0); };
  const json notes = {run::cpu_name() + ", " + std::to_string(found.threads) + " hardware threads. " + devices + ".",
                      "Medians of " + std::to_string(found.plan.rounds) + " turns of " + number(found.plan.turn_ms, 0) +
                          " ms, drivers alternating; pipelines and first frames of " +
                          std::to_string(found.plan.starts) +
                          " fresh processes, shader caches off. A frame is submission to fence; recording is apart. "
                          "Turns in which other "
                          "processes used more than " +
                          number(100 * kDisturbance, 0) +
                          " % of the CPUs while the driver's threads waited for one are left out; where that was half "
                          "of them or more, the "
                          "figure is marked.",
                      "Limits, measured in the same run on all threads: " + giga(found.rates.operations) +
                          " G operations/s (an fma is one), " + giga(found.rates.loads) + " G loads/s, " +
                          giga(found.rates.cached) + " GB/s within 16 KB, " + number(1e-6 * found.rates.draws, 0) +
                          " M draws/s; memory is measured with buffers as large as the scene's own."};
  json sections = json::array({{{"heading", "What must be true"}, {"blocks", {block_of(goal_cells(goals))}}}});
  std::vector<std::string> sizes;
  for (const Series& series : found.series) {
    if (std::find(sizes.begin(), sizes.end(), series.size()) == sizes.end()) sizes.push_back(series.size());
  }
  for (const std::string& size : sizes) sections.push_back(frames_section(found, size));
  if (!of_size(found, "1280x720").empty()) sections.push_back(pipelines_section(found));
  if (!found.starts.empty()) sections.push_back(starts_section(found));
  if (!found.two_threads.empty()) sections.push_back(growth_section(found));
  sections.push_back(absences_section(found));
  sections.push_back(pictures_section(found));
  return {{"title", "Lapilli's frames beside its peers'"},
          {"notes", notes},
          {"results", results(found, goals)},
          {"sections", sections}};
}

}  // namespace lapilli::bench
