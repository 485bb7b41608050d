#include "layer/rings.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/place_text.h"
#include "remodel/error.h"
#include "shape/turn.h"

namespace remodel {

namespace {

constexpr double full_turn_deg = 360.0;
// A station without a fan that turns by this much has become a corner.
constexpr double corner_from_deg = 60.0;

Point left_of(Point v) {
  return {-v.y, v.x};
}
Point unit(Point v) {
  return (1.0 / std::sqrt(dot(v, v))) * v;
}
// Turned by what turns the x axis to `by`, of length 1.
Point turned(Point v, Point by) {
  return {v.x * by.x - v.y * by.y, v.x * by.y + v.y * by.x};
}

// The turns, above -1/2 and at most 1/2, that lead from a to b, both of length 1. The bits are the same
// everywhere: Newton's method on what direction() gives. Its error is cubed by each step, from 0.05 at most.
double turns_between(Point a, Point b) {
  const Point v{dot(a, b), cross(a, b)};
  const double x = std::abs(v.x), y = std::abs(v.y);
  const double least = std::min(x, y), most = std::max(x, y);
  double turns = least / (8.0 * most);
  if (y > x) turns = 0.25 - turns;
  if (v.x < 0.0) turns = 0.5 - turns;
  if (v.y < 0.0) turns = -turns;
  for (int i = 0; i < 4; ++i) turns += cross(direction(turns), v) / (2.0 * std::numbers::pi);
  return turns;
}

struct WallCorner {
  Point before, after;  // the normals of the edges that meet there, into the domain
  // From one to the other, positive where the corner is convex, seen from the domain; 0 for small ones
  // without a fan.
  double turns = 0.0;
};

// One sector turns by about what a cell of the layer grows by: then the cells of fans are isotropic at the
// top.
double sector_turns(const LayerOptions& options) {
  return (options.growth - 1.0) / (2.0 * std::numbers::pi);
}

// Two corners with a fan each, and a short edge between them, such as the base of a trailing edge: their
// columns at that edge lean apart so that its tops are as far from each other as those of a sector, and not
// as near as the edge is short.
void lean_apart(WallCorner& from, WallCorner& to, double edge, bool left, const LayerOptions& options) {
  const double missing = (sector_turns(options) - edge / (2.0 * std::numbers::pi * options.thickness)) / 2.0;
  const double lean = std::min({missing, 0.25 * from.turns, 0.25 * to.turns});
  if (lean <= 0.0) return;
  from.after = turned(from.after, direction(left ? lean : -lean));
  to.before = turned(to.before, direction(left ? -lean : lean));
  from.turns -= lean;
  to.turns -= lean;
}

// Turns of stations without a fan are only compared with angles far larger than this: they need no exact
// ones.
constexpr double cosine_of_small_turn = 0.98;

// The normal of each edge, into the domain.
std::vector<Point> edge_normals(const std::vector<Point>& points, bool closed, bool left) {
  std::vector<Point> normals(points.size() - (closed ? 0 : 1));
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Point along = unit(points[i + 1 == points.size() ? 0 : i + 1] - points[i]);
    normals[i] = left ? left_of(along) : -1.0 * left_of(along);
  }
  return normals;
}

// `sectors`: of fans at these stations, where there are any. The ends of a chain are no corners.
std::vector<WallCorner> corners_of_wall(const std::vector<Point>& points, bool closed, bool left,
                                        const LayerOptions& options,
                                        const std::vector<std::uint32_t>* sectors) {
  const std::size_t n = points.size();
  const std::vector<Point> normals = edge_normals(points, closed, left);
  std::vector<WallCorner> corners(n);
  if (!closed) {
    corners.front() = {normals.front(), normals.front(), 0.0};
    corners.back() = {normals.back(), normals.back(), 0.0};
  }
  for (std::size_t i = closed ? 0 : 1; i < (closed ? n : n - 1); ++i) {
    corners[i] = {normals[i == 0 ? n - 1 : i - 1], normals[i], 0.0};
    const Point before = corners[i].before, after = corners[i].after;
    const bool fan = sectors != nullptr && (*sectors)[i] > 0;
    if (!fan && dot(before, after) > cosine_of_small_turn) continue;
    const double turns = turns_between(before, after);
    corners[i].turns = left ? -turns : turns;
  }
  const auto has_fan = [&](std::size_t i) {
    return sectors != nullptr ? (*sectors)[i] > 0 : corners[i].turns * full_turn_deg > options.fan_from_deg;
  };
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const std::size_t next = i + 1 == n ? 0 : i + 1;
    if (has_fan(i) && has_fan(next))
      lean_apart(corners[i], corners[next], distance(points[i], points[next]), left, options);
  }
  return corners;
}

std::uint32_t sectors_for(double turns, const LayerOptions& options) {
  if (turns * full_turn_deg <= options.fan_from_deg) return 0;
  const double sectors = std::floor(turns / sector_turns(options) + 0.5);
  return static_cast<std::uint32_t>(std::clamp(sectors, 2.0, 64.0));
}

