// The commands of the API that are implemented. The table is made at build time by registry.py.
// Specification: chapter "Initialization", section "Command Function Pointers".
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <span>
#include <string_view>

namespace lapilli {

enum class CommandLevel : uint8_t { global, instance, physical_device, device };

struct CommandEntry {
  std::string_view name;
  PFN_vkVoidFunction function;
  CommandLevel level;
  uint32_t core_minor;    // Vulkan 1.x that has it
  const char* extension;  // null: core
};

// Sorted by name.
std::span<const CommandEntry> command_table();
// Null if the driver has no such command.
const CommandEntry* find_command(std::string_view name);

struct Instance;
struct Device;

// What vkGetInstanceProcAddr returns; `instance` may be null: then only global commands are found.
PFN_vkVoidFunction instance_command(const Instance* instance, std::string_view name);
// What vkGetDeviceProcAddr returns: device commands of enabled extensions and of the core.
PFN_vkVoidFunction device_command(const Device& device, std::string_view name);
// What vk_icdGetPhysicalDeviceProcAddr returns. Without an instance the loader asks whether it is a command at all.
PFN_vkVoidFunction physical_device_command(const Instance* instance, std::string_view name);

}  // namespace lapilli
