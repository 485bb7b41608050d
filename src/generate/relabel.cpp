#include "generate/relabel.h"

#include <algorithm>

#include "generate/recovery_error.h"

namespace remodel {

namespace {

// The label of a triangle beside one of its constrained edges.
Region side_label(const MeshData& mesh, const Triangle& t, int i) {
  const VertexId a = t.vertex[next3(i)];
  const std::uint32_t k = mesh.edge_between(a, t.vertex[previous3(i)]);
  const Sides& sides = mesh.sides[mesh.loop_of(mesh.at(k).curve)];
  return mesh.at(k).vertex == a ? sides.left : sides.right;  // the triangle lies on the left of a -> b
}

class Relabelling {
 public:
  Relabelling(MeshData& mesh, std::span<const TriangleId> uncertain)
      : mesh_(mesh),
        triangulation_(mesh.triangulation),
        uncertain_(uncertain),
        relabelled_(&mesh.arena),
        todo_(&mesh.arena) {}

  void run() {
    for (const TriangleId t : uncertain_) triangulation_.set_region(t, Region::unknown);
    for (const TriangleId t : uncertain_) seed_from_boundary(t);
    flood();
    for (const TriangleId t : uncertain_) seed_from_neighbours(t);
    for (const TriangleId t : uncertain_) require_agreement(t);
    for (const TriangleId t : relabelled_) require_agreement(t);
  }

  // Interior vertices of the triangles that are outside the domain now.
  List<VertexId> strays() const {
    List<VertexId> found(&mesh_.arena);
    for (const std::span<const TriangleId> list : {uncertain_, std::span<const TriangleId>(relabelled_)})
      for (const TriangleId t : list)
        if (triangulation_[t].region == Region::outside)
          for (const VertexId v : triangulation_[t].vertex)
            if (v != infinite_vertex && triangulation_[v].boundary == no_index) found.push_back(v);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

 private:
  void label(TriangleId t, Region region) {
    if (triangulation_[t].region == region) return;
    if (triangulation_[t].region != Region::unknown) relabelled_.push_back(t);
    triangulation_.set_region(t, region);
    todo_.push_back(t);
  }

  void flood() {
    while (!todo_.empty()) {
      const TriangleId t = todo_.back();
      todo_.pop_back();
      const Region region = triangulation_[t].region;
      for (const Link link : triangulation_[t].link)
        if (!link.constrained()) label(link.triangle(), region);
    }
  }

  void seed_from_boundary(TriangleId t) {
    for (int i = 0; i < 3; ++i)
      if (triangulation_[t].link[i].constrained()) label(t, side_label(mesh_, triangulation_[t], i));
  }

  // Boundary edges that call one part of the plane by two names belong to loops that do not nest.
  void require_agreement(TriangleId t) const {
    for (int i = 0; i < 3; ++i)
      if (triangulation_[t].link[i].constrained() &&
          triangulation_[t].region != side_label(mesh_, triangulation_[t], i))
        throw RecoveryError(contradicting_sides);
    if (triangulation_[t].ghost() && triangulation_[t].region == Region::domain)
      throw RecoveryError(contradicting_sides);
  }

  // A part without a boundary edge of its own is labelled like what lies around it.
  void seed_from_neighbours(TriangleId t) {
    if (triangulation_[t].region != Region::unknown) return;
    for (const Link link : triangulation_[t].link) {
      const Region region = triangulation_[link.triangle()].region;
      if (link.constrained() || region == Region::unknown) continue;
      label(t, region);
      flood();
      return;
    }
  }

  MeshData& mesh_;
  Triangulation& triangulation_;
  std::span<const TriangleId> uncertain_;
  List<TriangleId> relabelled_, todo_;
};

}  // namespace

void relabel(MeshData& mesh, std::span<const TriangleId> uncertain) {
  const Arena::Scope scope(mesh.arena);
  Relabelling relabelling(mesh, uncertain);
  relabelling.run();
  mesh.triangulation.remove(relabelling.strays());
}

void relabel_touched(MeshData& mesh) {
  const Arena::Scope scope(mesh.arena);
  List<TriangleId> changed(&mesh.arena);
  mesh.triangulation.for_each_touched([&](TriangleId t, bool same) {
    if (!same) changed.push_back(t);
  });
  relabel(mesh, changed);
}

List<TriangleId> alive_since_mark(MeshData& mesh) {
  List<TriangleId> result(&mesh.arena);
  for (const TriangleId t : mesh.triangulation.touched_since_mark())
    if (mesh.triangulation[t].alive()) result.push_back(t);
  return result;
}

}  // namespace remodel
