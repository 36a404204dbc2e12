// Images of failures and reference images on disk.
#pragma once

#include <optional>
#include <string>

#include "common/target.h"

namespace lapilli::conformance {

// Writes <name>_ours.png, <name>_theirs.png and <name>_difference.png (amplified) to output_directory().
void write_comparison(const std::string& name, const samples::Frame& ours, const samples::Frame& theirs);

// A frame as NAME.png and NAME.depth (float32, little endian, rows top down).
void write_frame(const std::string& path_without_suffix, const samples::Frame& frame);
std::optional<samples::Frame> read_frame(const std::string& path_without_suffix);

}  // namespace lapilli::conformance
