// What is left to do where the boundary has the structure of the new domain, but not all of its places.

#include <algorithm>
#include <cmath>

#include "generate/recovery_error.h"
#include "remodel/predicates.h"
#include "step/methods.h"

namespace remodel {

namespace {

struct Offset {
  VertexId vertex;
  Point to;
};

// The vertices of a loop that are off their places. False where one is by more than roundings, or a station.
bool list_offsets(const MeshData& mesh, std::size_t loop, List<Offset>& offsets) {
  constexpr double spacings = 0x1p-40;
  bool rests = true;
  mesh.walk(mesh.loop_heads[loop], [&](std::uint32_t k) {
    const Point p = mesh.on_curve(mesh.at(k).curve, mesh.at(k).t), here = mesh.point(k);
    if (here == p) return;
    const double near = spacings * std::max(std::abs(p.x), std::abs(p.y));
    rests &= mesh.at(k).steiner && squared_distance(here, p) <= near * near;
    offsets.push_back({mesh.at(k).vertex, p});
  });
  return rests;
}

void move(MeshData& mesh, const Offset& offset, List<TriangleId>& around) {
  Triangulation& triangulation = mesh.triangulation;
  triangulation.move(offset.vertex, offset.to, triangulation[offset.vertex].length_scale);
  triangulation.for_each_corner(offset.vertex, [&](Corner c) {
    const Triangle& t = triangulation[c.triangle];
    if (t.ghost()) return;
    if (orient2d(triangulation.point(t.vertex[0]), triangulation.point(t.vertex[1]),
                 triangulation.point(t.vertex[2])) <= 0)
      throw RecoveryError("a boundary vertex cannot be moved by a rounding");
    triangulation.refresh_circle(c.triangle);
    around.push_back(c.triangle);
  });
}

}  // namespace

List<std::size_t> settle(MeshData& mesh, List<VertexId>& settled) {
  List<std::size_t> moving(&mesh.arena);
  List<TriangleId> around(&mesh.arena);
  for (std::size_t loop = 0; loop < mesh.loop_heads.size(); ++loop) {
    List<Offset> offsets(&mesh.arena);
    if (!list_offsets(mesh, loop, offsets)) {
      moving.push_back(loop);
      continue;
    }
    for (const Offset& offset : offsets) {
      move(mesh, offset, around);
      settled.push_back(offset.vertex);
    }
  }
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  std::erase_if(around, [&](TriangleId t) { return !mesh.triangulation[t].alive(); });
  mesh.triangulation.restore_delaunay(around);
  return moving;
}

}  // namespace remodel
