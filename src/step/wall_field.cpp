#include "step/wall_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace remodel {

namespace {

Point product(Point a, Point b) {  // of complex numbers
  return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
}

Point conjugate(Point a) {
  return {a.x, -a.y};
}

// The complex quotient a / b, zero for b = 0.
Point quotient(Point a, Point b) {
  const double squared = dot(b, b);
  return squared > 0.0 ? (1.0 / squared) * product(a, conjugate(b)) : Point{};
}

std::vector<WallField::Run> runs_of(const MeshData& mesh, std::span<const std::size_t> moving,
                                    std::span<const Point> points) {
  const auto at = [&](std::uint32_t k) {
    return points.empty() ? mesh.point(k) : points[mesh.at(k).vertex.index];
  };
  std::vector<WallField::Run> runs;
  for (std::size_t loop = 0; loop < mesh.loop_heads.size(); ++loop) {
    const std::uint32_t head = mesh.loop_heads[loop];
    WallField::Run& run = runs.emplace_back();
    run.moving = std::ranges::binary_search(moving, loop);
    mesh.walk_edges(head, [&](std::uint32_t k, std::uint32_t next) {
      const Point from = at(k), to = at(next);
      run.edges.push_back(
          {mesh.at(k).vertex, mesh.at(next).vertex, from, to, std::sqrt(squared_distance(from, to))});
    });
    if (run.edges.empty()) {
      const VertexId v = mesh.at(head).vertex;
      run.edges.push_back({v, v, at(head), at(head), mesh.length_scale(head)});
    }
  }
  return runs;
}

}  // namespace

WallField::WallField(const MeshData& mesh, std::span<const std::size_t> moving, std::span<const Point> points)
    : WallField(runs_of(mesh, moving, points)) {}

WallField::WallField(const std::vector<Run>& runs) {
  double extent = 0.0, length = 0.0;  // squared; of all moving edges
  for (const Run& run : runs) {
    const auto first = static_cast<std::uint32_t>(edges_.size());
    edges_.insert(edges_.end(), run.edges.begin(), run.edges.end());
    moving_.resize(edges_.size(), run.moving);
    add_nodes(first, static_cast<std::uint32_t>(edges_.size()));
    if (!run.moving) continue;
    Box box;
    for (const Edge& edge : run.edges) {
      box.add(edge.from), box.add(edge.to);
      length += edge.length;
    }
    box_.add(box);
    // A single point has its length scale for an extent; no edge is longer than its loop's.
    const double first_length = run.edges.front().length;
    extent = std::max({extent, squared_distance(box.low, box.high), first_length * first_length});
  }
  affine_.resize(nodes_.size());
  of_edges_.resize(edges_.size());
  const double reach = radius * std::sqrt(extent);
  least_ = 0.5 * std::numbers::pi / (reach * reach * reach);
  // Edges at the distance d or more have weights of length / d^4 at most.
  squared_reach_ = std::sqrt(length / least_);
}

// The depth of the recursion is the logarithm of the number of edges.
void WallField::add_nodes(std::uint32_t first, std::uint32_t last) {
  const std::size_t n = nodes_.size();
  Node node;
  node.first = first, node.last = last, node.moving = moving_[first];
  for (std::uint32_t i = first; i < last; ++i) {
    node.centre = node.centre + 0.5 * edges_[i].length * (edges_[i].from + edges_[i].to);
    node.length += edges_[i].length;
  }
  node.centre = (1.0 / node.length) * node.centre;
  nodes_.push_back(node);
  if (last - first > 1) {
    double reach = 0.0;  // squared
    for (std::uint32_t i = first; i < last; ++i)
      for (const Point p : {edges_[i].from, edges_[i].to})
        reach = std::max(reach, squared_distance(p, node.centre));
    nodes_[n].near = reach / (opening * opening);
    const std::uint32_t middle = first + (last - first) / 2;
    add_nodes(first, middle);
    add_nodes(middle, last);
  }
  nodes_[n].after = static_cast<std::uint32_t>(nodes_.size());
}

void WallField::set(std::size_t edge, Point a, Point b) {
  const Edge& e = edges_[edge];
  const Point slope = quotient(b - a, e.to - e.from);
  const Point middle = 0.5 * (e.from + e.to);
  of_edges_[edge] = {0.5 * (a + b) - product(slope, middle), slope};
}

