#include "aero/domain_nodes.h"

#include "remodel/mesh_derivative.h"

namespace remodel {
namespace {

// The points that a shape has numbers of, otherwise its ends.
std::vector<Point> given_points(const Shape& shape) {
  if (const auto* spline = std::get_if<Spline>(&shape)) return spline->points;
  if (const auto* polyline = std::get_if<Polyline>(&shape)) return polyline->points;
  if (const auto* line = std::get_if<Line>(&shape)) return {line->from, line->to};
  return {point_at(shape, 0.0), point_at(shape, 1.0)};
}

bool has_numbers(const Shape& shape) {
  return !std::holds_alternative<CstAirfoil>(shape) && !std::holds_alternative<Arc>(shape);
}

// Of a curve alone, without its loop's placement.
std::size_t count_of_numbers(const Curve& curve) {
  constexpr std::size_t of_placement = 4;
  return coefficients_of(Domain{{Loop{.curves = {curve}}}}).size() - of_placement;
}

class Collector {
 public:
  void add(const Loop& loop, std::size_t index) {
    const std::size_t first_curve = result.curves.size();
    for (std::size_t c = 0; c < loop.curves.size(); ++c) {
      // The end of the curve before is the beginning of this one.
      std::optional<std::size_t> begin;
      if (c != 0) begin = result.curves.back().nodes.back();
      const bool is_last = c + 1 == loop.curves.size();
      std::optional<std::size_t> end;
      if (is_last && !loop.open && c != 0) end = result.curves[first_curve].nodes.front();
      add_curve(loop.curves[c], index, begin, end, loop.curves.size() == 1);
    }
    number_ += 4;
  }

  DomainNodes result;

 private:
  void add_curve(const Curve& curve, std::size_t loop, std::optional<std::size_t> begin,
                 std::optional<std::size_t> end, bool is_alone) {
    CurveNodes of{.loop = loop, .curve = &curve, .nodes = {}};
    of.has_points =
        std::holds_alternative<Spline>(curve.shape) || std::holds_alternative<Polyline>(curve.shape);
    const std::vector<Point> points = given_points(curve.shape);
    const bool is_closed = points.size() > 2 && points.front() == points.back();
    if (is_alone && is_closed) end = result.nodes.size();  // the curve's own beginning
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool at_end = i + 1 == points.size();
      const std::optional<std::size_t> shared = i == 0 ? begin : at_end ? end : std::nullopt;
      of.nodes.push_back(shared.value_or(result.nodes.size()));
      if (!shared) result.nodes.push_back({.at = points[i], .numbers = {}});
      DomainNode& node = result.nodes[of.nodes.back()];
      if (!has_numbers(curve.shape))
        node.is_stiff = true;
      else if (!(at_end && is_closed))
        node.numbers.push_back(number_ + 2 * i);
    }
    number_ += count_of_numbers(curve);
    result.curves.push_back(std::move(of));
  }

  std::size_t number_ = 0;
};

}  // namespace

DomainNodes nodes_of(const Domain& domain) {
  Collector collector;
  for (std::size_t l = 0; l < domain.loops.size(); ++l) collector.add(domain.loops[l], l);
  for (const PeriodicPair& pair : domain.periodic)
    for (const CurveNodes& curve : collector.result.curves)
      if (curve.curve->name == pair.name || curve.curve->name == pair.moved)
        for (const std::size_t node : curve.nodes) collector.result.nodes[node].is_periodic = true;
  return std::move(collector.result);
}

}  // namespace remodel
