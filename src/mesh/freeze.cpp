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
      frozen.steiner[p] = mesh.at(k).steiner ? 1 : 0;
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

// The part of the domain that each triangle of the view lies in. Constrained edges separate parts; what lies
// beside the loops of the design says their names, internal ones first: an outer loop may pass several.
// Regions are numbered in the order of triangles.
class Regions {
 public:
  Regions(const MeshData& mesh, FrozenMesh& frozen)
      : mesh_(mesh), frozen_(frozen), region_(mesh.triangulation.triangle_slots(), no_index) {}

  void run() {
    for (std::size_t loop = 0; loop < mesh_.loop_heads.size(); ++loop)
      if (mesh_.domain.loops[loop].role == LoopRole::internal) seed(loop);
    spread();
    for (std::size_t loop = 0; loop < mesh_.loop_heads.size(); ++loop)
      if (mesh_.domain.loops[loop].role != LoopRole::internal) seed(loop);
    spread();
    for (const std::uint32_t id : frozen_.triangle_ids) {
      const std::string& name = region_[id] == no_index ? unnamed_ : names_[region_[id]];
      frozen_.region.push_back(index_in(frozen_.region_names, name));
    }
  }

 private:
  static std::uint32_t index_in(std::vector<std::string>& names, const std::string& name) {
    const auto known = std::find(names.begin(), names.end(), name);
    const auto index = static_cast<std::uint32_t>(known - names.begin());
    if (known == names.end()) names.push_back(name);
    return index;
  }

  void seed(VertexId from, VertexId to, const std::string& name) {
    const TriangleId t = mesh_.triangulation.find_edge(from, to)->triangle;
    if (name.empty() || mesh_.triangulation[t].region != Region::domain || region_[t.index] != no_index)
      return;
    region_[t.index] = index_in(names_, name);
    todo_.push_back(t);
  }

  void seed(std::size_t loop) {
    const Loop& named = mesh_.domain.loops[loop];
    const std::string& right = named.role == LoopRole::internal ? named.right_region : named.region;
    mesh_.walk_edges(mesh_.loop_heads[loop], [&](std::uint32_t k, std::uint32_t next) {
      seed(mesh_.at(k).vertex, mesh_.at(next).vertex, named.region);
      seed(mesh_.at(next).vertex, mesh_.at(k).vertex, right);
    });
  }

  void spread() {
    while (!todo_.empty()) {
      const TriangleId t = todo_.back();
      todo_.pop_back();
      for (const Link link : mesh_.triangulation[t].link) {
        if (link.constrained() || region_[link.triangle().index] != no_index) continue;
        region_[link.triangle().index] = region_[t.index];
        todo_.push_back(link.triangle());
      }
    }
  }

  const MeshData& mesh_;
  FrozenMesh& frozen_;
  std::vector<std::string> names_;
  const std::string unnamed_ = "domain";
  std::vector<std::uint32_t> region_;  // per triangle slot, index of a name
  std::vector<TriangleId> todo_;
};

bool has_regions(const Domain& domain) {
  return std::any_of(domain.loops.begin(), domain.loops.end(),
                     [](const Loop& loop) { return !loop.region.empty() || !loop.right_region.empty(); });
}

bool made_of_chains(const Domain& domain) {
  return std::any_of(domain.loops.begin(), domain.loops.end(),
                     [](const Loop& loop) { return loop.open && loop.role != LoopRole::internal; });
}

}  // namespace

// Points in the order of vertex ids, triangles in the order of triangle ids.
FrozenMesh Mesh::freeze() const {
  const Triangulation& triangulation = data().triangulation;
  FrozenMesh frozen;
  frozen.delaunay_slack_deg = delaunay_slack_deg();
  std::vector<std::uint32_t> point_of(triangulation.vertex_slots(), no_index);
  const auto as_imported = triangles_as_imported(data());
  triangulation.for_each_domain_triangle([&](TriangleId id, const Triangle& t) {
    frozen.triangle_ids.push_back(id.index);
    frozen.birth.push_back(t.birth);
    const auto kept = as_imported.find(id.index);
    frozen.triangles.push_back(kept != as_imported.end()
                                   ? kept->second
                                   : std::array{t.vertex[0].index, t.vertex[1].index, t.vertex[2].index});
    for (const VertexId v : t.vertex) point_of[v.index] = 0;
  });
  for (std::uint32_t i = 0; i < triangulation.vertex_slots(); ++i) {
    frozen.last_generation = std::max(frozen.last_generation, triangulation.generation(VertexId{i}));
    if (point_of[i] == no_index) continue;
    point_of[i] = static_cast<std::uint32_t>(frozen.points.size());
    frozen.points.push_back(triangulation.point(VertexId{i}));
    frozen.length_scale.push_back(triangulation[VertexId{i}].length_scale);
    frozen.vertex_ids.push_back(i);
    frozen.vertex_keys.push_back(VertexKey{{i}, triangulation.generation(VertexId{i})}.value());
  }
  for (auto& triangle : frozen.triangles)
    for (std::uint32_t& v : triangle) v = point_of[v];
  frozen.curve.assign(frozen.points.size(), -1);
  frozen.parameter.assign(frozen.points.size(), 0.0);
  frozen.steiner.assign(frozen.points.size(), 0);
  freeze_boundary(data(), point_of, frozen);
  for (const PeriodicPair& pair : data().domain.periodic) frozen.periodic.push_back({pair.name, pair.moved});
  if (made_of_chains(data().domain)) LoopOrder(data(), point_of, frozen).run();
  if (has_regions(data().domain)) Regions(data(), frozen).run();
  return frozen;
}

}  // namespace remodel
