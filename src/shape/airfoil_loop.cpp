// The rows of an element become a closed outline that begins at the trailing edge, whatever the file begins
// with.

#include <algorithm>
#include <cmath>
#include <sstream>

#include "airfoil_rows.h"
#include "remodel/error.h"

namespace remodel {
namespace {

// Files have five or six digits: what lies closer together than this, in chords, is one point, and ends that
// are closer than that are one edge.
constexpr double same_point = 1e-7, same_edge = 1e-5;
// A base is drawn across the chord: within six degrees.
constexpr double across = 0.1;
// The line from the last point to the first where a file leaves it out: within 53 degrees.
constexpr double slanted = 0.8;
// The base of a trailing edge is a small part of the chord.
constexpr double largest_base = 0.2;
// The last side before a sharp trailing edge, where a file may leave it out.
constexpr double largest_side = 0.06;
// Ends farther apart are no base and no side: a surface is missing.
constexpr double largest_gap = 0.75;
constexpr double count_tolerance = 0.02;

template <typename... Parts>
[[noreturn]] void refuse(const std::string& source, const AirfoilRow* row, const Parts&... parts) {
  std::ostringstream problem;
  problem.precision(10);
  (problem << ... << parts);
  throw Error(ErrorCode::format,
              row != nullptr && row->line > 0 ? source + ":" + std::to_string(row->line) : source,
              problem.str());
}

bool is_count(double value) {
  return value >= 2.0 && value == std::floor(value);
}

// A first row such as "61. 61.". A Selig file of a chord of 100 may begin with whole numbers too, but its
// first x is where its points end.
bool begins_with_counts(const AirfoilRowList& rows) {
  const Point first = rows.front().point;
  if (!is_count(first.x) || !is_count(first.y)) return false;
  if (first.x + first.y == static_cast<double>(rows.size() - 1)) return true;
  double least = HUGE_VAL, largest = -HUGE_VAL;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    least = std::min(least, rows[i].point.x);
    largest = std::max(largest, rows[i].point.x);
  }
  return rows.size() == 1 || std::abs(first.x - largest) > count_tolerance * (largest - least);
}

AirfoilElement without_counts(const AirfoilElement& element, const std::string& source) {
  const AirfoilRowList& rows = element.rows;
  if (element.first_surface > 0 || !begins_with_counts(rows)) return element;
  const Point counts = rows.front().point;
  if (counts.x + counts.y != static_cast<double>(rows.size() - 1))
    refuse(source, &rows.front(), "found counts of ", counts.x, " and ", counts.y, " points, but ",
           rows.size() - 1, " points follow");
  return {.rows = {rows.begin() + 1, rows.end()}, .first_surface = static_cast<std::size_t>(counts.x)};
}

// Two surfaces from the leading edge become one run around it.
AirfoilRowList run_of(const AirfoilElement& given, const std::string& source) {
  const AirfoilElement element = without_counts(given, source);
  if (element.first_surface == 0) return element.rows;
  const auto middle = element.rows.begin() + static_cast<std::ptrdiff_t>(element.first_surface);
  const AirfoilRowList first(element.rows.begin(), middle), second(middle, element.rows.end());
  for (const AirfoilRowList* surface : {&first, &second}) {
    if (!surface->empty() && surface->front().point.x < surface->back().point.x) continue;
    if (surface->empty()) refuse(source, nullptr, "found a surface without points, expected two surfaces");
    refuse(source, &surface->front(), "found a surface from x = ", surface->front().point.x,
           " to x = ", surface->back().point.x, ", expected it from the leading to the trailing edge");
  }
  AirfoilRowList run(first.rbegin(), first.rend());
  run.insert(run.end(), second.begin(), second.end());
  return run;
}

std::size_t farthest_from(const AirfoilRowList& rows, Point p) {
  std::size_t farthest = 0;
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (squared_distance(rows[i].point, p) > squared_distance(rows[farthest].point, p)) farthest = i;
  return farthest;
}

void drop_repetitions(AirfoilRowList& rows, double extent) {
  const auto same = [extent](const AirfoilRow& a, const AirfoilRow& b) {
    return distance(a.point, b.point) <= same_point * extent;
  };
  const AirfoilRow last = rows.back();
  rows.erase(std::unique(rows.begin(), rows.end(), same), rows.end());
  rows.back() = last;  // an end is kept as it is
}

// Whether a side lies across the chord, the two ends of which are given, and is short.
bool is_base(Point from, Point to, Point nose, Point tail, double slant = across) {
  const Point chord = tail - nose, side = to - from;
  const double length = distance(from, to), extent = distance(nose, tail);
  return length < largest_base * extent && std::abs(dot(side, chord)) < slant * length * extent;
}

// The two ends of the chord, roughly: an outline begins at its trailing edge, or anywhere.
struct Ends {
  Point nose;
  std::size_t tail = 0;
  bool first_is_tail = false;
};

// Whether an outline begins at the end that lies at `tail`: there, or on the base beside it.
bool begins_at(const AirfoilRowList& rows, Point nose, Point tail) {
  const Point first = rows.front().point, last = rows.back().point;
  if (first == tail || last == tail) return true;
  if (distance(first, nose) < 0.9 * distance(tail, nose)) return false;
  return is_base(first, last, nose, tail, slanted) || is_base(first, rows[1].point, nose, tail) ||
         is_base(rows[rows.size() - 2].point, last, nose, tail);
}

// Whether the last side is missing, from the last point back to a sharp trailing edge: it would lie along the
// surface, and not be longer than others there.
bool leaves_its_end_out(const AirfoilRowList& rows, Point nose) {
  const Point first = rows.front().point, last = rows.back().point;
  const Point before = rows[rows.size() - 2].point;
  const double gap = distance(first, last), extent = distance(first, nose);
  return gap > same_edge * extent && gap < largest_side * extent &&
         !is_base(first, last, nose, first, slanted) && gap <= 2.0 * distance(last, before) &&
         dot(first - last, last - before) > 0.0;
}

Ends ends_of(const AirfoilRowList& rows) {
  const Point first = rows.front().point;
  const std::size_t a = farthest_from(rows, first), b = farthest_from(rows, rows[a].point);
  const double extent = distance(rows[a].point, rows[b].point);
  if (begins_at(rows, rows[a].point, rows[b].point) && first.x - rows[a].point.x > -0.2 * extent)
    return {rows[a].point, 0, true};
  const std::size_t tail = rows[a].point.x >= rows[b].point.x ? a : b;
  return {rows[tail == a ? b : a].point, tail, false};
}

// The same outline from another of its points on; where that ends a base, from the base's upper end.
AirfoilRowList from_tail(AirfoilRowList rows, const Ends& ends, double extent) {
  const Point tail = rows[ends.tail].point;
  std::size_t first = ends.tail;
  if (distance(rows.front().point, rows.back().point) <= same_edge * extent) {
    rows.pop_back();
    first %= rows.size();
  }
  std::rotate(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(first), rows.end());
  if (is_base(rows.front().point, rows[1].point, ends.nose, tail))
    std::rotate(rows.begin(), rows.begin() + 1, rows.end());
  else if (!is_base(rows.back().point, rows.front().point, ends.nose, tail))
    rows.push_back(rows.front());
  return rows;
}

}  // namespace

