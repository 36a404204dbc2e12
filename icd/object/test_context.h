// For tests: an instance, and a device without a queue.
#pragma once

#include <memory>

#include "object/device_context.h"
#include "object/instance.h"

namespace lapilli {

struct TestContext {
  TestContext() {
    VkInstanceCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    instance = make_object<Instance>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_INSTANCE, info);
    device = std::make_unique<DeviceContext>(instance->host, instance->physical_device);
  }
  ObjectPtr<Instance> instance;
  std::unique_ptr<DeviceContext> device;
};

}  // namespace lapilli
