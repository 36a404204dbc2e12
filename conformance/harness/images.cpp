// See images.h.
#include "harness/images.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "common/png.h"
#include "harness/devices.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace lapilli::conformance {

void write_comparison(const std::string& name, const samples::Frame& ours, const samples::Frame& theirs) {
  const std::string base = output_directory() + "/" + name;
  samples::write_png(base + "_ours.png", ours.width, ours.height, ours.color);
  samples::write_png(base + "_theirs.png", theirs.width, theirs.height, theirs.color);
  if (ours.color.size() != theirs.color.size()) return;
  std::vector<uint8_t> difference(ours.color.size());
  for (size_t i = 0; i < difference.size(); ++i) {
    const int d = std::abs(int(ours.color[i]) - int(theirs.color[i]));
    // A difference of one step must be visible.
    difference[i] = i % 4 == 3 ? 255 : uint8_t(std::min(255, d == 0 ? 0 : 40 + d * 8));
  }
  samples::write_png(base + "_difference.png", ours.width, ours.height, difference);
}

void write_frame(const std::string& path, const samples::Frame& frame) {
  samples::write_png(path + ".png", frame.width, frame.height, frame.color);
  std::ofstream depth(path + ".depth", std::ios::binary);
  depth.write(reinterpret_cast<const char*>(frame.depth.data()), std::streamsize(frame.depth.size() * sizeof(float)));
}

std::optional<samples::Frame> read_frame(const std::string& path) {
  int width = 0, height = 0, channels = 0;
  stbi_uc* pixels = stbi_load((path + ".png").c_str(), &width, &height, &channels, 4);
  if (pixels == nullptr) return std::nullopt;
  samples::Frame frame;
  frame.width = uint32_t(width);
  frame.height = uint32_t(height);
  const size_t count = size_t(width) * size_t(height);
  frame.color.assign(pixels, pixels + count * 4);
  stbi_image_free(pixels);
  frame.depth.resize(count);
  std::ifstream depth(path + ".depth", std::ios::binary);
  depth.read(reinterpret_cast<char*>(frame.depth.data()), std::streamsize(count * sizeof(float)));
  if (!depth) return std::nullopt;
  return frame;
}

}  // namespace lapilli::conformance
