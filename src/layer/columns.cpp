// Columns of a wall, in five steps: room, thickness, directions, points, validity.
//
// A column on a wall's point p leaves the wall along n and ends in the direction m: its point at the height h
// is X(h) = p + h n + (h^2 / T)(m - n), T its thickness. n is the bisector of the wall's edges, so that cells
// stand upright on the wall; m is n made smooth along the wall, so that the tops are a smooth polygon with
// even spacing.

#include "layer/columns.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "geometry/filters.h"
#include "layer/ball.h"
#include "layer/heights.h"
#include "layer/outside.h"
#include "remodel/error.h"
#include "shape/segments.h"

namespace remodel {

namespace {

// A column takes this part of its ball's radius, as long as a triangle fits between two layers, but at least
// that.
constexpr double part_of_radius = 0.5, least_part_of_radius = 0.3;
// Thickness changes by at most this for each unit of length along the wall.
constexpr double thickness_slope = 0.3;
// Directions at the tops are smooth over this part of the thickness. Less leaves uneven tops, more tilts
// columns.
constexpr double smoothing_length = 0.25;
// What gives way beside cells that are not convex, and tops that meet: a column's tilt is halved twice, then
// its thickness is reduced six times.
constexpr int tilt_rounds = 2, thickness_rounds = 6;
constexpr double thickness_reduction = 0.7;
// Meeting tops are found one pair at a time.
constexpr int most_rounds = 200;

using ColumnSet = std::vector<std::vector<bool>>;  // per ring and column

// What columns have given up, per ring and column.
class Concessions {
 public:
  explicit Concessions(const std::vector<ColumnRing>& rings) {
    for (const ColumnRing& ring : rings) {
      tilt_.emplace_back(ring.size(), 1.0);
      thickness_.emplace_back(ring.size(), 1.0);
      rounds_.emplace_back(ring.size(), 0);
    }
  }
  // False if one of the columns has nothing left to give.
  bool demand(const ColumnSet& columns) {
    for (std::size_t r = 0; r < columns.size(); ++r)
      for (std::size_t c = 0; c < columns[r].size(); ++c) {
        if (!columns[r][c]) continue;
        const int round = rounds_[r][c]++;
        if (round >= tilt_rounds + thickness_rounds) return false;
        (round < tilt_rounds ? tilt_ : thickness_)[r][c] *= round < tilt_rounds ? 0.5 : thickness_reduction;
      }
    return true;
  }
  const std::vector<double>& tilt(std::size_t ring) const { return tilt_[ring]; }
  const std::vector<double>& thickness(std::size_t ring) const { return thickness_[ring]; }
  std::size_t count() const {
    std::size_t columns = 0;
    for (const auto& ring : rounds_)
      for (const int rounds : ring) columns += rounds > 0;
    return columns;
  }

 private:
  std::vector<std::vector<double>> tilt_, thickness_;  // factors
  std::vector<std::vector<int>> rounds_;
};

struct Box {
  Point low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  void take(Point p, double margin) {
    low = {std::min(low.x, p.x - margin), std::min(low.y, p.y - margin)};
    high = {std::max(high.x, p.x + margin), std::max(high.y, p.y + margin)};
  }
  bool meets(Point a, Point b) const {
    return std::max(a.x, b.x) >= low.x && std::min(a.x, b.x) <= high.x && std::max(a.y, b.y) >= low.y &&
           std::min(a.y, b.y) <= high.y;
  }
};

// Which edges of a chain's loop are of its openings, by their first station. None of a closed ring.
std::vector<bool> opening_edges(const Walls& walls, const ColumnRing& ring) {
  if (ring.closed()) return {};
  std::vector<bool> edges;
  const std::vector<Curve>& curves = walls.domain.loops[ring.wall.loop].curves;
  for (std::size_t c = 0; c < curves.size(); ++c)
    edges.resize(edges.size() + curves[c].parameters.size(),
                 c == ring.openings[0].curve() || c == ring.openings[1].curve());
  return edges;
}

// The stations of all loops, and points between those that lie far apart where a layer may come near; but for
// the edges that are left out, of this loop, which bound no ball.
std::vector<Point> boundary_samples(const Walls& walls, const Box& near, double thickness, std::size_t loop,
                                    const std::vector<bool>& left_out) {
  std::vector<Point> samples;
  for (std::size_t l = 0; l < walls.points.size(); ++l) {
    const std::vector<Point>& points = walls.points[l];
    const auto is_out = [&](std::size_t i) { return l == loop && !left_out.empty() && left_out[i]; };
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!is_out(i) || !is_out(i == 0 ? points.size() - 1 : i - 1)) samples.push_back(points[i]);
      if (is_out(i)) continue;
      if (i + 1 == points.size() && walls.domain.loops[l].open) break;
      const Point a = points[i], b = points[i + 1 == points.size() ? 0 : i + 1];
      if (!near.meets(a, b)) continue;
      const double pieces = std::min(std::floor(2.0 * distance(a, b) / thickness), 1000.0);
      for (double k = 1.0; k < pieces; k += 1.0) samples.push_back(a + (k / pieces) * (b - a));
    }
  }
  return samples;
}

