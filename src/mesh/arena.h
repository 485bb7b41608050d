#pragma once

// Memory for lists that live no longer than a step, so that steps need nothing of the heap.

#include <cstddef>
#include <memory>
#include <memory_resource>
#include <vector>

namespace remodel {

// Gives out memory in order, and takes it back at the end of a Scope: all that was given out since it began.
// The blocks stay until its own end. Scopes nest: what is older than one must not grow while it lasts.
class Arena : public std::pmr::memory_resource {
 public:
  Arena() = default;
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  class Scope {
   public:
    explicit Scope(Arena& arena) : arena_(arena), block_(arena.block_), used_(arena.used_) {}
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;
    ~Scope() {
      arena_.block_ = block_;
      arena_.used_ = used_;
    }

   private:
    Arena& arena_;
    std::size_t block_, used_;
  };

 private:
  struct Block {
    std::unique_ptr<std::byte[]> bytes;
    std::size_t size;
  };

  void* do_allocate(std::size_t bytes, std::size_t alignment) override;
  void do_deallocate(void*, std::size_t, std::size_t) override {}
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

  std::vector<Block> blocks_;
  std::size_t block_ = 0, used_ = 0;  // the block in use, and how much of it
};

// A list in an arena. Copies are not: they go to the heap.
template <class T>
using List = std::pmr::vector<T>;

}  // namespace remodel
