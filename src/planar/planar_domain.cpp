#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "geometry/place_text.h"
#include "planar/arrangement.h"
#include "planar/chains.h"
#include "remodel/error.h"

namespace remodel {
namespace {

std::string name_of(int marker, LoopRole role) {
  if (marker != 0) return std::to_string(marker);
  return role == LoopRole::internal ? "internal" : "boundary";
}

// A closed chain begins where its marker changes, if it does.
void begin_at_a_change(Chain& chain) {
  const auto change = std::adjacent_find(chain.markers.begin(), chain.markers.end(), std::not_equal_to<>());
  if (!chain.closed() || change == chain.markers.end()) return;
  const auto shift = change - chain.markers.begin() + 1;
  std::rotate(chain.markers.begin(), chain.markers.begin() + shift, chain.markers.end());
  chain.vertices.pop_back();
  std::rotate(chain.vertices.begin(), chain.vertices.begin() + shift, chain.vertices.end());
  chain.vertices.push_back(chain.vertices.front());
}

Curve curve_through(std::string name, std::vector<Point>&& points) {
  const std::size_t pieces = points.size() - 1;
  Curve curve{.name = std::move(name),
              .shape = Line{points.front(), points.back()},
              .parameters = Parameters::uniform(pieces)};
  if (pieces > 1) curve.shape = Polyline{std::move(points)};
  return curve;
}

Loop loop_of(const Arrangement& arrangement, Chain& chain) {
  begin_at_a_change(chain);
  Loop loop{.role = !chain.domain_right  ? LoopRole::left
                    : !chain.domain_left ? LoopRole::right
                                         : LoopRole::internal,
            .curves = {},
            .open = !chain.closed()};
  const VertexId first = chain.vertices[0], second = chain.vertices[1];
  loop.region = chain.domain_left ? arrangement.region_on_left(first, second)
                                  : arrangement.region_on_left(second, first);
  if (loop.role == LoopRole::internal) loop.right_region = arrangement.region_on_left(second, first);
  for (std::size_t begin = 0, end = 0; begin < chain.markers.size(); begin = end) {
    while (end < chain.markers.size() && chain.markers[end] == chain.markers[begin]) ++end;
    std::vector<Point> points;
    for (std::size_t i = begin; i <= end; ++i) points.push_back(arrangement.point(chain.vertices[i]));
    loop.curves.push_back(curve_through(name_of(chain.markers[begin], loop.role), std::move(points)));
  }
  return loop;
}

void add_single_points(const PlanarGraph& graph, Arrangement& arrangement, Domain& domain) {
  std::set<VertexId> seen;
  for (const auto& [key, marker] : arrangement.edges()) seen.insert({key.first, key.second});
  for (std::size_t i = 0; i < graph.points.size(); ++i) {
    const VertexId v = arrangement.vertices()[i];
    if (!seen.insert(v).second) continue;
    if (!arrangement.domain_around(v)) {
      ++arrangement.findings.outside_points;
      continue;
    }
    const Point p = arrangement.point(v);
    domain.loops.push_back({.role = LoopRole::internal,
                            .curves = {{.name = "point", .shape = Line{p, p}, .parameters = {0.0}}},
                            .open = true});
  }
}

// The first end of the outline that is open, and the nearest vertex that it might have met. Empty if there is
// none.
std::string open_end(const Arrangement& arrangement) {
  std::map<VertexId, std::vector<VertexId>> neighbours;
  for (const auto& [key, marker] : arrangement.edges()) {
    neighbours[key.first].push_back(key.second);
    neighbours[key.second].push_back(key.first);
  }
  for (const auto& [end, along] : neighbours) {
    if (along.size() != 1) continue;
    const Point p = arrangement.point(end);
    std::string text = ": the outline is open at " + exact_text(p);
    double nearest = std::numeric_limits<double>::infinity();
    Point other;
    for (const auto& [v, unused] : neighbours)
      if (v != end && v != along.front() && squared_distance(arrangement.point(v), p) < nearest)
        other = arrangement.point(v), nearest = squared_distance(other, p);
    if (std::isfinite(nearest))
      text += ", " + rough_text(std::sqrt(nearest)) + " away from the point at " + exact_text(other);
    return text;
  }
  return {};
}

}  // namespace

Domain planar_domain(const PlanarGraph& graph, const std::string& source, Crossings crossings,
                     PlanarFindings* findings, double join) {
  require_join(join);
  if (graph.points.size() < 3 || graph.segments.size() < 3)
    throw Error(ErrorCode::geometry, source,
                "found " + std::to_string(graph.points.size()) + " points and " +
                    std::to_string(graph.segments.size()) + " segments, expected at least 3 of both");
  Arrangement arrangement(graph, source, crossings, join);
  Domain domain;
  bool encloses = false;
  for (Chain& chain : link_chains(arrangement)) {
    encloses |= chain.domain_left || chain.domain_right;
    domain.loops.push_back(loop_of(arrangement, chain));
  }
  if (!encloses)
    throw Error(ErrorCode::geometry, source,
                std::string("the segments enclose nothing") + (graph.holes.empty() ? "" : " but holes") +
                    open_end(arrangement) + ", expected a closed outline around the area to mesh");
  add_single_points(graph, arrangement, domain);
  if (findings != nullptr) *findings = arrangement.findings;
  return domain;
}

}  // namespace remodel
