#pragma once

// A living mesh as it was at a mark, where it has changed since.

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
      : triangulation(mesh.data().triangulation),
        record(mesh.data().marked.of(mark)),
        fates(fates_in(triangulation, record)),
        then_(record.vertices().size()),
        born_(triangulation.triangle_slots()) {
    for (std::uint32_t i = 0; i < record.vertices().size(); ++i)
      if (record.vertices()[i].alive) then_.emplace(record.vertices()[i].id.index, i);
    for (const TriangleId t : fates.born) born_[t.index] = true;
  }

  Point point_then(std::uint32_t v) const {
    const std::uint32_t noted = then_.find(v);
    return noted == no_index ? triangulation.point(VertexId{v}) : record.vertices()[noted].point;
  }
  // Whether the slot holds the vertex that it held.
  bool is_same(std::uint32_t v) const { return !fates.other[v]; }
  bool is_born(TriangleId t) const { return born_[t.index]; }
  // visit(id, vertices at the mark), of those that are gone.
  template <class Visit>
  void for_each_gone(Visit visit) const {
    for (const std::uint32_t note : fates.gone) {
      const ChangeRecord::TriangleThen& then = record.triangles()[note];
      visit(then.id, Triple{then.vertex[0].index, then.vertex[1].index, then.vertex[2].index});
    }
  }
  static Triple triple_of(const Triangle& t) {
    return {t.vertex[0].index, t.vertex[1].index, t.vertex[2].index};
  }

  const Triangulation& triangulation;
  const ChangeRecord& record;
  const Fates fates;

 private:
  NumberMap then_;          // by slot, of vertices that lived, the note
  std::vector<bool> born_;  // by slot
};

}  // namespace remodel