// Neighbours along a ring differ by no more than the slope allows. Twice around reaches all, of a chain once.
void limit_slope(ColumnRing& ring) {
  const std::size_t n = ring.pairs(), times = ring.closed() ? 2 : 1;
  for (std::size_t k = 0; k < times * n; ++k) {
    const std::size_t c = k % n, next = ring.after(c);
    ring.thickness[next] = std::min(ring.thickness[next], ring.thickness[c] + thickness_slope * ring.step[c]);
  }
  for (std::size_t k = times * n; k-- > 0;) {
    const std::size_t c = k % n, next = ring.after(c);
    ring.thickness[c] = std::min(ring.thickness[c], ring.thickness[next] + thickness_slope * ring.step[c]);
  }
}

void limit_by_balls(ColumnRing& ring, const WallBalls& balls, double wanted) {
  ring.thickness.assign(ring.size(), wanted);
  for (std::size_t c = 0; c < ring.size(); ++c) {
    const double spacing = ring.spacing[c];
    // Beyond this radius the ball is no bound: R / 2 and R - spacing are both more than what is wanted.
    const double radius = balls.radius(ring.foot[c], ring.normal[c], 2.0 * wanted + spacing);
    const double room =
        std::max(least_part_of_radius * radius, std::min(part_of_radius * radius, radius - spacing));
    ring.thickness[c] = std::min(wanted, room);
  }
}

void set_room(std::vector<ColumnRing>& rings, const Walls& walls, double wanted) {
  Box near;
  for (const ColumnRing& ring : rings)
    for (const Point p : ring.foot) near.take(p, 5.0 * wanted);
  std::optional<WallBalls> of_all;  // the same for all closed rings
  for (ColumnRing& ring : rings) {
    const auto balls = [&] {
      return WallBalls(boundary_samples(walls, near, wanted, ring.wall.loop, opening_edges(walls, ring)));
    };
    if (ring.closed()) {
      if (!of_all) of_all.emplace(balls());
      limit_by_balls(ring, *of_all, wanted);
    } else {
      limit_by_balls(ring, balls(), wanted);
      ring.thickness.front() = std::min(ring.thickness.front(), ring.openings[0].longest());
      ring.thickness.back() = std::min(ring.thickness.back(), ring.openings[1].longest());
    }
    limit_slope(ring);
  }
}

// Solves the cyclic tridiagonal system diagonal[i] x[i] - link[i-1] x[i-1] - link[i] x[i+1] = right[i], which
// is symmetric and diagonally dominant, by elimination and the Sherman-Morrison formula for its two far
// corners. The result is in `right`.
void solve_cyclic(std::vector<double> diagonal, const std::vector<double>& link, std::vector<Point>& right) {
  const std::size_t n = right.size();
  // The matrix is a tridiagonal one and u v^T, where u = (g, 0 ... 0, -a), v = (1, 0 ... 0, -a / g).
  const double a = link[n - 1], g = -diagonal[0];
  diagonal[0] -= g;
  diagonal[n - 1] -= a * a / g;
  std::vector<double> corner(n, 0.0);
  corner[0] = g;
  corner[n - 1] = -a;
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = link[i - 1] / diagonal[i - 1];
    diagonal[i] -= factor * link[i - 1];
    right[i] = right[i] + factor * right[i - 1];
    corner[i] += factor * corner[i - 1];
  }
  for (std::size_t i = n; i-- > 0;) {
    const bool last = i + 1 == n;
    right[i] = (1.0 / diagonal[i]) * (last ? right[i] : right[i] + link[i] * right[i + 1]);
    corner[i] = (last ? corner[i] : corner[i] + link[i] * corner[i + 1]) / diagonal[i];
  }
  const double below = 1.0 + corner[0] - a / g * corner[n - 1];
  const Point part = (1.0 / below) * (right[0] - (a / g) * right[n - 1]);
  for (std::size_t i = 0; i < n; ++i) right[i] = right[i] - corner[i] * part;
}

