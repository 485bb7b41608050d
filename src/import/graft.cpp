#include "import/graft.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "base/disjoint_sets.h"
#include "generate/discretise.h"
#include "generate/recovery_error.h"
#include "remodel/mesh_state.h"
#include "remodel/predicates.h"
#include "triangulation/state.h"

namespace remodel {

namespace {

// ---- the graft

// Slots of the finished triangulation by those of the boundary's own.
std::vector<VertexId> renumbered(const MeshData& filler, const SoundMesh& mesh, const LoopsOfMesh& loops) {
  std::vector<VertexId> result(filler.triangulation.vertex_slots());
  result[infinite_vertex.index] = infinite_vertex;
  for (std::size_t loop = 0; loop < loops.points.size(); ++loop) {
    std::uint32_t k = filler.loop_heads[loop];
    for (const std::uint32_t point : loops.points[loop]) {
      result[filler.at(k).vertex.index] = mesh.vertex(point);
      k = filler.at(k).next;
    }
  }
  return result;
}

struct Side {
  VertexId from, to;
  std::uint32_t triangle;
  int corner;
};

bool before(const Side& a, const Side& b) {
  return std::tie(a.from, a.to) < std::tie(b.from, b.to);
}

using Edges = std::vector<std::pair<VertexId, VertexId>>;

// Inner edges, in both directions, sorted.
Edges inner_edges(const SoundMesh& mesh) {
  Edges edges;
  for (const InnerEdge& edge : mesh.inner) {
    edges.push_back({mesh.vertex(edge.from), mesh.vertex(edge.to)});
    edges.push_back({mesh.vertex(edge.to), mesh.vertex(edge.from)});
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

// Every side is linked to the same edge in the other direction; it is constrained where the domain ends, and
// on inner edges.
void link_triangles(std::vector<Triangle>& triangles, const Edges& inner) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    for (int k = 0; k < 3; ++k)
      sides.push_back({triangles[i].vertex[next3(k)], triangles[i].vertex[previous3(k)], i, k});
  std::sort(sides.begin(), sides.end(), before);
  for (const Side& side : sides) {
    const auto other = std::lower_bound(sides.begin(), sides.end(), Side{side.to, side.from, 0, 0}, before);
    if (other == sides.end() || other->from != side.to || other->to != side.from)
      throw RecoveryError("the boundary does not separate inside and outside");
    const bool constrained = triangles[side.triangle].region != triangles[other->triangle].region ||
                             std::binary_search(inner.begin(), inner.end(), std::pair{side.from, side.to});
    triangles[side.triangle].link[side.corner] =
        Link(TriangleId{other->triangle}, other->corner, constrained);
  }
}

// Each point in the slot of its vertex. Slots without one are free, and their next keys are new ones.
void place_vertices(const SoundMesh& mesh, TriangulationState& state) {
  const auto points = static_cast<std::uint32_t>(mesh.points.size());
  const std::size_t slots = mesh.vertex(points - 1).index + std::size_t{1};
  state.vertices.resize(slots);
  state.generations.assign(slots, mesh.last_generation + (mesh.keys.empty() ? 1 : 0));
  state.generations[infinite_vertex.index] = mesh.last_generation;
  std::vector<bool> taken(slots, false);
  taken[infinite_vertex.index] = true;
  for (std::uint32_t i = 0; i < points; ++i) {
    const VertexId v = mesh.vertex(i);
    state.vertices[v.index].point = mesh.points[i];
    if (!mesh.keys.empty()) state.generations[v.index] = mesh.keys[i].generation;
    taken[v.index] = true;
  }
  for (auto i = static_cast<std::uint32_t>(slots); i-- > 0;)
    if (!taken[i]) state.free_vertices.push_back(i);
}

}  // namespace

void graft(const SoundMesh& mesh, const LoopsOfMesh& loops, MeshData& data) {
  discretise(data);
  const std::vector<VertexId> vertices = renumbered(data, mesh, loops);
  TriangulationState state;
  place_vertices(mesh, state);
  for (const auto& corners : mesh.triangles) {
    Triangle& t = state.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) t.vertex[k] = mesh.vertex(corners[k]);
    t.region = Region::domain;
  }
  for (std::uint32_t i = 0; i < data.triangulation.triangle_slots(); ++i) {
    const Triangle& filler = data.triangulation[TriangleId{i}];
    if (!filler.alive() || filler.region != Region::outside) continue;
    Triangle& t = state.triangles.emplace_back();
    for (int k = 0; k < 3; ++k) t.vertex[k] = vertices[filler.vertex[k].index];
    t.region = Region::outside;
  }
  link_triangles(state.triangles, inner_edges(mesh));
  for (std::uint32_t i = 0; i < state.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k)
      state.vertices[state.triangles[i].vertex[k].index].star = Link(TriangleId{i}, k);
  if (const std::string broken = state.restore(data.triangulation); !broken.empty())
    throw RecoveryError(broken);
  // A vertex of several loops names the entry of the first.
  for (auto k = static_cast<std::uint32_t>(data.boundary.size()); k-- > 0;) {
    data.boundary.edit(k).vertex = vertices[data.boundary[k].vertex.index];
    data.triangulation.set_boundary(data.boundary[k].vertex, k);
  }
}

void take_design(DesignOfMesh design, MeshData& data) {
  data.domain = std::move(design.domain);
  data.index_curves();
  std::vector<std::vector<BoundaryVertex>> loops;
  for (const std::uint32_t head : data.loop_heads) {
    auto& loop = loops.emplace_back();
    data.walk(head, [&](std::uint32_t k) { loop.push_back(data.at(k)); });
  }
  data.boundary.take_all();
  data.loop_heads.clear();
  for (const auto& loop : loops)
    for (const BoundaryVertex& entry : loop) data.triangulation.set_boundary(entry.vertex, no_index);
  for (std::size_t i = 0; i < loops.size(); ++i) {
    const bool open = data.domain.loops[i].open;
    std::uint32_t previous = no_index;
    for (std::size_t k = 0; k < loops[i].size(); ++k) {
      const BoundaryVertex& entry = loops[i][k];
      const double t = design.parameters[i][k];
      const std::vector<double>& stations = data.curve(entry.curve).parameters;
      const bool end = open && k + 1 == loops[i].size();
      const bool steiner = !end && !std::binary_search(stations.begin(), stations.end(), t);
      previous = data.add_boundary_vertex(
          {.vertex = entry.vertex, .curve = entry.curve, .t = t, .steiner = steiner}, previous);
      if (k == 0) data.loop_heads.push_back(previous);
    }
    if (!open) data.close_loop(data.loop_heads.back(), previous);
  }
}

// ---- flips

namespace {

using Corners = std::array<std::uint32_t, 3>;  // vertex ids

std::vector<Corners> corners_of(const MeshData& data, std::size_t count) {
  std::vector<Corners> result;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Triangle& t = data.triangulation[TriangleId{i}];
    result.push_back({t.vertex[0].index, t.vertex[1].index, t.vertex[2].index});
  }
  return result;
}

// Faces: triangles are joined across the edges that the other triangulation does not have.
class Faces {
 public:
  Faces(const MeshData& data, const std::vector<Corners>& file)
      : data_(data),
        file_(file),
        file_edges_(directed_edges(file)),
        living_edges_(directed_edges(corners_of(data, file.size()))),
        faces_(file.size()),
        proper_(file.size(), false) {
    for (const DirectedEdge& edge : file_edges_) join(edge);
  }

