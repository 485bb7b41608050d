// Coordinate files of airfoils, as rows of numbers, become an upper and a lower surface.
//
//   Selig order:     trailing edge - upper surface - leading edge - lower surface - trailing edge
//   Lednicer order:  a line with the number of points of each surface, then the upper and the lower surface,
//                    both from the leading to the trailing edge

#include <algorithm>
#include <cmath>
#include <sstream>

#include "airfoil_rows.h"
#include "remodel/error.h"

namespace remodel {
namespace {

using Rows = std::vector<AirfoilRow>;

// The two surfaces may end this far apart in x: trailing edges cut at an angle. More is a file that was cut
// off.
constexpr double end_tolerance = 0.02;
// The surfaces are compared by straight interpolation between the file's points, which misses the true curve
// by up to this near a sparse nose. What crosses by more is no airfoil; what crosses by less, the fit
// decides.
constexpr double crossing_tolerance = 2e-3;

template <typename... Parts>
[[noreturn]] void refuse_file(const std::string& where, const Parts&... parts) {
  std::ostringstream problem;
  problem.precision(10);
  (problem << ... << parts);
  throw Error(ErrorCode::format, where, problem.str());
}

std::string place(const std::string& source, const AirfoilRow& row) {
  return row.line > 0 ? source + ":" + std::to_string(row.line) : source;
}

bool is_count(double value) {
  return value >= 2.0 && value == std::floor(value);
}

// A first row such as "61. 61.". A Selig file of a chord of 100 may begin with whole numbers too, but its
// first x is where its points end.
bool begins_with_counts(const Rows& rows) {
  const Point first = rows.front().point;
  if (!is_count(first.x) || !is_count(first.y)) return false;
  if (first.x + first.y == static_cast<double>(rows.size() - 1)) return true;
  double least = HUGE_VAL;
  double largest = -HUGE_VAL;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    least = std::min(least, rows[i].point.x);
    largest = std::max(largest, rows[i].point.x);
  }
  return rows.size() == 1 || std::abs(first.x - largest) > end_tolerance * (largest - least);
}

Rows outline_of_lednicer(const Rows& rows, const std::string& source) {
  const Point counts = rows.front().point;
  if (counts.x + counts.y != static_cast<double>(rows.size() - 1)) {
    refuse_file(place(source, rows.front()), "found counts of ", counts.x, " and ", counts.y, " points, but ",
                rows.size() - 1, " points follow");
  }
  const auto middle = rows.begin() + 1 + static_cast<std::ptrdiff_t>(counts.x);
  const Rows upper(rows.begin() + 1, middle);
  Rows lower(middle, rows.end());
  for (const Rows* surface : {&upper, static_cast<const Rows*>(&lower)}) {
    if (!(surface->front().point.x < surface->back().point.x)) {
      refuse_file(place(source, surface->front()), "found a surface from x = ", surface->front().point.x,
                  " to x = ", surface->back().point.x, ", expected it from the leading to the trailing edge");
    }
  }
  if (lower.front().point == upper.front().point) lower.erase(lower.begin());
  Rows outline(upper.rbegin(), upper.rend());
  outline.insert(outline.end(), lower.begin(), lower.end());
  return outline;
}

void drop_repetitions(Rows& outline) {
  const auto same = [](const AirfoilRow& a, const AirfoilRow& b) { return a.point == b.point; };
  outline.erase(std::unique(outline.begin(), outline.end(), same), outline.end());
}

// The parametrisation is y over x, so the leading edge is where x is smallest, whatever point the file's
// author had in mind; the middle one of a flat nose.
std::size_t leading_edge(const Rows& outline) {
  const auto by_x = [](const AirfoilRow& a, const AirfoilRow& b) { return a.point.x < b.point.x; };
  const auto first = std::min_element(outline.begin(), outline.end(), by_x);
  auto last = first;
  while (last + 1 != outline.end() && (last + 1)->point.x == first->point.x) ++last;
  return static_cast<std::size_t>((first - outline.begin() + (last - outline.begin())) / 2);
}

double area_of(const Rows& outline) {
  double twice = 0.0;
  const Point origin = outline.front().point;
  for (std::size_t i = 2; i < outline.size(); ++i) {
    twice += cross(outline[i - 1].point - origin, outline[i].point - origin);
  }
  return 0.5 * twice;
}

// A blunt trailing edge may be drawn, as points below each other: the outermost of them ends the surface.
void drop_trailing_edge_base(Rows& surface) {
  while (surface.size() > 3 && surface[surface.size() - 2].point.x == surface.back().point.x)
    surface.pop_back();
}

void check_order(const Rows& surface, const std::string& source) {
  if (surface.size() < 3) {
    refuse_file(
        place(source, surface.back()), "found a surface of ", surface.size(),
        " points, expected at least 3, and the trailing edge first (Selig) or the points counted (Lednicer)");
  }
  const double nose = surface.front().point.x;
  for (std::size_t i = 1; i < surface.size(); ++i) {
    const double x = surface[i].point.x;
    if (x > surface[i - 1].point.x || x == nose) continue;
    refuse_file(place(source, surface[i]), "found x = ", x, " beside x = ", surface[i - 1].point.x,
                ", expected x to grow from the leading to the trailing edge");
  }
}

// Chord 1, leading edge at the origin, trailing edge at (1, 0): no rotation, which would break the premise
// that opposite vertices share x, but a shear, linear in x, which for a leading edge a little off is the
// same. Returns the shear.
double normalise(Rows& upper, Rows& lower, const std::string& source) {
  const Point nose = upper.front().point;
  const Point tail = 0.5 * (upper.back().point + lower.back().point);
  const double chord = tail.x - nose.x;
  if (std::abs(upper.back().point.x - lower.back().point.x) > end_tolerance * chord) {
    refuse_file(source, "found surfaces that end at x = ", upper.back().point.x,
                " and x = ", lower.back().point.x, ", expected both at the trailing edge");
  }
  if (!(chord >= 1e-6)) refuse_file(source, "found a chord of ", chord, ", expected at least 1e-6");
  for (Rows* surface : {&upper, &lower}) {
    for (AirfoilRow& row : *surface) {
      const double x = (row.point.x - nose.x) / chord;
      row.point = {x, (row.point.y - nose.y) / chord - x * ((tail.y - nose.y) / chord)};
    }
  }
  return (tail.y - nose.y) / chord;
}

double interpolated(const Rows& surface, double x) {
  const auto right =
      std::upper_bound(surface.begin() + 1, surface.end() - 1, x,
                       [](double value, const AirfoilRow& row) { return value < row.point.x; });
  const Point a = (right - 1)->point;
  const Point b = right->point;
  if (a.x == b.x) return a.y;
  return a.y + (b.y - a.y) * ((x - a.x) / (b.x - a.x));
}

void check_above(const Rows& points, const Rows& other, double sign, const std::string& source) {
  for (const AirfoilRow& row : points) {
    const Point p = row.point;
    if (p.x <= 0.0 || p.x >= 1.0 || sign * (p.y - interpolated(other, p.x)) >= -crossing_tolerance) continue;
    refuse_file(place(source, row), "found the surfaces crossed at x = ", p.x,
                " chords, expected the upper one above the lower one");
  }
}

std::vector<Point> points_of(const Rows& rows) {
  std::vector<Point> points;
  points.reserve(rows.size());
  for (const AirfoilRow& row : rows) points.push_back(row.point);
  return points;
}

}  // namespace

