// A run as lines on the terminal and as the JSON that page.py makes a page of.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "goals.h"

namespace lapilli::bench {

std::string heading(const std::vector<run::Driver>& drivers);
// Frames and CPU times of all drivers, what the best peer takes for one of ours, and the reasons of who is absent.
std::string line(const Series& series);
std::string table(const std::vector<Goal>& goals);

// {"title", "notes", "results", "sections"}; page.py reads all but "results".
nlohmann::json page(const Findings& found);

}  // namespace lapilli::bench
