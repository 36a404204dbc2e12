// The one place where stb_image_write is compiled.
#include "common/png.h"

#include <stdexcept>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

namespace lapilli::samples {

void write_png(const std::string& path, uint32_t width, uint32_t height, std::span<const uint8_t> rgba) {
  if (rgba.size() != size_t{width} * height * 4) throw std::runtime_error(path + ": pixels do not match the size");
  if (stbi_write_png(path.c_str(), static_cast<int>(width), static_cast<int>(height), 4, rgba.data(),
                     static_cast<int>(width * 4)) == 0) {
    throw std::runtime_error("cannot write " + path);
  }
}

}  // namespace lapilli::samples
