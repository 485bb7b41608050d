// Polars (remodel/polar.h) as arrays.

#include "remodel/polar.h"

#include "apart.h"
#include "living.h"
#include "living_flow.h"

namespace remodel::python {
namespace {

constexpr double none = PolarPoint::none;

template <class Of>
py::array column(const PolarCurve& curve, Of of) {
  std::vector<double> values;
  for (const PolarPoint& point : curve.points) values.push_back(of(point));
  return copied(values);
}

py::array flags(const PolarCurve& curve, bool PolarPoint::*member) {
  py::array_t<bool> values(static_cast<py::ssize_t>(curve.points.size()));
  for (std::size_t i = 0; i < curve.points.size(); ++i)
    values.mutable_at(static_cast<py::ssize_t>(i)) = curve.points[i].*member;
  return values;
}

// By the name of each wall its forces, an array each.
py::dict curve_bodies(const PolarCurve& curve) {
  py::dict result;
  const auto add = [&](const std::string& wall, const char* name, double FlowBody::*member) {
    const auto of = [&](const PolarPoint& point) {
      for (const FlowBody& body : point.bodies)
        if (body.name == wall) return body.*member;
      return none;
    };
    result[py::str(wall)][name] = column(curve, of);
  };
  for (const PolarPoint& point : curve.points)
    for (const FlowBody& body : point.bodies) {
      if (result.contains(body.name)) continue;
      result[py::str(body.name)] = py::dict();
      add(body.name, "cl", &FlowBody::cl), add(body.name, "cd", &FlowBody::cd),
          add(body.name, "cm", &FlowBody::cm);
      if (curve.model == FlowModel::euler) continue;
      add(body.name, "cd_pressure", &FlowBody::cd_pressure),
          add(body.name, "cd_friction", &FlowBody::cd_friction);
      add(body.name, "y_plus_max", &FlowBody::y_plus_max);
    }
  return result;
}

py::dict curve_dict(const PolarCurve& curve) {
  py::dict result("mach"_a = curve.mach, "bodies"_a = curve_bodies(curve));
  const auto add = [&](const char* name, double PolarPoint::*member) {
    result[name] = column(curve, [&](const PolarPoint& point) { return point.*member; });
  };
  add("alpha", &PolarPoint::alpha_deg), add("cl", &PolarPoint::cl), add("cd", &PolarPoint::cd);
  add("cm", &PolarPoint::cm), add("cd_pressure", &PolarPoint::cd_pressure);
  add("cd_friction", &PolarPoint::cd_friction), add("y_plus_max", &PolarPoint::y_plus_max);
  result["converged"] = flags(curve, &PolarPoint::converged),
  result["asked"] = flags(curve, &PolarPoint::asked);
  py::list status, reason, warnings_of;
  for (const PolarPoint& point : curve.points) {
    status.append(point.status ? name_of(*point.status) : "not-looked-for");
    reason.append(point.reason), warnings_of.append(point.warnings);
  }
  result["status"] = status, result["reason"] = reason, result["warnings_of"] = warnings_of;
  const std::optional<LargestLift> largest = largest_lift(curve);
  result["cl_max"] = largest ? largest->cl : none,
  result["alpha_of_cl_max"] = largest ? largest->alpha_deg : none;
  result["cl_max_passed"] = largest && largest->passed;
  result["warnings"] = polar_warnings(curve);
  return result;
}

py::list polars(const py::object& mesh, const py::object& solver, const std::vector<double>& machs,
                const std::vector<double>& alphas, const std::vector<double>& lifts,
                const std::array<double, 2>& reference, double reference_length, double reynolds,
                const Transition& transition, const std::optional<double>& wall_temperature, int halvings,
                int misses) {
  const Snapshot frozen = snapshot_of(mesh);
  PolarOptions options{.flow = flow_options_of(solver), .machs = machs, .alphas_deg = alphas, .lifts = lifts};
  options.halvings = halvings, options.misses = misses;
  options.conditions = conditions_of(machs.empty() ? 0.0 : machs.front(), 0.0, {}, reference,
                                     reference_length, reynolds, transition, wall_temperature);
  require_reynolds_with_friction(options.flow.model, reynolds);
  const auto stop = std::make_shared<Stop>();
  options.flow.observer = stop.get();
  const PolarResult found =
      Apart().run(stop, [frozen, options, stop] { return find_polar(*frozen, "mesh", options); });
  py::list result;
  for (const PolarCurve& curve : found.curves) result.append(curve_dict(curve));
  return result;
}

}  // namespace

void add_polars(py::module_& module) {
  module.def("_polars", &polars, "mesh"_a, "solver"_a, "machs"_a, "alphas"_a, "lifts"_a, "reference"_a,
             "reference_length"_a, "reynolds"_a, "transition"_a, "wall_temperature"_a, "halvings"_a,
             "misses"_a);
}

}  // namespace remodel::python
