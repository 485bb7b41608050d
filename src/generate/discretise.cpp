#include "generate/discretise.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "generate/recovery_error.h"
#include "remodel/predicates.h"

namespace remodel {

namespace {

// The first triangle: the first station, the next one, and the first that is not in line with them.
void start(MeshData& mesh, const std::vector<std::vector<BoundaryStation>>& loops) {
  const Point a = mesh.domain.at(loops[0][0]), b = mesh.domain.at(loops[0][1]);
  for (const auto& loop : loops)
    for (const BoundaryStation& station : loop) {
      const Point c = mesh.domain.at(station);
      if (orient2d(a, b, c) == 0) continue;
      mesh.triangulation.start(a, b, c);
      return;
    }
  throw RecoveryError("all boundary points lie on one line");
}

// Every other of the points so far missing, coarse to fine: 0, then n/2, n/4, 3n/4, and so on. In the order
// of the loop each point would see, and refill, all of the triangles between the first points and the last.
std::vector<std::size_t> coarse_to_fine(std::size_t n) {
  std::size_t stride = 1;
  while (stride < n) stride *= 2;
  std::vector<std::size_t> order{0};
  for (; stride > 1; stride /= 2)
    for (std::size_t i = stride / 2; i < n; i += stride) order.push_back(i);
  return order;
}

void insert_loop(MeshData& mesh, const std::vector<BoundaryStation>& stations) {
  std::vector<VertexId> vertices(stations.size());
  TriangleId hint = mesh.triangulation.star(VertexId{1}).triangle;
  for (const std::size_t i : coarse_to_fine(stations.size())) {
    // The nearest point before i that is in: i with its last bit cleared.
    if (i > 0) hint = mesh.triangulation.star(vertices[i & (i - 1)]).triangle;
    vertices[i] = mesh.triangulation.insert(mesh.domain.at(stations[i]), hint).vertex;
  }
  std::uint32_t previous = no_index;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const BoundaryVertex vertex{
        .vertex = vertices[i], .curve = static_cast<std::uint32_t>(stations[i].curve), .t = stations[i].t};
    const std::uint32_t k = mesh.add_boundary_vertex(vertex, previous);
    if (previous == no_index) mesh.loop_heads.push_back(k);
    previous = k;
  }
}

void constrain_loop(MeshData& mesh, std::uint32_t head) {
  std::uint32_t k = head;
  do {
    const auto result = mesh.triangulation.constrain(mesh.at(k).vertex, mesh.next(k).vertex);
    if (result.kind != ConstrainResult::Kind::done) throw RecoveryError("boundary edges cross or touch");
    k = mesh.at(k).next;
  } while (k != head);
}

}  // namespace

double neighbour_length_scale(const MeshData& mesh, std::uint32_t k) {
  const Triangulation& triangulation = mesh.triangulation;
  const VertexId v = mesh.at(k).vertex;
  double scale = mesh.base_length_scale(k);
  const Corner first = triangulation.star(v);
  Corner c = first;
  do {
    if (triangulation[c.triangle].region == Region::domain)
      for (const VertexId u : {triangulation.following(c), triangulation.preceding(c)}) {
        const Vertex& neighbour = triangulation[u];
        const double distance = std::sqrt(squared_distance(neighbour.point, triangulation.point(v)));
        const bool station = neighbour.boundary != no_index && !mesh.at(neighbour.boundary).steiner;
        scale = std::min(scale, station ? distance / mesh.options.resolution
                                        : neighbour.length_scale + distance / mesh.options.gradation);
      }
    c = triangulation.counterclockwise(c);
  } while (c.triangle != first.triangle);
  return scale;
}

void discretise(MeshData& mesh) {
  std::vector<std::vector<BoundaryStation>> loops;
  for (std::size_t loop = 0; loop < mesh.domain.loops.size(); ++loop)
    loops.push_back(mesh.domain.stations(loop));
  start(mesh, loops);
  for (const auto& stations : loops) insert_loop(mesh, stations);
  mesh.orient_loops();
  for (const std::uint32_t head : mesh.loop_heads) constrain_loop(mesh, head);
  mesh.label_regions();
  for (std::uint32_t k = 0; k < mesh.boundary.size(); ++k)
    mesh.set_boundary_length_scale(k, neighbour_length_scale(mesh, k));
}

}  // namespace remodel
