// Counts what a test program allocates: calls of malloc, by new or by Eigen; where a sanitizer
// brings a malloc of its own, calls of new. To be included once in a program.
#pragma once

#include <cstdlib>
#include <new>

namespace tumble::test {
inline long allocations = 0;
}

// gcc tells of its address sanitizer by a macro, clang by a feature.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define TUMBLE_MALLOC_IS_THE_SANITIZERS
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define TUMBLE_MALLOC_IS_THE_SANITIZERS
#endif

#if defined(__GLIBC__) && !defined(TUMBLE_MALLOC_IS_THE_SANITIZERS)

extern "C" {
void* __libc_malloc(std::size_t size) noexcept;

void* malloc(std::size_t size) noexcept {
  ++tumble::test::allocations;
  return __libc_malloc(size);
}
}

#else

// GCC 12 takes the free of an inlined delete for a mismatch.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"

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

#endif
