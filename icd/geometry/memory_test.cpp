// What the front end allocates: counted by the program's own operator new.
#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "geometry/geometry_fixture.h"

namespace {
std::atomic<int64_t> bytes{0}, most_bytes{0}, allocations{0};

void* counted(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  const int64_t now = bytes += static_cast<int64_t>(malloc_usable_size(memory));
  int64_t most = most_bytes;
  while (now > most && !most_bytes.compare_exchange_weak(most, now)) {
  }
  ++allocations;
  return memory;
}
void give_back(void* memory) {
  if (memory == nullptr) return;
  bytes -= static_cast<int64_t>(malloc_usable_size(memory));
  std::free(memory);
}
}  // namespace

void* operator new(size_t size) { return counted(std::malloc(size)); }
void* operator new(size_t size, std::align_val_t alignment) {
  const size_t unit = static_cast<size_t>(alignment);
  return counted(std::aligned_alloc(unit, (size + unit - 1) / unit * unit));
}
void* operator new(size_t size, const std::nothrow_t&) noexcept {
  try {
    return operator new(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void* operator new(size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  try {
    return operator new(size, alignment);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void operator delete(void* memory) noexcept { give_back(memory); }
void operator delete(void* memory, size_t) noexcept { give_back(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { give_back(memory); }
void operator delete(void* memory, size_t, std::align_val_t) noexcept { give_back(memory); }

namespace lapilli {
namespace {

// Bins all draws; the number of sets.
uint32_t bin(FrontEnd& front_end, std::span<const DrawCall> draws, uint64_t& triangles) {
  ExecutionLimits limits;
  front_end.begin(draws, tiles_of(1280, 720), {0, 0, 1280, 720}, limits);
  BinSet set;
  uint32_t sets = 0;
  triangles = 0;
  do {
    EXPECT_TRUE(front_end.next(set));
    ++sets;
    for (const BinChunk& chunk : set.chunks) triangles += chunk.triangles.size();
  } while (!set.last);
  return sets;
}

// A draw that takes several sets.
void expect_bounded(const DrawCall& draw, uint64_t expected_triangles) {
  ThreadPool pool(2);
  FrontEnd front_end(pool);
  const int64_t before = bytes;
  most_bytes = before;
  uint64_t triangles = 0;
  EXPECT_GT(bin(front_end, {&draw, 1}, triangles), 1u);
  EXPECT_EQ(triangles, expected_triangles);
  EXPECT_LT(most_bytes - before, int64_t{100} << 20);
}

TEST(Memory, TenMillionTrianglesTakeBoundedMemory) {
  const GridMesh mesh(250, 200);
  TestProgram program;
  program.bind(mesh.vertices);
  DrawCall draw = program.draw_indexed(mesh.indices);
  draw.instance_count = 100;
  expect_bounded(draw, 10'000'000);
}

// All of them in all tiles.
TEST(Memory, LargeTrianglesTakeBoundedMemory) {
  const std::vector<MeshVertex> vertices = {{-1, -1, 0, {}}, {3, -1, 0, {}}, {-1, 3, 0, {}}};
  TestProgram program;
  program.bind(vertices);
  DrawCall draw = program.draw(3);
  draw.instance_count = 200'000;
  expect_bounded(draw, 200'000);
}

TEST(Memory, AFrameThatRepeatsAllocatesNothing) {
  const GridMesh mesh(100, 100);
  TestProgram program;
  program.bind(mesh.vertices);
  const std::vector<DrawCall> draws(3, program.draw_indexed(mesh.indices));
  ThreadPool pool(1);
  FrontEnd front_end(pool);
  uint64_t triangles = 0;
  bin(front_end, draws, triangles);
  const int64_t before = allocations;
  bin(front_end, draws, triangles);
  EXPECT_EQ(allocations - before, 0);
  EXPECT_EQ(triangles, 60'000u);
}

}  // namespace
}  // namespace lapilli
