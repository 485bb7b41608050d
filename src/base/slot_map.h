#pragma once

// Sets and maps of ids for searches. Emptying one costs nothing, so a small search in a large mesh stays
// small.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace remodel {

// Copies begin empty.
template <class Id>
class SlotSet {
 public:
  SlotSet() = default;
  SlotSet(const SlotSet&) {}
  SlotSet(SlotSet&&) = default;
  SlotSet& operator=(const SlotSet&) { return *this = SlotSet(); }
  SlotSet& operator=(SlotSet&&) = default;

  // Empties it, for ids below `slots`.
  void clear(std::size_t slots) {
    if (stamps_.size() < slots) stamps_.resize(slots, 0);
    if (++now_ == 0) std::fill(stamps_.begin(), stamps_.end(), 0), now_ = 1;
  }
  // Whether it is new.
  bool insert(Id id) {
    if (contains(id)) return false;
    stamps_[id.index] = now_;
    return true;
  }
  void erase(Id id) { stamps_[id.index] = 0; }
  bool contains(Id id) const { return stamps_[id.index] == now_; }
  void prefetch(Id id) const { __builtin_prefetch(&stamps_[id.index]); }

 private:
  std::vector<std::uint32_t> stamps_;
  std::uint32_t now_ = 0;
};

// The same with a value for each id.
template <class Id, class Value>
class SlotMap {
 public:
  SlotMap() = default;
  SlotMap(const SlotMap&) {}
  SlotMap(SlotMap&&) = default;
  SlotMap& operator=(const SlotMap&) { return *this = SlotMap(); }
  SlotMap& operator=(SlotMap&&) = default;

  void clear(std::size_t slots) {
    ids_.clear(slots);
    if (values_.size() < slots) values_.resize(slots);
  }
  bool contains(Id id) const { return ids_.contains(id); }
  // Whether it is new: otherwise the value stays.
  bool insert(Id id, Value value) {
    if (!ids_.insert(id)) return false;
    values_[id.index] = value;
    return true;
  }
  // Precondition: contains(id).
  Value& operator[](Id id) { return values_[id.index]; }
  Value operator[](Id id) const { return values_[id.index]; }
  Value value_or(Id id, Value otherwise) const { return contains(id) ? values_[id.index] : otherwise; }

 private:
  SlotSet<Id> ids_;
  std::vector<Value> values_;
};

}  // namespace remodel
