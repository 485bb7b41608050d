#include "generate/discretise.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <set>
#include <string>
#include <utility>

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

namespace {

bool is_station(const MeshData& mesh, VertexId v) {
  const std::uint32_t k = mesh.triangulation[v].boundary;
  return k != no_index && !mesh.at(k).steiner;
}

// The distance from a vertex to the nearest other station that the domain's edges lead to; infinity if there
// is none. Every vertex of a Delaunay triangulation has a neighbour that is nearer to the start, so that
// vertices are met in the order of their distances.
double distance_to_station(const MeshData& mesh, VertexId start) {
  const Triangulation& triangulation = mesh.triangulation;
  using Entry = std::pair<double, VertexId>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> waiting;
  std::set<VertexId> met{start};
  const auto visit_neighbours = [&](VertexId v) {
    triangulation.for_each_corner(v, [&](Corner c) {
      if (triangulation[c.triangle].region != Region::domain) return;
      for (const VertexId u : {triangulation.following(c), triangulation.preceding(c)})
        if (met.insert(u).second)
          waiting.push({squared_distance(triangulation.point(u), triangulation.point(start)), u});
    });
  };
  visit_neighbours(start);
  while (!waiting.empty()) {
    const auto [distance, v] = waiting.top();
    waiting.pop();
    if (is_station(mesh, v)) return std::sqrt(distance);
    visit_neighbours(v);
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

VertexId insert_boundary_point(Triangulation& triangulation, Point p, VertexId near) {
  for (;;) {
    const auto [v, is_new] = triangulation.insert(p, triangulation.star(near).triangle);
    if (is_new && triangulation.at_constraint(v))
      throw RecoveryError("a boundary vertex lies on another boundary edge");
    if (is_new) return v;
    if (triangulation[v].boundary != no_index) throw RecoveryError("two boundary vertices lie at one point");
    if (v == near) {
      const Corner c = triangulation.star(v);
      near = triangulation.following(c) == infinite_vertex ? triangulation.preceding(c)
                                                           : triangulation.following(c);
    }
    triangulation.remove(v);
  }
}

double neighbour_length_scale(const MeshData& mesh, std::uint32_t k, Neighbours neighbours) {
  const Triangulation& triangulation = mesh.triangulation;
  const VertexId v = mesh.at(k).vertex;
  const bool single = mesh.is_single_point(k);
  if (single && neighbours == Neighbours::stations)
    return distance_to_station(mesh, v) / mesh.options.resolution;
  double scale = single ? std::numeric_limits<double>::infinity() : mesh.base_length_scale(k);
  triangulation.for_each_corner(v, [&](Corner c) {
    if (triangulation[c.triangle].region != Region::domain) return;
    for (const VertexId u : {triangulation.following(c), triangulation.preceding(c)}) {
      const Vertex& neighbour = triangulation[u];
      const double distance = std::sqrt(squared_distance(neighbour.point, triangulation.point(v)));
      if (is_station(mesh, u))
        scale = std::min(scale, distance / mesh.options.resolution);
      else if (neighbours == Neighbours::all)
        scale = std::min(scale, neighbour.length_scale + distance / mesh.options.gradation);
    }
  });
  return scale;
}

void require_points_in_domain(const MeshData& mesh) {
  const Triangulation& triangulation = mesh.triangulation;
  for (const std::uint32_t head : mesh.loop_heads) {
    const BoundaryVertex& only = mesh.at(head);
    if (only.next != no_index || only.previous != no_index) continue;
    bool inside = false;
    triangulation.for_each_corner(only.vertex, [&](Corner c) {
      inside = inside || triangulation[c.triangle].region == Region::domain;
    });
    if (!inside)
      throw RecoveryError("the single point '" + mesh.curve(only.curve).name + "' lies outside the domain");
  }
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
  require_points_in_domain(mesh);
  for (std::uint32_t k = 0; k < mesh.boundary.size(); ++k)
    mesh.set_boundary_length_scale(k, neighbour_length_scale(mesh, k));
}

}  // namespace remodel
