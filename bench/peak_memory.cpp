/// Replaces the global operator new of the program it is linked into.
#include "bench/peak_memory.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <malloc.h>
#include <new>

namespace {

bool is_counting = false;
std::int64_t live = 0, peak = 0;

void* counted(void* block) {
  if (block == nullptr) throw std::bad_alloc();
  if (is_counting) {
    live += static_cast<std::int64_t>(malloc_usable_size(block));
    peak = std::max(peak, live);
  }
  return block;
}

void release(void* block) {
  if (is_counting) live -= static_cast<std::int64_t>(malloc_usable_size(block));
  std::free(block);
}

}  // namespace

void* operator new(std::size_t size) {
  return counted(std::malloc(std::max<std::size_t>(size, 1)));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto to = static_cast<std::size_t>(alignment);
  return counted(std::aligned_alloc(to, (std::max<std::size_t>(size, 1) + to - 1) / to * to));
}
void operator delete(void* block) noexcept { release(block); }
void operator delete(void* block, std::size_t) noexcept { release(block); }
void operator delete(void* block, std::align_val_t) noexcept { release(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { release(block); }

namespace oriel::bench {

std::size_t peak_bytes_of(const std::function<void()>& work) {
  live = peak = 0;
  is_counting = true;
  work();
  is_counting = false;
  return static_cast<std::size_t>(peak);
}

}  // namespace oriel::bench
