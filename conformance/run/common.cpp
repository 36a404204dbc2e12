// See common.h.
#include "run/common.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace lapilli::run {
namespace {

namespace fs = std::filesystem;

// Short names by which the manifests of known drivers are recognized.
std::string label_of(const std::string& manifest) {
  const std::string file = fs::path(manifest).filename();
  if (file.find("lapilli") != std::string::npos) return "Lapilli";
  if (file.find("lvp") != std::string::npos) return "lavapipe";
  if (file.find("swiftshader") != std::string::npos) return "SwiftShader";
  return fs::path(manifest).stem().stem();
}

}  // namespace

std::vector<std::string> manifests_from_environment() {
  std::vector<std::string> manifests;
  for (const char* name : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) {
    const char* value = std::getenv(name);
    if (value == nullptr || !manifests.empty()) continue;
    std::istringstream list(value);
    for (std::string manifest; std::getline(list, manifest, ':');) {
      if (!manifest.empty()) manifests.push_back(manifest);
    }
  }
  return manifests;
}

std::vector<Driver> drivers_of(const std::vector<std::string>& manifests, const char* program) {
  std::vector<Driver> drivers;
  for (const std::string& manifest : manifests) {
    if (fs::exists(manifest)) {
      drivers.push_back({manifest, label_of(manifest)});
    } else {
      std::fprintf(stderr, "%s: %s is not there; going on without it\n", program, manifest.c_str());
    }
  }
  for (const char* peer : {"lavapipe", "SwiftShader"}) {
    const bool found = std::any_of(drivers.begin(), drivers.end(), [&](const Driver& d) { return d.label == peer; });
    if (!found) std::fprintf(stderr, "%s: %s is not installed; going on without it\n", program, peer);
  }
  return drivers;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::string number(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof(text), "%.*f", digits, value);
  return text;
}

std::string aligned(const std::vector<std::vector<std::string>>& lines, size_t left) {
  std::vector<size_t> widths(lines[0].size());
  for (const std::vector<std::string>& line : lines) {
    if (line.size() != widths.size()) continue;  // a failure's text may be longer than its column
    for (size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  std::ostringstream out;
  for (const std::vector<std::string>& line : lines) {
    std::string text;
    for (size_t i = 0; i < line.size(); ++i) {
      const std::string padding(widths[i] - std::min(widths[i], line[i].size()), ' ');
      text += i < left ? line[i] + padding + "  " : padding + line[i] + "  ";
    }
    out << text.substr(0, text.find_last_not_of(' ') + 1) << '\n';
  }
  return out.str();
}

std::string cpu_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  }
  return "an unnamed CPU";
}

bool write_page(const std::string& data_file, const std::string& page_file) {
  const std::string command =
      std::string(LAPILLI_PYTHON " '" LAPILLI_PAGE_SCRIPT "' '") + data_file + "' '" + page_file + "'";
  return std::system(command.c_str()) == 0;
}

}  // namespace lapilli::run
