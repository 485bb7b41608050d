#include "planar/arrangement.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "geometry/place_text.h"
#include "planar/join_points.h"
#include "remodel/error.h"
#include "remodel/predicates.h"
#include "triangulation/coarse_to_fine.h"

namespace remodel {
namespace {

using Rational = boost::multiprecision::cpp_rational;

// A crossing takes its place in memory: what crosses everywhere is refused in order.
constexpr std::size_t most_vertices = 10'000'000;

[[noreturn]] void refuse(const std::string& source, const std::string& problem) {
  throw Error(ErrorCode::geometry, source, problem);
}

}  // namespace

Arrangement::Arrangement(const PlanarGraph& graph, std::string source, Crossings crossings, double join)
    : graph_(graph), source_(std::move(source)), policy_(crossings) {
  const double extent = extent_of(graph.points);
  findings.joins.tolerance = join * extent;
  snap_ = std::max(join, default_join) * extent;
  insert_points();
  for (std::size_t i = 0; i < graph.segments.size(); ++i) {
    const PlanarGraph::Segment& segment = graph.segments[i];
    if (std::max(segment.from, segment.to) >= vertices_.size())
      refuse(source_, name_of_segment(i) + " ends at a point that is not there");
    const VertexId a = vertices_[segment.from], b = vertices_[segment.to];
    if (a == b)
      ++findings.empty_segments;
    else
      insert_segment({a, b, segment.marker, i});
  }
  mark_outside();
  mark_regions();
}

void Arrangement::insert_points() {
  for (std::size_t i = 0; i < graph_.points.size(); ++i)
    if (!safe_for_predicates(graph_.points[i]))
      refuse(source_, "point " + std::to_string(i) + " is " + exact_text(graph_.points[i]) +
                          ", expected coordinates that are 0 or of magnitude 1e-60 to 1e60");
  const std::vector<Point> points = joined_places(graph_.points, findings.joins);
  const auto second = std::find_if(points.begin(), points.end(), [&](Point p) { return !(p == points[0]); });
  const auto third =
      std::find_if(second, points.end(), [&](Point p) { return orient2d(points[0], *second, p) != 0; });
  if (third == points.end())
    refuse(source_, "all points lie on one line, expected a graph that encloses an area");
  triangulation_.start(points[0], *second, *third);
  vertices_.resize(points.size());
  VertexId last{1};
  std::size_t inserted = 3;
  for (const std::size_t i : coarse_to_fine(points.size())) {
    if (i > 0) last = vertices_[i & (i - 1)];
    last = vertices_[i] = triangulation_.insert(points[i], triangulation_.star(last).triangle).vertex;
    ++inserted;
  }
  findings.duplicate_points = inserted - 3 - triangulation_.vertex_count() - findings.joins.count;
  first_crossing_ = triangulation_.vertex_slots();
}

void Arrangement::insert_segment(Piece segment) {
  todo_.push_back(segment);
  while (!todo_.empty()) {
    const Piece piece = todo_.back();
    todo_.pop_back();
    if (piece.from == piece.to) continue;  // a crossing that was rounded to an end
    if (const VertexId near = vertex_near(piece); near) {
      count_as_joined(piece, near);
      route(piece, near);
      continue;
    }
    const ConstrainResult result = triangulation_.constrain(piece.from, piece.to);
    switch (result.kind) {
      case ConstrainResult::Kind::done:
        add(piece);
        break;
      case ConstrainResult::Kind::vertex:
        route(piece, result.first);
        break;
      case ConstrainResult::Kind::blocked:
        cross(piece, result.first, result.second);
        break;
    }
  }
}

void Arrangement::route(const Piece& piece, VertexId through) {
  ++findings.points_on_segments;
  todo_.push_back({through, piece.to, piece.marker, piece.segment});
  todo_.push_back({piece.from, through, piece.marker, piece.segment});
}

// A segment that misses a point of the graph by rounding, and is led through it. (Beside crossings it is
// their own rounding.)
void Arrangement::count_as_joined(const Piece& piece, VertexId through) {
  if (through.index >= first_crossing_) return;
  const Point a = point(piece.from), along = point(piece.to) - a;
  const double distance = std::abs(remodel::cross(along, point(through) - a)) / std::sqrt(dot(along, along));
  Joins& joins = findings.joins;
  if (joins.count++ == 0)
    joins.first =
        name_of_segment(piece.segment) + " with the point at " + exact_text(point(through)) + " beside it";
  joins.largest = std::max(joins.largest, distance);
}

// Whether v is so near to the open segment that no mesh could go between. The detour is so flat that both of
// its parts are shorter than the segment: detours end.
bool Arrangement::is_near(VertexId v, VertexId from, VertexId to) const {
  if (v == infinite_vertex || v == from || v == to) return false;
  const Point a = point(from), along = point(to) - a, p = point(v) - a;
  const double length = dot(along, along), projection = dot(p, along), across = remodel::cross(along, p);
  return std::abs(across) < 0.01 * std::min(projection, length - projection) &&
         across * across < snap_ * snap_ * length;
}

// A vertex near to the piece among those of the triangles that it passes, up to the first constrained edge:
// what lies behind is looked at when the crossing with that has been made.
VertexId Arrangement::vertex_near(const Piece& piece) const {
  const Point a = point(piece.from), b = point(piece.to);
  const auto side = [&](VertexId v) { return v == infinite_vertex ? 0 : orient2d(a, b, point(v)); };
  const Corner first = triangulation_.star(piece.from);
  Corner c = first;
  for (;;) {
    const VertexId right = triangulation_.following(c), left = triangulation_.preceding(c);
    if (right == piece.to || left == piece.to) return {};
    if (right != infinite_vertex && left != infinite_vertex && side(right) < 0 && side(left) > 0) break;
    c = triangulation_.counterclockwise(c);
    if (c.triangle == first.triangle) return {};  // it leaves through a vertex
  }
  for (;;) {
    for (const VertexId v : {triangulation_.following(c), triangulation_.preceding(c)})
      if (is_near(v, piece.from, piece.to)) return v;
    const Link link = triangulation_.link(c);
    const VertexId apex = triangulation_.apex(link);
    const int s = side(apex);
    if (link.constrained() || apex == piece.to || s == 0) return {};
    c = {link.triangle(), s > 0 ? next3(link.corner()) : previous3(link.corner())};
  }
}

void Arrangement::add(const Piece& piece) {
  const auto [place, is_new] = edges_.emplace(undirected(piece.from, piece.to), piece.marker);
  if (is_new) {
    segment_of_[place->first] = piece.segment;
  } else {
    ++findings.overlaps;
    if (place->second == 0) place->second = piece.marker;
  }
}

// Both are given up, and come back in two pieces each. The rounded point may lie beside both of them: what
// the pieces cross then is found when they are inserted.
void Arrangement::cross(const Piece& piece, VertexId first, VertexId second) {
  const Key key = undirected(first, second);
  const int marker = edges_.at(key);
  const std::size_t segment = segment_of_.at(key);
  const Point p = crossing_of(piece, first, second);
  if (policy_ == Crossings::refuse)
    refuse(source_, name_of_segment(piece.segment) + " and " + name_of_segment(segment) + " cross at " +
                        exact_text(p) + ", expected segments that meet at their ends only");
  if (triangulation_.vertex_count() >= most_vertices)
    refuse(source_, "more than 10 million points and crossings found");
  ++findings.crossings;
  triangulation_.release(first, second);
  edges_.erase(key);
  const VertexId v = vertex_at(p, first);
  todo_.push_back({piece.from, v, piece.marker, piece.segment});
  todo_.push_back({v, piece.to, piece.marker, piece.segment});
  todo_.push_back({first, v, marker, segment});
  todo_.push_back({v, second, marker, segment});
}

// A vertex at p, or one so near that no mesh could go between: where three segments meet in one point, their
// crossings differ by rounding. Segments that are as near to a new vertex are led through it.
VertexId Arrangement::vertex_at(Point p, VertexId near) {
  const Location location = triangulation_.locate(p, triangulation_.star(near).triangle);
  VertexId best;
  double distance = snap_ * snap_;
  const auto consider = [&](VertexId v) {
    if (v != infinite_vertex && squared_distance(point(v), p) < distance)
      distance = squared_distance(point(v), p), best = v;
  };
  for (const VertexId v : triangulation_[location.triangle].vertex) consider(v);
  for (const Link link : triangulation_[location.triangle].link) consider(triangulation_.apex(link));
  if (best) return best;
  const auto [v, is_new] = triangulation_.insert(p, location.triangle);
  if (!is_new) return v;
  split_edge_at(v);
  lead_through(v);
  return v;
}

void Arrangement::lead_through(VertexId v) {
  std::vector<Key> near;
  triangulation_.for_each_corner(v, [&](Corner c) {
    const VertexId a = triangulation_.following(c), b = triangulation_.preceding(c);
    if (triangulation_.link(c).constrained() && is_near(v, a, b)) near.push_back(undirected(a, b));
  });
  for (const Key& key : near) {
    triangulation_.release(key.first, key.second);
    route({key.first, key.second, edges_.at(key), segment_of_.at(key)}, v);
    edges_.erase(key);
  }
}

// The new vertex fell exactly on another piece, which the triangulation has split.
void Arrangement::split_edge_at(VertexId v) {
  std::vector<VertexId> ends;
  triangulation_.for_each_corner(v, [&](Corner c) {
    if (triangulation_.link({c.triangle, previous3(c.index)}).constrained())
      ends.push_back(triangulation_.following(c));
  });
  if (ends.size() != 2) return;
  const Key key = undirected(ends[0], ends[1]);
  for (const VertexId end : ends) {
    edges_[undirected(end, v)] = edges_.at(key);
    segment_of_[undirected(end, v)] = segment_of_.at(key);
  }
  edges_.erase(key);
}

// Exact, then rounded: within the boxes of both, but for the last bit.
Point Arrangement::crossing_of(const Piece& piece, VertexId first, VertexId second) const {
  const Point a = point(piece.from), b = point(piece.to), c = point(first), d = point(second);
  const Rational ax(a.x), ay(a.y), bx(b.x), by(b.y), cx(c.x), cy(c.y), dx(d.x), dy(d.y);
  const Rational along_x = bx - ax, along_y = by - ay, across_x = dx - cx, across_y = dy - cy;
  const Rational t =
      ((cx - ax) * across_y - (cy - ay) * across_x) / (along_x * across_y - along_y * across_x);
  const Rational x = ax + t * along_x, y = ay + t * along_y;
  return {x.convert_to<double>(), y.convert_to<double>()};
}

std::string Arrangement::name_of_segment(std::size_t segment) const {
  if (segment < graph_.segment_lines.size())
    return "the segment of line " + std::to_string(graph_.segment_lines[segment]);
  return "segment " + std::to_string(segment);
}

// Over everything but segments, as far as enter(triangle) is true.
template <class Enter>
void Arrangement::spread_from(TriangleId start, Enter&& enter) const {
  std::vector<TriangleId> todo;
  if (enter(start)) todo.push_back(start);
  while (!todo.empty()) {
    const TriangleId t = todo.back();
    todo.pop_back();
    for (const Link link : triangulation_[t].link)
      if (!link.constrained() && enter(link.triangle())) todo.push_back(link.triangle());
  }
}

TriangleId Arrangement::triangle_at(Point p) const {
  return triangulation_.locate(p, triangulation_.star(infinite_vertex).triangle).triangle;
}

// From outside of the hull and from the points in holes.
void Arrangement::mark_outside() {
  outside_.assign(triangulation_.triangle_slots(), false);
  const auto mark = [&](TriangleId t) {
    const bool is_new = !outside_[t.index];
    outside_[t.index] = true;
    return is_new;
  };
  spread_from(triangulation_.star(infinite_vertex).triangle, mark);
  const std::vector<bool> around = outside_;
  for (const Point hole : graph_.holes) {
    if (around[triangle_at(hole).index])
      findings.left_out.push_back("the hole at " + exact_text(hole) +
                                  " lies outside of all outlines: left out");
    spread_from(triangle_at(hole), mark);
  }
}

void Arrangement::mark_regions() {
  region_.assign(triangulation_.triangle_slots(), 0);
  for (const PlanarGraph::Region& region : graph_.regions) {
    const auto say = [&](const std::string& what) {
      findings.left_out.push_back("region '" + region.name + "' at " + exact_text(region.at) + what);
    };
    const TriangleId start = triangle_at(region.at);
    if (outside_[start.index]) {
      say(" lies outside of the domain: left out");
      continue;
    }
    if (const std::string& other = region_names_[region_[start.index]]; !other.empty()) {
      if (other != region.name) say(" lies in one part with region '" + other + "', whose name is taken");
      continue;
    }
    const auto index = static_cast<std::uint32_t>(region_names_.size());
    region_names_.push_back(region.name);
    spread_from(start, [&](TriangleId t) {
      const bool is_new = region_[t.index] == 0;
      region_[t.index] = index;
      return is_new;
    });
  }
}

const std::string& Arrangement::region_on_left(VertexId from, VertexId to) const {
  return region_names_[region_[triangulation_.find_edge(from, to)->triangle.index]];
}

bool Arrangement::domain_on_left(VertexId from, VertexId to) const {
  return !outside_[triangulation_.find_edge(from, to)->triangle.index];
}

}  // namespace remodel
