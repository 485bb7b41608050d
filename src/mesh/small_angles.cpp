#include "mesh/small_angles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory_resource>

namespace remodel {

namespace {

// The angle from u counter-clockwise to v is below 60 degrees.
bool sharp(Point u, Point v) {
  return cross(u, v) > 0.0 && dot(u, v) > 0.5 * std::sqrt(dot(u, u) * dot(v, v));
}

// An edge of the initial discretisation at a vertex, so that no split changes what is small: where it leads,
// and whether the domain is on its left, seen from the vertex.
struct Leg {
  Point direction;
  bool domain_on_left;
};

using Legs = List<Leg>;

void add_legs(const MeshData& mesh, std::uint32_t k, Legs& legs) {
  mesh.at_vertex(k, [&](std::uint32_t e) {
    const Sides& sides = mesh.sides[mesh.loop_of(mesh.at(e).curve)];
    if (const std::uint32_t next = mesh.at(e).next_station; next != no_index)
      legs.push_back({mesh.point(next) - mesh.point(e), sides.left == Region::domain});
    if (const std::uint32_t previous = mesh.at(e).previous_station; previous != no_index)
      legs.push_back({mesh.point(previous) - mesh.point(e), sides.right == Region::domain});
  });
}

// In the order of their angles from the positive x axis.
bool comes_before(const Leg& a, const Leg& b) {
  const auto lower = [](Point p) { return p.y < 0.0 || (p.y == 0.0 && p.x < 0.0); };
  if (lower(a.direction) != lower(b.direction)) return lower(b.direction);
  return cross(a.direction, b.direction) > 0.0;
}

// Cheap, for most vertices: two edges that meet at 60 degrees or more.
bool may_be_sharp(const MeshData& mesh, std::uint32_t k) {
  const BoundaryVertex& v = mesh.at(k);
  if (v.twin != k) return true;
  if (v.next_station == no_index || v.previous_station == no_index) return false;
  const Point p = mesh.point(k), u = mesh.point(v.next_station) - p, w = mesh.point(v.previous_station) - p;
  const double product = dot(u, w);
  return product > 0.0 && product * product >= 0.24 * (dot(u, u) * dot(w, w));
}

bool has_sharp_wedge(Legs& legs) {
  std::sort(legs.begin(), legs.end(), comes_before);
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const Leg& next = legs[i + 1 == legs.size() ? 0 : i + 1];
    if (legs[i].domain_on_left && sharp(legs[i].direction, next.direction)) return true;
  }
  return false;
}

bool is_sharp(const MeshData& mesh, std::uint32_t k, Legs& legs) {
  legs.clear();
  add_legs(mesh, k, legs);
  return has_sharp_wedge(legs);
}

// The non-Steiner vertices next to a boundary vertex on its loops, each with the segment of the initial
// discretisation between (by its first entry), split or not: what is exempt stays so. A vertex in the middle
// of a loop has two.
struct Neighbour {
  VertexId corner;
  std::uint32_t segment;
};
template <class Visit>
void for_each_neighbour(const MeshData& mesh, std::uint32_t k, Visit visit) {
  mesh.at_vertex(k, [&](std::uint32_t e) {
    const std::uint32_t before = mesh.non_steiner_before(e), after = mesh.non_steiner_after(e);
    if (before != no_index) visit(Neighbour{mesh.at(before).vertex, before});
    if (after != no_index) visit(Neighbour{mesh.at(after).vertex, mesh.at(e).steiner ? before : e});
  });
}

}  // namespace

std::size_t SmallAngles::count() const {
  std::vector<VertexId> corners;
  for (const std::uint32_t head : mesh_.loop_heads)
    mesh_.walk(head, [&](std::uint32_t k) {
      if (is_corner(mesh_.at(k).vertex)) corners.push_back(mesh_.at(k).vertex);
    });
  std::sort(corners.begin(), corners.end());
  return static_cast<std::size_t>(std::unique(corners.begin(), corners.end()) - corners.begin());
}

bool SmallAngles::is_corner(VertexId v) const {
  const std::uint32_t k = mesh_.triangulation[v].boundary;
  if (!may_be_sharp(mesh_, k)) return false;
  std::array<std::byte, 16 * sizeof(Leg)> storage;  // few vertices have more
  std::pmr::monotonic_buffer_resource memory(storage.data(), storage.size());
  Legs legs(&memory);
  legs.reserve(15);
  return is_sharp(mesh_, k, legs);
}

bool SmallAngles::seditious(VertexId a, VertexId b) const {
  const std::uint32_t ka = mesh_.triangulation[a].boundary, kb = mesh_.triangulation[b].boundary;
  if (ka == no_index || kb == no_index) return false;
  bool found = false;
  for_each_neighbour(mesh_, ka, [&](const Neighbour& from) {
    for_each_neighbour(mesh_, kb, [&](const Neighbour& to) {
      if (found || from.corner != to.corner || from.segment == to.segment || !is_corner(from.corner)) return;
      const Point corner = mesh_.triangulation.point(from.corner);
      const double da = squared_distance(corner, mesh_.triangulation.point(a));
      const double db = squared_distance(corner, mesh_.triangulation.point(b));
      const double ab = squared_distance(mesh_.triangulation.point(a), mesh_.triangulation.point(b));
      // Shells are hit to rounding; the next shell is four times away. The angle between the sides is the
      // small one: a corner may have others.
      found = std::abs(da - db) <= 1e-6 * (da + db) && ab < da;
    });
  });
  return found;
}

bool SmallAngles::exempt(const Triangle& triangle) const {
  // The shortest edge must join two vertices of the boundary: where two corners are inside, none does.
  int inside = 0;
  for (const VertexId v : triangle.vertex) inside += mesh_.triangulation[v].boundary == no_index ? 1 : 0;
  if (inside > 1) return false;
  int shortest = 0;
  double length = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const double l = squared_distance(mesh_.triangulation.point(triangle.vertex[next3(i)]),
                                      mesh_.triangulation.point(triangle.vertex[previous3(i)]));
    if (l < length) length = l, shortest = i;
  }
  return seditious(triangle.vertex[next3(shortest)], triangle.vertex[previous3(shortest)]);
}

double SmallAngles::shell_fraction(double length) {
  int exponent = 0;
  std::frexp(length * (2.0 / 3.0),
             &exponent);  // the power of two between a third and two thirds of the length
  return std::ldexp(0.5, exponent) / length;
}

std::size_t count_exempt(const MeshData& mesh) {
  const SmallAngles small_angles(mesh);
  if (small_angles.count() == 0) return 0;
  const QualityBounds bounds = mesh.promised_bounds();
  std::size_t count = 0;
  mesh.triangulation.for_each_domain_triangle([&](TriangleId, const Triangle& t) {
    if (badness(mesh.triangulation, t, bounds) > 1.0 && small_angles.exempt(t)) ++count;
  });
  return count;
}

}  // namespace remodel
