// What vkEnumerate…ExtensionProperties answer.
#include "object/extensions.h"

#include <cstring>
#include <vector>

#include "object/enumerate.h"

namespace lapilli {

VkResult enumerate_extensions(ExtensionLevel level, const char* layer, uint32_t* count, VkExtensionProperties* out) {
  if (layer != nullptr) return VK_ERROR_LAYER_NOT_PRESENT;
  std::vector<ExtensionInfo> offered;
  for (const ExtensionInfo& info : kExtensions) {
    if (info.level == level) offered.push_back(info);
  }
  return enumerate(std::span<ExtensionInfo>(offered), count, out,
                   [](VkExtensionProperties& target, const ExtensionInfo& source) {
                     target = {};
                     std::strncpy(target.extensionName, source.name, sizeof(target.extensionName) - 1);
                     target.specVersion = source.spec_version;
                   });
}

}  // namespace lapilli
