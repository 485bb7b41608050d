#pragma once

// Numbers by number, in the order in which they came in: a hash table of a size that follows its content.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "remodel/ids.h"

namespace remodel {

class NumberMap {
 public:
  // Room for so many without growth.
  explicit NumberMap(std::size_t expected = 16) { rebuild(std::bit_ceil(2 * expected + 16)); }

  // The value of a key, and whether it is new: otherwise it stays what it was.
  std::pair<std::uint32_t, bool> emplace(std::uint32_t key, std::uint32_t value) {
    if (2 * (size_ + 1) > slots_.size()) rebuild(2 * slots_.size());
    Slot& slot = slots_[place(key)];
    if (slot.key == key) return {slot.value, false};
    slot = {key, value};
    ++size_;
    return {value, true};
  }
  std::uint32_t find(std::uint32_t key) const { return slots_[place(key)].value; }  // no_index: not there

 private:
  struct Slot {
    std::uint32_t key = no_index, value = no_index;
  };

  // Where the key is, or would be. There is always an empty slot.
  std::size_t place(std::uint32_t key) const {
    std::size_t at = (key * std::uint64_t{0x9e3779b97f4a7c15}) >> shift_;
    while (slots_[at].key != key && slots_[at].key != no_index) at = (at + 1) & (slots_.size() - 1);
    return at;
  }
  void rebuild(std::size_t slots) {
    std::vector<Slot> old(slots);
    old.swap(slots_);
    shift_ = 64 - std::countr_zero(slots);
    for (const Slot& slot : old)
      if (slot.key != no_index) slots_[place(slot.key)] = slot;
  }

  std::vector<Slot> slots_;
  int shift_ = 0;
  std::size_t size_ = 0;
};

}  // namespace remodel
