// A limit ended refinement: the shortest edges say where, and how much there is is counted.

#include "remodel/limits.h"

#include <cmath>
#include <limits>

#include "geometry/place_text.h"
#include "mesh/mesh_data.h"

namespace remodel {
namespace {

struct ShortEdge {
  VertexId a, b;
  double squared = std::numeric_limits<double>::infinity();
  void take(VertexId from, VertexId to, double length) {
    if (length < squared) a = from, b = to, squared = length;
  }
};

struct ShortEdges {
  ShortEdge any;
  ShortEdge between_walls;  // both ends on boundaries, but no part of one
};

ShortEdges short_edges(const MeshData& mesh) {
  ShortEdges shortest;
  mesh.triangulation.for_each_domain_triangle([&](TriangleId, const Triangle& t) {
    for (int i = 0; i < 3; ++i) {
      const VertexId a = t.vertex[next3(i)], b = t.vertex[previous3(i)];
      const double length = squared_distance(mesh.triangulation.point(a), mesh.triangulation.point(b));
      shortest.any.take(a, b, length);
      const bool walls =
          mesh.triangulation[a].boundary != no_index && mesh.triangulation[b].boundary != no_index;
      if (walls && !t.link[i].constrained()) shortest.between_walls.take(a, b, length);
    }
  });
  return shortest;
}

}  // namespace

std::string crowded_place(const Mesh& whole) {
  const MeshData& mesh = whole.data();
  const auto [any, between] = short_edges(mesh);
  if (!any.a) return {};
  const auto name = [&](VertexId v) {
    return "\"" + mesh.curve(mesh.at(mesh.triangulation[v].boundary).curve).name + "\"";
  };
  // Triangles between two walls have edges about as long as the way across: less than a quarter of it is
  // something else.
  if (!(between.squared <= 16.0 * any.squared))
    return "at " + exact_text(mesh.triangulation.point(any.a)) + ", where edges are " +
           rough_text(std::sqrt(any.squared)) + " long";
  const std::string one = name(between.a), other = name(between.b);
  const std::string width = rough_text(std::sqrt(between.squared));
  return "at " + exact_text(mesh.triangulation.point(between.a)) +
         (one == other ? ", where two walls of " + one + " are " + width + " apart"
                       : ", where the walls " + one + " and " + other + " are " + width + " apart");
}

MeshCounts counts_of(const Mesh& whole) {
  const MeshData& mesh = whole.data();
  MeshCounts counts;
  counts.triangles = mesh.domain_triangles;
  counts.vertices = mesh.triangulation.vertex_count();
  for (const std::string& marker : mesh.imported.markers) counts.boundary[marker] = 0;
  for (std::size_t curve = 0; curve < mesh.domain.curve_count(); ++curve)
    counts.boundary[mesh.domain.curve(curve).name] = 0;
  for (const std::uint32_t head : mesh.loop_heads) {
    mesh.walk_edges(
        head, [&](std::uint32_t k, std::uint32_t) { ++counts.boundary[mesh.curve(mesh.at(k).curve).name]; });
    mesh.walk(head, [&](std::uint32_t k) { counts.steiner_boundary_vertices += mesh.at(k).steiner ? 1 : 0; });
  }
  return counts;
}

}  // namespace remodel
