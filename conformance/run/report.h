// The results as a table on the terminal, as PNGs, and as the JSON that page.py makes a page of.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "run/compare.h"
#include "run/measure.h"

namespace lapilli::run {

// A driver's measurement of a scene beside the oracle and beside the first driver's.
struct Row {
  Measurement measurement;
  OracleError error;
  Difference from_first;  // zero for the first driver
  std::string picture;    // file names in the output directory, empty if there is none
  std::string difference_picture;
};

struct SceneReport {
  std::string name;
  std::string summary;
  size_t triangles = 0;
  int64_t undecidable = 0;  // pixels that the oracle leaves out
  bool writes_depth = true;
  std::vector<Row> rows;  // in the order of the drivers
};

constexpr int kAmplification = 64;  // of difference pictures

// Compares the measured frames with the oracle and with the first driver's, and writes the PNGs into `directory`.
SceneReport make_report(std::string_view name, std::string_view summary, const samples::SceneGeometry& geometry,
                        std::vector<Measurement> measurements, const std::string& directory);

std::string table(const std::vector<SceneReport>& reports);

// {"title", "notes", "results", "sections"}; page.py reads all but "results".
nlohmann::json page(const std::vector<SceneReport>& reports, const Plan& plan);

}  // namespace lapilli::run
