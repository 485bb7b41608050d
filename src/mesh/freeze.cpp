// The frozen view of a living mesh.

#include <algorithm>
#include <map>
#include <utility>

#include "mesh/import_record.h"
#include "mesh/mesh_data.h"
#include "remodel/mesh.h"

namespace remodel {

namespace {

// Names in the order of the design's curves, each once.
std::size_t boundary_index(FrozenMesh& frozen, const std::string& name) {
  for (std::size_t i = 0; i < frozen.boundaries.size(); ++i)
    if (frozen.boundaries[i].name == name) return i;
  frozen.boundaries.push_back({name, {}});
  return frozen.boundaries.size() - 1;
}

// A vertex where chains join lies on several curves: the view names the one of its first entry.
void freeze_boundary(const MeshData& mesh, const std::vector<std::uint32_t>& point_of, FrozenMesh& frozen) {
  for (const std::string& marker : mesh.imported.markers) boundary_index(frozen, marker);
  for (std::size_t curve = 0; curve < mesh.domain.curve_count(); ++curve)
    boundary_index(frozen, mesh.domain.curve(curve).name);
  for (std::size_t loop = 0; loop < mesh.loop_heads.size(); ++loop) {
    struct Named {
      std::size_t boundary;
      std::array<std::uint32_t, 2> edge;
    };
    std::vector<Named> edges;  // along the loop
    mesh.walk_edges(mesh.loop_heads[loop], [&](std::uint32_t k, std::uint32_t next) {
      const BoundaryVertex& from = mesh.at(k);
      edges.push_back({boundary_index(frozen, mesh.curve(from.curve).name),
                       {point_of[from.vertex.index], point_of[mesh.at(next).vertex.index]}});
    });
    mesh.walk(mesh.loop_heads[loop], [&](std::uint32_t k) {
      if (mesh.triangulation[mesh.at(k).vertex].boundary != k) return;
      const std::uint32_t p = point_of[mesh.at(k).vertex.index];
      frozen.curve[p] = static_cast<std::int32_t>(mesh.at(k).curve);
      frozen.parameter[p] = mesh.at(k).t;
    });
    if (mesh.sides[loop].left != Region::domain) {
      std::reverse(edges.begin(), edges.end());
      for (Named& named : edges) std::swap(named.edge[0], named.edge[1]);
    }
    for (const Named& named : edges) frozen.boundaries[named.boundary].edges.push_back(named.edge);
  }
}

// Chains make up loops together, whose edges come in the order of the loop under each name, like those of
// closed loops. Edges with the domain on both sides stay where they are, behind the others.
class LoopOrder {
 public:
  LoopOrder(const MeshData& mesh, const std::vector<std::uint32_t>& point_of, FrozenMesh& frozen)
      : mesh_(mesh), triangulation_(mesh.triangulation), point_of_(point_of), frozen_(frozen) {}

  void run() {
    for (std::size_t loop = 0; loop < mesh_.loop_heads.size(); ++loop) collect(loop);
    std::vector<FrozenBoundary> ordered = frozen_.boundaries;
    for (FrozenBoundary& boundary : ordered) boundary.edges.clear();
    for (const Edge& start : edges_)
      for (Edge edge = start; !names_.at(edge).used; edge = next(edge)) {
        names_.at(edge).used = true;
        ordered[names_.at(edge).boundary].edges.push_back(
            {point_of_[edge.first.index], point_of_[edge.second.index]});
      }
    for (const auto& [boundary, edge] : inner_) ordered[boundary].edges.push_back(edge);
    frozen_.boundaries = std::move(ordered);
  }

 private:
  using Edge = std::pair<VertexId, VertexId>;  // the domain on its left
  struct Name {
    std::size_t boundary;
    bool used = false;
  };

  void collect(std::size_t loop) {
    const Sides& sides = mesh_.sides[loop];
    mesh_.walk_edges(mesh_.loop_heads[loop], [&](std::uint32_t k, std::uint32_t to) {
      const std::size_t boundary = boundary_index(frozen_, mesh_.curve(mesh_.at(k).curve).name);
      Edge edge{mesh_.at(k).vertex, mesh_.at(to).vertex};
      if (sides.left == Region::domain && sides.right == Region::domain) {
        inner_.push_back({boundary, {point_of_[edge.first.index], point_of_[edge.second.index]}});
        return;
      }
      if (sides.left != Region::domain) std::swap(edge.first, edge.second);
      names_[edge] = {boundary};
      edges_.push_back(edge);
    });
  }

  // Turns around the edge's end through the domain.
  Edge next(const Edge& edge) const {
    const Corner apex = *triangulation_.find_edge(edge.first, edge.second);
    Corner c{apex.triangle, previous3(apex.index)};  // at the end of the edge
    for (;;) {
      const Link across =
          triangulation_.link({c.triangle, previous3(c.index)});  // over the edge that leaves it
      if (triangulation_[across.triangle()].region != Region::domain)
        return {edge.second, triangulation_.following(c)};
      c = triangulation_.clockwise(c);
    }
  }

  const MeshData& mesh_;
  const Triangulation& triangulation_;
  const std::vector<std::uint32_t>& point_of_;
  FrozenMesh& frozen_;
  std::vector<Edge> edges_;
  std::map<Edge, Name> names_;
  std::vector<std::pair<std::size_t, std::array<std::uint32_t, 2>>> inner_;
};

bool made_of_chains(const Domain& domain) {
  return std::any_of(domain.loops.begin(), domain.loops.end(),
                     [](const Loop& loop) { return loop.open && loop.role != LoopRole::internal; });
}

}  // namespace

// Points in the order of vertex ids, triangles in the order of triangle ids.
FrozenMesh Mesh::freeze() const {
  const Triangulation& triangulation = data_->triangulation;
  FrozenMesh frozen;
  std::vector<std::uint32_t> point_of(triangulation.vertex_slots(), no_index);
  const auto as_imported = triangles_as_imported(*data_);
  for (std::uint32_t i = 0; i < triangulation.triangle_slots(); ++i) {
    const Triangle& t = triangulation[TriangleId{i}];
    if (!t.alive() || t.region != Region::domain) continue;
    frozen.triangle_ids.push_back(i);
    frozen.birth.push_back(t.birth);
    const auto kept = as_imported.find(i);
    frozen.triangles.push_back(kept != as_imported.end()
                                   ? kept->second
                                   : std::array{t.vertex[0].index, t.vertex[1].index, t.vertex[2].index});
    for (const VertexId v : t.vertex) point_of[v.index] = 0;
  }
  for (std::uint32_t i = 0; i < triangulation.vertex_slots(); ++i) {
    if (point_of[i] == no_index) continue;
    point_of[i] = static_cast<std::uint32_t>(frozen.points.size());
    frozen.points.push_back(triangulation.point(VertexId{i}));
    frozen.length_scale.push_back(triangulation[VertexId{i}].length_scale);
    frozen.vertex_ids.push_back(i);
  }
  for (auto& triangle : frozen.triangles)
    for (std::uint32_t& v : triangle) v = point_of[v];
  frozen.curve.assign(frozen.points.size(), -1);
  frozen.parameter.assign(frozen.points.size(), 0.0);
  freeze_boundary(*data_, point_of, frozen);
  if (made_of_chains(data_->domain)) LoopOrder(*data_, point_of, frozen).run();
  return frozen;
}

}  // namespace remodel