  const Flips& flips() const { return flips_; }

  // The slots of each face that flips changed, if it is to be recorded. A face's slots are those of the
  // file's triangles in it: a flip writes both its triangles into the slots of the two before.
  void record(Record what, ImportRecord& into) {
    std::vector<std::uint32_t> sizes(file_.size(), 0);
    for (std::uint32_t i = 0; i < file_.size(); ++i) ++sizes[faces_.root(i)];
    std::map<std::uint32_t, std::vector<std::uint32_t>> slots;  // by the face's root
    for (std::uint32_t i = 0; i < file_.size(); ++i)
      if (const std::uint32_t face = faces_.root(i);
          sizes[face] > 1 && (what == Record::all || !proper_[face]))
        slots[face].push_back(i);
    std::uint32_t face = 0;
    for (const auto& [first, members] : slots) {
      for (const std::uint32_t slot : members) {
        into.slots.push_back(slot);
        into.faces.push_back(face);
        into.triangles.insert(into.triangles.end(), file_[slot].begin(), file_[slot].end());
      }
      ++face;
    }
  }

 private:
  std::uint32_t apex(const DirectedEdge& edge) const {
    for (const std::uint32_t v : file_[edge.triangle])
      if (v != edge.from && v != edge.to) return v;
    return 0;
  }

  void join(const DirectedEdge& edge) {
    if (edge.from > edge.to) return;  // each edge once
    const DirectedEdge* other = find_edge(file_edges_, edge.to, edge.from);
    if (other == nullptr || find_edge(living_edges_, edge.from, edge.to) != nullptr) return;
    ++flips_.flipped;
    const auto point = [&](std::uint32_t v) { return data_.triangulation.point(VertexId{v}); };
    const bool inside =
        incircle(point(edge.from), point(edge.to), point(apex(edge)), point(apex(*other))) > 0;
    const std::uint32_t a = faces_.root(edge.triangle), b = faces_.root(other->triangle);
    const std::uint32_t low = std::min(a, b);
    proper_[low] = proper_[a] || proper_[b] || inside;
    faces_.join(std::max(a, b), low);
  }

  const MeshData& data_;
  const std::vector<Corners>& file_;
  std::vector<DirectedEdge> file_edges_, living_edges_;
  DisjointSets faces_;
  std::vector<bool> proper_;  // of a face's root: an edge of the file in it is not Delaunay
  Flips flips_;
};

std::size_t count_non_delaunay(const MeshData& data, std::size_t triangles) {
  const Triangulation& triangulation = data.triangulation;
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const Triangle& t = triangulation[TriangleId{i}];
    for (int k = 0; k < 3; ++k) {
      const Link link = t.link[k];
      if (link.constrained() || link.triangle().index < i) continue;
      const Point across = triangulation.point(triangulation[link.triangle()].vertex[link.corner()]);
      if (incircle(triangulation.point(t.vertex[0]), triangulation.point(t.vertex[1]),
                   triangulation.point(t.vertex[2]), across) > 0)
        ++count;
    }
  }
  return count;
}

}  // namespace

Flips make_delaunay(const SoundMesh& mesh, Record record, MeshData& data) {
  const std::vector<Corners> file = corners_of(data, mesh.triangles.size());
  const std::size_t non_delaunay = count_non_delaunay(data, file.size());
  std::vector<TriangleId> all;
  for (std::uint32_t i = 0; i < file.size(); ++i) all.push_back(TriangleId{i});
  data.triangulation.restore_delaunay(all);
  if (corners_of(data, file.size()) == file) return {};
  Faces faces(data, file);
  faces.record(record, data.imported);
  Flips flips = faces.flips();
  flips.non_delaunay = non_delaunay;
  return flips;
}

}  // namespace remodel
