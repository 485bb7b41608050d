// An airfoil in a domain: where it is, its design, and another one in its place.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "remodel/error.h"
#include "remodel/import.h"
#include "shape/airfoil_rows.h"

namespace remodel {

namespace {

// What counts as a corner decides where a chord is drawn, nothing else.
constexpr double sharp_turn = 120.0 * std::numbers::pi / 180.0;
constexpr double blunt_turn = 45.0 * std::numbers::pi / 180.0;
constexpr double nose_turn = 75.0 * std::numbers::pi / 180.0;  // less is a nose's, more a corner's
constexpr double longest_base = 0.1;                           // of the outline's extent
constexpr std::size_t polyline_pieces = 8;

// Counter-clockwise, closed: the last point is not the first one again.
using Outline = std::vector<Point>;

struct NamedOutline {
  Outline points;
  std::vector<std::string> names;  // of the side that begins at each point
  bool reversed = false;           // against the loop
};

NamedOutline outline_of(const Domain& domain, std::size_t loop) {
  NamedOutline outline;
  for (const BoundaryStation& station : domain.stations(loop)) {
    outline.points.push_back(domain.at(station));
    outline.names.push_back(domain.curve(station.curve).name);
  }
  if (signed_area(domain, loop) > 0.0) return outline;
  outline.reversed = true;
  std::reverse(outline.points.begin(), outline.points.end());
  std::reverse(outline.names.begin(), outline.names.end());
  // Now each stands with the point where its side ended.
  std::rotate(outline.names.begin(), outline.names.begin() + 1, outline.names.end());
  return outline;
}

double turn_at(const Outline& outline, std::size_t i) {
  const std::size_t n = outline.size();
  const Point in = outline[i] - outline[(i + n - 1) % n], out = outline[(i + 1) % n] - outline[i];
  return std::atan2(cross(in, out), dot(in, out));
}

// The trailing edge's two ends, counter-clockwise; the same twice if it is sharp.
struct TrailingEdge {
  std::size_t lower = 0, upper = 0;
};

double extent(const Outline& outline) {
  Point low = outline.front(), high = low;
  for (const Point p : outline) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return std::sqrt(squared_distance(low, high));
}

std::optional<TrailingEdge> blunt_edge(const Outline& outline, const std::vector<double>& turns) {
  const std::size_t n = outline.size();
  const double longest = longest_base * extent(outline);
  std::vector<std::size_t> corners;
  for (std::size_t i = 0; i < n; ++i)
    if (turns[i] > blunt_turn) corners.push_back(i);
  std::optional<TrailingEdge> best;
  double most = 0.0;
  for (std::size_t k = 0; k < corners.size() && corners.size() > 1; ++k) {
    const std::size_t lower = corners[k], upper = corners[(k + 1) % corners.size()];
    if (squared_distance(outline[lower], outline[upper]) > longest * longest) continue;
    if (turns[lower] + turns[upper] <= most) continue;
    most = turns[lower] + turns[upper];
    best = {lower, upper};
  }
  return best;
}

// The point of largest x that qualifies.
template <class Qualifies>
std::optional<std::size_t> rearmost(const Outline& outline, Qualifies qualifies) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < outline.size(); ++i)
    if (qualifies(i) && (!best || outline[i].x > outline[*best].x)) best = i;
  return best;
}

TrailingEdge trailing_edge_of(const Outline& outline) {
  std::vector<double> turns;
  for (std::size_t i = 0; i < outline.size(); ++i) turns.push_back(turn_at(outline, i));
  if (const auto sharp = rearmost(outline, [&](std::size_t i) { return turns[i] > sharp_turn; }))
    return {*sharp, *sharp};
  if (const auto blunt = blunt_edge(outline, turns)) return *blunt;
  const std::size_t round = *rearmost(outline, [](std::size_t) { return true; });
  return {round, round};
}

// Between a mesh's coordinates and those of the chord, which runs from (0, 0) to (1, 0).
class ChordFrame {
 public:
  explicit ChordFrame(const AirfoilPlace& place)
      : origin_(place.leading), along_(place.trailing - place.leading) {}
  bool is_chord() const { return origin_ == Point{0.0, 0.0} && along_ == Point{1.0, 0.0}; }
  Point to_chord(Point p) const {
    const Point d = p - origin_;
    if (is_chord()) return p;
    const double square = dot(along_, along_);
    return {dot(along_, d) / square, cross(along_, d) / square};
  }
  Point from_chord(Point p) const { return origin_ + p.x * along_ + p.y * Point{-along_.y, along_.x}; }

