// The matrices of free-form boxes, of bumps and of points of curves.

#include "aero/deformation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "aero/domain_nodes.h"

namespace remodel {
namespace {

constexpr std::size_t most_variables = 1000;

// A variable by the nodes that it displaces.
struct Displacement {
  std::string name;
  std::map<std::size_t, Point> of_node;
};

std::vector<std::pair<const char*, Point>> directions_of(Moves moves) {
  constexpr std::pair<const char*, Point> x = {"x", {1.0, 0.0}}, y = {"y", {0.0, 1.0}};
  if (moves == Moves::xy) return {x, y};
  return {moves == Moves::x ? x : y};
}

std::string place_name(std::size_t column, std::size_t row) {
  return "[" + std::to_string(column) + "," + std::to_string(row) + "]";
}

// Bernstein polynomials of degree n - 1 at s.
std::vector<double> bernstein(std::size_t n, double s) {
  std::vector<double> values(n, 0.0);
  values[0] = 1.0;
  for (std::size_t degree = 1; degree < n; ++degree)
    for (std::size_t i = degree + 1; i-- > 0;)
      values[i] = (1.0 - s) * (i < degree ? values[i] : 0.0) + s * (i > 0 ? values[i - 1] : 0.0);
  return values;
}

// The part of a deformation that is being read, with what messages need.
class PartReader {
 public:
  PartReader(const DomainNodes& nodes, const Domain& domain, ProblemPlace place)
      : nodes_(nodes), domain_(domain), place_(std::move(place)) {}

  std::vector<Displacement> operator()(const FreeFormBox& box) const {
    require_box(box);
    std::vector<std::size_t> inside;
    for (const CurveNodes* curve : curves_named(box.on)) {
      require_entries(box, *curve);
      for (const std::size_t node : curve->nodes)
        if (is_inside(box, nodes_.nodes[node].at)) inside.push_back(node);
    }
    if (inside.empty()) place_.fail("found a box that holds no point of '" + box.on + "'");
    std::vector<Displacement> result;
    for (std::size_t row = box.hold.bottom; row + box.hold.top < box.rows; ++row)
      for (std::size_t column = box.hold.left; column + box.hold.right < box.columns; ++column)
        for (const auto& [key, direction] : directions_of(box.moves)) {
          Displacement& of = result.emplace_back();
          of.name = box.on + ".box" + place_name(column, row) + "." + key;
          for (const std::size_t node : inside)
            of.of_node[node] = weight(box, nodes_.nodes[node].at, column, row) * direction;
        }
    return result;
  }

  std::vector<Displacement> operator()(const HicksHenneBumps& bumps) const {
    place_.require_number(bumps.width, "width", {1.0, 20.0});
    if (bumps.peaks.empty()) place_.fail("found no number in 'x', expected one or more");
    std::vector<Displacement> result;
    const std::vector<std::size_t> section = section_of(bumps.on);
    const auto by_x = [&](std::size_t a, std::size_t b) {
      return nodes_.nodes[a].at.x < nodes_.nodes[b].at.x;
    };
    const double front = nodes_.nodes[*std::min_element(section.begin(), section.end(), by_x)].at.x;
    const double back = nodes_.nodes[*std::max_element(section.begin(), section.end(), by_x)].at.x;
    for (const double peak : bumps.peaks) {
      place_.require_number(peak, "x", {0.001, 0.999});
      Displacement& of = result.emplace_back();
      of.name = bumps.on + (bumps.upper ? ".upper[" : ".lower[") + shown(peak) + "]";
      for (const std::size_t node : surface_of(section, bumps.upper)) {
        const double x = (nodes_.nodes[node].at.x - front) / (back - front);
        if (!(x > 0.0 && x < 1.0)) continue;
        const double place = std::pow(x, std::log(0.5) / std::log(peak));
        of.of_node[node] = {0.0, std::pow(std::sin(M_PI * place), bumps.width)};
      }
    }
    return result;
  }

  std::vector<Displacement> operator()(const CurvePoints& points) const {
    const CurveNodes& curve = curve_with_points(points.on);
    const bool is_closed = curve.nodes.front() == curve.nodes.back();
    const std::size_t count = curve.nodes.size() - (is_closed ? 1 : 0);
    if (points.points.empty()) place_.fail("found no number in 'points', expected one or more");
    std::vector<Displacement> result;
    for (const std::size_t i : points.points) {
      if (i >= count)
        place_.fail("found " + shown(i) + " in 'points', expected whole numbers from 0 to " +
                    shown(count - 1) + ", the points of '" + points.on + "'");
      for (const auto& [key, direction] : directions_of(points.moves)) {
        Displacement& of = result.emplace_back();
        of.name = points.on + "[" + std::to_string(i) + "]." + key;
        of.of_node[curve.nodes[i]] = direction;
      }
    }
    return result;
  }

