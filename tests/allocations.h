// Counts what a test program allocates. To be included once in a program: it replaces the global
// operator new. GCC 12 takes the free of an inlined delete for a mismatch.
#pragma once

#include <cstdlib>
#include <new>

#pragma GCC diagnostic ignored "-Wmismatched-new-delete"

namespace tumble::test {
inline long allocations = 0;
}

void* operator new(std::size_t size) {
  ++tumble::test::allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++tumble::test::allocations;
  return std::malloc(size);
}
void operator delete(void* p) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}
