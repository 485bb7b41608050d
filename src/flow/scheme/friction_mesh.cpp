#include "flow/scheme/friction_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "flow/scheme/laminar_zone.h"

namespace remodel::flow {

namespace {

// Columns of a fan stand close together at the edge: a difference between them would be stretched to that
// between columns behind, a hundred times as long. RAE 2822 was not found so.
constexpr double largest_ratio = 4.0;

double squared_distance_to_segment(Point p, Point a, Point b) {
  return squared_distance(p, a + nearest_part(p, a, b) * (b - a));
}

}  // namespace

double nearest_part(Point p, Point a, Point b) {
  return std::clamp(dot(p - a, b - a) / dot(b - a, b - a), 0.0, 1.0);
}

FrictionMesh::FrictionMesh(const FlowMesh& mesh, const std::optional<std::array<double, 2>>& transition)
    : mesh_(mesh) {
  sticks_.assign(mesh.size(), false);
  for (const BoundaryEdge& edge : mesh.boundary())
    if (mesh.patch(edge).sticks()) sticks_[edge.a] = sticks_[edge.b] = true;
  count_cells();
  make_upwind();
  make_triangles();
  make_mean_gradients();
  measure_distances();
  if (transition) laminar_ = laminar_zone(*this, *transition);
}

void FrictionMesh::count_cells() {
  around_.assign(mesh_.size(), {});
  quads_of_edge_.assign(mesh_.edges().size(), 0);
  edge_cells_.assign(2 * mesh_.edges().size(), no_index);
  const auto edge_between = [&](std::uint32_t a, std::uint32_t b) {
    for (const RingEntry& entry : mesh_.ring(a))
      if (entry.vertex == b) return entry.edge;
    return no_index;
  };
  for (std::uint32_t t = 0; t < mesh_.cells().size(); ++t) {
    const Cell& cell = mesh_.cells()[t];
    const std::uint32_t n = cell.corners();
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t v = mesh_.original(cell[i]);
      ++(n == 4 ? around_[v].quads : around_[v].triangles);
      const std::uint32_t e = edge_between(v, mesh_.original(cell[(i + 1) % n]));
      if (n == 4) ++quads_of_edge_[e];
      edge_cells_[2 * e + (edge_cells_[2 * e] == no_index ? 0 : 1)] = t;
    }
  }
  for (const BoundaryEdge& edge : mesh_.boundary())
    around_[edge.a].boundary = around_[edge.b].boundary = true;
}

// The other edge at v that has no cell in common with this one, where four cells of a layer meet, or two at
// its end.
const RingEntry* FrictionMesh::opposite(std::uint32_t v, std::uint32_t edge) const {
  const Around& at = around_[v];
  const bool is_inside = at.quads == 4 && at.triangles == 0 && !at.boundary;
  const bool is_end = at.quads == 2 && quads_of_edge_[edge] == 1;
  if (!is_inside && !is_end) return nullptr;
  const auto shares_cell = [&](std::uint32_t e, std::uint32_t f) {
    for (const std::uint32_t c : {edge_cells_[2 * e], edge_cells_[2 * e + 1]})
      if (c != no_index && mesh_.cells()[c].corners() == 4 &&
          (c == edge_cells_[2 * f] || c == edge_cells_[2 * f + 1]))
        return true;
    return false;
  };
  for (const RingEntry& entry : mesh_.ring(v)) {
    if (entry.edge == edge || shares_cell(edge, entry.edge)) continue;
    if (is_end && quads_of_edge_[entry.edge] != 1) continue;
    return &entry;
  }
  return nullptr;
}