void WallField::gather() {
  for (std::size_t n = nodes_.size(); n-- > 0;) {
    const Node& node = nodes_[n];
    if (!node.moving) continue;
    if (node.last - node.first == 1) {
      const Affine& of_edge = of_edges_[node.first];
      affine_[n] = {node.length * of_edge.constant, node.length * of_edge.slope};
      continue;
    }
    const Affine &a = affine_[n + 1], &b = affine_[nodes_[n + 1].after];
    affine_[n] = {a.constant + b.constant, a.slope + b.slope};
  }
}

// To the nearest point of the edge: so that the field goes over into the wall's displacement, however near x
// is.
double WallField::squared_distance_to(const Edge& edge, Point x) {
  const Point along = edge.to - edge.from, from = x - edge.from;
  const double squared_length = dot(along, along);
  const double share = squared_length > 0.0 ? std::clamp(dot(from, along) / squared_length, 0.0, 1.0) : 0.0;
  const Point off = from - share * along;
  return dot(off, off);
}

bool WallField::beyond_reach(Point x) const {
  return box_.squared_distance(x) > squared_reach_;
}

template <class Visit>
double WallField::see(Point x, Visit visit) const {
  constexpr double tiny = 1e-60;  // only keeps the weight finite
  double all = 0.0, moving = 0.0;
  const auto count = static_cast<std::uint32_t>(nodes_.size());
  for (std::uint32_t n = 0; n < count;) {
    const Node& node = nodes_[n];
    double squared = squared_distance(x, node.centre);
    if (squared < node.near) {
      ++n;
      continue;
    }
    if (node.near == 0.0) squared = squared_distance_to(edges_[node.first], x);
    const double inverse = 1.0 / std::max(squared, tiny);
    const double weight = inverse * inverse;
    all += weight * node.length;
    if (node.moving) {
      moving += weight * node.length;
      visit(n, weight);
    }
    n = node.after;
  }
  if (!(moving > least_)) return 0.0;
  const double fade = 1.0 - least_ / moving;
  return fade * fade / all;
}

Point WallField::at(Point x) const {
  if (beyond_reach(x)) return {};
  Affine sum;
  const double factor = see(x, [&](std::uint32_t n, double weight) {
    sum.constant = sum.constant + weight * affine_[n].constant;
    sum.slope = sum.slope + weight * affine_[n].slope;
  });
  return factor == 0.0 ? Point{} : factor * (sum.constant + product(sum.slope, x));
}

void WallField::look(Point x, std::vector<Sight>& sights) const {
  if (beyond_reach(x)) return;
  const std::size_t first = sights.size();
  const double factor = see(x, [&](std::uint32_t n, double weight) { sights.push_back({n, weight}); });
  if (factor == 0.0) sights.resize(first);
  for (std::size_t i = first; i < sights.size(); ++i) sights[i].weight *= factor;
}

Point WallField::at(Point x, std::span<const Sight> sights) const {
  Affine sum;
  for (const Sight& sight : sights) {
    sum.constant = sum.constant + sight.weight * affine_[sight.node].constant;
    sum.slope = sum.slope + sight.weight * affine_[sight.node].slope;
  }
  return sum.constant + product(sum.slope, x);
}

void WallField::pull(Point x, Point by_displacement) {
  if (beyond_reach(x)) return;
  const double factor = see(x, [](std::uint32_t, double) {});
  if (factor == 0.0) return;
  const Point by_constant = factor * by_displacement;
  const Point by_slope = product(by_constant, conjugate(x));
  see(x, [&](std::uint32_t n, double weight) {
    affine_[n].constant = affine_[n].constant + weight * by_constant;
    affine_[n].slope = affine_[n].slope + weight * by_slope;
  });
}

// The transpose of gather(): from the nodes down to the edges.
void WallField::spread() {
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const Node& node = nodes_[n];
    if (!node.moving) continue;
    const Affine by_node = affine_[n];
    if (node.last - node.first == 1) {
      of_edges_[node.first] = {node.length * by_node.constant, node.length * by_node.slope};
      continue;
    }
    for (const std::size_t child : {n + 1, std::size_t{nodes_[n + 1].after}}) {
      affine_[child].constant = affine_[child].constant + by_node.constant;
      affine_[child].slope = affine_[child].slope + by_node.slope;
    }
  }
}

// The transpose of set().
std::pair<Point, Point> WallField::ends(std::size_t edge) const {
  const Edge& e = edges_[edge];
  const Affine& by = of_edges_[edge];
  const Point middle = 0.5 * (e.from + e.to);
  const Point by_slope = by.slope - product(conjugate(middle), by.constant);
  const Point turned = quotient({1.0, 0.0}, e.to - e.from);
  const Point by_difference = product(conjugate(turned), by_slope);
  return {0.5 * by.constant - by_difference, 0.5 * by.constant + by_difference};
}

}  // namespace remodel