// The columns at the ends of a chain follow the openings.
void set_ends(ColumnRing& ring) {
  if (ring.closed()) return;
  const std::size_t last = ring.size() - 1;
  for (const auto& [end, opening] :
       {std::pair{std::size_t{0}, &ring.openings[0]}, {last, &ring.openings[1]}}) {
    const Point along = opening->at(ring.thickness[end]) - ring.foot[end];
    ring.normal[end] = (1.0 / std::sqrt(dot(along, along))) * along;
  }
}

// The directions at the tops minimise sum l^2 |m_i - m_(i+1)|^2 / s_i + sum w_i |m_i - n_i|^2 over the ring,
// where s_i is the distance of two neighbours at half the thickness, and w_i the half of both such distances.
// Those at the ends of a chain are given.
void set_tops(ColumnRing& ring, const std::vector<double>& tilt) {
  const std::size_t n = ring.size();
  std::vector<double> length(n, 0.0), link(n, 0.0), diagonal(n);
  for (std::size_t c = 0; c < ring.pairs(); ++c) {
    const std::size_t next = ring.after(c);
    const double thickness = 0.5 * (ring.thickness[c] + ring.thickness[next]);
    const Point turn = (0.5 * thickness) * (ring.normal[next] - ring.normal[c]);
    length[c] = std::sqrt(ring.step[c] * ring.step[c] + dot(turn, turn));
    const double smooth = smoothing_length * thickness;
    link[c] = smooth * smooth / length[c];
  }
  std::vector<Point> top(n);
  for (std::size_t c = 0; c < n; ++c) {
    const std::size_t before = ring.before(c);
    const double weight = 0.5 * (length[before] + length[c]);
    diagonal[c] = weight + link[before] + link[c];
    top[c] = weight * ring.normal[c];
  }
  if (!ring.closed()) {
    const std::size_t last = n - 1;
    top[1] = top[1] + link[0] * ring.normal[0];
    top[last - 1] = top[last - 1] + link[last - 1] * ring.normal[last];
    link[0] = link[last - 1] = 0.0;
    for (const std::size_t end : {std::size_t{0}, last}) diagonal[end] = 1.0, top[end] = ring.normal[end];
  }
  solve_cyclic(std::move(diagonal), link, top);
  for (std::size_t c = 0; c < n; ++c) {
    const Point smooth = (1.0 / std::sqrt(dot(top[c], top[c]))) * top[c];
    ring.top[c] = tilt[c] == 1.0 ? smooth : ring.normal[c] + tilt[c] * (smooth - ring.normal[c]);
  }
  if (!ring.closed()) ring.top.front() = ring.normal.front(), ring.top.back() = ring.normal.back();
}

// What is left of a coordinate where a solve has made it vanish, on a line of symmetry, is nothing that exact
// predicates could work with.
Point without_traces(Point p, double thickness) {
  const double trace = 1e-20 * thickness;
  return {std::abs(p.x) < trace ? 0.0 : p.x, std::abs(p.y) < trace ? 0.0 : p.y};
}

void set_points(ColumnRing& ring, const LayerOptions& options, std::uint32_t levels) {
  const std::size_t n = ring.size();
  ring.growth.assign(n, 1.0);
  ring.points.resize(n * levels);
  std::vector<double> heights(levels);
  for (std::size_t c = 0; c < n; ++c) {
    const double thickness = ring.thickness[c];
    if (c > 0 && thickness == ring.thickness[c - 1]) {
      ring.growth[c] = ring.growth[c - 1];
    } else {
      ring.growth[c] = growth_of(options.first_height, options.growth, thickness, levels);
      level_heights(options.first_height, ring.growth[c], thickness, heights);
    }
    if (!ring.closed() && (c == 0 || c + 1 == n)) {
      const Opening& opening = ring.openings[c == 0 ? 0 : 1];
      for (std::uint32_t j = 0; j < levels; ++j) ring.points[c * levels + j] = opening.at(heights[j]);
      continue;
    }
    const Point bend = (1.0 / thickness) * (ring.top[c] - ring.normal[c]);
    for (std::uint32_t j = 0; j < levels; ++j)
      ring.points[c * levels + j] =
          without_traces(ring.foot[c] + heights[j] * (ring.normal[c] + heights[j] * bend), thickness);
  }
}