void FrictionMesh::make_upwind() {
  upwind_start_.assign(1, 0);
  for (std::uint32_t e = 0; e < mesh_.edges().size(); ++e) {
    const DualEdge& edge = mesh_.edges()[e];
    const Point d = mesh_.vector(edge);
    for (std::size_t side = 0; side < 2; ++side) {
      const std::uint32_t here = side == 0 ? edge.a : edge.b, there = side == 0 ? edge.b : edge.a;
      const double sign = side == 0 ? 1.0 : -1.0;
      const RingEntry* behind = opposite(here, e);
      const Point back = behind == nullptr ? Point{} : mesh_.vector(mesh_.edges()[behind->edge]);
      const double ratio = behind == nullptr ? 0.0 : std::sqrt(dot(d, d) / dot(back, back));
      if (behind != nullptr && ratio <= largest_ratio) {
        upwind_.push_back({here, sign * ratio});
        upwind_.push_back({behind->vertex, -sign * ratio});
        kinds_.push_back({Upwind::opposite, behind->vertex, behind->edge});
      } else if (behind != nullptr || around_[here].triangles == 0 || mesh_.one_sided(here)) {
        upwind_.push_back({there, sign});
        upwind_.push_back({here, -sign});
        kinds_.push_back({Upwind::central});
      } else {
        kinds_.push_back({Upwind::gradient});
        double own = sign;
        for (const RingEntry& entry : mesh_.ring(here)) {
          const double weight = 2.0 * dot(entry.weight, d);
          own -= weight;
          upwind_.push_back({entry.vertex, weight - (entry.vertex == there ? sign : 0.0)});
        }
        upwind_.push_back({here, own});
      }
      upwind_start_.push_back(static_cast<std::uint32_t>(upwind_.size()));
    }
  }
}

void FrictionMesh::make_triangles() {
  std::set<std::pair<std::uint32_t, std::uint32_t>> outlets;
  for (const BoundaryEdge& edge : mesh_.boundary())
    if (mesh_.patch(edge).is_outlet()) outlets.insert(std::minmax(edge.place[0], edge.place[1]));
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, bool of_quad) {
    const std::array<PlaneVector<double>, 3> p = {mesh_.points()[a], mesh_.points()[b], mesh_.points()[c]};
    std::array<bool, 3> outlet = {};
    const auto is_outlet = [&](std::uint32_t from, std::uint32_t to) {
      return outlets.contains(std::minmax(from, to));
    };
    if (!outlets.empty()) outlet = {is_outlet(b, c), is_outlet(c, a), is_outlet(a, b)};
    triangles_.push_back({TriangleShape<double>(p, of_quad, outlet),
                          {mesh_.original(a), mesh_.original(b), mesh_.original(c)},
                          {a, b, c},
                          of_quad,
                          outlet});
  };
  for (const Cell& cell : mesh_.cells()) {
    const std::uint32_t n = cell.corners();
    if (n == 3)
      add(cell[0], cell[1], cell[2], false);
    else
      for (std::uint32_t i = 0; i < n; ++i) add(cell[i], cell[(i + 1) % n], cell[(i + 3) % n], true);
  }
}

void FrictionMesh::make_mean_gradients() {
  area_.assign(mesh_.size(), 0.0);
  mean_gradient_.assign(mesh_.ring_begin(mesh_.size()), {});
  for (const CornerTriangle& triangle : triangles_)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t v = triangle.corner[i];
      area_[v] += triangle.share[i];
      for (std::size_t k = 0; k < mesh_.ring(v).size(); ++k)
        for (std::size_t j = 0; j < 3; ++j)
          if (mesh_.ring(v)[k].vertex == triangle.corner[j]) {
            Point& weight = mean_gradient_[mesh_.ring_begin(v) + k];
            weight = weight + triangle.share[i] * Point{triangle.slope[j].x, triangle.slope[j].y};
          }
    }
  for (std::size_t v = 0; v < mesh_.size(); ++v)
    for (std::size_t k = mesh_.ring_begin(v); k < mesh_.ring_begin(v + 1); ++k)
      mean_gradient_[k] = (1.0 / area_[v]) * mean_gradient_[k];
}

