#include "layer/outside.h"

#include <utility>

namespace remodel {

namespace {

Point top_of(const ColumnRing& ring, std::size_t column, std::uint32_t levels) {
  return ring.points[(column + 1) * levels - 1];
}

Polyline tops_of_ring(const ColumnRing& ring, std::uint32_t levels) {
  Polyline tops;
  for (std::size_t c = 0; c < ring.size(); ++c) tops.points.push_back(top_of(ring, c, levels));
  if (ring.closed()) tops.points.push_back(tops.points.front());
  return tops;
}

// The ring of a loop's curve.
std::size_t ring_of(const std::vector<ColumnRing>& rings, std::size_t loop, std::size_t curve,
                    std::size_t curves) {
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const LayeredWall& wall = rings[r].wall;
    if (wall.loop == loop && (curve + curves - wall.first) % curves < wall.curves) return r;
  }
  return OutsideCurve::none;
}

}  // namespace

double OutsideCurve::own_parameter(const Shape& own, double t) const {
  const auto* polyline = std::get_if<Polyline>(&own);
  const double pieces = polyline != nullptr ? static_cast<double>(polyline->points.size() - 1) : 1.0;
  // Only the first and the last piece of a polyline are shorter.
  const double first = 1.0 / pieces, last = 1.0 - first;
  if (pieces == 1.0) return from + t * (to - from);
  if (t < first) return from + t * pieces * (first - from);
  if (t > last) return to - (1.0 - t) * pieces * (to - last);
  return t;
}

std::vector<OutsideCurve> outside_curves(const Domain& walls, const std::vector<ColumnRing>& rings,
                                         std::size_t loop) {
  const std::size_t n = walls.loops[loop].curves.size();
  std::vector<std::size_t> ring(n, OutsideCurve::none);
  bool any = false;
  for (std::size_t c = 0; c < n; ++c) {
    ring[c] = ring_of(rings, loop, c, n);
    any = any || ring[c] != OutsideCurve::none;
  }
  if (!any) return {};
  const auto inside = [&](std::size_t c) {
    return ring[c] != OutsideCurve::none && rings[ring[c]].wall.first != c;
  };
  std::size_t begin = 0;
  while (inside(begin)) ++begin;
  std::vector<OutsideCurve> curves;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t c = (begin + k) % n, before = (c + n - 1) % n, after = (c + 1) % n;
    if (inside(c)) continue;
    OutsideCurve& curve = curves.emplace_back();
    if ((curve.ring = ring[c]) != OutsideCurve::none) continue;
    curve.curve = c;
    if ((curve.begins = ring[before]) != OutsideCurve::none)
      curve.from = rings[ring[before]].openings[1].parameter(rings[ring[before]].thickness.back());
    if ((curve.ends = ring[after]) != OutsideCurve::none)
      curve.to = rings[ring[after]].openings[0].parameter(rings[ring[after]].thickness.front());
  }
  return curves;
}

void number_outside_curves(const Domain& walls, std::vector<ColumnRing>& rings) {
  for (ColumnRing& ring : rings) {
    const std::vector<OutsideCurve> curves = outside_curves(walls, rings, ring.wall.loop);
    for (std::size_t c = 0; c < curves.size(); ++c)
      if (curves[c].ring != OutsideCurve::none) rings[curves[c].ring].outside_curve = c;
  }
}

Shape outside_shape(const Shape& own, const OutsideCurve& curve, const std::vector<ColumnRing>& rings,
                    std::uint32_t levels) {
  Shape shape = own;
  if (auto* arc = std::get_if<Arc>(&shape)) {
    // The same operations as in Opening::at(), so that the arc begins at the top to the bit.
    const double sweep = arc->sweep;
    arc->start += curve.from * sweep;
    arc->sweep = (curve.to - curve.from) * sweep;
    return shape;
  }
  auto* line = std::get_if<Line>(&shape);
  auto* polyline = std::get_if<Polyline>(&shape);
  if (line == nullptr && polyline == nullptr) return shape;
  if (curve.begins != OutsideCurve::none)
    (line != nullptr ? line->from : polyline->points.front()) =
        top_of(rings[curve.begins], rings[curve.begins].size() - 1, levels);
  if (curve.ends != OutsideCurve::none)
    (line != nullptr ? line->to : polyline->points.back()) = top_of(rings[curve.ends], 0, levels);
  return shape;
}

Domain with_moved_stations(Domain walls, const std::vector<ColumnRing>& rings) {
  for (std::size_t l = 0; l < walls.loops.size(); ++l)
    for (const OutsideCurve& curve : outside_curves(walls, rings, l)) {
      if (curve.ring != OutsideCurve::none) continue;
      Curve& own = walls.loops[l].curves[curve.curve];
      std::vector<double> moved;
      if (curve.begins != OutsideCurve::none) moved.push_back(0.0);
      for (const double t : own.parameters) moved.push_back(curve.own_parameter(own.shape, t));
      own.parameters = std::move(moved);
    }
  return walls;
}

Domain outside_of(const Domain& walls, const LayerColumns& columns, std::uint32_t levels) {
  Domain outside = walls;
  for (std::size_t l = 0; l < walls.loops.size(); ++l) {
    const std::vector<OutsideCurve> curves = outside_curves(walls, columns.rings, l);
    if (curves.empty()) continue;
    const std::vector<Curve>& own = walls.loops[l].curves;
    Loop& loop = outside.loops[l];
    loop.curves.clear();
    loop.placement = {};
    for (const OutsideCurve& curve : curves) {
      if (curve.ring == OutsideCurve::none) {
        Curve beyond = own[curve.curve];
        beyond.shape = outside_shape(beyond.shape, curve, columns.rings, levels);
        loop.curves.push_back(std::move(beyond));
        continue;
      }
      const ColumnRing& ring = columns.rings[curve.ring];
      loop.curves.push_back({.name = own[ring.wall.first].name,
                             .shape = tops_of_ring(ring, levels),
                             .parameters = Parameters::uniform(ring.pairs())});
    }
  }
  return outside;
}

}  // namespace remodel
