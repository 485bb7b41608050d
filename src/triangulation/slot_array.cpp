#include "triangulation/slot_array.h"

#include <cstdint>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace remodel {

namespace {

void* allocate(std::size_t bytes) {
  return ::operator new (bytes, std::align_val_t{SlotMemory::alignment});
}
void deallocate(void* data) {
  ::operator delete (data, std::align_val_t{SlotMemory::alignment});
}

#ifdef __linux__

constexpr std::size_t heap_limit = std::size_t{16} << 20;
constexpr std::size_t huge_page = std::size_t{2} << 20;

// Address space that begins at a huge page; below and above, less than one huge page is left over.
struct Reservation {
  std::byte* whole;
  std::byte* aligned;
  std::size_t bytes;

  explicit Reservation(std::size_t size) : bytes(size) {
    constexpr int flags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE;
    void* const data = mmap(nullptr, bytes + huge_page, PROT_READ | PROT_WRITE, flags, -1, 0);
    if (data == MAP_FAILED) throw std::bad_alloc();
    whole = static_cast<std::byte*>(data);
    aligned = whole + (huge_page - reinterpret_cast<std::uintptr_t>(data) % huge_page) % huge_page;
  }
  void trim() const {
    const auto below = static_cast<std::size_t>(aligned - whole);
    if (below > 0) munmap(whole, below);
    if (below < huge_page) munmap(aligned + bytes, huge_page - below);
  }
};

// Pages of the given size that begin with those of `from`, if there are any.
SlotMemory map(std::size_t bytes, SlotMemory from) {
  bytes = (bytes + huge_page - 1) / huge_page * huge_page;
  const Reservation place(bytes);
  if (from.data != nullptr &&
      mremap(from.data, from.bytes, bytes, MREMAP_MAYMOVE | MREMAP_FIXED, place.aligned) == MAP_FAILED) {
    munmap(place.whole, bytes + huge_page);
    throw std::bad_alloc();
  }
  place.trim();
  madvise(place.aligned, bytes, MADV_HUGEPAGE);  // a wish: it may be refused
  return {place.aligned, bytes};
}

void unmap(SlotMemory memory) {
  munmap(memory.data, memory.bytes);
}

#else

constexpr std::size_t heap_limit = SIZE_MAX;
SlotMemory map(std::size_t, SlotMemory) {
  return {};
}
void unmap(SlotMemory) {}

#endif

bool on_heap(std::size_t bytes) {
  return bytes <= heap_limit;
}

}  // namespace

void SlotMemory::grow(std::size_t to, std::size_t used) {
  if (!on_heap(bytes)) {
    *this = map(to, *this);
    return;
  }
  const SlotMemory larger = on_heap(to) ? SlotMemory{allocate(to), to} : map(to, {});
  if (used > 0) std::memcpy(larger.data, data, used);
  release();
  *this = larger;
}

void SlotMemory::release() {
  if (data != nullptr) on_heap(bytes) ? deallocate(data) : unmap(*this);
  *this = {};
}

}  // namespace remodel
