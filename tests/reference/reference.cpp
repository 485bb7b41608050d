#include "reference/reference.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <map>
#include <optional>

namespace remodel::reference {

namespace {

using Integer = boost::multiprecision::cpp_int;

// Scales points to integer multiples of one power of two.
template <std::size_t n>
std::array<std::array<Integer, 2>, n> whole(const std::array<Point, n>& points) {
  int smallest = 0;
  const auto last_bit = [](double value) {
    int exponent = 0;
    std::frexp(value, &exponent);
    return exponent - 53;
  };
  for (const Point p : points)
    for (const double value : {p.x, p.y})
      if (value != 0.0) smallest = std::min(smallest, last_bit(value));
  const auto convert = [&](double value) -> Integer {
    if (value == 0.0) return 0;
    int exponent = 0;
    const auto mantissa = static_cast<long long>(std::ldexp(std::frexp(value, &exponent), 53));
    Integer result = mantissa;
    result <<= static_cast<unsigned>(exponent - 53 - smallest);
    return result;
  };
  std::array<std::array<Integer, 2>, n> result;
  for (std::size_t i = 0; i < n; ++i) result[i] = {convert(points[i].x), convert(points[i].y)};
  return result;
}

bool less(Point a, Point b) {
  return a.x != b.x ? a.x < b.x : a.y < b.y;
}

}  // namespace

int orient(Point a, Point b, Point c) {
  const auto p = whole<3>({a, b, c});
  const Integer area = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
  return area.sign();
}

int incircle(Point a, Point b, Point c, Point d) {
  const auto p = whole<4>({a, b, c, d});
  Integer x[3], y[3], z[3];
  for (int i = 0; i < 3; ++i) {
    x[i] = p[static_cast<std::size_t>(i)][0] - p[3][0];
    y[i] = p[static_cast<std::size_t>(i)][1] - p[3][1];
    z[i] = x[i] * x[i] + y[i] * y[i];
  }
  const Integer determinant = x[0] * (y[1] * z[2] - y[2] * z[1]) - y[0] * (x[1] * z[2] - x[2] * z[1]) +
                              z[0] * (x[1] * y[2] - x[2] * y[1]);
  return determinant.sign();
}

int incircle_lifted(Point a, Point b, Point c, Point d) {
  if (const int s = incircle(a, b, c, d); s != 0) return s;
  // The derivative of the determinant by the lift of each point.
  struct Lift {
    Point point;
    int gain;
  };
  std::array<Lift, 4> lifts{
      Lift{a, orient(d, b, c)}, {b, orient(a, d, c)}, {c, orient(a, b, d)}, {d, -orient(a, b, c)}};
  std::sort(lifts.begin(), lifts.end(), [](const Lift& l, const Lift& m) { return less(m.point, l.point); });
  for (const Lift& lift : lifts)
    if (lift.gain != 0) return lift.gain;
  return 0;
}

Edge edge_of(std::size_t a, std::size_t b) {
  return a < b ? Edge{a, b} : Edge{b, a};
}

Face face_of(std::size_t a, std::size_t b, std::size_t c) {
  Face face{a, b, c};
  std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
  return face;
}

std::set<Face> delaunay(const std::vector<Point>& points) {
  std::set<Face> result;
  const std::size_t n = points.size();
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a + 1; b < n; ++b)
      for (std::size_t c = a + 1; c < n; ++c) {
        if (c == b || orient(points[a], points[b], points[c]) <= 0) continue;
        bool empty = true;
        for (std::size_t d = 0; d < n && empty; ++d)
          if (d != a && d != b && d != c)
            empty = incircle_lifted(points[a], points[b], points[c], points[d]) < 0;
        if (empty) result.insert({a, b, c});
      }
  return result;
}

namespace {

class EdgeSet {
 public:
  EdgeSet(const std::vector<Point>& points, const std::set<Edge>& constraints)
      : points_(points), n_(points.size()), sides_(n_ * n_ * n_), constraints_(constraints) {
    for (std::size_t a = 0; a < n_; ++a)
      for (std::size_t b = 0; b < n_; ++b)
        for (std::size_t c = 0; c < n_; ++c)
          sides_[(a * n_ + b) * n_ + c] = static_cast<signed char>(orient(points[a], points[b], points[c]));
    edges_ = constraints;
    for (std::size_t a = 0; a < n_; ++a)
      for (std::size_t b = a + 1; b < n_; ++b)
        if (!passes_through_a_point(a, b) && !crosses_an_edge(a, b)) edges_.insert({a, b});
  }

