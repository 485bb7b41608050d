#pragma once

// The boundary table of a mesh: the entries of all loops and chains, with a journal, so that a step can be
// taken back in time proportional to what it changed.

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "remodel/ids.h"

namespace remodel {

// A place of a loop or chain at a vertex. The constrained edge from it runs to `next`. Where the ends of
// chains join other loops, one vertex has several of these; its own record names the first.
struct BoundaryVertex {
  VertexId vertex;
  std::uint32_t curve = 0;  // index over all curves of the domain
  double t = 0.0;
  bool steiner = false;       // inserted by refinement, not part of the initial discretisation
  double scale_factor = 1.0;  // length scale over what the curves alone would give: see base_length_scale()
  std::uint32_t next = no_index, previous = no_index;  // indices of the boundary table; none at chains' ends
  std::uint32_t twin =
      no_index;  // another one at the same vertex, in a ring: itself where it is the only one
  std::uint32_t station = no_index;  // the last non-Steiner entry up to here: itself, if it is one
  std::uint32_t next_station = no_index, previous_station = no_index;  // of a non-Steiner entry
};

// Indices stay what they are until their entry is dropped; then they are given out again. The order of the
// entries means nothing.
class BoundaryTable {
 public:
  const BoundaryVertex& operator[](std::uint32_t k) const { return entries_[k]; }
  std::size_t size() const { return entries_.size(); }  // dropped ones included
  // Every change goes through these.
  BoundaryVertex& edit(std::uint32_t k) {
    if (journalling_) changes_.push_back({k, Change::edited, entries_[k]});
    return entries_[k];
  }
  std::uint32_t add();         // an empty entry
  void drop(std::uint32_t k);  // the entry becomes an empty one
  // Moves all out: the table is empty afterwards.
  std::vector<BoundaryVertex> take_all();

  // One journal at a time. Nothing but begin() and the changes themselves allocates.
  void begin();
  void commit();
  void rollback() noexcept;

 private:
  struct Change {
    enum What { edited, reused, appended, dropped };
    std::uint32_t k;
    What what;
    BoundaryVertex before;
  };
  std::vector<BoundaryVertex> entries_;
  std::vector<std::uint32_t> free_;  // dropped, the next to be given out last
  bool journalling_ = false;
  std::vector<Change> changes_;
  // What take_all() found under the journal; later changes need none.
  std::optional<std::pair<std::vector<BoundaryVertex>, std::vector<std::uint32_t>>> taken_;
};

}  // namespace remodel
