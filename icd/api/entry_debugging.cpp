// Entry points of chapter "Debugging": VK_EXT_debug_utils.
#include "api/entry.h"
#include "object/instance.h"

namespace lapilli::entry {

VKAPI_ATTR VkResult VKAPI_CALL vkCreateDebugUtilsMessengerEXT(VkInstance instance,
                                                              const VkDebugUtilsMessengerCreateInfoEXT* info,
                                                              const VkAllocationCallbacks* callbacks,
                                                              VkDebugUtilsMessengerEXT* messenger) {
  return create_messenger(*Instance::from(instance), *info, callbacks, messenger);
}

VKAPI_ATTR void VKAPI_CALL vkDestroyDebugUtilsMessengerEXT(VkInstance instance, VkDebugUtilsMessengerEXT messenger,
                                                           const VkAllocationCallbacks*) {
  destroy_messenger(*Instance::from(instance), Messenger::from(messenger));
}

VKAPI_ATTR void VKAPI_CALL vkSubmitDebugUtilsMessageEXT(VkInstance instance,
                                                        VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                        VkDebugUtilsMessageTypeFlagsEXT types,
                                                        const VkDebugUtilsMessengerCallbackDataEXT* data) {
  Instance::from(instance)->messengers.submit(static_cast<VkDebugUtilsMessageSeverityFlagsEXT>(severity), types, *data);
}

VKAPI_ATTR VkResult VKAPI_CALL vkSetDebugUtilsObjectNameEXT(VkDevice, const VkDebugUtilsObjectNameInfoEXT* info) {
  return set_object_name(*info);
}

// Tags are for tools that show them; the driver has none.
VKAPI_ATTR VkResult VKAPI_CALL vkSetDebugUtilsObjectTagEXT(VkDevice, const VkDebugUtilsObjectTagInfoEXT*) {
  return VK_SUCCESS;
}

VKAPI_ATTR void VKAPI_CALL vkQueueBeginDebugUtilsLabelEXT(VkQueue queue, const VkDebugUtilsLabelEXT* label) {
  Queue::from(queue)->begin_label(label->pLabelName);
}

VKAPI_ATTR void VKAPI_CALL vkQueueEndDebugUtilsLabelEXT(VkQueue queue) { Queue::from(queue)->end_label(); }

// A single label marks a moment; messages carry open labels only.
VKAPI_ATTR void VKAPI_CALL vkQueueInsertDebugUtilsLabelEXT(VkQueue, const VkDebugUtilsLabelEXT*) {}
VKAPI_ATTR void VKAPI_CALL vkCmdInsertDebugUtilsLabelEXT(VkCommandBuffer, const VkDebugUtilsLabelEXT*) {}

VKAPI_ATTR void VKAPI_CALL vkCmdBeginDebugUtilsLabelEXT(VkCommandBuffer commands, const VkDebugUtilsLabelEXT* label) {
  record_begin_label(*CommandBuffer::from(commands), label->pLabelName);
}

VKAPI_ATTR void VKAPI_CALL vkCmdEndDebugUtilsLabelEXT(VkCommandBuffer commands) {
  record_end_label(*CommandBuffer::from(commands));
}

}  // namespace lapilli::entry
