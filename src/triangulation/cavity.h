#pragma once

// The cavity of a point, and the lists that it is kept in.

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

#include "triangulation/triangle.h"

namespace remodel {

// A list that is filled anew for every vertex: clear() keeps the storage, and nothing is constructed twice.
// Copies begin empty.
template <class T>
class Buffer {
 public:
  Buffer() = default;
  Buffer(const Buffer&) {}
  Buffer(Buffer&& other) noexcept { *this = std::move(other); }
  Buffer& operator=(const Buffer&) { return *this; }
  Buffer& operator=(Buffer&& other) noexcept {
    std::swap(storage_, other.storage_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
    return *this;
  }

  void clear() { size_ = 0; }
  void push_back(const T& value) {
    if (size_ == capacity_) grow();
    storage_[size_++] = value;
  }
  void pop_back() { --size_; }
  // The values are what was there, or nothing in particular: to be written.
  void resize(std::size_t size) {
    while (capacity_ < size) grow();
    size_ = size;
  }
  const T& front() const { return storage_[0]; }
  const T& back() const { return storage_[size_ - 1]; }
  const T& operator[](std::size_t i) const { return storage_[i]; }
  T& operator[](std::size_t i) { return storage_[i]; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T* begin() const { return storage_.get(); }
  T* begin() { return storage_.get(); }
  const T* end() const { return storage_.get() + size_; }
  T* end() { return storage_.get() + size_; }

  // Fills a buffer anew, from the start, as a stack. Its state is two pointers, which a loop keeps in
  // registers; the buffer has its size when the writer ends.
  class Writer {
   public:
    explicit Writer(Buffer& buffer)
        : buffer_(buffer), next_(buffer.begin()), limit_(buffer.begin() + buffer.capacity_) {}
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
    ~Writer() { buffer_.size_ = size(); }

    void push_back(const T& value) {
      if (next_ == limit_) {
        const std::size_t size = buffer_.size_ = buffer_.capacity_;
        buffer_.grow();
        next_ = buffer_.begin() + size;
        limit_ = buffer_.begin() + buffer_.capacity_;
      }
      *next_++ = value;
    }
    T pop() { return *--next_; }
    std::size_t size() const { return static_cast<std::size_t>(next_ - buffer_.begin()); }
    bool empty() const { return next_ == buffer_.begin(); }

   private:
    Buffer& buffer_;
    T *next_, *limit_;
  };

 private:
  [[gnu::noinline]] void grow() {
    const std::size_t capacity = 2 * capacity_ + 32;
    auto larger = std::make_unique<T[]>(capacity);
    std::copy_n(storage_.get(), size_, larger.get());
    storage_ = std::move(larger);
    capacity_ = capacity;
  }

  std::unique_ptr<T[]> storage_;
  std::size_t size_ = 0, capacity_ = 0;
};

// The triangles that a new point destroys (those whose circumcircle holds it, not crossing constraints) and
// their boundary in counter-clockwise order.
struct RingEdge {
  VertexId from;  // the edge runs to the next ring edge's from
  Link outer;     // the triangle beyond, and whether the edge is constrained
};
struct Cavity {
  Buffer<TriangleId> triangles;
  Buffer<RingEdge> ring;
  bool constrained = false;  // whether an edge of the ring is
  Buffer<RingEdge> todo;     // scratch of the search
};

}  // namespace remodel
