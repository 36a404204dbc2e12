// Frames of many draws: one that repeats takes no memory (neither its submission, nor its draws, nor the renderer
// behind them), and one with more draws than are rendered at once looks the same. Also a queue without memory.
#include <gtest/gtest.h>
#include <signal.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <new>

#include "queue/test_scene.h"

namespace lapilli {
namespace {

// What was drawn in the first set is there, in colour and depth, when the second one is drawn.
TEST(Frame, ManyDrawsAreRenderedInSets) {
  TestScene scene(16, 8, {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}});
  CommandBuffer& commands = scene.add_commands();
  scene.begin_pass(commands);
  record_bind_pipeline(commands, scene.add_pipeline());
  scene.draw(commands, -1, -1, 0, 1, 0.2f, 0);
  for (uint32_t i = 0; i < kMaxDraws; ++i) record_draw(commands, {3, 1, 0, 0});  // not nearer: without effect
  scene.draw(commands, 0, -1, 1, 0, 0.6f, 1);
  scene.draw(commands, -1, -1, 1, 1, 0.4f, 2);
  record_end_render_pass(commands);
  scene.submit(commands);
  for (uint32_t y = 0; y < 8; ++y) {
    for (uint32_t x = 0; x < 16; ++x) {
      EXPECT_EQ(scene.pixel(x, y)[0], x < 8 ? 255 : 0);
      EXPECT_EQ(scene.pixel(x, y)[1], 0);
      EXPECT_EQ(scene.pixel(x, y)[2], x < 8 ? 0 : 255);
    }
  }
}

}  // namespace
}  // namespace lapilli

// Sanitizers have allocators of their own.
#if defined(__GLIBC__) && !defined(LAPILLI_SANITIZED)

namespace {

std::atomic<long> allocations{0};
thread_local bool refuses = false;  // what operator new asks for

}  // namespace

// Takes the place of the C library's in this program, so that nothing goes by: operator new calls it too.
extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* memory, size_t size);
void* __libc_memalign(size_t alignment, size_t size);

void* malloc(size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  return refuses ? nullptr : __libc_malloc(size);
}
void* calloc(size_t count, size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_calloc(count, size);
}
void* realloc(void* memory, size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_realloc(memory, size);
}
void* aligned_alloc(size_t alignment, size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  return __libc_memalign(alignment, size);
}
void* memalign(size_t alignment, size_t size) { return aligned_alloc(alignment, size); }
int posix_memalign(void** memory, size_t alignment, size_t size) {
  *memory = aligned_alloc(alignment, size);
  return *memory != nullptr ? 0 : ENOMEM;
}
}

namespace lapilli {
namespace {

TEST(Frame, ARepeatedOneAllocatesNothing) {
  TestScene scene(200, 100, {{1, 0, 0, 1}, {0, 1, 0, 1}});
  const Pipeline& one = scene.add_pipeline();
  const Pipeline& other = scene.add_pipeline(VK_CULL_MODE_NONE, VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_A_BIT);
  CommandBuffer& commands = scene.add_commands();
  scene.begin_pass(commands);
  for (uint32_t i = 0; i < 1000; ++i) {
    if (i % 10 == 0) record_bind_pipeline(commands, i % 20 == 0 ? one : other);
    const float left = -1 + static_cast<float>(i % 40) / 20, top = -1 + static_cast<float>(i / 40) / 12.5f;
    scene.draw(commands, left, top, left + 0.05f, top + 0.08f, 0.5f, i % 2);
  }
  record_end_render_pass(commands);

  scene.submit(commands);
  scene.submit(commands);
  const long before = allocations.load();
  ASSERT_GT(before, 0);
  for (int frame = 0; frame < 3; ++frame) scene.submit(commands);
  EXPECT_EQ(allocations.load() - before, 0);
  EXPECT_EQ(scene.pixel(2, 2)[0], 255);
  EXPECT_EQ(scene.pixel(7, 2)[1], 255);
}

TEST(Queue, WithoutMemoryForItsThreadTheSignalsStayAsTheyWere) {
  TestContext context;
  const ObjectPtr<Device> device =
      make_object<Device>(HostMemory(), VK_SYSTEM_ALLOCATION_SCOPE_DEVICE, context.instance->physical_device);
  bool refused = false;
  refuses = true;
  try {
    device->queue->start();
  } catch (const std::bad_alloc&) {
    refused = true;
  }
  refuses = false;
  EXPECT_TRUE(refused);
  sigset_t blocked;
  pthread_sigmask(SIG_SETMASK, nullptr, &blocked);
  EXPECT_EQ(sigismember(&blocked, SIGINT), 0);
  device->queue->start();
}

}  // namespace
}  // namespace lapilli

#endif