void mark_pair(ColumnSet& marked, const std::vector<ColumnRing>& rings, std::size_t ring,
               std::size_t column) {
  marked[ring][column] = true;
  marked[ring][rings[ring].after(column)] = true;
}

// Strictly convex and counter-clockwise.
bool is_convex_quadrilateral(Point a, Point b, Point c, Point d) {
  using geometry::orient2d_filtered;
  return orient2d_filtered(a, b, c) > 0 && orient2d_filtered(b, c, d) > 0 && orient2d_filtered(c, d, a) > 0 &&
         orient2d_filtered(d, a, b) > 0;
}

// Whether all cells between a column and the next one are convex.
bool stand_well(const ColumnRing& ring, std::size_t column, std::uint32_t levels) {
  const std::size_t other = ring.after(column);
  const std::size_t a = ring.left ? column : other, b = ring.left ? other : column;
  Point low_a = ring.foot[a], low_b = ring.foot[b];
  const Point *high_a = &ring.points[a * levels], *high_b = &ring.points[b * levels];
  std::uint32_t level = 0;
  if (ring.station[a] == ring.station[b]) {
    if (geometry::orient2d_filtered(low_a, *high_b, *high_a) <= 0) return false;
    low_a = *high_a++, low_b = *high_b++, ++level;
  }
  for (; level < levels; ++level) {
    if (!is_convex_quadrilateral(low_a, low_b, *high_b, *high_a)) return false;
    low_a = *high_a++, low_b = *high_b++;
  }
  return true;
}

// The columns beside cells that are not convex.
bool mark_folded(const std::vector<ColumnRing>& rings, std::uint32_t levels, ColumnSet& marked) {
  bool found = false;
  for (std::size_t r = 0; r < rings.size(); ++r)
    for (std::size_t c = 0; c < rings[r].pairs(); ++c) {
      if (stand_well(rings[r], c, levels)) continue;
      mark_pair(marked, rings, r, c);
      found = true;
    }
  return found;
}

// A side of the domain beyond the layer: of which ring's tops, if it is of one, and from which column on.
struct Owner {
  std::size_t ring = no_side, column = 0;
};

// The sides of the domain beyond the layer, and whose they are.
class OutsideSides {
 public:
  OutsideSides(const Walls& walls, const std::vector<ColumnRing>& rings, std::uint32_t levels)
      : rings_(rings), levels_(levels) {
    const std::vector<Loop>& loops = walls.domain.loops;
    for (std::size_t l = 0; l < loops.size(); ++l) {
      const std::vector<OutsideCurve> curves = outside_curves(walls.domain, rings, l);
      if (curves.empty()) {
        if (!is_single_point(loops[l]))
          add(walls.points[l], std::vector<Owner>(walls.points[l].size()), loops[l].open);
        continue;
      }
      points_.clear(), of_loop_.clear();
      for (const OutsideCurve& curve : curves) add_curve(walls.domain, curve, l);
      add(points_, of_loop_, false);
    }
  }
  const std::vector<Side>& sides() const { return sides_; }
  const Owner& owner(std::size_t side) const { return owners_[side]; }

 private:
  void add_curve(const Domain& walls, const OutsideCurve& curve, std::size_t loop) {
    if (curve.ring != OutsideCurve::none) {
      const ColumnRing& ring = rings_[curve.ring];
      for (std::size_t c = 0; c < ring.pairs(); ++c) {
        points_.push_back(ring.points[(c + 1) * levels_ - 1]);
        of_loop_.push_back({curve.ring, c});
      }
      return;
    }
    const Curve& own = walls.loops[loop].curves[curve.curve];
    const Shape shape = outside_shape(own.shape, curve, rings_, levels_);
    for (const double t : own.parameters) points_.push_back(point_at(shape, t));
    of_loop_.resize(points_.size());
  }