 private:
  Point origin_, along_;
};

// The points from the trailing edge's upper end over the leading edge to its lower end, in chords. A sharp
// trailing edge is the first point and the last.
Outline around(const Outline& outline, const TrailingEdge& edge, const ChordFrame& frame) {
  Outline result;
  const std::size_t n = outline.size();
  std::size_t i = edge.upper;
  do {
    result.push_back(frame.to_chord(outline[i]));
    i = (i + 1) % n;
  } while (i != edge.lower);
  result.push_back(frame.to_chord(outline[i]));
  return result;
}

// Where the leading edge lies, and the points beside it, which are one where it is on a point.
struct LeadingEdge {
  Point place{};
  std::size_t before = 0, after = 0;
};

AirfoilRowList rows_of(const Outline& points) {
  AirfoilRowList rows;
  for (const Point p : points) rows.push_back({p, 0});
  return rows;
}

// Of the points from one end of the trailing edge around to the other. An outline that bends smoothly there
// has its nose where that of a coordinate file is, on a point or between two; one with a corner, where it is
// farthest from the trailing edge.
LeadingEdge leading_edge_of(const Outline& points, Point trailing) {
  const auto farthest = std::max_element(points.begin(), points.end(), [&](Point a, Point b) {
    return squared_distance(a, trailing) < squared_distance(b, trailing);
  });
  const auto i = static_cast<std::size_t>(farthest - points.begin());
  const LeadingEdge on_point{*farthest, i, i};
  if (i < 2 || i + 2 >= points.size() || turn_at(points, i) > nose_turn) return on_point;
  const AirfoilNose nose = nose_of(rows_of(points));
  const bool is_there = nose.before <= i && i <= nose.after;
  return is_there ? LeadingEdge{nose.frame.nose, nose.before, nose.after} : on_point;
}

// None where x does not fall all the way to the leading edge and rise all the way back.
std::optional<std::vector<double>> parameters_of(const Outline& points, const LeadingEdge& nose) {
  std::vector<double> parameters{0.0};
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    if (!(points[i].x >= 0.0 && points[i].x < 1.0)) return std::nullopt;
    const double t = std::acos(2.0 * points[i].x - 1.0) / (2.0 * std::numbers::pi);
    const bool on_nose = i == nose.before && i == nose.after;
    parameters.push_back(on_nose ? 0.5 : i <= nose.before ? t : 1.0 - t);
  }
  for (std::size_t i = 1; i < parameters.size(); ++i)
    if (!(parameters[i] > parameters[i - 1]) || parameters[i] >= 1.0) return std::nullopt;
  return parameters;
}

std::vector<double> base_of(const Outline& outline, const TrailingEdge& edge) {
  std::vector<double> base;
  const Point from = outline[edge.lower], along = outline[edge.upper] - from;
  for (std::size_t i = edge.lower; i != edge.upper; i = (i + 1) % outline.size())
    base.push_back(dot(outline[i] - from, along) / dot(along, along));
  if (base.empty()) return base;
  base.front() = 0.0;
  for (std::size_t i = 1; i < base.size(); ++i)
    if (!(base[i] > base[i - 1]) || base[i] >= 1.0) return Parameters::uniform(base.size());
  return base;
}

bool has_name(const Loop& loop, const std::string& name) {
  return std::any_of(loop.curves.begin(), loop.curves.end(),
                     [&](const Curve& curve) { return curve.name == name; });
}

std::string names_of(const Domain& domain) {
  std::string names;
  for (const Loop& loop : domain.loops)
    for (const Curve& curve : loop.curves) {
      const std::string quoted = "'" + curve.name + "'";
      if (names.find(quoted) == std::string::npos) names += (names.empty() ? "" : ", ") + quoted;
    }
  return names;
}

