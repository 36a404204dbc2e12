// What the programs that compare drivers share: the drivers they are given, medians, tables, pages.
#pragma once

#include <string>
#include <vector>

namespace lapilli::run {

struct Driver {
  std::string manifest;  // path of its ICD's JSON
  std::string label;     // short name for tables and files
};

// VK_DRIVER_FILES, or else VK_ICD_FILENAMES: manifests separated by colons.
std::vector<std::string> manifests_from_environment();
// Leaves out, and says so in the name of `program`, what is not there.
std::vector<Driver> drivers_of(const std::vector<std::string>& manifests, const char* program);

// The middle value (the upper one of two); 0 of none.
double median(std::vector<double> values);

// Fixed-point text with this many digits after the point.
std::string number(double value, int digits);
// Lines of cells in columns; the first `left` are set to the left. A line with fewer cells is not aligned.
std::string aligned(const std::vector<std::vector<std::string>>& lines, size_t left);
std::string cpu_name();

// Runs page.py, which makes PAGE.html of DATA.json; false if that failed.
bool write_page(const std::string& data_file, const std::string& page_file);

}  // namespace lapilli::run
