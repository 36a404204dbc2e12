// Pictures that one fragment shader draws over the whole screen: the feature list of shaders, one theme each
// (shaders/pictures).
#pragma once

#include <span>
#include <string_view>

#include "common/target.h"

namespace lapilli::samples {

struct ShaderPicture {
  std::string_view name;
  std::string_view theme;
  std::span<const uint32_t> fragment_shader;
};

std::span<const ShaderPicture> shader_pictures();

Frame draw_shader_picture(const Context& context, const ShaderPicture& picture, VkExtent2D extent);

}  // namespace lapilli::samples
