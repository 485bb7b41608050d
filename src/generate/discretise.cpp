#include "generate/discretise.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "generate/recovery_error.h"
#include "remodel/predicates.h"
#include "triangulation/coarse_to_fine.h"

namespace remodel {

namespace {

// The first triangle: the first two points, and the first that is not in line with them.
void start(MeshData& mesh, const std::vector<std::vector<Point>>& loops) {
  std::vector<Point> first;
  for (const auto& points : loops)
    for (const Point p : points) {
      if (first.size() < 2) {
        if (first.empty() || !(first[0] == p)) first.push_back(p);
        continue;
      }
      if (orient2d(first[0], first[1], p) == 0) continue;
      mesh.triangulation.start(first[0], first[1], p);
      return;
    }
  throw RecoveryError("all boundary points lie on one line");
}

// The last vertex inserted is where the search for the next loop begins: files list neighbours together.
void insert_loop(MeshData& mesh, std::size_t loop, const std::vector<Point>& points, VertexId& last) {
  std::vector<VertexId> vertices(points.size());
  for (const std::size_t i : coarse_to_fine(points.size())) {
    if (i > 0) last = vertices[i & (i - 1)];
    last = vertices[i] = mesh.triangulation.insert(points[i], mesh.triangulation.star(last).triangle).vertex;
  }
  const std::vector<BoundaryStation> stations = mesh.domain.stations(loop);
  std::uint32_t previous = no_index;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    previous = mesh.add_boundary_vertex(
        {.vertex = vertices[i], .curve = static_cast<std::uint32_t>(stations[i].curve), .t = stations[i].t},
        previous);
    if (i == 0) mesh.loop_heads.push_back(previous);
  }
  if (!mesh.domain.loops[loop].open) mesh.close_loop(mesh.loop_heads.back(), previous);
}

void constrain_loop(MeshData& mesh, std::uint32_t head) {
  mesh.walk_edges(head, [&](std::uint32_t k, std::uint32_t next) {
    const auto result = mesh.triangulation.constrain(mesh.at(k).vertex, mesh.at(next).vertex);
    if (result.kind != ConstrainResult::Kind::done) throw RecoveryError("boundary edges cross or touch");
  });
}

}  // namespace

double neighbour_length_scale(const MeshData& mesh, std::uint32_t k, Neighbours neighbours) {
  const Triangulation& triangulation = mesh.triangulation;
  const VertexId v = mesh.at(k).vertex;
  double scale = mesh.base_length_scale(k);
  triangulation.for_each_corner(v, [&](Corner c) {
    if (triangulation[c.triangle].region != Region::domain) return;
    for (const VertexId u : {triangulation.following(c), triangulation.preceding(c)}) {
      const Vertex& neighbour = triangulation[u];
      const double distance = std::sqrt(squared_distance(neighbour.point, triangulation.point(v)));
      const bool station = neighbour.boundary != no_index && !mesh.at(neighbour.boundary).steiner;
      if (station)
        scale = std::min(scale, distance / mesh.options.resolution);
      else if (neighbours == Neighbours::all)
        scale = std::min(scale, neighbour.length_scale + distance / mesh.options.gradation);
    }
  });
  return scale;
}

void discretise(MeshData& mesh) {
  mesh.index_curves();
  std::vector<std::vector<Point>> loops;
  for (std::size_t loop = 0; loop < mesh.domain.loops.size(); ++loop)
    loops.push_back(mesh.domain.points(loop));
  start(mesh, loops);
  VertexId last{1};
  for (std::size_t loop = 0; loop < loops.size(); ++loop) insert_loop(mesh, loop, loops[loop], last);
  mesh.orient_loops();
  for (const std::uint32_t head : mesh.loop_heads) constrain_loop(mesh, head);
  if (!mesh.label_regions()) throw RecoveryError(contradicting_sides);
  for (std::uint32_t k = 0; k < mesh.boundary.size(); ++k)
    mesh.set_boundary_length_scale(k, neighbour_length_scale(mesh, k));
}

}  // namespace remodel