std::size_t loop_named(const Domain& domain, const std::string& name, const std::string& source) {
  const auto refuse = [&](const std::string& problem) { throw Error(ErrorCode::argument, source, problem); };
  std::vector<std::size_t> bodies;
  bool outside = false;
  for (std::size_t i = 0; i < domain.loops.size(); ++i) {
    if (!has_name(domain.loops[i], name)) continue;
    if (domain.loops[i].role == LoopRole::hole)
      bodies.push_back(i);
    else
      outside = true;
  }
  if (bodies.size() > 1)
    refuse("boundary '" + name + "' has " + std::to_string(bodies.size()) + " bodies, one expected");
  if (bodies.empty() && outside)
    refuse("boundary '" + name + "' surrounds the mesh, the outline of a body in it expected");
  if (bodies.empty()) refuse("no boundary '" + name + "' found, one of " + names_of(domain) + " expected");
  return bodies.front();
}

// The paper's own curve, as airfoil_domain() and with_airfoil() make it.
std::optional<AirfoilPlace> place_of_curve(const Loop& loop) {
  if (!std::holds_alternative<CstAirfoil>(loop.curves.front().shape)) return std::nullopt;
  AirfoilPlace place{.trailing = {1.0, 0.0}, .parameters = loop.curves.front().parameters};
  if (loop.curves.size() > 1) place.base = loop.curves[1].parameters;
  place.names.assign(place.parameters.size() + place.base.size(), loop.curves.front().name);
  return place;
}

AirfoilPlace place_of_outline(const NamedOutline& named, const std::string& source) {
  const Outline& outline = named.points;
  const TrailingEdge edge = trailing_edge_of(outline);
  AirfoilPlace place;
  place.trailing =
      edge.lower == edge.upper ? outline[edge.upper] : 0.5 * (outline[edge.lower] + outline[edge.upper]);
  const ChordFrame own({.leading = {0.0, 0.0}, .trailing = {1.0, 0.0}});  // the outline's coordinates
  const LeadingEdge nose = leading_edge_of(around(outline, edge, own), place.trailing);
  place.leading = nose.place;
  place.base = base_of(outline, edge);
  for (std::size_t i = 0; i < outline.size(); ++i)
    place.names.push_back(named.names[(edge.upper + i) % outline.size()]);
  const Outline points = around(outline, edge, ChordFrame(place));
  if (auto parameters = parameters_of(points, nose)) {
    place.parameters = std::move(*parameters);
    place.backwards = named.reversed;
    const std::size_t n = outline.size();
    place.first = ((named.reversed ? n - 1 : 0) + n - edge.upper) % n;
    return place;
  }
  if (!place.one_name())
    throw Error(ErrorCode::geometry, source,
                "the outline of '" + place.names.front() +
                    "' turns back in x between its two edges, an airfoil's "
                    "expected where its sides have different names");
  const std::size_t even = points.size() - 1 + (points.size() - 1) % 2;
  return with_points(std::move(place), static_cast<int>(std::max<std::size_t>(even, 8)));
}

// The points of an airfoil's sides, `polyline_pieces` a side, from one end of the trailing edge to the other,
// and over a blunt one back to the first.
std::vector<Point> points_of_sides(const CstAirfoil& airfoil, const AirfoilPlace& place) {
  const ChordFrame frame(place);
  std::vector<Point> points;
  const auto add = [&](const std::vector<double>& stations, auto point) {
    for (std::size_t i = 0; i < stations.size(); ++i) {
      const double from = stations[i], to = i + 1 < stations.size() ? stations[i + 1] : 1.0;
      for (std::size_t k = 0; k < polyline_pieces; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(polyline_pieces);
        points.push_back(frame.from_chord(point(k == 0 ? from : from + share * (to - from))));
      }
    }
  };
  add(place.parameters, [&](double t) { return airfoil.at(t); });
  const Line line{.from = airfoil.at(1.0), .to = airfoil.at(0.0)};
  add(place.base, [&](double t) { return point_at(line, t); });
  return points;
}

// From counter-clockwise from the trailing edge to how the loop runs: the points of all sides, and the names.
void follow_loop(const AirfoilPlace& place, std::vector<Point>& points, std::vector<std::string>& names) {
  const auto first = static_cast<std::ptrdiff_t>(place.first);
  std::rotate(points.begin(), points.begin() + first * std::ptrdiff_t{polyline_pieces}, points.end());
  std::rotate(names.begin(), names.begin() + first, names.end());
  if (!place.backwards) return;
  std::reverse(points.begin() + 1, points.end());
  std::reverse(names.begin(), names.end());
}

