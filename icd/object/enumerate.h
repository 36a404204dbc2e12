// The two-call idiom of vkEnumerate… and vkGet… commands.
// Specification: chapter "Fundamentals", section "Retrieving Results".
#pragma once

#include <vulkan/vulkan_core.h>

#include <algorithm>
#include <cstdint>
#include <span>

namespace lapilli {

// `assign(target, source)` fills one element of the application's array.
template <class Source, class Target, class Assign>
VkResult enumerate(std::span<Source> all, uint32_t* count, Target* out, Assign assign) {
  const uint32_t total = static_cast<uint32_t>(all.size());
  if (out == nullptr) {
    *count = total;
    return VK_SUCCESS;
  }
  const uint32_t written = std::min(*count, total);
  for (uint32_t i = 0; i < written; ++i) assign(out[i], all[i]);
  *count = written;
  return written < total ? VK_INCOMPLETE : VK_SUCCESS;
}

template <class Source, class Target>
VkResult enumerate(std::span<Source> all, uint32_t* count, Target* out) {
  return enumerate(all, count, out, [](Target& target, const Source& source) { target = source; });
}

}  // namespace lapilli
