#include "mesh/boundary_table.h"

#include <cassert>

namespace remodel {

namespace {

// Room for one more, so that adding it throws nothing.
template <class T>
void make_room(std::vector<T>& list) {
  if (list.size() == list.capacity()) list.reserve(2 * list.size() + 8);
}

}  // namespace

std::uint32_t BoundaryTable::add() {
  if (free_.empty()) {
    const auto k = static_cast<std::uint32_t>(entries_.size());
    make_room(entries_);
    if (journalling_) changes_.push_back({k, Change::appended, {}});
    entries_.emplace_back();
    return k;
  }
  const std::uint32_t k = free_.back();
  if (journalling_) changes_.push_back({k, Change::reused, {}});
  free_.pop_back();
  return k;
}

void BoundaryTable::drop(std::uint32_t k) {
  make_room(free_);
  if (journalling_) changes_.push_back({k, Change::dropped, entries_[k]});
  entries_[k] = {};
  free_.push_back(k);
}

std::vector<BoundaryVertex> BoundaryTable::take_all() {
  std::vector<BoundaryVertex> all = entries_;
  if (journalling_ && !taken_) {
    rollback();  // to what the journal began with: entries_ and free_ of then are what is kept
    taken_.emplace(std::move(entries_), std::move(free_));
    journalling_ = true;
  }
  entries_.clear();
  free_.clear();
  return all;
}

void BoundaryTable::begin() {
  assert(!journalling_);
  changes_.clear();
  taken_.reset();
  journalling_ = true;
}

void BoundaryTable::commit() {
  journalling_ = false;
  taken_.reset();
}

void BoundaryTable::rollback() noexcept {
  journalling_ = false;
  if (taken_) {
    entries_.swap(taken_->first);
    free_.swap(taken_->second);
    taken_.reset();
    return;
  }
  while (!changes_.empty()) {
    const Change& change = changes_.back();
    switch (change.what) {
      case Change::edited:
        entries_[change.k] = change.before;
        break;
      case Change::reused:
        entries_[change.k] = {};
        free_.push_back(change.k);
        break;
      case Change::appended:
        entries_.pop_back();
        break;
      case Change::dropped:
        free_.pop_back();
        entries_[change.k] = change.before;
        break;
    }
    changes_.pop_back();
  }
}

}  // namespace remodel
