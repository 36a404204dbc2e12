// A bump allocator for what lives as long as a draw or a pass: memory comes in chunks, a reset keeps them.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace lapilli {

// Where an arena takes its chunks from. allocate returns nullptr when there is no memory.
class MemorySource {
 public:
  virtual void* allocate(std::size_t bytes, std::size_t alignment) = 0;
  virtual void release(void* memory, std::size_t bytes) = 0;

 protected:
  ~MemorySource() = default;
};

// The process's heap.
MemorySource& heap_memory();

// Not thread-safe: one arena for each thread.
class Arena {
 public:
  static constexpr std::size_t kDefaultChunkBytes = 256 * 1024;
  static constexpr std::size_t kMaxAlignment = 64;

  // limit_bytes bounds the memory taken from the source (chunk headers included).
  explicit Arena(std::size_t limit_bytes, std::size_t chunk_bytes = kDefaultChunkBytes,
                 MemorySource& source = heap_memory());
  ~Arena();
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  // Uninitialized memory, or nullptr when the limit is reached or the source has none. alignment is a power of two up
  // to kMaxAlignment. A size of 0 gives a valid pointer.
  void* allocate(std::size_t bytes, std::size_t alignment) {
    assert(alignment != 0 && (alignment & (alignment - 1)) == 0 && alignment <= kMaxAlignment);
    const std::size_t begin = (next_ + alignment - 1) & ~(alignment - 1);
    if (begin > end_ || bytes > end_ - begin) return allocate_in_next_chunk(bytes);
    next_ = begin + bytes;
    return reinterpret_cast<void*>(begin);
  }

  template <class T>
  T* allocate_array(std::size_t count) {
    static_assert(std::is_trivially_destructible_v<T> && alignof(T) <= kMaxAlignment);
    if (count > std::numeric_limits<std::size_t>::max() / sizeof(T)) return nullptr;
    return static_cast<T*>(allocate(count * sizeof(T), alignof(T)));
  }

  // Forgets every allocation; the chunks stay and are used again.
  void reset();
  // Gives all memory back.
  void release();

  std::size_t reserved_bytes() const { return reserved_bytes_; }  // taken from the source

 private:
  struct Chunk {
    Chunk* next;
    std::size_t bytes;  // header included
  };

  void* allocate_in_next_chunk(std::size_t bytes);
  void* use(Chunk* chunk, std::size_t bytes);

  MemorySource& source_;
  const std::size_t limit_bytes_;
  const std::size_t chunk_bytes_;
  Chunk* first_ = nullptr;
  Chunk* current_ = nullptr;
  // Addresses of the free memory in current_; without a chunk not even 0 bytes fit.
  std::uintptr_t next_ = 1, end_ = 0;
  std::size_t reserved_bytes_ = 0;
};

}  // namespace lapilli
