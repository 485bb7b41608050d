#include "remodel/mesh_derivative.h"

namespace remodel {
namespace {

// Numbers of a curve alone, without a placement.
std::size_t count_of(const Curve& curve) {
  const Domain none{.loops = {Loop{}}}, alone{.loops = {Loop{.curves = {curve}}}};
  return coefficients_of(alone).size() - coefficients_of(none).size();
}

void add(std::vector<std::string>& names, const std::string& curve,
         std::initializer_list<const char*> numbers) {
  for (const char* number : numbers) names.push_back(curve + "." + number);
}

void add_row(std::vector<std::string>& names, const std::string& row, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) names.push_back(row + "[" + std::to_string(i) + "]");
}

void add_curve(std::vector<std::string>& names, const Curve& curve) {
  if (const auto* airfoil = std::get_if<CstAirfoil>(&curve.shape)) {
    add_row(names, curve.name + ".upper", airfoil->upper.size());
    add_row(names, curve.name + ".lower", airfoil->lower.size());
    add(names, curve.name, {"te_upper", "te_lower"});
  } else if (std::holds_alternative<Line>(curve.shape)) {
    add(names, curve.name, {"from.x", "from.y", "to.x", "to.y"});
  } else if (std::holds_alternative<Arc>(curve.shape)) {
    add(names, curve.name, {"centre.x", "centre.y", "radius", "start", "sweep"});
  } else {
    const std::size_t points = count_of(curve) / 2;
    for (std::size_t i = 0; i < points; ++i) {
      const std::string point = curve.name + ".points[" + std::to_string(i) + "]";
      add(names, point, {"x", "y"});
    }
  }
}

}  // namespace

std::vector<std::string> coefficient_names(const Domain& domain) {
  std::vector<std::string> names;
  for (const Loop& loop : domain.loops) {
    for (const Curve& curve : loop.curves) add_curve(names, curve);
    add(names, loop.curves.empty() ? "loop" : loop.curves.front().name, {"chord", "rotation_deg", "x", "y"});
  }
  return names;
}

bool is_of_section(const std::string& name) {
  return name.find(".upper[") != std::string::npos || name.find(".lower[") != std::string::npos;
}

}  // namespace remodel
