#include "flow/potential/trailing_edge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace remodel::flow {

namespace {

double distance(Point a, Point b) {
  return std::hypot(b.x - a.x, b.y - a.y);
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

struct Sample {
  std::size_t index;
  double distance;  // from the edge, of the mean over the vertex's hat function
  double towards;   // 1 or -1: the sign of a clockwise speed towards the edge; that of A and B too
};

// At most per_side of each side, as many of both, farther from the base than twice its width.
std::vector<Sample> samples_near(std::span<const Point> body, std::size_t base, std::size_t per_side) {
  const std::size_t n = body.size(), most = (n - base) / 2;
  const double nearest = 2.0 * distance(body[0], body[base - 1]);
  std::array<std::vector<Sample>, 2> sides;
  for (const bool clockwise : {true, false}) {
    const auto at = [&](std::size_t k) { return clockwise ? (base - 1 + k) % n : (n - k) % n; };
    std::vector<Sample>& samples = sides[clockwise ? 0 : 1];
    double walked = 0.0;
    for (std::size_t k = 1; k <= most && samples.size() < per_side; ++k) {
      const double inner = distance(body[at(k - 1)], body[at(k)]);
      const double outer = distance(body[at(k)], body[at(k + 1)]);
      walked += inner;
      if (walked >= nearest)
        samples.push_back({at(k), walked + (outer - inner) / 3.0, clockwise ? -1.0 : 1.0});
    }
  }
  const std::size_t both = std::min(sides[0].size(), sides[1].size());
  sides[0].resize(both);
  sides[0].insert(sides[0].end(), sides[1].begin(), sides[1].begin() + static_cast<std::ptrdiff_t>(both));
  return sides[0];
}

// In the fluid, between the surfaces beside the base.
double fluid_angle(std::span<const Point> body, std::size_t base) {
  const Point lower = body[base % body.size()] - body[base - 1], upper = body[body.size() - 1] - body[0];
  const double angle = std::atan2(cross(upper, lower), dot(upper, lower));
  return 2.0 * std::numbers::pi - std::max(angle, 0.0);
}

using Matrix3 = std::array<std::array<double, 3>, 3>;

// The first row of the inverse of a symmetric matrix.
std::array<double, 3> first_row_of_inverse(const Matrix3& m) {
  const double c0 = m[1][1] * m[2][2] - m[1][2] * m[2][1];
  const double c1 = m[1][2] * m[2][0] - m[1][0] * m[2][2];
  const double c2 = m[1][0] * m[2][1] - m[1][1] * m[2][0];
  const double determinant = m[0][0] * c0 + m[0][1] * c1 + m[0][2] * c2;
  return {c0 / determinant, c1 / determinant, c2 / determinant};
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
    const double width = distance(body[upper], body[lower]), x = 0.5 * (body[upper].x + body[lower].x);
    if (width > widest * outline || (found && x <= downstream)) continue;
    found = {upper, (lower + body.size() - upper) % body.size() + 1};
    downstream = x;
  }
  return found;
}

std::vector<std::pair<std::size_t, double>> kutta_weights(std::span<const Point> body, std::size_t base) {
  constexpr std::size_t per_side = 4;
  const std::vector<Sample> samples = samples_near(body, base, per_side);
  std::vector<std::pair<std::size_t, double>> weights;
  if (samples.size() < 4) {  // equal speeds at the edge's neighbours
    return {{base % body.size(), 1.0}, {body.size() - 1, 1.0}};
  }
  double longest = 0.0;
  for (const Sample& sample : samples) longest = std::max(longest, sample.distance);
  const double power = std::numbers::pi / fluid_angle(body, base);
  std::vector<std::array<double, 3>> rows;
  Matrix3 normal{};
  for (const Sample& sample : samples) {
    const double s = sample.distance / longest;
    rows.push_back({sample.towards * std::pow(s, power - 1.0), std::pow(s, 2.0 * power - 1.0),
                    sample.towards * std::pow(s, 3.0 * power - 1.0)});
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) normal[i][k] += rows.back()[i] * rows.back()[k];
  }
  const std::array<double, 3> row = first_row_of_inverse(normal);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double weight = row[0] * rows[i][0] + row[1] * rows[i][1] + row[2] * rows[i][2];
    weights.emplace_back(samples[i].index, samples[i].towards * weight);
  }
  return weights;
}

}  // namespace remodel::flow