// One polyline a run of sides with equal names.
std::vector<Curve> polylines_of(std::vector<Point> points, const std::vector<std::string>& names) {
  points.push_back(points.front());
  std::vector<Curve> curves;
  for (std::size_t begin = 0, end = 0; begin < names.size(); begin = end) {
    while (end < names.size() && names[end] == names[begin]) ++end;
    const auto at = [&](std::size_t side) {
      return points.begin() + static_cast<std::ptrdiff_t>(side * polyline_pieces);
    };
    curves.push_back({.name = names[begin],
                      .shape = Polyline{{at(begin), at(end) + 1}},
                      .parameters = Parameters::uniform(end - begin)});
  }
  return curves;
}

}  // namespace

bool AirfoilPlace::one_name() const {
  return std::all_of(names.begin(), names.end(), [&](const std::string& n) { return n == names.front(); });
}

AirfoilPlace find_airfoil(const Domain& domain, const std::string& name, const std::string& source) {
  const std::size_t loop = loop_named(domain, name, source);
  std::optional<AirfoilPlace> place = place_of_curve(domain.loops[loop]);
  if (!place) place = place_of_outline(outline_of(domain, loop), source);
  place->loop = loop;
  return *place;
}

AirfoilPlace with_points(AirfoilPlace place, int points) {
  if (points < 8 || points % 2 != 0)
    throw Error(ErrorCode::argument, "points",
                "found " + std::to_string(points) + ", expected an even number, at least 8");
  if (!place.one_name())
    throw Error(
        ErrorCode::argument, "points",
        "given for an outline of several names, expected for one of a single name: each side keeps its own");
  place.parameters = Parameters::uniform(static_cast<std::size_t>(points));
  place.first = 0;
  place.backwards = false;
  if (!place.base.empty()) place.base = {0.0};
  const std::string name = place.names.front();
  place.names.assign(place.parameters.size() + place.base.size(), name);
  return place;
}

CstFit fit_airfoil(const Domain& domain, const AirfoilPlace& place, int degree) {
  const Loop& loop = domain.loops[place.loop];
  if (const auto* airfoil = std::get_if<CstAirfoil>(&loop.curves.front().shape)) return {.airfoil = *airfoil};
  const Outline outline = outline_of(domain, place.loop).points;
  const Outline points = around(outline, trailing_edge_of(outline), ChordFrame(place));
  const std::string where = "boundary '" + loop.curves.front().name + "'";
  const bool nose_on_point =
      std::any_of(points.begin(), points.end(), [](Point p) { return squared_distance(p, {}) < 1e-18; });
  CstFit fit = fit_cst(nose_on_point ? surfaces_of_outline(where, rows_of(points), where)
                                     : surfaces_of({.name = where, .points = points}, where),
                       degree);
  if (!place.base.empty()) {
    fit.airfoil.te_upper = points.front().y;
    fit.airfoil.te_lower = points.back().y;
  }
  return fit;
}

Domain with_airfoil(const Domain& domain, const AirfoilPlace& wanted, const CstAirfoil& airfoil) {
  AirfoilPlace place = wanted;
  const bool sharp = airfoil.te_upper == airfoil.te_lower;
  if (sharp) place.base.clear();
  if (!sharp && place.base.empty()) place.base = {0.0};
  place.names.resize(place.parameters.size() + place.base.size(), wanted.names.back());
  if (place.names.size() != wanted.names.size()) place.first = 0, place.backwards = false;
  Loop loop{.role = LoopRole::hole, .curves = {}};
  if (std::holds_alternative<CstAirfoil>(domain.loops[place.loop].curves.front().shape)) {
    const std::string& name = place.names.front();
    loop.curves.push_back({.name = name, .shape = airfoil, .parameters = place.parameters});
    const Line line{.from = airfoil.at(1.0), .to = airfoil.at(0.0)};
    if (!sharp) loop.curves.push_back({.name = name, .shape = line, .parameters = place.base});
  } else {
    std::vector<Point> points = points_of_sides(airfoil, place);
    follow_loop(place, points, place.names);
    loop.curves = polylines_of(std::move(points), place.names);
  }
  loop.region = domain.loops[place.loop].region;
  Domain result = domain;
  result.loops[place.loop] = std::move(loop);
  return result;
}

}  // namespace remodel
