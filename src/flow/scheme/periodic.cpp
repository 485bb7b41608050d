#include "flow/scheme/periodic.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <utility>

#include "remodel/error.h"

namespace remodel::flow {

namespace {

constexpr double tolerance = 1e-4;  // of the shortest edge: files round coordinates

// A boundary's vertices by ascending x, and its shortest edge.
struct Line {
  std::vector<std::uint32_t> vertices;
  double shortest = std::numeric_limits<double>::infinity();
};

Line line_of(const std::string& name, std::span<const Point> points,
             const std::vector<FrozenBoundary>& boundaries, const std::string& source) {
  Line line;
  for (const FrozenBoundary& boundary : boundaries) {
    if (boundary.name != name) continue;
    for (const auto& [a, b] : boundary.edges) {
      line.vertices.push_back(a), line.vertices.push_back(b);
      line.shortest = std::min(line.shortest, std::sqrt(squared_distance(points[a], points[b])));
    }
  }
  if (line.vertices.empty())
    throw Error(ErrorCode::argument, source,
                "found no boundary '" + name + "', expected one of the name as a periodic boundary");
  std::sort(line.vertices.begin(), line.vertices.end(), [&](std::uint32_t i, std::uint32_t j) {
    return points[i].x != points[j].x ? points[i].x < points[j].x : i < j;
  });
  line.vertices.erase(std::unique(line.vertices.begin(), line.vertices.end()), line.vertices.end());
  return line;
}

// Medians of coordinates: a vertex that is elsewhere does not move them far.
Point middle_of(const Line& line, std::span<const Point> points) {
  std::vector<double> x, y;
  for (const std::uint32_t v : line.vertices) x.push_back(points[v].x), y.push_back(points[v].y);
  const auto half = static_cast<std::ptrdiff_t>(x.size() / 2);
  std::nth_element(x.begin(), x.begin() + half, x.end());
  std::nth_element(y.begin(), y.begin() + half, y.end());
  return {x[x.size() / 2], y[y.size() / 2]};
}

std::string text_of(Point p) {
  char text[64];
  std::snprintf(text, sizeof text, "(%.6g, %.6g)", p.x, p.y);
  return text;
}

// The vertex of the line at this place; no_index: there is none.
std::uint32_t vertex_at(Point p, const Line& line, std::span<const Point> points, double distance) {
  auto at = std::lower_bound(line.vertices.begin(), line.vertices.end(), p.x - distance,
                             [&](std::uint32_t v, double x) { return points[v].x < x; });
  for (; at != line.vertices.end() && points[*at].x <= p.x + distance; ++at)
    if (squared_distance(points[*at], p) <= distance * distance) return *at;
  return no_index;
}

// Where both boundaries of two pairs meet their vertices are the same by either.
bool may_pair(const PeriodicVertices& found, std::uint32_t v, std::uint32_t image) {
  const auto free_for = [&](std::uint32_t one, std::uint32_t other) {
    return found.counterpart[one] == one || found.counterpart[one] == other;
  };
  return v != image && free_for(v, image) && free_for(image, v);
}

PeriodicPairing paired(const Line& first, const Line& moved, std::span<const Point> points,
                       const std::string& names, const std::string& source, PeriodicVertices& found) {
  if (first.vertices.size() != moved.vertices.size())
    throw Error(ErrorCode::argument, source,
                names + " have " + std::to_string(first.vertices.size()) + " and " +
                    std::to_string(moved.vertices.size()) +
                    " vertices, expected one to be the other moved, vertex for vertex");
  const Point period = middle_of(moved, points) - middle_of(first, points);
  const double near = tolerance * std::min(first.shortest, moved.shortest);
  PeriodicPairing pair{.names = names, .period = period, .images = {}};
  for (const std::uint32_t v : first.vertices) {
    const Point place = points[v] + period;
    const std::uint32_t image = vertex_at(place, moved, points, near);
    if (image == no_index)
      throw Error(ErrorCode::argument, source,
                  names + " differ: found no vertex of the second at " + text_of(place) +
                      ", where the first one's point " + std::to_string(v) +
                      " comes to lie, expected one to be the other moved, vertex for vertex");
    if (!may_pair(found, v, image))
      throw Error(ErrorCode::argument, source,
                  names + " meet another pair, or each other, at point " + std::to_string(v) +
                      ", expected boundaries apart");
    if (found.counterpart[v] == image) continue;  // by another pair
    found.original[image] = found.counterpart[image] = v, found.counterpart[v] = image;
    pair.images.push_back(image);
  }
  return pair;
}

}  // namespace

void PeriodicVertices::move(std::span<const Point> points, const std::string& source) {
  constexpr double part_of_period = 1e-5;
  for (PeriodicPairing& pair : pairs) {
    const double part = 1.0 / static_cast<double>(pair.images.size());
    pair.period = {};
    for (const std::uint32_t image : pair.images)
      pair.period = pair.period + part * (points[image] - points[original[image]]);
    for (const std::uint32_t image : pair.images) {
      const Point off = points[image] - points[original[image]] - pair.period;
      if (dot(off, off) <= part_of_period * part_of_period * dot(pair.period, pair.period)) continue;
      throw Error(ErrorCode::argument, source,
                  pair.names + " differ at points " + std::to_string(original[image]) + " and " +
                      std::to_string(image) + ", expected one to be the other moved");
    }
  }
}

PeriodicVertices periodic_vertices(std::span<const Point> points,
                                   const std::vector<FrozenBoundary>& boundaries,
                                   const std::vector<Patch>& patches, const std::string& source) {
  PeriodicVertices found;
  for (const Patch& patch : patches) {
    const Periodic* of = std::get_if<Periodic>(&patch.condition);
    if (of == nullptr || of->moved.empty()) continue;
    if (found.original.empty()) {
      found.original.resize(points.size());
      std::iota(found.original.begin(), found.original.end(), 0U);
      found.counterpart = found.original;
    }
    PeriodicPairing pair = paired(
        line_of(patch.name, points, boundaries, source), line_of(of->moved, points, boundaries, source),
        points, "the periodic boundaries '" + patch.name + "' and '" + of->moved + "'", source, found);
    if (!pair.images.empty()) found.pairs.push_back(std::move(pair));
  }
  found.move(points, source);
  return found;
}

}  // namespace remodel::flow