double twice_area_of(const AirfoilRowList& rows) {
  double twice = 0.0;
  const Point origin = rows.front().point;
  for (std::size_t i = 2; i < rows.size(); ++i)
    twice += cross(rows[i - 1].point - origin, rows[i].point - origin);
  return twice;
}

AirfoilLoop loop_of_element(const AirfoilElement& element, const std::string& source) {
  AirfoilRowList rows = run_of(element, source);
  const auto refuse_few = [&](std::size_t found) {
    refuse(source, rows.empty() ? nullptr : &rows.back(), "found an outline of ", found,
           " points, expected at least 4 different ones, and the trailing edge first (Selig) or the points "
           "counted (Lednicer)");
  };
  if (rows.size() < 4) refuse_few(rows.size());
  Ends ends = ends_of(rows);
  const double extent = distance(ends.nose, rows[ends.tail].point);
  if (!(extent >= 1e-6)) refuse(source, nullptr, "found a chord of ", extent, ", expected at least 1e-6");
  drop_repetitions(rows, extent);
  if (rows.size() < 4) refuse_few(rows.size());
  const double area = twice_area_of(rows);
  if (!(std::abs(area) > 1e-9 * extent * extent))
    refuse(source, nullptr, "found an outline that encloses nothing, expected that of an airfoil");
  if (area < 0.0) std::reverse(rows.begin(), rows.end());
  if (!ends.first_is_tail) {
    ends = ends_of(rows);
    if (!ends.first_is_tail) rows = from_tail(std::move(rows), ends, extent);
  }
  if (leaves_its_end_out(rows, ends.nose)) rows.push_back(rows.front());
  AirfoilLoop loop{.rows = std::move(rows)};
  Point& upper = loop.rows.front().point;
  Point& lower = loop.rows.back().point;
  loop.gap = distance(upper, lower);
  if (cross(ends.nose - upper, lower - upper) < 0.0) loop.gap = -loop.gap;
  if (std::abs(loop.gap) > largest_gap * extent)
    refuse(source, &loop.rows.back(), "found an outline whose ends are ", std::abs(loop.gap) / extent,
           " of its length apart, expected a closed one: the file seems to be cut off");
  if (loop.gap != 0.0 && std::abs(loop.gap) <= same_edge * extent) {
    upper = lower = 0.5 * (upper + lower);
    loop.closed = true;
  }
  return loop;
}

AirfoilLoop without_base(AirfoilLoop loop) {
  AirfoilRowList& rows = loop.rows;
  const Point tail = 0.5 * (rows.front().point + rows.back().point);
  const Point nose = rows[farthest_from(rows, tail)].point;
  const bool drawn = rows.front().point == rows.back().point;
  std::size_t first = 0, last = rows.size() - 1;
  const auto more = [&] { return last - first + 1 > 5; };
  while (more() && is_base(rows[first].point, rows[first + 1].point, nose, tail)) ++first;
  while (more() && is_base(rows[last].point, rows[last - 1].point, nose, tail)) --last;
  rows = AirfoilRowList(rows.begin() + static_cast<std::ptrdiff_t>(first),
                        rows.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  if (drawn && !(rows.front().point == rows.back().point)) {
    const Point upper = rows.front().point, lower = rows.back().point;
    loop.gap = distance(upper, lower);
    if (cross(nose - upper, lower - upper) < 0.0) loop.gap = -loop.gap;
  }
  return loop;
}

}  // namespace remodel
