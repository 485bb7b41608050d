// Coordinate files of airfoils become outlines, and an upper and a lower surface.

#include <algorithm>
#include <cmath>
#include <sstream>

#include "airfoil_rows.h"
#include "remodel/error.h"

namespace remodel {
namespace {

using Rows = AirfoilRowList;

// The two surfaces may end this far apart in x: trailing edges cut at an angle. More is a file that was cut
// off.
constexpr double end_tolerance = 0.02;
// The surfaces are compared by straight interpolation between the file's points, which misses the true curve
// by up to this near a sparse nose. What crosses by more is no airfoil; what crosses by less, the fit
// decides.
constexpr double crossing_tolerance = 2e-3;
// What is said: more than the digits of files and the scaling of a chord of about 1.
constexpr double notable_degrees = 0.1, notable_length = 0.01, notable_gap = 1e-5;

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
    if (i == 1 && x > -1e-5) continue;  // the arc's own depth
    refuse_file(
        place(source, surface[i]), "found x = ", x, " behind x = ", surface[i - 1].point.x,
        " in chords from the nose, expected x to grow from the leading to the trailing edge, as a fit of "
        "y over x needs it: an outline that goes back and forth has none and is taken as given alone");
  }
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

// From the nose on, in its frame.
Rows surface_of(const Rows& run, const AirfoilNose& nose) {
  Rows surface;
  if (nose.before != nose.after) surface.push_back({.point = {}, .line = run.front().line});
  for (const AirfoilRow& row : run) surface.push_back({in_frame(nose.frame, row.point), row.line});
  return surface;
}

AirfoilCoordinates split_at_nose(std::string name, const Rows& rows, const AirfoilNose& nose,
                                 const std::string& source) {
  Rows back(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(nose.before) + 1);
  std::reverse(back.begin(), back.end());
  const Rows ahead(rows.begin() + static_cast<std::ptrdiff_t>(nose.after), rows.end());
  const Rows upper = surface_of(back, nose), lower = surface_of(ahead, nose);
  check_order(upper, source);
  check_order(lower, source);
  if (std::abs(upper.back().point.x - lower.back().point.x) > end_tolerance)
    refuse_file(source, "found surfaces that end at x = ", upper.back().point.x,
                " and x = ", lower.back().point.x,
                " in chords from the nose, expected both at the trailing edge");
  check_above(upper, lower, 1.0, source);
  check_above(lower, upper, -1.0, source);
  return {.name = std::move(name), .upper = points_of(upper), .lower = points_of(lower), .frame = nose.frame};
}

void drop_repetitions(Rows& outline) {
  const auto same = [](const AirfoilRow& a, const AirfoilRow& b) { return a.point == b.point; };
  outline.erase(std::unique(outline.begin(), outline.end(), same), outline.end());
}

// A number as people say it.
std::string said(double value, int digits) {
  std::ostringstream text;
  text.precision(digits);
  text << value;
  return text.str();
}

std::string with_decimal(double degrees) {
  std::ostringstream text;
  text.setf(std::ios::fixed);
  text.precision(1);
  text << degrees;
  return text.str();
}

void note_turn(const AirfoilFrame& frame, std::vector<std::string>& notes) {
  const double degrees = frame.incidence_deg();
  if (std::abs(degrees) < notable_degrees) return;
  notes.push_back(
      "its chord is drawn nose " + std::string(degrees > 0.0 ? "up" : "down") + " by " +
      with_decimal(std::abs(degrees)) +
      " degrees; the fit lies along its chord, which angles are from unless it is placed as drawn");
}

void note_size(const AirfoilFrame& frame, std::vector<std::string>& notes) {
  const bool scaled = std::abs(frame.chord - 1.0) > notable_length;
  const bool moved = std::sqrt(squared_distance(frame.nose, {})) > notable_length * frame.chord;
  const auto rounded = [&](double value) {  // to what matters of a chord
    return said(std::round(value / frame.chord * 1e4) * 1e-4 * frame.chord + 0.0, 6);
  };
  const std::string nose = rounded(frame.nose.x) + "," + rounded(frame.nose.y);
  if (scaled)
    notes.push_back("its chord of " + said(frame.chord, 6) + " is scaled to 1" +
                    (moved ? " and its nose moved from " + nose + " to the origin" : ""));
  else if (moved)
    notes.push_back("its nose is moved from " + nose + " to the origin");
}

void note_gap(double gap, std::vector<std::string>& notes) {
  if (gap >= -notable_gap) return;
  notes.push_back("its trailing edge is crossed by " + said(-gap, 3) + " chords, and the fit closes it");
}

// Blunt trailing edges of the usual collections are a tenth of this or less, those of most flat backs less
// than it: what is said of the others is true of them too.
constexpr double notable_base = 0.03;

// An outline that stops before its trailing edge looks as one with a base does, but for its length.
void note_base(double gap, const std::string& element, std::vector<std::string>& notes) {
  if (std::abs(gap) <= notable_base) return;
  notes.push_back(element + "its ends are " + said(std::abs(gap), 3) +
                  " chords apart, and a straight edge closes the outline there");
}

std::vector<std::string> with_source(std::vector<std::string> notes, const std::string& source) {
  for (std::string& note : notes) note.insert(0, source + ": ");
  return notes;
}

}  // namespace

