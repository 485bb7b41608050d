#include "step/test_allocations.h"

#include <cstdlib>
#include <new>

namespace remodel::test {

long allocations = 0;
long allocations_left = -1;
bool fails_for_good = false;

namespace {

void count_allocation() {
  ++allocations;
  if (allocations_left < 0) return;
  if (allocations_left > 0) {
    --allocations_left;
    return;
  }
  if (!fails_for_good) allocations_left = -1;
  throw std::bad_alloc();
}

}  // namespace
}  // namespace remodel::test

void* operator new(std::size_t size) {
  remodel::test::count_allocation();
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  remodel::test::count_allocation();
  const auto a = static_cast<std::size_t>(alignment);
  if (void* p = std::aligned_alloc(a, (size + a - 1) / a * a)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}
void operator delete(void* p, std::align_val_t) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  std::free(p);
}
