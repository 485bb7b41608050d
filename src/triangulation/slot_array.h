#pragma once

// An array of records that grows by one at a time to any size: a std::vector for records that may be copied
// as bytes, which never holds two copies of a large array. Up to 16 megabytes it lives on the heap and is
// copied when it grows. Beyond, it has pages of its own, which the system moves without copying them; unused
// capacity is address space only. These pages ask to be huge ones: a mesh is visited all over, and much of
// the time of a large one would go into address translation.

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

namespace remodel {

// Memory for arrays, aligned to cache lines.
struct SlotMemory {
  static constexpr std::size_t alignment = 64;
  void* data = nullptr;
  std::size_t bytes = 0;

  // Grows to at least the given size; the first `used` bytes stay. Throws std::bad_alloc, and then nothing
  // has changed.
  void grow(std::size_t to, std::size_t used);
  void release();
};

template <class T>
class SlotArray {
  static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= SlotMemory::alignment);

 public:
  SlotArray() = default;
  explicit SlotArray(std::span<const T> from) { append(from); }
  SlotArray(const SlotArray& other) : SlotArray(std::span<const T>(other.data(), other.size())) {}
  SlotArray(SlotArray&& other) noexcept { swap(other); }
  SlotArray& operator=(SlotArray other) noexcept {
    swap(other);
    return *this;
  }
  ~SlotArray() { memory_.release(); }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  const T& operator[](std::size_t i) const { return data()[i]; }
  T& operator[](std::size_t i) { return data()[i]; }

  void push_back(const T& value) {
    const T copy = value;  // may lie in this array
    reserve(size_ + 1);
    new (data() + size_++) T(copy);
  }
  void reserve(std::size_t size) {
    if (size > capacity()) memory_.grow(sizeof(T) * std::max(size, 2 * size_), sizeof(T) * size_);
  }
  // Forgets all from this size on.
  void truncate(std::size_t size) { size_ = size; }

 private:
  const T* data() const { return static_cast<const T*>(memory_.data); }
  T* data() { return static_cast<T*>(memory_.data); }
  std::size_t capacity() const { return memory_.bytes / sizeof(T); }
  void append(std::span<const T> from) {
    reserve(size_ + from.size());
    if (!from.empty()) std::memcpy(data() + size_, from.data(), from.size_bytes());
    size_ += from.size();
  }
  void swap(SlotArray& other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(size_, other.size_);
  }

  SlotMemory memory_;
  std::size_t size_ = 0;
};

}  // namespace remodel
