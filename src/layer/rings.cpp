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
  // From one to the other, positive where the corner is convex, seen from the domain; 0 for small ones without a fan.
  double turns = 0.0;
};

double signed_area_of(const std::vector<Point>& polygon) {
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    twice += cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  return 0.5 * twice;
}

bool domain_on_left(const Walls& walls, std::size_t loop) {
  const LoopRole role = walls.domain.loops[loop].role;
  if (role == LoopRole::left || role == LoopRole::right) return role == LoopRole::left;
  return (role == LoopRole::outer) == (signed_area_of(walls.points[loop]) > 0.0);
}

// One sector turns by about what a cell of the layer grows by: then the cells of fans are isotropic at the top.
double sector_turns(const LayerOptions& options) {
  return (options.growth - 1.0) / (2.0 * std::numbers::pi);
}

// Two corners with a fan each, and a short edge between them, such as the base of a trailing edge: their columns at
// that edge lean apart so that its tops are as far from each other as those of a sector, and not as near as the edge
// is short.
void lean_apart(WallCorner& from, WallCorner& to, double edge, bool left, const LayerOptions& options) {
  const double missing = (sector_turns(options) - edge / (2.0 * std::numbers::pi * options.thickness)) / 2.0;
  const double lean = std::min({missing, 0.25 * from.turns, 0.25 * to.turns});
  if (lean <= 0.0) return;
  from.after = turned(from.after, direction(left ? lean : -lean));
  to.before = turned(to.before, direction(left ? -lean : lean));
  from.turns -= lean;
  to.turns -= lean;
}

// Turns of stations without a fan are only compared with angles far larger than this: they need no exact ones.
constexpr double cosine_of_small_turn = 0.98;

