// Alignment, the limit, reuse, and sources that fail.
#include "base/arena.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <random>
#include <vector>

namespace lapilli {
namespace {

class CountingMemory final : public MemorySource {
 public:
  void* allocate(std::size_t bytes, std::size_t alignment) override {
    if (allowed == 0) return nullptr;
    --allowed;
    ++allocations;
    live_bytes += bytes;
    return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  }
  void release(void* memory, std::size_t bytes) override {
    live_bytes -= bytes;
    std::free(memory);
  }
  int allowed = 1000;
  int allocations = 0;
  std::size_t live_bytes = 0;
};

TEST(Arena, AllocationsAreAlignedAndApart) {
  CountingMemory memory;
  {
    Arena arena(1 << 20, 4096, memory);
    std::mt19937 random(1);
    std::vector<std::pair<unsigned char*, std::size_t>> blocks;
    for (int i = 0; i < 500; ++i) {
      const std::size_t bytes = random() % 600;
      const std::size_t alignment = std::size_t{1} << random() % 7;
      auto* block = static_cast<unsigned char*>(arena.allocate(bytes, alignment));
      ASSERT_NE(block, nullptr);
      ASSERT_EQ(reinterpret_cast<std::uintptr_t>(block) % alignment, 0u);
      std::memset(block, i & 255, bytes);
      blocks.emplace_back(block, bytes);
    }
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      for (std::size_t byte = 0; byte < blocks[i].second; ++byte) ASSERT_EQ(blocks[i].first[byte], i & 255);
    }
    EXPECT_EQ(arena.reserved_bytes(), memory.live_bytes);
  }
  EXPECT_EQ(memory.live_bytes, 0u);
}

TEST(Arena, ResetKeepsTheChunks) {
  CountingMemory memory;
  Arena arena(1 << 20, 4096, memory);
  for (int i = 0; i < 20; ++i) ASSERT_NE(arena.allocate(1000, 8), nullptr);
  ASSERT_NE(arena.allocate(10000, 8), nullptr);  // larger than a chunk
  const int allocations = memory.allocations;
  void* first = nullptr;
  for (int round = 0; round < 10; ++round) {
    arena.reset();
    void* block = arena.allocate(1000, 8);
    if (round == 0) first = block;
    EXPECT_EQ(block, first);
    for (int i = 1; i < 20; ++i) ASSERT_NE(arena.allocate(1000, 8), nullptr);
    ASSERT_NE(arena.allocate(10000, 8), nullptr);
  }
  EXPECT_EQ(memory.allocations, allocations);
  arena.release();
  EXPECT_EQ(memory.live_bytes, 0u);
  ASSERT_NE(arena.allocate(16, 16), nullptr);
}

TEST(Arena, StopsAtItsLimit) {
  CountingMemory memory;
  Arena arena(10000, 4096, memory);
  std::size_t total = 0;
  while (arena.allocate(100, 4) != nullptr) total += 100;
  EXPECT_LE(memory.live_bytes, 10000u);
  EXPECT_GT(total, 9000u);
  EXPECT_EQ(arena.allocate(100, 4), nullptr);
  arena.reset();
  EXPECT_NE(arena.allocate(100, 4), nullptr);
  EXPECT_EQ(arena.allocate(10001, 4), nullptr);
  EXPECT_EQ(arena.allocate(SIZE_MAX, 64), nullptr);
  EXPECT_EQ(arena.allocate_array<double>(SIZE_MAX / 4), nullptr);
}

TEST(Arena, SurvivesASourceWithoutMemory) {
  CountingMemory memory;
  memory.allowed = 1;
  Arena arena(1 << 20, 4096, memory);
  ASSERT_NE(arena.allocate(4000, 4), nullptr);
  EXPECT_EQ(arena.allocate(4000, 4), nullptr);
  EXPECT_EQ(arena.allocate(4000, 4), nullptr);
  // What is left of the first chunk still serves.
  EXPECT_NE(arena.allocate(16, 4), nullptr);
  arena.reset();
  EXPECT_NE(arena.allocate(4000, 4), nullptr);
}

TEST(Arena, UsesTheHeapByDefault) {
  Arena arena(1 << 16);
  auto* numbers = arena.allocate_array<double>(100);
  ASSERT_NE(numbers, nullptr);
  for (int i = 0; i < 100; ++i) numbers[i] = i;
  EXPECT_EQ(numbers[99], 99.0);
}

}  // namespace
}  // namespace lapilli
