#include "step/outcome.h"

#include <algorithm>
#include <utility>
#include <variant>

namespace remodel {

RemodelResult unchanged(const MeshData& mesh) {
  RemodelResult result;
  result.triangles_before = result.triangles = result.preserved = result.connected = mesh.domain_triangles;
  result.stopped = mesh.stopped;
  return result;
}

RemodelResult interrupted(const MeshData& mesh) {
  RemodelResult result = unchanged(mesh);
  result.stopped = Stopped::interrupted;
  return result;
}

RemodelResult finish_adjustment(MeshData& mesh, AdjustCache& cache) {
  RemodelResult result;
  result.triangles_before = result.triangles = result.connected = mesh.domain_triangles;
  result.full_adjustment = true;
  result.preserved = mesh.domain_triangles - cache.changed;
  for (std::size_t i = 0; i < cache.moving.size(); ++i)
    if (cache.changes_place(i)) ++result.moved;
  bool basis_kept = true;
  std::size_t n = 0;
  for (std::size_t i = 0; i < cache.loops.size(); ++i) {
    Loop& loop = mesh.domain.loops[cache.loops[i]];
    std::swap(loop.placement, cache.placements[i]);
    mesh.loop_moved(cache.loops[i]);
    for (Curve& curve : loop.curves) {
      curve.shape.swap(cache.shapes[n]);
      if (const auto* airfoil = std::get_if<CstAirfoil>(&curve.shape))
        basis_kept &= same_basis(std::get<CstAirfoil>(cache.shapes[n]), *airfoil);
      ++n;
    }
  }
  ++mesh.step;
  if (!basis_kept) mesh.cache.reset();
  return result;
}

RemodelResult count_replacement(MeshData& mesh, std::span<const VertexId> moved) {
  const Triangulation& triangulation = mesh.triangulation;
  mesh.seen_vertices.clear(triangulation.vertex_slots());
  for (const VertexId v : moved) mesh.seen_vertices.insert(v);
  const auto is_joined = [&](TriangleId id, const Triangle& t) {
    for (const VertexId v : t.vertex)
      if (!triangulation[v].alive()) return false;
    if (const Triangle& now = triangulation[id]; now.in_domain() && Triangulation::same_edges(t, now))
      return true;
    const auto corner = triangulation.find_edge(t.vertex[0], t.vertex[1]);
    return corner && triangulation.vertex(*corner) == t.vertex[2] &&
           triangulation[corner->triangle].region == Region::domain;
  };
  const auto has_moved = [&](VertexId v) { return mesh.seen_vertices.contains(v); };
  std::size_t before = 0, lost = 0, taken_apart = 0, after = 0;
  for (const Triangulation::Earlier& earlier : triangulation.earlier()) {
    if (!earlier.triangle.in_domain()) continue;
    ++before;
    const bool joined = is_joined(earlier.id, earlier.triangle);
    if (!joined) ++taken_apart;
    if (!joined || std::any_of(earlier.triangle.vertex, earlier.triangle.vertex + 3, has_moved)) ++lost;
  }
  mesh.seen_triangles.clear(triangulation.triangle_slots());
  triangulation.for_each_moved_only([&](TriangleId id) {
    const Triangle& t = triangulation[id];
    if (t.region == Region::domain && std::any_of(t.vertex, t.vertex + 3, has_moved) &&
        mesh.seen_triangles.insert(id))
      ++lost;
  });
  for (const TriangleId t : triangulation.touched())
    if (triangulation[t].in_domain()) ++after;
  RemodelResult result;
  result.triangles_before = mesh.domain_triangles;
  result.preserved = mesh.domain_triangles - lost;
  result.connected = mesh.domain_triangles - taken_apart;
  mesh.domain_triangles = mesh.domain_triangles - before + after;
  result.triangles = mesh.domain_triangles;
  result.moved = moved.size();
  result.inserted = triangulation.vertices_inserted();
  result.removed = triangulation.vertices_removed();
  result.flipped = triangulation.edges_flipped();
  return result;
}

RemodelResult exchange(Mesh& mesh, GenerateResult&& fresh, std::optional<Mesh>& before) {
  MeshData &old = mesh.data(), &made = fresh.mesh.data();
  made.step = old.step + 1;
  for (std::uint32_t i = 0; i < made.triangulation.triangle_slots(); ++i)
    made.triangulation.set_birth(TriangleId{i}, made.step);
  made.triangulation.begin_generations_after(old.triangulation);
  RemodelResult result;
  result.removed = old.triangulation.vertex_count();
  result.inserted = made.triangulation.vertex_count();
  result.triangles_before = mesh.triangle_count();
  result.triangles = fresh.mesh.triangle_count();
  result.stopped = fresh.stopped;
  old.marked.for_each([&](ChangeRecord& record) {
    note_all(old.triangulation, made.triangulation, record);
    record.note_exchange();
  });
  made.marked = std::move(old.marked);
  before = std::move(mesh);
  mesh = std::move(fresh.mesh);
  return result;
}

void exchange_back(Mesh& mesh, Mesh&& before) {
  before.data().marked = std::move(mesh.data().marked);
  mesh = std::move(before);
}

}  // namespace remodel