 private:
  std::vector<const CurveNodes*> curves_named(const std::string& name) const {
    std::vector<const CurveNodes*> found;
    std::vector<std::string> names;
    for (const CurveNodes& curve : nodes_.curves) {
      if (curve.curve->name == name) found.push_back(&curve);
      if (std::find(names.begin(), names.end(), curve.curve->name) == names.end())
        names.push_back(curve.curve->name);
    }
    if (found.empty()) place_.require_word(name, "on", names);
    for (const PeriodicPair& pair : domain_.periodic)
      if (name == pair.name || name == pair.moved)
        place_.fail("found the periodic curve '" + name + "' as 'on', expected one that may move alone");
    for (const CurveNodes* curve : found)
      if (std::holds_alternative<CstAirfoil>(curve->curve->shape))
        place_.fail("found the airfoil '" + name + "' as 'on', expected splines, polylines or lines");
      else if (std::holds_alternative<Arc>(curve->curve->shape))
        place_.fail("found the arc '" + name + "' as 'on', expected splines, polylines or lines");
    return found;
  }

  const CurveNodes& curve_with_points(const std::string& name) const {
    const CurveNodes* found = nullptr;
    for (const CurveNodes* curve : curves_named(name)) {
      if (!curve->has_points) continue;
      if (found != nullptr)
        place_.fail("found several curves '" + name +
                    "' as 'on', expected the name of one spline or polyline");
      found = curve;
    }
    if (found == nullptr)
      place_.fail("found '" + name + "' as 'on', expected the name of a spline or polyline");
    return *found;
  }

  void require_box(const FreeFormBox& box) const {
    if (!(box.low.x < box.high.x && std::isfinite(box.high.x - box.low.x)))
      place_.fail("found " + shown(std::array{box.low.x, box.high.x}) +
                  " as 'x', expected the left side, then the right one");
    if (!(box.low.y < box.high.y && std::isfinite(box.high.y - box.low.y)))
      place_.fail("found " + shown(std::array{box.low.y, box.high.y}) +
                  " as 'y', expected the bottom, then the top");
    for (const std::size_t count : {box.columns, box.rows})
      if (count < 2 || count > 30)
        place_.fail("found " + shown(std::array{box.columns, box.rows}) +
                    " as 'points', expected columns and rows, 2 to 30 each");
    if (box.hold.left + box.hold.right >= box.columns || box.hold.bottom + box.hold.top >= box.rows)
      place_.fail("found 'hold' of all control points, expected less");
  }

  static bool is_inside(const FreeFormBox& box, Point p) {
    return p.x >= box.low.x && p.x <= box.high.x && p.y >= box.low.y && p.y <= box.high.y;
  }

  static double weight(const FreeFormBox& box, Point p, std::size_t column, std::size_t row) {
    const double s = (p.x - box.low.x) / (box.high.x - box.low.x);
    const double t = (p.y - box.low.y) / (box.high.y - box.low.y);
    return bernstein(box.columns, s)[column] * bernstein(box.rows, t)[row];
  }

  // A curve that leaves the box through a side whose control points move would tear there.
  void require_entries(const FreeFormBox& box, const CurveNodes& curve) const {
    for (std::size_t i = 0; i + 1 < curve.nodes.size(); ++i) {
      Point in = nodes_.nodes[curve.nodes[i]].at, out = nodes_.nodes[curve.nodes[i + 1]].at;
      if (is_inside(box, in) == is_inside(box, out)) continue;
      if (is_inside(box, out)) std::swap(in, out);
      const std::pair<const char*, bool> sides[] = {{"left", out.x < box.low.x && box.hold.left == 0},
                                                    {"right", out.x > box.high.x && box.hold.right == 0},
                                                    {"bottom", out.y < box.low.y && box.hold.bottom == 0},
                                                    {"top", out.y > box.high.y && box.hold.top == 0}};
      for (const auto& [side, is_torn] : sides)
        if (is_torn)
          place_.fail("found '" + box.on + "' entering the box through its " + side + " side near " +
                      shown(std::array{in.x, in.y}) + ", expected that side in 'hold'");
    }
  }