  void add(const std::vector<Point>& points, const std::vector<Owner>& owners, bool open) {
    const std::size_t first = sides_.size(), n = points.size();
    for (std::size_t i = 0; i + (open ? 1 : 0) < n; ++i) {
      const bool last = open && i + 2 == n;
      const std::size_t next = i + 1 == n ? 0 : i + 1;
      sides_.push_back({points[i], points[next], last ? no_side : first + next, open && i == 0});
      owners_.push_back(owners[i]);
    }
  }

  const std::vector<ColumnRing>& rings_;
  std::uint32_t levels_;
  std::vector<Side> sides_;
  std::vector<Owner> owners_;
  std::vector<Point> points_;   // of the loop under way
  std::vector<Owner> of_loop_;  // of its sides
};

// The columns of tops that meet others, or a loop without a layer: one pair of sides at a time.
bool mark_meeting(const Walls& walls, const std::vector<ColumnRing>& rings, std::uint32_t levels,
                  ColumnSet& marked) {
  const OutsideSides outside(walls, rings, levels);
  const std::optional<SidePair> meeting = find_meeting_sides(outside.sides());
  if (!meeting) return false;
  for (const std::size_t side : {meeting->first, meeting->second})
    if (const Owner& owner = outside.owner(side); owner.ring != no_side)
      mark_pair(marked, rings, owner.ring, owner.column);
  return true;
}

[[noreturn]] void refuse_layer(const Domain& walls, const std::vector<ColumnRing>& rings,
                               const ColumnSet& marked) {
  for (std::size_t r = 0; r < rings.size(); ++r)
    for (std::size_t c = 0; c < rings[r].size(); ++c)
      if (marked[r][c])
        throw Error(ErrorCode::geometry, "layers",
                    "found no room for cells at " + column_place(walls, rings[r], c) +
                        ", expected walls that are smooth there, or have stations closer together");
  throw Error(ErrorCode::geometry, "layers", "found no room for cells, expected walls that keep apart");
}

}  // namespace

CellPoints layer_cell(const ColumnRing& ring, std::size_t column, std::uint32_t level, std::uint32_t levels) {
  const std::size_t other = ring.after(column);
  const auto at = [&](std::size_t c, std::uint32_t l) {
    return l == 0 ? ring.foot[c] : ring.points[c * levels + l - 1];
  };
  const std::size_t a = ring.left ? column : other, b = ring.left ? other : column;
  return {{at(a, level), at(b, level), at(b, level + 1), at(a, level + 1)},
          level == 0 && ring.station[column] == ring.station[other]};
}

bool is_convex(const CellPoints& cell) {
  const auto& p = cell.corner;
  if (cell.triangle) return geometry::orient2d_filtered(p[1], p[2], p[3]) > 0;
  return is_convex_quadrilateral(p[0], p[1], p[2], p[3]);
}

LayerColumns columns_of(const Walls& walls, const std::vector<LayeredWall>& layered,
                        const FanSectors& sectors, const LayerOptions& options, std::uint32_t levels) {
  LayerColumns columns{rings_of(walls, layered, sectors, options), 0};
  std::vector<ColumnRing>& rings = columns.rings;
  set_room(rings, walls, options.thickness);
  for (ColumnRing& ring : rings) lean_to_openings(ring, options);
  number_outside_curves(walls.domain, rings);
  std::vector<std::vector<double>> room;
  for (const ColumnRing& ring : rings) room.push_back(ring.thickness);
  Concessions given(rings);
  ColumnSet marked;
  for (int round = 0; round < most_rounds; ++round) {
    marked.clear();
    for (std::size_t r = 0; r < rings.size(); ++r) {
      set_ends(rings[r]);
      set_tops(rings[r], given.tilt(r));
      set_points(rings[r], options, levels);
      marked.emplace_back(rings[r].size());
    }
    const bool folded = mark_folded(rings, levels, marked);
    if (!folded && !mark_meeting(walls, rings, levels, marked)) {
      columns.shrunk = given.count();
      return columns;
    }
    if (!given.demand(marked)) break;
    for (std::size_t r = 0; r < rings.size(); ++r) {
      for (std::size_t c = 0; c < rings[r].size(); ++c)
        rings[r].thickness[c] = room[r][c] * given.thickness(r)[c];
      limit_slope(rings[r]);
    }
  }
  refuse_layer(walls.domain, rings, marked);
}

}  // namespace remodel
