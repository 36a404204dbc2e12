// PNG files of RGBA8 pixels.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace lapilli::samples {

// `rgba` holds width * height * 4 bytes, rows top down. Throws std::runtime_error if the file cannot be written.
void write_png(const std::string& path, uint32_t width, uint32_t height, std::span<const uint8_t> rgba);

}  // namespace lapilli::samples
