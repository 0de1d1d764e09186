#include "experiments/bench/allocations.h"

#include <gmp.h>

#include <cstdlib>
#include <new>

namespace {

std::uint64_t count = 0;  // not atomic: benchmarks use one thread

void* counted(std::size_t size) {
  ++count;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}

void* counted(void* memory, std::size_t, std::size_t size) {
  ++count;
  if (void* longer = std::realloc(memory, size)) return longer;
  throw std::bad_alloc();
}

[[maybe_unused]] const bool gmp_is_counted = [] {
  mp_set_memory_functions(counted, counted, [](void* memory, std::size_t) { std::free(memory); });
  return true;
}();

}  // namespace

std::uint64_t kds::bench::allocations() { return count; }

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
