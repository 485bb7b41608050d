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

// A boundary's vertices by ascending x, and its shortest edge.
struct Line {
  std::vector<std::uint32_t> vertices;
  double shortest = std::numeric_limits<double>::infinity();
  Point centre = {};
};

Line line_of(const std::string& name, std::span<const Point> points,
             const std::vector<FrozenBoundary>& boundaries) {
  Line line;
  for (const FrozenBoundary& boundary : boundaries) {
    if (boundary.name != name) continue;
    for (const auto& [a, b] : boundary.edges) {
      line.vertices.push_back(a), line.vertices.push_back(b);
      line.shortest = std::min(line.shortest, std::sqrt(squared_distance(points[a], points[b])));
    }
  }
  std::sort(line.vertices.begin(), line.vertices.end(), [&](std::uint32_t i, std::uint32_t j) {
    return points[i].x != points[j].x ? points[i].x < points[j].x : i < j;
  });
  line.vertices.erase(std::unique(line.vertices.begin(), line.vertices.end()), line.vertices.end());
  for (const std::uint32_t v : line.vertices)
    line.centre = line.centre + (1.0 / static_cast<double>(line.vertices.size())) * points[v];
  return line;
}

std::string text_of(Point p) {
  char text[64];
  std::snprintf(text, sizeof text, "(%.6g, %.6g)", p.x, p.y);
  return text;
}

// The vertex of the line at this place; no_index: there is none.
std::uint32_t vertex_at(Point p, const Line& line, std::span<const Point> points, double tolerance) {
  auto at = std::lower_bound(line.vertices.begin(), line.vertices.end(), p.x - tolerance,
                             [&](std::uint32_t v, double x) { return points[v].x < x; });
  for (; at != line.vertices.end() && points[*at].x <= p.x + tolerance; ++at)
    if (squared_distance(points[*at], p) <= tolerance * tolerance) return *at;
  return no_index;
}

}  // namespace

PeriodicVertices periodic_vertices(std::span<const Point> points,
                                   const std::vector<FrozenBoundary>& boundaries,
                                   const std::vector<Patch>& patches, const std::string& source) {
  constexpr double tolerance = 1e-4;  // of the shortest edge: files round coordinates
  PeriodicVertices found;
  for (const Patch& patch : patches) {
    const Periodic* pair = std::get_if<Periodic>(&patch.condition);
    if (pair == nullptr || pair->moved.empty()) continue;
    const std::string both = "the periodic boundaries '" + patch.name + "' and '" + pair->moved + "'";
    const Line first = line_of(patch.name, points, boundaries),
               moved = line_of(pair->moved, points, boundaries);
    for (const auto& [line, name] : {std::pair(&first, &patch.name), std::pair(&moved, &pair->moved)})
      if (line->vertices.empty())
        throw Error(ErrorCode::argument, source,
                    "found no boundary '" + *name + "', expected one of the name as a periodic boundary");
    if (first.vertices.size() != moved.vertices.size())
      throw Error(ErrorCode::argument, source,
                  both + " have " + std::to_string(first.vertices.size()) + " and " +
                      std::to_string(moved.vertices.size()) +
                      " vertices, expected one to be the other moved, vertex for vertex");
    const Point period = moved.centre - first.centre;
    if (found.original.empty()) {
      found.original.resize(points.size());
      std::iota(found.original.begin(), found.original.end(), 0U);
      found.counterpart = found.original;
      found.at.assign(points.size(), false);
    }
    const double near = tolerance * std::min(first.shortest, moved.shortest);
    for (const std::uint32_t v : first.vertices) {
      const Point place = points[v] + period;
      const std::uint32_t image = vertex_at(place, moved, points, near);
      if (image == no_index)
        throw Error(ErrorCode::argument, source,
                    both + " differ: found no vertex of the second at " + text_of(place) +
                        ", where the first one's point " + std::to_string(v) +
                        " comes to lie, expected one to be the other moved, vertex for vertex");
      if (found.at[v] || found.at[image])
        throw Error(ErrorCode::argument, source,
                    both + " meet another pair, or each other, at point " +
                        std::to_string(found.at[v] ? v : image) + ", expected boundaries apart");
      found.original[image] = found.counterpart[image] = v, found.counterpart[v] = image;
    }
    for (const Line* line : {&first, &moved})
      for (const std::uint32_t v : line->vertices) found.at[v] = true;
    found.periods.push_back(period);
  }
  return found;
}

}  // namespace remodel::flow
