#include "flow/potential/trailing_edge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace remodel::flow {

namespace {

// From a to b, of length 1.
Point direction(Point a, Point b) {
  return (1.0 / distance(a, b)) * (b - a);
}

// Of the body at corner i, radians: in [0, 2 pi).
double corner_angle(std::span<const Point> body, std::size_t i) {
  const std::size_t n = body.size();
  const Point to_next = body[(i + 1) % n] - body[i];
  const Point to_last = body[(i + n - 1) % n] - body[i];
  // Clockwise, the body is on the right: from the last side to the next one, counter-clockwise.
  const double angle = std::atan2(cross(to_last, to_next), dot(to_last, to_next));
  return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle;
}

// In the fluid, between the surfaces beside the base.
double fluid_angle(Point upper, Point lower) {
  const double angle = std::atan2(cross(upper, lower), dot(upper, lower));
  return 2.0 * std::numbers::pi - std::max(angle, 0.0);
}

double second_integral(double s, double power) {
  return std::pow(std::abs(s), power + 2.0) / ((power + 1.0) * (power + 2.0));
}

// The integral of s^power against a function of s that is 1 up to `from` and falls to 0 at `to`.
double integral_falling(double from, double to, double power) {
  return (second_integral(to, power) - second_integral(from, power)) / (to - from);
}

// A side of the body, walked from its corner at the trailing edge.
struct EdgeSide {
  std::vector<std::size_t> vertices;  // the corner first
  std::vector<double> s;              // how far each is ahead of the middle of the base, along the side
};

EdgeSide side_of(std::span<const Point> body, std::size_t base, bool clockwise, Point middle, Point along) {
  const std::size_t n = body.size(), corner = clockwise ? base - 1 : 0;
  EdgeSide side{{corner}, {dot(body[corner] - middle, along)}};
  for (std::size_t k = 1; k <= n - base; ++k) {
    side.vertices.push_back(clockwise ? (corner + k) % n : n - k);
    side.s.push_back(side.s.back() + distance(body[side.vertices[k - 1]], body[side.vertices[k]]));
  }
  return side;
}

}  // namespace

std::optional<TrailingEdge> trailing_edge(std::span<const Point> body) {
  constexpr double sharp = std::numbers::pi / 3.0, corner = 0.75 * std::numbers::pi, widest = 0.03;
  std::optional<TrailingEdge> found;
  std::vector<std::size_t> corners;
  double outline = 0.0;
  for (std::size_t i = 0; i < body.size(); ++i) {
    const double angle = corner_angle(body, i);
    outline += distance(body[i], body[(i + 1) % body.size()]);
    if (angle < corner) corners.push_back(i);
    if (angle < sharp && (!found || body[i].x > body[found->first].x)) found = {i, 1};
  }
  if (found) return found;
  double downstream = 0.0;
  for (std::size_t k = 0; corners.size() > 1 && k < corners.size(); ++k) {
    const std::size_t upper = corners[k], lower = corners[(k + 1) % corners.size()];
    const std::size_t count = (lower + body.size() - upper) % body.size() + 1;
    double width = 0.0;
    for (std::size_t i = upper; i != lower; i = (i + 1) % body.size())
      width += distance(body[i], body[(i + 1) % body.size()]);
    const double x = 0.5 * (body[upper].x + body[lower].x);
    if (width > widest * outline || (found && x <= downstream)) continue;
    found = {upper, count};
    downstream = x;
  }
  return found;
}

Point edge_direction(std::span<const Point> body, std::size_t base) {
  const Point lower = direction(body[base % body.size()], body[base - 1]);
  const Point upper = direction(body.back(), body.front());
  return direction({}, lower + upper);
}

bool edge_faces_downstream(std::span<const Point> body, Point stream) {
  constexpr double sharpest_round = 2.0 * std::numbers::pi / 3.0;
  const auto leaves_at = [&](const TrailingEdge& edge) {
    std::vector<Point> turned(body.begin(), body.end());
    std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(edge.first), turned.end());
    return dot(edge_direction(turned, edge.count), stream) >= least_cosine;
  };
  for (std::size_t i = 0; i < body.size(); ++i)
    if (corner_angle(body, i) < sharpest_round && leaves_at({i, 1})) return true;
  const auto edge = trailing_edge(body);
  return edge && leaves_at(*edge);
}

KuttaCondition kutta_condition(std::span<const Point> body, std::size_t base) {
  constexpr double widths = 2.0;
  const std::size_t n = body.size();
  const Point lower = body[base - 1], upper = body[0];
  const Point to_lower = direction(lower, body[base % n]), to_upper = direction(upper, body[n - 1]);
  const Point along = -1.0 * edge_direction(body, base), middle = 0.5 * (lower + upper);
  const double power = 2.0 * std::numbers::pi / fluid_angle(to_upper, to_lower) - 1.0;

  KuttaCondition condition;
  for (std::size_t i = 0; i < base; ++i) condition.terms.push_back({i, 1.0});
  double rest = 0.0, speeds = 0.0;
  for (const double sign : {-1.0, 1.0}) {  // clockwise is away from the edge below it and towards it above
    const EdgeSide side = side_of(body, base, sign < 0.0, middle, along);
    const std::size_t most = std::max<std::size_t>(1, (n - base) / 2);
    std::size_t k = 1;
    for (; k < most && side.s[k] < widths * distance(lower, upper); ++k)
      condition.terms.push_back({side.vertices[k], 1.0});
    const double falling = integral_falling(side.s[k - 1], side.s[k], power);
    rest += sign * falling;
    // The neighbour's hat; where it is the last vertex before the base, that of its first half.
    const double next = side.s[std::min(k + 1, side.s.size() - 1)];
    const double hat = next > side.s[k] ? integral_falling(side.s[k], next, power) - falling : falling;
    speeds += hat;
    condition.beside[sign < 0.0 ? 0 : 1] = side.vertices[k];
    condition.weights_beside[sign < 0.0 ? 0 : 1] = 1.0 / hat;
  }
  condition.terms.push_back({condition.beside[0], rest / speeds});
  condition.terms.push_back({condition.beside[1], -rest / speeds});
  return condition;
}

}  // namespace remodel::flow
