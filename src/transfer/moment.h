#pragma once

// A living mesh as it was at a mark, where it has changed since.

#include <algorithm>
#include <array>
#include <vector>

#include "mesh/mesh_data.h"
#include "transfer/number_map.h"

namespace remodel {

class Moment {
 public:
  using Triple = std::array<std::uint32_t, 3>;

  // Throws Error (argument) as Mesh::changes_since() does.
  Moment(const Mesh& mesh, const Mark& mark)
      : changes(mesh.changes_since(mark)),
        triangulation(mesh.data().triangulation),
        record(mesh.data().marked.of(mark)),
        then_(record.vertices().size()) {
    for (std::uint32_t i = 0; i < record.vertices().size(); ++i)
      if (record.vertices()[i].alive) then_.emplace(record.vertices()[i].id.index, i);
    for (const VertexKey& key : changes.inserted) other_.push_back(key.id);
    for (const VertexKey& key : changes.removed) other_.push_back(key.id);
    std::sort(other_.begin(), other_.end());
  }

  Point point_then(std::uint32_t v) const {
    const std::uint32_t noted = then_.find(v);
    return noted == no_index ? triangulation.point(VertexId{v}) : record.vertices()[noted].point;
  }
  // Whether the slot holds the vertex that it held.
  bool is_same(std::uint32_t v) const {
    return !std::binary_search(other_.begin(), other_.end(), VertexId{v});
  }
  bool is_born(TriangleId t) const { return std::binary_search(changes.born.begin(), changes.born.end(), t); }
  // visit(id, vertices at the mark), of those that are gone.
  template <class Visit>
  void for_each_gone(Visit visit) const {
    for (const ChangeRecord::TriangleThen& then : record.triangles())
      if (std::binary_search(changes.gone.begin(), changes.gone.end(), then.id))
        visit(then.id, Triple{then.vertex[0].index, then.vertex[1].index, then.vertex[2].index});
  }
  static Triple triple_of(const Triangle& t) {
    return {t.vertex[0].index, t.vertex[1].index, t.vertex[2].index};
  }

  const Changes changes;
  const Triangulation& triangulation;
  const ChangeRecord& record;

 private:
  NumberMap then_;               // by slot, of vertices that lived, the note
  std::vector<VertexId> other_;  // slots that do not hold what they held
};

}  // namespace remodel
