#include "mesh/quick_check.h"

#include <cmath>

#include "remodel/predicates.h"

namespace remodel {

namespace {

std::string triangle_name(std::uint32_t i) {
  return "triangle " + std::to_string(i);
}

constexpr double margin = 1.0 + 2e-9;  // for another rounding than that of whoever made the mesh

std::string check_links(const MeshData& mesh, std::uint32_t i, const OppositeAngles& opposite) {
  const Triangulation& triangulation = mesh.triangulation;
  const Triangle& t = triangulation[TriangleId{i}];
  for (int k = 0; k < 3; ++k) {
    const Link link = t.link[k];
    if (link.triangle().index >= triangulation.triangle_slots() || link.corner() > 2)
      return triangle_name(i) + ": link out of range";
    const Triangle& u = triangulation[link.triangle()];
    const int j = link.corner();
    if (!u.alive() || u.link[j] != Link(TriangleId{i}, k, link.constrained()) ||
        u.vertex[next3(j)] != t.vertex[previous3(k)] || u.vertex[previous3(j)] != t.vertex[next3(k)])
      return triangle_name(i) + ": neighbour across corner " + std::to_string(k) + " does not return";
    if (!link.constrained() && u.region != t.region)
      return triangle_name(i) + ": region changes across an unconstrained edge";
    if (link.constrained() && mesh.edge_between(t.vertex[next3(k)], t.vertex[previous3(k)]) == no_index)
      return triangle_name(i) + ": edge opposite corner " + std::to_string(k) +
             " is constrained, but no boundary edge";
    const auto within_slack = [&] {
      return mesh.reference != nullptr &&
             opposite.within(triangulation.point(t.vertex[next3(k)]),
                             triangulation.point(t.vertex[previous3(k)]), triangulation.point(t.vertex[k]),
                             triangulation.point(u.vertex[j]), margin);
    };
    if (t.region == Region::domain && !link.constrained() &&
        triangulation.in_conflict(TriangleId{i}, triangulation.point(u.vertex[j])) && !within_slack())
      return triangle_name(i) + ": edge opposite corner " + std::to_string(k) + " is not locally Delaunay";
  }
  return {};
}

std::string check_triangle(const MeshData& mesh, std::uint32_t i, const QualityBounds& promised,
                           const SmallAngles& small_angles) {
  const Triangulation& triangulation = mesh.triangulation;
  const Triangle& t = triangulation[TriangleId{i}];
  if (t.region == Region::unknown) return triangle_name(i) + ": no region";
  if (t.badness != 0) return triangle_name(i) + ": still marked as bad";
  if (t.ghost())
    return t.region == Region::domain ? triangle_name(i) + ": outside the hull, labelled domain"
                                      : std::string{};
  if (orient2d(triangulation.point(t.vertex[0]), triangulation.point(t.vertex[1]),
               triangulation.point(t.vertex[2])) <= 0)
    return triangle_name(i) + ": not counter-clockwise";
  if (t.region == Region::domain && badness(triangulation, t, promised) > 1.0 && !small_angles.exempt(t))
    return triangle_name(i) + ": below the promised quality, badness " +
           std::to_string(badness(triangulation, t, promised));
  return {};
}

std::string links_do_not_return(const MeshData& mesh, std::uint32_t k) {
  return "boundary vertex " + std::to_string(mesh.at(k).vertex.index) +
         ": neighbours on its loop do not return";
}

// Entries that name each other: then walks along loops end.
std::string check_boundary_links(const MeshData& mesh) {
  for (std::uint32_t k = 0; k < mesh.boundary.size(); ++k) {
    const BoundaryVertex& v = mesh.at(k);
    const bool returns = (v.next == no_index || mesh.at(v.next).previous == k) &&
                         (v.previous == no_index || mesh.at(v.previous).next == k);
    if (v.vertex && !returns) return links_do_not_return(mesh, k);
  }
  return {};
}

std::string check_boundary_vertex(const MeshData& mesh, std::uint32_t k) {
  const BoundaryVertex& v = mesh.at(k);
  const std::string name = "boundary vertex " + std::to_string(v.vertex.index);
  bool recorded = false;
  if (const std::uint32_t first = mesh.triangulation[v.vertex].boundary; first != no_index)
    mesh.at_vertex(first, [&](std::uint32_t e) { recorded |= e == k; });
  if (!recorded) return name + ": record and vertex disagree";
  if (!(mesh.triangulation.point(v.vertex) == mesh.on_curve(v.curve, v.t)))
    return name + ": not on the design";
  if (!(mesh.triangulation[v.vertex].length_scale > 0.0)) return name + ": no length scale";
  return {};
}

std::string check_boundary_edge(const MeshData& mesh, const Sides& sides, std::uint32_t k,
                                std::uint32_t next) {
  const std::string name = "boundary vertex " + std::to_string(mesh.at(k).vertex.index);
  const auto edge = mesh.triangulation.find_edge(mesh.at(k).vertex, mesh.at(next).vertex);
  if (!edge || !mesh.triangulation.link(*edge).constrained()) return name + ": boundary edge is missing";
  const Region on_left = mesh.triangulation[edge->triangle].region;
  const Region on_right = mesh.triangulation[mesh.triangulation.link(*edge).triangle()].region;
  return on_left == sides.left && on_right == sides.right ? std::string{}
                                                          : name + ": regions beside its edge are wrong";
}

}  // namespace

QuickCheck::QuickCheck(const MeshData& mesh)
    : mesh_(mesh),
      promised_(mesh.promised_bounds()),
      small_angles_(mesh),
      opposite_(mesh.reference ? mesh.delaunay_slack_deg : 0.0) {
  promised_.squared_radius_edge *= margin;
  promised_.squared_gradation *= margin;
}

std::string QuickCheck::triangle(TriangleId t) const {
  std::string broken = check_triangle(mesh_, t.index, promised_, small_angles_);
  return broken.empty() ? check_links(mesh_, t.index, opposite_) : broken;
}

// Ends whatever the entries say: a link is followed only where it returns.
std::string QuickCheck::loop(std::size_t loop) const {
  const std::uint32_t head = mesh_.loop_heads[loop];
  std::size_t stations = 0, visited = 0;
  for (std::uint32_t k = head, next; k != no_index; k = next == head ? no_index : next) {
    next = mesh_.at(k).next;
    if (++visited > mesh_.boundary.size() || (next != no_index && mesh_.at(next).previous != k))
      return links_do_not_return(mesh_, k);
    stations += mesh_.at(k).steiner ? 0 : 1;
    if (std::string broken = check_boundary_vertex(mesh_, k); !broken.empty()) return broken;
    if (next == no_index) continue;
    if (std::string broken = check_boundary_edge(mesh_, mesh_.sides[loop], k, next); !broken.empty())
      return broken;
  }
  return stations == mesh_.domain.stations(loop).size() ? std::string{}
                                                        : "boundary: stations of the design are missing";
}

namespace {

// All loops, and that no other vertex takes itself for one of theirs. Precondition: entries name each other.
std::string check_loops(const MeshData& mesh, const QuickCheck& check) {
  std::size_t visited = 0, recorded = 0;
  for (std::size_t loop = 0; loop < mesh.loop_heads.size(); ++loop) {
    if (std::string broken = check.loop(loop); !broken.empty()) return broken;
    mesh.walk(mesh.loop_heads[loop], [&](std::uint32_t k) {
      visited += mesh.triangulation[mesh.at(k).vertex].boundary == k ? 1 : 0;
    });
  }
  for (std::uint32_t i = 1; i < mesh.triangulation.vertex_slots(); ++i) {
    const Vertex& v = mesh.triangulation[VertexId{i}];
    recorded += v.alive() && v.boundary != no_index ? 1 : 0;
  }
  return visited == recorded ? std::string{}
                             : "boundary: vertices say that they are on it, but no loop has them";
}

}  // namespace

std::string check_boundary(const MeshData& mesh) {
  std::string broken = check_boundary_links(mesh);
  return broken.empty() ? check_loops(mesh, QuickCheck(mesh)) : broken;
}

std::string Mesh::quick_check() const {
  const Triangulation& triangulation = data().triangulation;
  if (std::string broken = check_boundary_links(data()); !broken.empty()) return broken;
  const QuickCheck check(data());
  std::size_t count = 0;
  constexpr std::uint32_t ahead = 16;
  const auto slots = static_cast<std::uint32_t>(triangulation.triangle_slots());
  for (std::uint32_t i = 0; i < slots; ++i) {
    if (i + ahead < slots && triangulation[TriangleId{i + ahead}].alive())
      triangulation.prefetch_around(TriangleId{i + ahead});
    if (!triangulation[TriangleId{i}].alive()) continue;
    if (triangulation[TriangleId{i}].region == Region::domain) ++count;
    if (std::string broken = check.triangle(TriangleId{i}); !broken.empty()) return broken;
  }
  if (count != data().domain_triangles)
    return "triangle count: " + std::to_string(count) + " found, " + std::to_string(data().domain_triangles) +
           " recorded";
  return check_loops(data(), check);
}

}  // namespace remodel
