#include "io/foreign.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/scanner.h"
#include "io/text_writer.h"
#include "remodel/error.h"

namespace remodel::io {

namespace {

constexpr const char* axis_names[] = {"x", "y", "z"};

struct Range {
  double low = 0.0, high = 0.0;
};

// Of the points from the first used one on.
std::array<Range, 3> ranges_of(std::span<const double> coordinates, const std::vector<bool>& used,
                               std::size_t first) {
  std::array<Range, 3> ranges;
  for (std::size_t axis = 0; axis < 3 && first < used.size(); ++axis)
    ranges[axis] = {coordinates[3 * first + axis], coordinates[3 * first + axis]};
  for (std::size_t i = 3 * first; i < coordinates.size(); ++i) {
    if (!used[i / 3]) continue;
    Range& range = ranges[i % 3];
    range = {std::min(range.low, coordinates[i]), std::max(range.high, coordinates[i])};
  }
  return ranges;
}

std::string number(double value) {
  TextWriter out;
  out << value;
  return out.take();
}

}  // namespace

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t most = 6;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + in_quotes(names[i]);
  return names.size() > most ? text + " and " + std::to_string(names.size() - most) + " more" : text;
}

std::string_view advice_on(CellKind kind) {
  if (kind == CellKind::other) return "";
  return ": cells of second order have points in the middle of edges; write the mesh with cells of first "
         "order "
         "(Gmsh: SetOrder 1)";
}

void Warnings::note_unused_points(const std::vector<bool>& used, std::size_t edges) const {
  const auto unused = static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
  if (notes_ == nullptr || unused == 0) return;
  const std::string what = unused == 1 ? "a point that no cell uses is left out"
                                       : std::to_string(unused) + " points that no cell uses are left out";
  add(edges == 0 ? what
                 : what + ", and " + std::to_string(edges) +
                       (edges == 1 ? " line that ends there" : " lines that end there"));
  notes_->unused_points = unused;
  for (std::uint32_t i = 0; i < used.size(); ++i)
    if (used[i]) notes_->kept_points.push_back(i);
}

// A program that turned a mesh into its plane leaves rounding errors behind, no more: a share of its size.
std::vector<Point> in_their_plane(std::span<const double> coordinates, const std::vector<bool>& used,
                                  const std::string& place, const Warnings& warnings) {
  constexpr double rounding = 1e-9;
  const auto first_used = static_cast<std::size_t>(std::find(used.begin(), used.end(), true) - used.begin());
  const std::array<Range, 3> ranges = ranges_of(coordinates, used, first_used);
  double size = 0.0;
  for (const Range& range : ranges) size = std::max({size, std::abs(range.low), std::abs(range.high)});
  const auto flat = [&](std::size_t axis) { return ranges[axis].high - ranges[axis].low <= rounding * size; };
  std::size_t across = 2;
  while (across > 0 && !flat(across)) --across;
  if (!flat(across)) {
    const double expected = coordinates[3 * first_used + 2];
    std::size_t i = 3 * first_used + 2;
    while (!used[i / 3] || std::abs(coordinates[i] - expected) <= rounding * size) i += 3;
    throw Error(ErrorCode::format, place,
                "z = " + number(coordinates[i]) + " found at point " + std::to_string(i / 3) +
                    ", z = " + number(expected) + " as at point " + std::to_string(first_used) +
                    " expected: a mesh in one plane");
  }
  const std::size_t first = across == 0 ? 1 : 0, second = across == 2 ? 1 : 2;
  const std::string plane = std::string(axis_names[across]) + " = " +
                            number(first_used < used.size() ? coordinates[3 * first_used + across] : 0.0);
  if (across != 2)
    warnings.add("the mesh lies in the plane " + plane + ": its " + axis_names[first] + " and " +
                 axis_names[second] + " are taken for x and y");
  else if (std::abs(ranges[2].low) > rounding * size)
    warnings.add("the mesh lies in the plane " + plane + ", which is left out");
  std::vector<Point> points;
  points.reserve(coordinates.size() / 3);
  for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3)
    points.push_back({coordinates[i + first], coordinates[i + second]});
  return points;
}

}  // namespace remodel::io