// As often as fits into the mesh, either way.
std::vector<FrictionMesh::Turns> FrictionMesh::possible_turns() const {
  std::vector<Turns> turns = {{}};
  for (std::uint32_t j = 0; j < mesh_.periodic_pairs().size(); ++j) {
    const Point period = mesh_.periodic_pairs()[j].period;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Point p : mesh_.points()) {
      const double along = dot(p, period) / dot(period, period);
      low = std::min(low, along), high = std::max(high, along);
    }
    for (int k = 1; k <= static_cast<int>(std::ceil(high - low)); ++k)
      turns.push_back({j, k}), turns.push_back({j, -k});
  }
  return turns;
}

Point FrictionMesh::moved(std::size_t v, Turns turns) const {
  if (turns.count == 0) return mesh_.points()[v];
  return mesh_.points()[v] + static_cast<double>(turns.count) * mesh_.periodic_pairs()[turns.pair].period;
}

// The distance from every segment: exact, and quick beside one Jacobian. Moved places that are farther from
// the box of all walls than the nearest wall need no look.
void FrictionMesh::measure_distances() {
  distance_.assign(mesh_.size(), std::numeric_limits<double>::infinity());
  nearest_.assign(mesh_.size(), no_index);
  turns_.assign(mesh_.size(), {});
  std::vector<std::uint32_t> walls;
  Point low = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()},
        high = -1.0 * low;
  for (std::uint32_t e = 0; e < mesh_.boundary().size(); ++e) {
    const BoundaryEdge& edge = mesh_.boundary()[e];
    if (!mesh_.patch(edge).sticks()) continue;
    walls.push_back(e);
    for (const Point p : {mesh_.points()[edge.a], mesh_.points()[edge.b]}) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  const auto from_box = [&](Point p) {
    const double x = std::max({low.x - p.x, p.x - high.x, 0.0}),
                 y = std::max({low.y - p.y, p.y - high.y, 0.0});
    return x * x + y * y;
  };
  const std::vector<Turns> turns = possible_turns();
  for (std::size_t v = 0; v < mesh_.size(); ++v) {
    for (const Turns turn : turns) {
      const Point p = moved(v, turn);
      if (turn.count != 0 && from_box(p) >= distance_[v]) continue;
      for (const std::uint32_t e : walls) {
        const BoundaryEdge& edge = mesh_.boundary()[e];
        const double square = squared_distance_to_segment(p, mesh_.points()[edge.a], mesh_.points()[edge.b]);
        if (square < distance_[v]) distance_[v] = square, nearest_[v] = e, turns_[v] = turn;
      }
    }
    distance_[v] = sticks_[v] ? 0.0 : std::sqrt(distance_[v]);
  }
}

// The nearest place on a segment moves along it alone, or not at all.
void FrictionMesh::add_distance_slopes(const std::vector<double>& by_distance,
                                       std::vector<Point>& points) const {
  std::vector<Point> by_period(mesh_.periodic_pairs().size());
  for (std::size_t v = 0; v < mesh_.size(); ++v) {
    if (by_distance[v] == 0.0 || nearest_[v] == no_index || sticks_[v]) continue;
    const BoundaryEdge& edge = mesh_.boundary()[nearest_[v]];
    const Point p = nearest_from(v), a = mesh_.points()[edge.a], b = mesh_.points()[edge.b];
    const double t = nearest_part(p, a, b);
    const Point by = (by_distance[v] / distance_[v]) * (p - (a + t * (b - a)));
    points[v] = points[v] + by;
    points[edge.a] = points[edge.a] - (1.0 - t) * by, points[edge.b] = points[edge.b] - t * by;
    if (turns_[v].count != 0)
      by_period[turns_[v].pair] = by_period[turns_[v].pair] + static_cast<double>(turns_[v].count) * by;
  }
  for (std::size_t j = 0; j < by_period.size(); ++j)
    for (const std::uint32_t image : mesh_.periodic_pairs()[j].images) {
      const Point by = (1.0 / static_cast<double>(mesh_.periodic_pairs()[j].images.size())) * by_period[j];
      Point& original = points[mesh_.original(image)];
      points[image] = points[image] + by, original = original - by;
    }
}

}  // namespace remodel::flow
