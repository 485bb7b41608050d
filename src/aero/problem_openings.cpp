#include "aero/problem_openings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "aero/outlet_numbers.h"
#include "aero/problem_keys.h"
#include "shape/loop_side.h"

namespace remodel {
namespace {

constexpr std::size_t most_openings = 100;

std::string numbered(const std::string& where, const char* what, std::size_t index) {
  return where + ", " + what + " " + std::to_string(index + 1);
}

// Curves that bound the domain, each name once; inner ones bound nothing.
std::vector<std::string> boundaries_of(const Domain& domain) {
  std::vector<std::string> names;
  for (const Loop& loop : domain.loops)
    for (const Curve& curve : loop.curves)
      if (loop.role != LoopRole::internal && std::find(names.begin(), names.end(), curve.name) == names.end())
        names.push_back(curve.name);
  return names;
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// From station to station, of all curves of this name, with the domain on their left.
std::vector<Point> edges_named(const Domain& domain, const std::string& name) {
  std::vector<Point> edges;
  for (std::size_t i = 0; i < domain.loops.size(); ++i) {
    const Loop& loop = domain.loops[i];
    const std::vector<Point> points = domain.points(i);
    const bool is_on_left = has_domain_on_left(domain, i).value_or(true);
    std::size_t at = 0;
    for (const Curve& curve : loop.curves)
      for (std::size_t k = 0; k < curve.parameters.size(); ++k, ++at)
        if (curve.name == name && at + (loop.open ? 1 : 0) < points.size())
          edges.push_back((is_on_left ? 1.0 : -1.0) * (points[(at + 1) % points.size()] - points[at]));
  }
  return edges;
}

// The mirror image of the stream is the stream: what a flow asks of such planes, to the same digits.
void require_symmetry(const DesignPoint& point, const Domain& domain, const ProblemPlace& place) {
  constexpr double least_turn = 1e-4, degree = 0.017453292519943295;
  if (!point.symmetry.empty() && point.conditions.cl)
    place.fail("found 'cl' with 'symmetry', expected 'alpha_deg'");
  const double alpha = point.conditions.alpha_deg * degree;
  const Point stream = {std::cos(alpha), std::sin(alpha)};
  for (const std::string& name : point.symmetry)
    for (const Point edge : edges_named(domain, name))
      if (std::fabs(cross(edge, stream)) > least_turn * std::sqrt(dot(edge, edge)))
        place.fail("found '" + name +
                   "' as the name of a symmetry plane, expected a straight line along the " + "stream of " +
                   shown(point.conditions.alpha_deg) + " degrees");
}

// Gas enters at less than 89 degrees to the normal, as a flow asks of it.
void require_inlet_angles(const DesignPoint& point, const Domain& domain, const ProblemPlace& place) {
  constexpr double degree = 0.017453292519943295;
  for (const FlowInlet& inlet : point.inlets) {
    if (!inlet.angle_deg) continue;
    const Point along = {std::cos(*inlet.angle_deg * degree), std::sin(*inlet.angle_deg * degree)};
    for (const Point edge : edges_named(domain, inlet.name))
      if (!(cross(edge, along) > std::cos(89.0 * degree) * std::sqrt(dot(edge, edge))))
        place.fail("found " + shown(*inlet.angle_deg) + " as the 'angle_deg' of the inlet '" + inlet.name +
                   "', expected a direction into the domain, at less than 89 degrees to the normal");
  }
}

// Gas leaves by no outlet whose pressure is that of the gas at rest, or more.
void require_lower_pressures(const DesignPoint& point, const Domain& domain, const ProblemPlace& place) {
  const double total = entering_total_pressure(point, domain) *
                       std::pow(1.0 + 0.2 * point.conditions.mach * point.conditions.mach, 3.5);
  for (const FlowOutlet& outlet : point.outlets)
    if (!(outlet.pressure < total))
      place.fail("found " + shown(outlet.pressure) + " as the 'pressure' of the outlet '" + outlet.name +
                 "', expected less than the " + short_number(total) +
                 " of the total pressure that the gas enters with");
}

}  // namespace

void read_openings(const Json& point, const std::string& where, DesignPoint& to) {
  const Keys keys(point, where);
  for (const Json& entry : keys.list("inlets", most_openings)) {
    const Keys inlet(entry, numbered(where, "inlet", to.inlets.size()),
                     {"name", "total_pressure", "total_temperature", "angle_deg"});
    to.inlets.push_back({.name = inlet.get<std::string>("name"),
                         .total_pressure = inlet.get<double>("total_pressure", 1.0),
                         .total_temperature = inlet.get<double>("total_temperature", 1.0)});
    if (entry.contains("angle_deg")) to.inlets.back().angle_deg = inlet.get<double>("angle_deg");
  }
  for (const Json& entry : keys.list("outlets", most_openings)) {
    const Keys outlet(entry, numbered(where, "outlet", to.outlets.size()), {"name", "pressure"});
    to.outlets.push_back(
        {.name = outlet.get<std::string>("name"), .pressure = outlet.get<double>("pressure", 1.0)});
  }
  to.symmetry = keys.get<std::vector<std::string>>("symmetry", std::vector<std::string>{});
}

void write_openings(const DesignPoint& point, Json& to) {
  for (const FlowInlet& inlet : point.inlets) {
    to["inlets"].push_back({{"name", inlet.name},
                            {"total_pressure", inlet.total_pressure},
                            {"total_temperature", inlet.total_temperature}});
    if (inlet.angle_deg) to["inlets"].back()["angle_deg"] = *inlet.angle_deg;
  }
  for (const FlowOutlet& outlet : point.outlets)
    to["outlets"].push_back({{"name", outlet.name}, {"pressure", outlet.pressure}});
  if (!point.symmetry.empty()) to["symmetry"] = point.symmetry;
}

void require_openings(const DesignPoint& point, const Domain& domain, const ProblemPlace& place) {
  const std::vector<std::string> boundaries = boundaries_of(domain);
  const auto is_boundary = [&](const std::string& name) {
    return std::find(boundaries.begin(), boundaries.end(), name) != boundaries.end();
  };
  std::vector<std::string> names = {"farfield"};
  const auto require_name = [&](const std::string& name, const char* what) {
    if (!is_boundary(name))
      place.fail("found '" + name + "' as the name of " + what +
                 ", expected that of curves of the domain: " + listed(boundaries));
    if (std::find(names.begin(), names.end(), name) != names.end())
      place.fail("found '" + name + "' as the name of " + what + ", expected another name for each boundary");
    names.push_back(name);
  };
  constexpr Limits part = {1e-3, 1e3};
  for (const FlowInlet& inlet : point.inlets) {
    require_name(inlet.name, "an inlet");
    place.require_number(inlet.total_pressure, "total_pressure", part);
    place.require_number(inlet.total_temperature, "total_temperature", part);
    if (inlet.angle_deg) place.require_number(*inlet.angle_deg, "angle_deg", {-180.0, 180.0});
  }
  for (const FlowOutlet& outlet : point.outlets) {
    require_name(outlet.name, "an outlet");
    place.require_number(outlet.pressure, "pressure", part);
  }
  for (const std::string& name : point.symmetry) require_name(name, "a symmetry plane");
  if (!point.inlets.empty() && point.conditions.mach >= 1.0)
    place.fail("found 'inlets' with a 'mach' of 1 or more, expected less");
  for (const PeriodicPair& pair : domain.periodic)
    for (const std::string& name : {pair.name, pair.moved}) require_name(name, "a periodic boundary");
  const bool has_farfield = is_boundary("farfield");
  if (!has_farfield && (point.inlets.empty() || point.outlets.empty()))
    place.fail(std::string("found no curve 'farfield' in the domain and no ") +
               (point.inlets.empty() ? "'inlets'" : "'outlets'") + ", expected one for the gas to " +
               (point.inlets.empty() ? "enter" : "leave") + " by");
  if (!has_farfield && point.conditions.cl)
    place.fail("found 'cl' with a domain without a curve 'farfield', expected 'alpha_deg'");
  if (names.size() - 1 + (has_farfield ? 1 : 0) >= boundaries.size())
    place.fail("found no wall among the curves of the domain (" + listed(boundaries) +
               "), expected one that is no opening");
  require_symmetry(point, domain, place);
  require_inlet_angles(point, domain, place);
  require_lower_pressures(point, domain, place);
}

}  // namespace remodel