AirfoilCoordinates surfaces_of_outline(std::string name, Rows outline, const std::string& source) {
  drop_repetitions(outline);
  if (twice_area_of(outline) < 0.0) std::reverse(outline.begin(), outline.end());
  return split_at_nose(std::move(name), outline, foremost_nose(outline), source);
}

AirfoilCoordinates surfaces_of(const AirfoilOutline& outline, const std::string& source) {
  AirfoilLoop loop;
  for (const Point p : outline.points) loop.rows.push_back({p, 0});
  const Rows rows = without_base(std::move(loop)).rows;
  return split_at_nose(outline.name, rows, nose_of(rows), source);
}

AirfoilCoordinates parse_airfoil(std::string_view text, const std::string& source) {
  AirfoilText file = read_airfoil_rows(text, source);
  if (file.elements.size() > 1)
    refuse_file(source, "found ", file.elements.size(), " elements, the second from line ",
                file.elements[1].rows.front().line,
                " on, expected one airfoil: several are taken as a domain is, by mesh, flow and update");
  const AirfoilLoop loop = loop_of_element(file.elements.front(), source);
  const Rows rows = without_base(loop).rows;
  const AirfoilNose nose = nose_of(rows);
  AirfoilCoordinates result = split_at_nose(std::move(file.name), rows, nose, source);
  result.frame.closed = loop.closed ? loop.gap / nose.frame.chord : 0.0;
  std::vector<std::string> notes = std::move(file.notes);
  note_turn(nose.frame, notes);
  note_size(nose.frame, notes);
  note_gap(result.upper.back().y - result.lower.back().y, notes);
  result.warnings = with_source(std::move(notes), source);
  return result;
}

AirfoilOutlines parse_outlines(std::string_view text, const std::string& source) {
  AirfoilText file = read_airfoil_rows(text, source);
  AirfoilOutlines result;
  for (const AirfoilElement& element : file.elements) {
    const AirfoilLoop loop = loop_of_element(element, source);
    AirfoilOutline outline{.name = file.name, .points = points_of(loop.rows)};
    outline.frame = nose_of(without_base(loop).rows).frame;
    outline.frame.closed = loop.closed ? loop.gap / outline.frame.chord : 0.0;
    outline.gap = loop.closed ? 0.0 : loop.gap / outline.frame.chord;
    note_base(outline.gap,
              file.elements.size() == 1 ? "" : "element " + std::to_string(result.elements.size() + 1) + ": ",
              file.notes);
    result.elements.push_back(std::move(outline));
  }
  result.warnings = with_source(std::move(file.notes), source);
  return result;
}

}  // namespace remodel
