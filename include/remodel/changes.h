#pragma once

// The changes of a living mesh since a moment of its life: a solver needs them to carry its state, an
// optimiser to know whether the structure of its matrices still holds.
//
//   const Mark before = mesh.mark();
//   remodel(mesh, design);
//   const Changes changes = mesh.changes_since(before);
//   if (!changes.same_connectivity()) ...

#include <memory>
#include <utility>
#include <vector>

#include "remodel/ids.h"

namespace remodel {

// Vertices are named by keys, which are never given out again in the life of a mesh, also where it is
// generated afresh. All lists ascend.
struct Changes {
  std::vector<VertexKey> moved;     // the same vertex at other coordinates
  std::vector<VertexKey> inserted;  // there now, not at the mark
  std::vector<VertexKey> removed;   // there at the mark, not now
  // Domain triangles by their ids: of now, and of the mesh at the mark. A triangle that joins the same three
  // vertices as at the mark, in the same slot, is in neither list, wherever its vertices have moved; one that
  // was taken apart and put together again in another slot is in both.
  std::vector<TriangleId> born, gone;

  // True if the same triangles join the same vertices: matrices have the same pattern, and only coordinates
  // differ.
  bool same_connectivity() const {
    return inserted.empty() && removed.empty() && born.empty() && gone.empty();
  }
};

class ChangeRecord;  // src/mesh/change_record.h

// A moment in the life of a mesh. While it lives, the mesh notes what steps change, in time and memory
// proportional to it, over any number of steps. Marks are of one mesh: copies and files of the mesh know
// nothing of them. Copies of a mark name the same moment.
class Mark {
 public:
  Mark() = default;  // of no mesh

 private:
  friend class ChangeRecords;
  explicit Mark(std::shared_ptr<ChangeRecord> record) : record_(std::move(record)) {}
  std::shared_ptr<ChangeRecord> record_;
};

}  // namespace remodel
