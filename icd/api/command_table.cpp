// Looking up commands by name, and what may be returned to whom.
#include "api/command_table.h"

#include <algorithm>

#include "object/instance.h"
#include "queue/device.h"

namespace lapilli {
namespace {

bool offered(const CommandEntry& command, const ExtensionSet& instance_extensions, const ExtensionSet* device) {
  if (command.extension == nullptr) return command.core_minor == 0;
  return instance_extensions.has(command.extension) || (device != nullptr && device->has(command.extension));
}

bool is_device_extension(const char* name) {
  return std::any_of(kExtensions.begin(), kExtensions.end(), [name](const ExtensionInfo& info) {
    return info.level == ExtensionLevel::device && std::string_view(name) == info.name;
  });
}

}  // namespace

const CommandEntry* find_command(std::string_view name) {
  const std::span<const CommandEntry> table = command_table();
  const auto at = std::lower_bound(table.begin(), table.end(), name,
                                   [](const CommandEntry& entry, std::string_view key) { return entry.name < key; });
  return at != table.end() && at->name == name ? &*at : nullptr;
}

PFN_vkVoidFunction instance_command(const Instance* instance, std::string_view name) {
  const CommandEntry* command = find_command(name);
  if (command == nullptr) return nullptr;
  if (command->level == CommandLevel::global) return command->core_minor == 0 ? command->function : nullptr;
  if (instance == nullptr) return nullptr;
  // Commands of any device: an extension that a device could enable counts.
  const bool of_device = command->extension != nullptr && is_device_extension(command->extension);
  return of_device || offered(*command, instance->extensions, nullptr) ? command->function : nullptr;
}

PFN_vkVoidFunction device_command(const Device& device, std::string_view name) {
  const CommandEntry* command = find_command(name);
  if (command == nullptr || command->level != CommandLevel::device) return nullptr;
  const ExtensionSet& of_instance = device.physical_device.instance.extensions;
  return offered(*command, of_instance, &device.extensions) ? command->function : nullptr;
}

PFN_vkVoidFunction physical_device_command(const Instance* instance, std::string_view name) {
  const CommandEntry* command = find_command(name);
  if (command == nullptr || command->level != CommandLevel::physical_device) return nullptr;
  if (instance == nullptr || offered(*command, instance->extensions, nullptr)) return command->function;
  return nullptr;
}

}  // namespace lapilli
