#include "aero/problem_openings.h"

#include <algorithm>

#include "aero/problem_keys.h"

namespace remodel {
namespace {

constexpr std::size_t most_openings = 100;

std::string numbered(const std::string& where, const char* what, std::size_t index) {
  return where + ", " + what + " " + std::to_string(index + 1);
}

bool has_boundary(const Domain& domain, const std::string& name) {
  for (const Loop& loop : domain.loops)
    for (const Curve& curve : loop.curves)
      if (curve.name == name) return true;
  return false;
}

}  // namespace

void read_openings(const Json& point, const std::string& where, DesignPoint& to) {
  const Keys keys(point, where);
  for (const Json& entry : keys.list("inlets", most_openings)) {
    const Keys inlet(entry, numbered(where, "inlet", to.inlets.size()),
                     {"name", "total_pressure", "total_temperature"});
    to.inlets.push_back({.name = inlet.get<std::string>("name"),
                         .total_pressure = inlet.get<double>("total_pressure", 1.0),
                         .total_temperature = inlet.get<double>("total_temperature", 1.0)});
  }
  for (const Json& entry : keys.list("outlets", most_openings)) {
    const Keys outlet(entry, numbered(where, "outlet", to.outlets.size()), {"name", "pressure"});
    to.outlets.push_back(
        {.name = outlet.get<std::string>("name"), .pressure = outlet.get<double>("pressure", 1.0)});
  }
  to.symmetry = keys.get<std::vector<std::string>>("symmetry", std::vector<std::string>{});
}

void write_openings(const DesignPoint& point, Json& to) {
  for (const FlowInlet& inlet : point.inlets)
    to["inlets"].push_back({{"name", inlet.name},
                            {"total_pressure", inlet.total_pressure},
                            {"total_temperature", inlet.total_temperature}});
  for (const FlowOutlet& outlet : point.outlets)
    to["outlets"].push_back({{"name", outlet.name}, {"pressure", outlet.pressure}});
  if (!point.symmetry.empty()) to["symmetry"] = point.symmetry;
}

void require_openings(const DesignPoint& point, const Domain& domain, const ProblemPlace& place) {
  std::vector<std::string> names = {"farfield"};
  const auto require_name = [&](const std::string& name, const char* what) {
    if (!has_boundary(domain, name))
      place.fail("found '" + name + "' as the name of " + what + ", expected that of curves of the domain");
    if (std::find(names.begin(), names.end(), name) != names.end())
      place.fail("found '" + name + "' as the name of " + what + ", expected another name for each boundary");
    names.push_back(name);
  };
  constexpr Limits part = {1e-3, 1e3};
  for (const FlowInlet& inlet : point.inlets) {
    require_name(inlet.name, "an inlet");
    place.require_number(inlet.total_pressure, "total_pressure", part);
    place.require_number(inlet.total_temperature, "total_temperature", part);
  }
  for (const FlowOutlet& outlet : point.outlets) {
    require_name(outlet.name, "an outlet");
    place.require_number(outlet.pressure, "pressure", part);
  }
  for (const std::string& name : point.symmetry) require_name(name, "a symmetry plane");
  if (!point.inlets.empty() && point.conditions.mach >= 1.0)
    place.fail("found 'inlets' with a 'mach' of 1 or more, expected less");
  if (!has_boundary(domain, "farfield") && (point.inlets.empty() || point.outlets.empty()))
    place.fail(std::string("found no curve 'farfield' in the domain and no ") +
               (point.inlets.empty() ? "'inlets'" : "'outlets'") + ", expected one for the gas to " +
               (point.inlets.empty() ? "enter" : "leave") + " by");
}

}  // namespace remodel
