// Walking pNext chains. Specification: chapter "Fundamentals", section "Valid Usage for Structure Pointer Chains".
#pragma once

#include <vulkan/vulkan_core.h>

namespace lapilli {

// The first structure of this type in the chain, or null.
template <class T>
const T* find_in_chain(const void* chain, VkStructureType type) {
  for (auto* at = static_cast<const VkBaseInStructure*>(chain); at != nullptr; at = at->pNext) {
    if (at->sType == type) return reinterpret_cast<const T*>(at);
  }
  return nullptr;
}

}  // namespace lapilli