AirfoilCoordinates surfaces_of_outline(std::string name, Rows outline, const std::string& source) {
  drop_repetitions(outline);
  const auto nose = outline.begin() + static_cast<std::ptrdiff_t>(leading_edge(outline));
  Rows upper(outline.begin(), nose + 1);
  std::reverse(upper.begin(), upper.end());
  Rows lower(nose, outline.end());
  if (area_of(outline) < 0.0) std::swap(upper, lower);  // the lower surface came first
  for (Rows* surface : {&upper, &lower}) {
    drop_trailing_edge_base(*surface);
    check_order(*surface, source);
  }
  const double incline = normalise(upper, lower, source);
  check_above(upper, lower, 1.0, source);
  check_above(lower, upper, -1.0, source);
  return {.name = std::move(name), .upper = points_of(upper), .lower = points_of(lower), .incline = incline};
}

AirfoilCoordinates parse_airfoil(std::string_view text, const std::string& source) {
  AirfoilRows file = read_airfoil_rows(text, source);
  if (file.rows.empty()) refuse_file(source, "found no coordinates, expected lines of two numbers, x and y");
  const Rows outline = begins_with_counts(file.rows) ? outline_of_lednicer(file.rows, source) : file.rows;
  return surfaces_of_outline(std::move(file.name), outline, source);
}

}  // namespace remodel
