// What surrounds every entry point: memory that runs out becomes a VkResult, and commands that compute run in the
// driver's floating-point environment.
#pragma once

#include <new>
#include <type_traits>

#include "base/fp_environment.h"
#include "command/command_buffer.h"

namespace lapilli {

// What is left to do for commands that return nothing: recording remembers it until vkEndCommandBuffer.
inline void out_of_memory(VkCommandBuffer commands) {
  CommandBuffer::from(commands)->error = VK_ERROR_OUT_OF_HOST_MEMORY;
}
template <class H>
void out_of_memory(H) {}

template <class Function, Function* kFunction>
struct Guard;

template <class R, class First, class... Rest, R (*kFunction)(First, Rest...)>
struct Guard<R(First, Rest...), kFunction> {
  static VKAPI_ATTR R VKAPI_CALL call(First first, Rest... rest) {
    try {
      if constexpr (std::is_same_v<R, VkResult>) {
        // Only these may compute: pipelines fold constants. Recording and look-ups do not.
        const FpEnvironment environment;
        return kFunction(first, rest...);
      } else {
        return kFunction(first, rest...);
      }
    } catch (const std::bad_alloc&) {
      if constexpr (std::is_same_v<R, VkResult>) return VK_ERROR_OUT_OF_HOST_MEMORY;
      out_of_memory(first);
      if constexpr (!std::is_void_v<R> && !std::is_same_v<R, VkResult>) return {};
    }
  }
};

template <auto kFunction>
inline constexpr auto* guarded = &Guard<std::remove_pointer_t<decltype(kFunction)>, kFunction>::call;

}  // namespace lapilli