  void make_delaunay() {
    while (flip_one()) {
    }
  }

  std::set<Face> faces() const {
    std::set<Face> result;
    for (const Edge& edge : edges_)
      for (const auto& [a, b] : {std::pair(edge[0], edge[1]), std::pair(edge[1], edge[0])})
        if (const auto c = apex(a, b)) result.insert(face_of(a, b, *c));
    return result;
  }

 private:
  int side(std::size_t a, std::size_t b, std::size_t c) const { return sides_[(a * n_ + b) * n_ + c]; }

  bool passes_through_a_point(std::size_t a, std::size_t b) const {
    for (std::size_t c = 0; c < n_; ++c) {
      if (c == a || c == b || side(a, b, c) != 0) continue;
      const bool between = less(points_[a], points_[b])
                               ? less(points_[a], points_[c]) && less(points_[c], points_[b])
                               : less(points_[b], points_[c]) && less(points_[c], points_[a]);
      if (between) return true;
    }
    return false;
  }

  bool crosses_an_edge(std::size_t a, std::size_t b) const {
    return std::any_of(edges_.begin(), edges_.end(), [&](const Edge& e) {
      return side(a, b, e[0]) * side(a, b, e[1]) < 0 && side(e[0], e[1], a) * side(e[0], e[1], b) < 0;
    });
  }

  // The third point of the face on the left of a -> b.
  std::optional<std::size_t> apex(std::size_t a, std::size_t b) const {
    for (std::size_t c = 0; c < n_; ++c) {
      if (side(a, b, c) <= 0 || !edges_.contains(edge_of(b, c)) || !edges_.contains(edge_of(c, a))) continue;
      bool empty = true;
      for (std::size_t d = 0; d < n_ && empty; ++d)
        empty = d == a || d == b || d == c || side(a, b, d) < 0 || side(b, c, d) < 0 || side(c, a, d) < 0;
      if (empty) return c;
    }
    return std::nullopt;
  }

  bool flip_one() {
    for (const Edge& edge : edges_) {
      if (constraints_.contains(edge)) continue;
      const auto c = apex(edge[0], edge[1]), d = apex(edge[1], edge[0]);
      if (!c || !d || incircle_lifted(points_[edge[0]], points_[edge[1]], points_[*c], points_[*d]) < 0)
        continue;
      const Edge other = edge_of(*c, *d);
      edges_.erase(Edge(edge));
      edges_.insert(other);
      return true;
    }
    return false;
  }

  const std::vector<Point>& points_;
  std::size_t n_;
  std::vector<signed char> sides_;
  std::set<Edge> constraints_, edges_;
};

}  // namespace

std::set<Face> constrained_delaunay(const std::vector<Point>& points, const std::set<Edge>& constraints) {
  EdgeSet edges(points, constraints);
  edges.make_delaunay();
  return edges.faces();
}

std::set<Edge> certain_edges(const std::vector<Point>& points, const std::set<Face>& faces,
                             const std::set<Edge>& constraints) {
  std::map<Edge, std::vector<std::size_t>> apexes;
  for (const Face& face : faces)
    for (std::size_t i = 0; i < 3; ++i)
      apexes[edge_of(face[i], face[(i + 1) % 3])].push_back(face[(i + 2) % 3]);
  std::set<Edge> result;
  for (const auto& [edge, across] : apexes) {
    if (across.size() < 2 || constraints.contains(edge)) {
      result.insert(edge);
      continue;
    }
    const Point a = points[edge[0]], b = points[edge[1]], c = points[across[0]], d = points[across[1]];
    if (incircle(a, b, c, d) * orient(a, b, c) < 0) result.insert(edge);
  }
  return result;
}

std::size_t preserved(const FrozenMesh& before, const FrozenMesh& after) {
  using Corner = std::pair<std::uint32_t, std::pair<double, double>>;
  const auto triangles = [](const FrozenMesh& mesh) {
    std::set<std::array<Corner, 3>> result;
    for (const auto& triangle : mesh.triangles) {
      std::array<Corner, 3> corners;
      for (std::size_t i = 0; i < 3; ++i)
        corners[i] = {mesh.vertex_ids[triangle[i]], {mesh.points[triangle[i]].x, mesh.points[triangle[i]].y}};
      std::sort(corners.begin(), corners.end());
      result.insert(corners);
    }
    return result;
  };
  const auto old_ones = triangles(before), new_ones = triangles(after);
  return static_cast<std::size_t>(
      std::count_if(old_ones.begin(), old_ones.end(), [&](const auto& t) { return new_ones.contains(t); }));
}

}  // namespace remodel::reference