  // The nodes of the closed loop that curves of this name make up, counter-clockwise.
  std::vector<std::size_t> section_of(const std::string& name) const {
    const std::size_t loop = curves_named(name).front()->loop;
    std::vector<std::size_t> result;
    for (const CurveNodes& curve : nodes_.curves) {
      const bool is_named = curve.curve->name == name;
      if (is_named != (curve.loop == loop) || (is_named && domain_.loops[loop].open))
        place_.fail("found '" + name + "' as 'on', expected the name of all curves of one closed loop");
      if (is_named) result.insert(result.end(), curve.nodes.begin(), curve.nodes.end() - 1);
    }
    if (signed_area(domain_, loop) < 0.0) std::reverse(result.begin(), result.end());
    return result;
  }

  // From the rearmost node over the upper surface to the foremost one, or the others.
  std::vector<std::size_t> surface_of(std::vector<std::size_t> section, bool upper) const {
    const auto by_x = [&](std::size_t a, std::size_t b) {
      return nodes_.nodes[a].at.x < nodes_.nodes[b].at.x;
    };
    std::rotate(section.begin(), std::max_element(section.begin(), section.end(), by_x), section.end());
    const auto nose = std::min_element(section.begin(), section.end(), by_x);
    return upper ? std::vector(section.begin(), nose) : std::vector(nose, section.end());
  }

  const DomainNodes& nodes_;
  const Domain& domain_;
  ProblemPlace place_;
};

// Throws where it moves nothing, or a point that cannot follow.
DeformationVariable variable_of(const Displacement& of, const DeformationRange& range,
                                const DomainNodes& nodes, const ProblemPlace& place) {
  constexpr double least = 1e-9;  // of the variable
  DeformationVariable result{.name = of.name, .range = range};
  double most = 0.0;
  for (const auto& [index, by] : of.of_node) {
    const DomainNode& node = nodes.nodes[index];
    if (by == Point{}) continue;
    if (node.is_stiff)
      place.fail("found the variable '" + of.name + "', which moves the point " +
                 shown(std::array{node.at.x, node.at.y}) + ", where an arc or a section ends");
    most = std::max({most, std::fabs(by.x), std::fabs(by.y)});
    if (node.is_periodic)
      place.fail("found the variable '" + of.name + "', which moves the point " +
                 shown(std::array{node.at.x, node.at.y}) + " of a periodic curve, expected these to rest");
    for (const std::size_t number : node.numbers) {
      if (by.x != 0.0) result.moves.push_back({number, by.x});
      if (by.y != 0.0) result.moves.push_back({number + 1, by.y});
    }
  }
  if (!(most > least)) place.fail("found the variable '" + of.name + "', which moves nothing");
  return result;
}

void require_range(const DeformationRange& range, const ProblemPlace& place) {
  place.require_number(range.scale, "scale", {1e-6, 1e6});
  if (!range.bounds) return;
  const auto [low, high] = *range.bounds;
  if (!(low <= 0.0 && high >= 0.0 && low < high))
    place.fail("found " + shown(*range.bounds) +
               " as 'bounds', expected two numbers around 0, where the start is");
}

// Where several parts have a variable of one name, the later ones have their part's number too.
void add_variable(DeformationVariable variable, std::size_t part, const ProblemPlace& place,
                  std::vector<DeformationVariable>& to) {
  const auto is_known = [&] {
    return std::any_of(to.begin(), to.end(), [&](const auto& other) { return other.name == variable.name; });
  };
  if (is_known()) variable.name += " (deformation " + std::to_string(part + 1) + ")";
  if (is_known()) place.fail("found the variable '" + variable.name + "' twice");
  to.push_back(std::move(variable));
  if (to.size() > most_variables)
    place.fail("found more than " + std::to_string(most_variables) + " variables, expected fewer");
}

}  // namespace

const char* name_of(Moves moves) {
  return moves == Moves::x ? "x" : moves == Moves::y ? "y" : "xy";
}

std::vector<DeformationVariable> variables_of(const Deformation& deformation, const ProblemPlace& place) {
  const DomainNodes nodes = nodes_of(deformation.domain);
  if (deformation.parts.empty()) place.fail("found no deformation, expected one or more");
  std::vector<DeformationVariable> result;
  for (std::size_t i = 0; i < deformation.parts.size(); ++i) {
    const ProblemPlace inner = place.inner("deformation " + std::to_string(i + 1));
    const PartReader read(nodes, deformation.domain, inner);
    const DeformationRange& range = std::visit(
        [](const auto& part) -> const DeformationRange& { return part.range; }, deformation.parts[i]);
    require_range(range, inner);
    for (const Displacement& of : std::visit(read, deformation.parts[i]))
      add_variable(variable_of(of, range, nodes, inner), i, inner, result);
  }
  return result;
}

}  // namespace remodel