// `sectors`: of fans at these stations, where there are any.
std::vector<WallCorner> corners_of_wall(const std::vector<Point>& points, bool left, const LayerOptions& options,
                                        const std::vector<std::uint32_t>* sectors) {
  const std::size_t n = points.size();
  std::vector<Point> normals(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Point along = unit(points[i + 1 == n ? 0 : i + 1] - points[i]);
    normals[i] = left ? left_of(along) : -1.0 * left_of(along);
  }
  std::vector<WallCorner> corners(n);
  for (std::size_t i = 0; i < n; ++i) {
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
  for (std::size_t i = 0; i < n; ++i) {
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

std::string loop_text(const Domain& domain, std::size_t loop) {
  return "loop " + std::to_string(loop) + ", curve \"" + domain.loops[loop].curves.front().name + "\"";
}

bool is_named(const Loop& loop, const std::vector<std::string>& names) {
  const auto named = [&](const Curve& curve) {
    return std::find(names.begin(), names.end(), curve.name) != names.end();
  };
  const auto count = std::count_if(loop.curves.begin(), loop.curves.end(), named);
  if (count == 0) return false;
  if (loop.open || loop.role == LoopRole::internal || count < static_cast<std::ptrdiff_t>(loop.curves.size()))
    throw Error(ErrorCode::argument, "walls",
                "found boundary '" + std::find_if(loop.curves.begin(), loop.curves.end(), named)->name +
                    "', which is a part of a loop or lies inside the domain, expected names of whole closed loops");
  return true;
}

void require_known_names(const Domain& domain, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const auto has_name = [&](const Curve& curve) { return curve.name == name; };
    const auto in_loop = [&](const Loop& loop) {
      return std::any_of(loop.curves.begin(), loop.curves.end(), has_name);
    };
    if (!std::any_of(domain.loops.begin(), domain.loops.end(), in_loop))
      throw Error(ErrorCode::argument, "walls", "found '" + name + "', expected a boundary of the domain");
  }
}

// A chain that ends on a wall would have to end on the tops.
void require_no_chains(const Domain& domain, const std::vector<std::size_t>& loops) {
  std::vector<Point> ends;
  for (std::size_t l = 0; l < domain.loops.size(); ++l) {
    if (!domain.loops[l].open) continue;
    const std::vector<Point> points = domain.points(l);
    if (!points.empty()) ends.insert(ends.end(), {points.front(), points.back()});
  }
  for (const std::size_t l : loops) {
    if (ends.empty()) return;
    for (const Point p : domain.points(l))
      if (std::find(ends.begin(), ends.end(), p) != ends.end())
        throw Error(ErrorCode::geometry, "layers",
                    "found a chain that ends on " + loop_text(domain, l) + ", at " + exact_text(p) +
                        ", expected walls that no chain joins");
  }
}

}  // namespace

Walls::Walls(const Domain& of) : domain(of) {
  for (std::size_t l = 0; l < domain.loops.size(); ++l) points.push_back(domain.points(l));
}

std::vector<std::size_t> layered_loops(const Domain& domain, const LayerOptions& options) {
  require_known_names(domain, options.walls);
  std::vector<std::size_t> loops;
  for (std::size_t l = 0; l < domain.loops.size(); ++l) {
    const Loop& loop = domain.loops[l];
    if (options.walls.empty() ? loop.role == LoopRole::hole : is_named(loop, options.walls)) loops.push_back(l);
  }
  if (loops.empty())
    throw Error(ErrorCode::argument, "walls",
                "found a domain without holes, expected a closed wall for the layer: the walls of a duct, which end at an inlet "
                "or outlet, get none");
  require_no_chains(domain, loops);
  return loops;
}

FanSectors fans_of(const Walls& walls, const std::vector<std::size_t>& loops, const LayerOptions& options,
                   const std::vector<const std::vector<std::uint32_t>*>& kept) {
  FanSectors fans;
  for (std::size_t r = 0; r < loops.size(); ++r) {
    const std::vector<Point>& points = walls.points[loops[r]];
    const std::vector<std::uint32_t>* own = kept[r] != nullptr && kept[r]->size() == points.size() ? kept[r] : nullptr;
    const auto corners = corners_of_wall(points, domain_on_left(walls, loops[r]), options, own);
    std::vector<std::uint32_t>& sectors = fans.emplace_back(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const bool fits = own != nullptr && still_fits(corners[i].turns, (*own)[i], options);
      sectors[i] = fits ? (*own)[i] : sectors_for(corners[i].turns, options);
    }
  }
  return fans;
}

std::vector<ColumnRing> rings_of(const Walls& walls, const std::vector<std::size_t>& loops,
                                 const FanSectors& sectors, const LayerOptions& options) {
  std::vector<ColumnRing> rings;
  for (std::size_t r = 0; r < loops.size(); ++r) {
    ColumnRing& ring = rings.emplace_back();
    ring.loop = loops[r];
    ring.left = domain_on_left(walls, loops[r]);
    const std::vector<Point>& points = walls.points[loops[r]];
    const auto corners = corners_of_wall(points, ring.left, options, &sectors[r]);
    const std::size_t n = points.size();
    for (std::size_t i = 0; i < n; ++i) {
      const double to_next = distance(points[i], points[i + 1 == n ? 0 : i + 1]);
      const double from_previous = distance(points[i == 0 ? n - 1 : i - 1], points[i]);
      const std::uint32_t fan = sectors[r][i];
      for (std::uint32_t j = 0; j <= fan; ++j) {
        ring.station.push_back(static_cast<std::uint32_t>(i));
        ring.foot.push_back(points[i]);
        ring.spacing.push_back(0.5 * (from_previous + to_next));
        ring.step.push_back(j < fan ? 0.0 : to_next);
        if (fan == 0) {
          ring.normal.push_back(unit(corners[i].before + corners[i].after));
        } else {
          const double turns = (ring.left ? -corners[i].turns : corners[i].turns) * j / fan;
          ring.normal.push_back(j == fan ? corners[i].after : turned(corners[i].before, direction(turns)));
        }
      }
    }
    ring.top = ring.normal;
  }
  return rings;
}

std::string column_place(const Domain& domain, const ColumnRing& ring, std::size_t column) {
  const BoundaryStation station = domain.stations(ring.loop)[ring.station[column]];
  return "loop " + std::to_string(ring.loop) + ", curve \"" + domain.curve(station.curve).name +
         "\", t = " + exact_text(station.t) + " " + exact_text(ring.foot[column]);
}

}  // namespace remodel
