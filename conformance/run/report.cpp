// Puts the results into words, pictures and JSON.
#include "run/report.h"

#include <algorithm>
#include <cstdio>
#include <thread>

#include "common/png.h"

namespace lapilli::run {
namespace {

using nlohmann::json;

std::string scientific(double value) {
  if (value == 0) return "0";
  char text[64];
  std::snprintf(text, sizeof(text), "%.1e", value);
  return text;
}

// The columns of the terminal's and of the page's table, one function each.
struct Column {
  const char* heading;
  const char* unit;
  std::string (*cell)(const SceneReport&, const Row&, bool first);
};

constexpr Column kColumns[] = {
    {"instance + device", "ms",
     [](const SceneReport&, const Row& row, bool) { return number(row.measurement.timings.instance_device, 2); }},
    {"pipelines", "ms",
     [](const SceneReport&, const Row& row, bool) { return number(row.measurement.timings.pipelines, 2); }},
    {"first frame", "ms",
     [](const SceneReport&, const Row& row, bool) { return number(row.measurement.timings.first_frame, 2); }},
    {"median frame", "ms",
     [](const SceneReport&, const Row& row, bool) { return number(row.measurement.timings.median_frame, 3); }},
    {"pixels differ", "",
     [](const SceneReport&, const Row& row, bool first) { return first ? "" : std::to_string(row.from_first.pixels); }},
    {"largest diff.", "/255",
     [](const SceneReport&, const Row& row, bool first) {
       return first ? "" : std::to_string(row.from_first.largest);
     }},
    {"largest error", "/255", [](const SceneReport&, const Row& row, bool) { return number(row.error.largest, 4); }},
    {"mean error", "/255", [](const SceneReport&, const Row& row, bool) { return number(row.error.mean, 5); }},
    {"off by > 1", "pixels", [](const SceneReport&, const Row& row, bool) { return std::to_string(row.error.beyond); }},
    {"depth error", "",
     [](const SceneReport& report, const Row& row, bool) {
       return report.writes_depth ? scientific(row.error.depth) : "";
     }},
    {"coverage off", "pixels",
     [](const SceneReport& report, const Row& row, bool) {
       return report.writes_depth ? std::to_string(row.error.coverage) : "";
     }},
};

std::string heading(const Column& column) {
  return *column.unit == '\0' ? column.heading : std::string(column.heading) + " [" + column.unit + "]";
}

std::vector<std::vector<std::string>> cells(const std::vector<SceneReport>& reports) {
  std::vector<std::vector<std::string>> lines = {{"scene", "driver"}};
  for (const Column& column : kColumns) lines[0].push_back(heading(column));
  for (const SceneReport& report : reports) {
    for (const Row& row : report.rows) {
      const bool first = &row == &report.rows.front();
      std::vector<std::string> line = {first ? report.name : "", row.measurement.driver.label};
      if (row.measurement.frame) {
        for (const Column& column : kColumns) line.push_back(column.cell(report, row, first));
      } else {
        line.push_back(row.measurement.failure);
      }
      lines.push_back(std::move(line));
    }
  }
  return lines;
}

json results(const std::vector<SceneReport>& reports) {
  json all = json::array();
  for (const SceneReport& report : reports) {
    for (const Row& row : report.rows) {
      const Measurement& m = row.measurement;
      json entry = {
          {"scene", report.name}, {"driver", m.driver.label}, {"device", m.device}, {"subpixel_bits", m.subpixel_bits}};
      if (m.frame) {
        entry["ms"] = {{"instance_device", m.timings.instance_device},
                       {"pipelines", m.timings.pipelines},
                       {"first_frame", m.timings.first_frame},
                       {"median_frame", m.timings.median_frame}};
        entry["oracle"] = {{"largest", row.error.largest},
                           {"mean", row.error.mean},
                           {"beyond_1", row.error.beyond},
                           {"depth", row.error.depth}};
        entry["from_first"] = {{"pixels", row.from_first.pixels},
                               {"largest", row.from_first.largest},
                               {"coverage", row.from_first.coverage},
                               {"depth", row.from_first.depth}};
        if (report.writes_depth) entry["oracle"]["coverage"] = row.error.coverage;
      } else {
        entry["failure"] = m.failure;
      }
      all.push_back(std::move(entry));
    }
  }
  return all;
}

// A point for each scene and driver. `value` is what is on the other axis.
json plot(const std::vector<SceneReport>& reports, const char* title, const char* y_label, bool y_log,
          double (*value)(const SceneReport&, const Row&)) {
  json points = json::array();
  for (const SceneReport& report : reports) {
    for (const Row& row : report.rows) {
      const double y = row.measurement.frame ? value(report, row) : -1;
      if (y < 0) continue;
      points.push_back({{"series", row.measurement.driver.label},
                        {"label", report.name},
                        {"x", row.measurement.timings.median_frame},
                        {"y", y}});
    }
  }
  return {{"type", "scatter"}, {"title", title},     {"x_label", "median frame [ms]"},
          {"x_log", true},     {"y_label", y_label}, {"y_log", y_log},
          {"points", points}};
}

json pictures(const SceneReport& report) {
  json images = json::array();
  for (const Row& row : report.rows) {
    if (row.picture.empty()) continue;
    images.push_back({{"file", row.picture}, {"caption", row.measurement.driver.label}});
  }
  for (const Row& row : report.rows) {
    if (row.difference_picture.empty()) continue;
    images.push_back({{"file", row.difference_picture},
                      {"caption", "|" + report.rows.front().measurement.driver.label + " − " +
                                      row.measurement.driver.label + "| × " + std::to_string(kAmplification)}});
  }
  return {{"type", "images"}, {"images", images}};
}

}  // namespace

SceneReport make_report(std::string_view name, std::string_view summary, const samples::SceneGeometry& geometry,
                        std::vector<Measurement> measurements, const std::string& directory) {
  SceneReport report;
  report.name = name;
  report.summary = summary;
  report.writes_depth = false;
  for (const samples::DrawGeometry& draw : geometry.draws) {
    report.triangles += draw.indices.size() / 3;
    report.writes_depth = report.writes_depth || draw.depth_test;
  }
  const oracle::Expected expected = oracle::resolve(geometry);
  report.undecidable = std::count(expected.either.begin(), expected.either.end(), uint8_t{1});

  for (Measurement& measurement : measurements) {
    report.rows.push_back({std::move(measurement), {}, {}, "", ""});
    Row& row = report.rows.back();
    if (!row.measurement.frame) continue;
    const samples::Frame& frame = *row.measurement.frame;
    const std::string& label = row.measurement.driver.label;
    row.error = oracle_error(expected, frame, report.writes_depth, geometry.clear_depth);
    row.picture = report.name + "." + label + ".png";
    samples::write_png(directory + "/" + row.picture, frame.width, frame.height, frame.color);
    const Row& first = report.rows.front();
    if (&row == &first || !first.measurement.frame) continue;
    row.from_first = difference(*first.measurement.frame, frame, geometry.clear_depth);
    row.difference_picture = report.name + ".difference." + label + ".png";
    samples::write_png(directory + "/" + row.difference_picture, frame.width, frame.height,
                       difference_picture(*first.measurement.frame, frame, kAmplification));
  }
  return report;
}

std::string table(const std::vector<SceneReport>& reports) { return aligned(cells(reports), 2); }

json page(const std::vector<SceneReport>& reports, const Plan& plan) {
  json devices = json::object();
  for (const SceneReport& report : reports) {
    for (const Row& row : report.rows) {
      if (!row.measurement.device.empty())
        devices[row.measurement.driver.label] =
            row.measurement.device + " (" + std::to_string(row.measurement.subpixel_bits) + " subpixel bits)";
    }
  }
  std::string names;
  for (const auto& [label, device] : devices.items()) {
    names += (names.empty() ? "" : "; ") + label + ": " + device.get<std::string>();
  }
  const json notes = {
      cpu_name() + ", " + std::to_string(std::thread::hardware_concurrency()) + " hardware threads. " + names + ".",
      std::to_string(plan.scene_options.width) + " × " + std::to_string(plan.scene_options.height) +
          " pixels. Instance + device, pipelines and first frame: medians of " + std::to_string(plan.starts) +
          " fresh processes, shader caches off. Median frame: " + std::to_string(plan.rounds) + " turns of " +
          std::to_string(plan.frames_per_round) +
          " frames, drivers alternating. A frame is recording, submission and wait.",
      "Errors are against the exact image computed in float64, in steps of 1/255: correct rounding to 8 bits leaves up "
      "to 0.5."};

  const std::vector<std::vector<std::string>> lines = cells(reports);
  json sections = json::array();
  sections.push_back(
      {{"heading", "All scenes"},
       {"blocks",
        {{{"type", "table"}, {"columns", lines[0]}, {"rows", std::vector(lines.begin() + 1, lines.end())}},
         plot(reports, "Largest colour error against time", "largest error against float64 [1/255]", true,
              [](const SceneReport&, const Row& row) { return row.error.largest; }),
         plot(reports, "Largest depth error against time", "largest depth error (none is drawn at 1e-9)", true,
              [](const SceneReport& report, const Row& row) {
                return report.writes_depth ? std::max(row.error.depth, 1e-9) : -1.0;
              })}}});
  for (const SceneReport& report : reports) {
    std::string text = report.summary + ". " + std::to_string(report.triangles) + " triangles.";
    if (report.undecidable > 0) {
      text += " " + std::to_string(report.undecidable) + " pixels that rounding decides are left out of the errors.";
    }
    sections.push_back({{"heading", report.name}, {"text", text}, {"blocks", {pictures(report)}}});
  }
  return {
      {"title", "Lapilli beside its peers"}, {"notes", notes}, {"results", results(reports)}, {"sections", sections}};
}

}  // namespace lapilli::run