// Whether a corner may keep the sectors that it has.
bool still_fits(double turns, std::uint32_t sectors, const LayerOptions& options) {
  if (sectors == 0) return turns * full_turn_deg <= std::max(corner_from_deg, options.fan_from_deg);
  if (turns <= 0.0) return false;
  const double wanted = std::clamp(turns / sector_turns(options), 2.0, 64.0);
  return std::abs(wanted - static_cast<double>(sectors)) <= 2.5;
}

void add_columns(ColumnRing& ring, const Walls& walls, const std::vector<std::uint32_t>& sectors,
                 const LayerOptions& options) {
  const std::vector<Point> points = walls.points_of(ring.wall);
  const auto corners = corners_of_wall(points, ring.closed(), ring.left, options, &sectors);
  const std::size_t n = points.size(), stations = walls.points[ring.wall.loop].size();
  for (std::size_t i = 0; i < n; ++i) {
    const bool first = !ring.closed() && i == 0, last = !ring.closed() && i + 1 == n;
    const double to_next = last ? 0.0 : distance(points[i], points[i + 1 == n ? 0 : i + 1]);
    const double from_previous = first ? 0.0 : distance(points[i == 0 ? n - 1 : i - 1], points[i]);
    const std::uint32_t fan = sectors[i];
    for (std::uint32_t j = 0; j <= fan; ++j) {
      ring.station.push_back(static_cast<std::uint32_t>((ring.wall.station + i) % stations));
      ring.foot.push_back(points[i]);
      ring.spacing.push_back((first || last ? 1.0 : 0.5) * (from_previous + to_next));
      ring.step.push_back(j < fan ? 0.0 : to_next);
      if (fan == 0) {
        ring.normal.push_back(unit(corners[i].before + corners[i].after));
      } else {
        const double turns = (ring.left ? -corners[i].turns : corners[i].turns) * j / fan;
        ring.normal.push_back(j == fan ? corners[i].after : turned(corners[i].before, direction(turns)));
      }
    }
  }
}

}  // namespace

FanSectors fans_of(const Walls& walls, const std::vector<LayeredWall>& layered, const LayerOptions& options,
                   const std::vector<const std::vector<std::uint32_t>*>& kept) {
  FanSectors fans;
  for (std::size_t r = 0; r < layered.size(); ++r) {
    const std::vector<Point> points = walls.points_of(layered[r]);
    const std::vector<std::uint32_t>* own =
        kept[r] != nullptr && kept[r]->size() == points.size() ? kept[r] : nullptr;
    const auto corners =
        corners_of_wall(points, layered[r].closed, walls.on_left(layered[r].loop), options, own);
    std::vector<std::uint32_t>& sectors = fans.emplace_back(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const bool fits = own != nullptr && still_fits(corners[i].turns, (*own)[i], options);
      sectors[i] = fits ? (*own)[i] : sectors_for(corners[i].turns, options);
    }
  }
  return fans;
}

std::vector<ColumnRing> rings_of(const Walls& walls, const std::vector<LayeredWall>& layered,
                                 const FanSectors& sectors, const LayerOptions& options) {
  std::vector<ColumnRing> rings;
  for (std::size_t r = 0; r < layered.size(); ++r) {
    ColumnRing& ring = rings.emplace_back();
    ring.wall = layered[r];
    ring.left = walls.on_left(layered[r].loop);
    add_columns(ring, walls, sectors[r], options);
    if (!ring.closed()) ring.openings = openings_of(walls, ring.wall);
    ring.top = ring.normal;
  }
  return rings;
}

void lean_to_openings(ColumnRing& ring, const LayerOptions& options) {
  if (ring.closed()) return;
  constexpr double thicknesses = 4.0;
  const double reach = thicknesses * options.thickness;
  const std::size_t n = ring.size();
  const auto lean = [&](const Opening& opening, std::size_t end, bool forward) {
    const Point along = unit(opening.at(std::min(options.thickness, opening.longest())) - ring.foot[end]);
    const Point by = along - ring.normal[end];
    double away = 0.0;
    for (std::size_t k = 0, c = end; k < n && away < reach; ++k) {
      const double left = 1.0 - away / reach;
      ring.normal[c] = c == end ? along : unit(ring.normal[c] + (left * left * left) * by);
      if (k + 1 == n) break;
      away += forward ? ring.step[c] : ring.step[c - 1];
      c = forward ? c + 1 : c - 1;
    }
  };
  lean(ring.openings[0], 0, true);
  lean(ring.openings[1], n - 1, false);
}

std::string column_place(const Domain& domain, const ColumnRing& ring, std::size_t column) {
  const BoundaryStation station = domain.stations(ring.wall.loop)[ring.station[column]];
  return "loop " + std::to_string(ring.wall.loop) + ", curve \"" + domain.curve(station.curve).name +
         "\", t = " + exact_text(station.t) + " " + exact_text(ring.foot[column]);
}

}  // namespace remodel
