#include "mesh/arena.h"

#include <algorithm>

namespace remodel {

namespace {

constexpr std::size_t smallest_block = 4096;

}  // namespace

void* Arena::do_allocate(std::size_t bytes, std::size_t alignment) {
  for (; block_ < blocks_.size(); ++block_, used_ = 0) {
    void* at = blocks_[block_].bytes.get() + used_;
    std::size_t left = blocks_[block_].size - used_;
    if (std::align(alignment, bytes, at, left) == nullptr) continue;
    used_ = blocks_[block_].size - left + bytes;
    return at;
  }
  const std::size_t wanted =
      std::max({smallest_block, 2 * bytes + alignment, blocks_.empty() ? 0 : 2 * blocks_.back().size});
  blocks_.reserve(blocks_.size() + 1);
  blocks_.push_back({std::make_unique_for_overwrite<std::byte[]>(wanted), wanted});
  return do_allocate(bytes, alignment);
}

}  // namespace remodel
