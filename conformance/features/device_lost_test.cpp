// An endless shader loses the device after a time, and hangs nobody. Specification: "Devices and Queues", Lost Device.
#include <gtest/gtest.h>

#include <cstdlib>

#include "harness/compute.h"
#include "harness/devices.h"
#include "shaders/endless.comp.h"
#include "shaders/endless_barriers.comp.h"

namespace lapilli::conformance {
namespace {

TEST(LostDevice, AfterAnEndlessLoop) {
  if (!subject_is_lapilli()) GTEST_SKIP() << "the time limit is Lapilli's";
  setenv("LAPILLI_TIMEOUT_MS", "300", 1);
  const auto context = new_subject();
  unsetenv("LAPILLI_TIMEOUT_MS");
  // Odd: the loop ends. Even: it never meets 1.
  ComputeRun run;
  run.shader = shaders::kEndlessComp;
  run.buffers = {to_bytes<uint32_t>({0xFFFFFFFFu, 7})};
  EXPECT_EQ(from_bytes<uint32_t>(run_compute(*context, run)[0])[1], 1u);
  run.buffers = {to_bytes<uint32_t>({0, 7})};
  EXPECT_THROW(run_compute(*context, run), std::runtime_error);
  EXPECT_EQ(vkQueueWaitIdle(context->queue()), VK_ERROR_DEVICE_LOST);
  EXPECT_EQ(vkQueueSubmit(context->queue(), 0, nullptr, VK_NULL_HANDLE), VK_ERROR_DEVICE_LOST);
}

TEST(LostDevice, AfterEndlessBarriers) {
  if (!subject_is_lapilli()) GTEST_SKIP() << "the time limit is Lapilli's";
  setenv("LAPILLI_TIMEOUT_MS", "300", 1);
  const auto context = new_subject();
  unsetenv("LAPILLI_TIMEOUT_MS");
  ComputeRun run;
  run.shader = shaders::kEndlessBarriersComp;
  run.buffers = {to_bytes<uint32_t>({1, 7})};
  EXPECT_EQ(from_bytes<uint32_t>(run_compute(*context, run)[0])[1], 1u);
  run.buffers = {to_bytes<uint32_t>({0, 7})};
  EXPECT_THROW(run_compute(*context, run), std::runtime_error);
}

}  // namespace
}  // namespace lapilli::conformance
