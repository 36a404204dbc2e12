// Chunks of the bump allocator.
#include "base/arena.h"

#include <cstdlib>
#include <new>

namespace lapilli {
namespace {

class HeapMemory final : public MemorySource {
 public:
  void* allocate(std::size_t bytes, std::size_t alignment) override {
    return ::operator new (bytes, std::align_val_t{alignment}, std::nothrow);
  }
  void release(void* memory, std::size_t) override {
    ::operator delete (memory, std::align_val_t{Arena::kMaxAlignment});
  }
};

// The header takes one unit of the largest alignment, so that what follows is aligned.
constexpr std::size_t kHeaderBytes = Arena::kMaxAlignment;

std::size_t aligned_up(std::size_t offset, std::size_t alignment) {
  return (offset + alignment - 1) & ~(alignment - 1);
}

}  // namespace

MemorySource& heap_memory() {
  static HeapMemory heap;
  return heap;
}

Arena::Arena(std::size_t limit_bytes, std::size_t chunk_bytes, MemorySource& source)
    : source_(source), limit_bytes_(limit_bytes), chunk_bytes_(chunk_bytes) {
  static_assert(sizeof(Chunk) <= kHeaderBytes);
}

Arena::~Arena() { release(); }

// At the beginning of the next kept chunk that is large enough, else of a new one.
void* Arena::allocate_in_next_chunk(std::size_t bytes) {
  // Also keeps the sums below from overflowing.
  if (bytes > limit_bytes_) return nullptr;
  Chunk** link = current_ == nullptr ? &first_ : &current_->next;
  for (Chunk** candidate = link; *candidate != nullptr; candidate = &(*candidate)->next) {
    Chunk* chunk = *candidate;
    if (chunk->bytes - kHeaderBytes < bytes) continue;
    // Moves to the front of what is unused; smaller ones before it stay available.
    *candidate = chunk->next;
    chunk->next = *link;
    *link = chunk;
    return use(chunk, bytes);
  }

  const std::size_t room = limit_bytes_ - reserved_bytes_;
  const std::size_t least = aligned_up(bytes, kMaxAlignment) + kHeaderBytes;
  if (least < bytes || least > room) return nullptr;
  std::size_t size = least > chunk_bytes_ ? least : chunk_bytes_;
  if (size > room) size = room;
  void* memory = source_.allocate(size, kMaxAlignment);
  if (memory == nullptr) return nullptr;
  reserved_bytes_ += size;
  *link = new (memory) Chunk{*link, size};
  return use(*link, bytes);
}

void* Arena::use(Chunk* chunk, std::size_t bytes) {
  const auto start = reinterpret_cast<std::uintptr_t>(chunk);
  current_ = chunk;
  next_ = start + kHeaderBytes + bytes;
  end_ = start + chunk->bytes;
  return reinterpret_cast<std::byte*>(chunk) + kHeaderBytes;
}

void Arena::reset() {
  current_ = nullptr;
  next_ = 1;
  end_ = 0;
}

void Arena::release() {
  while (first_ != nullptr) {
    Chunk* chunk = first_;
    first_ = chunk->next;
    source_.release(chunk, chunk->bytes);
  }
  reserved_bytes_ = 0;
  reset();
}

}  // namespace lapilli
