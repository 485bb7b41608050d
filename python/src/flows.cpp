// Compressible flow: solve_flow, LivingFlow and FlowResult.

#include "remodel/boundary_layer.h"
#include "remodel/flow.h"

#include <numeric>

#include "apart.h"
#include "bindings.h"
#include "functionals.h"
#include "living.h"
#include "living_flow.h"
#include "records.h"

namespace remodel {

template <python::Is<FlowBody> T>
auto members(T& b) {
  return std::tie(b.name, b.cl, b.cd, b.cm, b.cd_pressure, b.cd_friction, b.y_plus_max);
}
template <python::Is<FlowOpening> T>
auto members(T& o) {
  return std::tie(o.name, o.mass_flow, o.flow_angle_deg, o.total_pressure, o.pressure, o.mach);
}
template <python::Is<FlowFriction> T>
auto members(T& f) {
  return std::tie(f.reynolds, f.transition, f.cd_pressure, f.cd_friction, f.y_plus_max, f.cf, f.y_plus,
                  f.viscosity_ratio, f.working, f.wall_temperature, f.heat, f.ch);
}
template <python::Is<FlowResult> T>
auto members(T& f) {
  return std::tie(f.status, f.reason, f.mach, f.alpha_deg, f.cl, f.cd, f.cm, f.bodies, f.openings, f.start,
                  f.residual, f.history, f.newton_steps, f.factorisations, f.coarse_steps,
                  f.krylov_iterations, f.corrected_vertices, f.solver, f.gmres_iterations, f.memory_mb,
                  f.seconds, f.density, f.velocity_x, f.velocity_y, f.pressure, f.warnings, f.lift_determined,
                  f.origin, f.entropy_drag, f.model, f.friction);
}

}  // namespace remodel

namespace remodel::python {

FlowConditions conditions_of(double mach, double alpha, const std::optional<double>& cl,
                             const std::array<double, 2>& reference, double reference_length, double reynolds,
                             const Transition& transition, const std::optional<double>& wall_temperature) {
  return {.mach = mach,
          .alpha_deg = alpha,
          .cl = cl,
          .reference = {reference[0], reference[1]},
          .reference_length = reference_length,
          .reynolds = reynolds,
          .transition = transition,
          .wall_temperature = wall_temperature};
}

void require_reynolds_with_friction(FlowModel model, double reynolds) {
  if (model == FlowModel::euler && reynolds != 0.0)
    throw Error(ErrorCode::argument, "reynolds", "given with the model euler, expected one with friction");
}

namespace {

using FlowPointer = std::shared_ptr<FlowResult>;
using Inlets =
    std::map<std::string, std::vector<double>>;  // total pressure, total temperature, maybe an angle
using Outlets = std::map<std::string, double>;   // pressure
using Pairs = std::vector<std::pair<std::string, std::string>>;  // of periodic boundaries

FlowSolver solver_named(const std::string& name) {
  for (const FlowSolver solver : {FlowSolver::lu, FlowSolver::gmres})
    if (name == name_of(solver)) return solver;
  throw Error(ErrorCode::argument, "solver", "found '" + name + "', expected 'lu', 'gmres' or None");
}

FlowModel model_named(const std::string& name) {
  for (const FlowModel model : {FlowModel::euler, FlowModel::laminar, FlowModel::sa})
    if (name == name_of(model)) return model;
  throw Error(ErrorCode::argument, "model", "found '" + name + "', expected 'euler', 'laminar' or 'sa'");
}

FlowOptions options_of(const Names& farfield, double tolerance, int max_steps, double memory_mb,
                       const std::optional<std::string>& solver, const Inlets& inlets, const Outlets& outlets,
                       const std::string& model, const Pairs& periodic) {
  FlowOptions options{
      .farfield = list_of(farfield), .tolerance = tolerance, .max_steps = max_steps, .memory_mb = memory_mb};
  options.model = model_named(model);
  if (solver) options.solver = solver_named(*solver);
  for (const auto& [name, given] : inlets) {
    if (given.size() != 2 && given.size() != 3)
      throw Error(
          ErrorCode::argument, "inlets",
          "found " + std::to_string(given.size()) + " numbers for '" + name +
              "', expected a total pressure, a total temperature and, if it is not along the normal, the "
              "angle of the flow");
    options.inlets.push_back({.name = name, .total_pressure = given[0], .total_temperature = given[1]});
    if (given.size() == 3) options.inlets.back().angle_deg = given[2];
  }
  for (const auto& [name, moved] : periodic) options.periodic.push_back({name, moved});
  for (const auto& [name, pressure] : outlets)
    options.outlets.push_back({.name = name, .pressure = pressure});
  return options;
}

// A flow knows the mesh that its values are on.
py::object with_mesh(const FlowPointer& flow, const Snapshot& mesh) {
  py::object result = py::cast(flow);
  result.attr("mesh") = std::const_pointer_cast<FrozenMesh>(mesh);
  return result;
}

py::object solved(const py::object& mesh, double mach, double alpha, const std::optional<double>& cl,
                  const std::array<double, 2>& reference, double reference_length, const Names& farfield,
                  double tolerance, int max_steps, double memory_mb, const std::optional<std::string>& solver,
                  const Inlets& inlets, const Outlets& outlets, double reynolds, const std::string& model,
                  const Transition& transition, const std::optional<double>& wall_temperature,
                  const Pairs& periodic) {
  const Snapshot frozen = snapshot_of(mesh);
  const FlowConditions conditions =
      conditions_of(mach, alpha, cl, reference, reference_length, reynolds, transition, wall_temperature);
  FlowOptions options =
      options_of(farfield, tolerance, max_steps, memory_mb, solver, inlets, outlets, model, periodic);
  require_reynolds_with_friction(options.model, reynolds);
  const auto stop = std::make_shared<Stop>();
  options.observer = stop.get();
  const FlowPointer flow = Apart().run(stop, [frozen, conditions, options, stop] {
    return std::make_shared<FlowResult>(solve_flow(*frozen, conditions, options));
  });
  return with_mesh(flow, frozen);
}

// Derivatives by points know the mesh that they are of (python/remodel/_gradients.py).
py::dict dict_of(FlowGradient gradient, const Snapshot& mesh) {
  const py::array points = view_of(std::move(gradient.points));
  const py::object of_mesh = py::module_::import("remodel._gradients").attr("of_mesh");
  return py::dict("points"_a = of_mesh(points, std::const_pointer_cast<FrozenMesh>(mesh)),
                  "mach"_a = gradient.mach, "alpha"_a = gradient.alpha_deg, "cl"_a = gradient.cl,
                  "reynolds"_a = gradient.reynolds);
}

// Functions of a flow by name, each a dict of its derivatives by fields of the flow and points.
std::vector<FlowFunctional> functionals_of(const py::dict& functions, std::size_t size) {
  std::vector<FlowFunctional> result;
  for (const auto& [key, parts] : functions) {
    const auto name = py::cast<std::string>(py::str(key));
    for (const char* own : {"cl", "cd", "cm", "alpha", "cd_pressure"})
      if (name == own)
        throw Error(ErrorCode::argument, "functions",
                    "found '" + name + "', which gradients() has anyway, expected another name");
    if (!py::isinstance<py::dict>(parts))
      throw Error(ErrorCode::argument, "functions, " + name, "found " + type_of(parts) + ", expected a dict");
    FlowFunctional& by = result.emplace_back(zero_functional(size));
    for (const auto& [part, values] : py::reinterpret_borrow<py::dict>(parts)) {
      const auto field = py::cast<std::string>(py::str(part));
      if (!add_field(by, field, "functions, " + name + ", " + field, values, size))
        throw Error(
            ErrorCode::argument, "functions, " + name,
            "found '" + field + "', expected mach, points, pressure, density, velocity_x or velocity_y");
    }
  }
  return result;
}

// A LivingFlow, with the observer that it keeps for its whole life.
struct Solver {
  explicit Solver(FlowOptions options) : flow(observed(std::move(options), *stop)) {}
  static FlowOptions observed(FlowOptions options, Stop& stop) {
    options.observer = &stop;
    return options;
  }

  std::shared_ptr<Stop> stop = std::make_shared<Stop>();
  LivingFlow flow;
};

// A LivingFlow that threads may share. A call that was left behind owns it as well.
class Flows {
 public:
  explicit Flows(FlowOptions options)
      : options_(std::move(options)), solver_(std::make_shared<Solver>(options_)) {}

  // Factors go when no other flow is being factored.
  ~Flows() {
    py::gil_scoped_release released;
    solver_.reset();
  }
  Flows(const Flows&) = delete;
  Flows& operator=(const Flows&) = delete;

  py::object solve(const py::object& mesh, double mach, double alpha, const std::optional<double>& cl,
                   const std::array<double, 2>& reference, double reference_length, double reynolds,
                   const Transition& transition, const std::optional<double>& wall_temperature) {
    require_reynolds_with_friction(options_.model, reynolds);
    const FlowConditions conditions =
        conditions_of(mach, alpha, cl, reference, reference_length, reynolds, transition, wall_temperature);
    const ThreadLock::Held held(lock_);
    const Snapshot given = snapshot_of(mesh), frozen = with_keys(given);
    const FlowPointer result = calls_.run(solver_->stop, [solver = solver_, frozen, conditions] {
      return std::make_shared<FlowResult>(solver->flow.solve(*frozen, conditions));
    });
    last_ = result->converged() ? given : nullptr;
    why_none_ = result->converged() ? "" : result->reason;
    return with_mesh(result, given);
  }
  // Gradients of the flow of the last solve(): by the points of its mesh, and by Mach number and angle.
  py::dict gradients(const py::dict& functions) {
    const ThreadLock::Held held(lock_);
    require_flow();
    const std::vector<FlowFunctional> wanted = functionals_of(functions, last_->points.size());
    FlowGradients found =
        calls_.run(solver_->stop, [solver = solver_, wanted] { return solver->flow.gradients(wanted); });
    py::dict result(
        "cl"_a = dict_of(std::move(found.cl), last_), "cd"_a = dict_of(std::move(found.cd), last_),
        "cm"_a = dict_of(std::move(found.cm), last_), "alpha"_a = dict_of(std::move(found.alpha_deg), last_));
    if (options_.model != FlowModel::euler)
      result["cd_pressure"] = dict_of(std::move(found.cd_pressure), last_);
    std::size_t next = 0;
    for (const auto& [name, parts] : functions)
      result[name] = dict_of(std::move(found.functions.at(next++)), last_);
    return result;
  }
  const FlowOptions& options() const { return options_; }
  void forget() {
    const ThreadLock::Held held(lock_);
    calls_.settle();
    solver_->flow.forget();
    last_.reset(), why_none_.clear();
  }

 private:
  // A living flow knows vertices by their keys. Another program's mesh has none: its points are numbered.
  static Snapshot with_keys(const Snapshot& mesh) {
    if (mesh->vertex_keys.size() == mesh->points.size()) return mesh;
    auto result = std::make_shared<FrozenMesh>(*mesh);
    result->vertex_keys.resize(mesh->points.size());
    std::iota(result->vertex_keys.begin(), result->vertex_keys.end(), std::uint64_t{0});
    return result;
  }

  // The solver itself still has the flow before, which nobody who asks now means.
  void require_flow() const {
    if (last_) return;
    const std::string found =
        why_none_.empty() ? "no flow was found yet" : "the last flow was not found (" + why_none_ + ")";
    throw Error(ErrorCode::argument, "gradients", found + ", expected one");
  }

  ThreadLock lock_;
  const FlowOptions options_;
  std::shared_ptr<Solver> solver_;
  Apart calls_;
  Snapshot last_;         // the mesh of the last flow; none if that was not found
  std::string why_none_;  // why not; empty before the first one
};

// Arrays by name, a value for each station.
py::dict boundary_layer_of(const FlowResult& flow, const py::object& mesh) {
  const std::vector<BoundaryLayerStation> stations = boundary_layer(*snapshot_of(mesh), flow);
  py::dict result;
  py::list walls;
  for (const BoundaryLayerStation& station : stations) walls.append(station.wall);
  result["wall"] = walls;
  const auto add = [&](const char* name, auto BoundaryLayerStation::*member) {
    std::vector<double> values;
    for (const BoundaryLayerStation& station : stations)
      values.push_back(static_cast<double>(station.*member));
    result[name] = copied(values);
  };
  std::vector<std::int64_t> vertices;
  for (const BoundaryLayerStation& station : stations) vertices.push_back(station.vertex);
  result["vertex"] = py::array_t<std::int64_t>(static_cast<py::ssize_t>(vertices.size()), vertices.data());
  add("arc", &BoundaryLayerStation::arc), add("cf", &BoundaryLayerStation::cf);
  add("y_plus", &BoundaryLayerStation::y_plus), add("edge_speed", &BoundaryLayerStation::edge_speed);
  add("thickness", &BoundaryLayerStation::thickness);
  add("displacement_thickness", &BoundaryLayerStation::displacement_thickness);
  add("momentum_thickness", &BoundaryLayerStation::momentum_thickness);
  add("shape_factor", &BoundaryLayerStation::shape_factor);
  add("ch", &BoundaryLayerStation::ch);
  return result;
}

py::list profiles_of(const FlowResult& flow, const py::object& mesh, const std::vector<double>& places) {
  py::list result;
  for (const BoundaryLayerProfile& profile : boundary_layer_profiles(*snapshot_of(mesh), flow, places)) {
    py::dict one("wall"_a = profile.wall, "place"_a = profile.place, "vertex"_a = profile.vertex);
    const auto add = [&](const char* name, double BoundaryLayerPoint::*member) {
      std::vector<double> values;
      for (const BoundaryLayerPoint& point : profile.points) values.push_back(point.*member);
      one[name] = copied(values);
    };
    add("height", &BoundaryLayerPoint::height), add("speed", &BoundaryLayerPoint::speed);
    add("density", &BoundaryLayerPoint::density), add("temperature", &BoundaryLayerPoint::temperature);
    add("viscosity_ratio", &BoundaryLayerPoint::viscosity_ratio);
    add("y_plus", &BoundaryLayerPoint::y_plus), add("u_plus", &BoundaryLayerPoint::u_plus);
    result.append(one);
  }
  return result;
}

double if_determined(const FlowResult& flow, double value) {
  return flow.lift_determined ? value : std::numeric_limits<double>::quiet_NaN();
}

py::dict bodies_of(const FlowResult& flow) {
  py::dict result;
  for (const FlowBody& body : flow.bodies) {
    py::dict entry("cl"_a = if_determined(flow, body.cl), "cd"_a = body.cd,
                   "cm"_a = if_determined(flow, body.cm));
    if (flow.friction)
      entry = py::dict("cd_pressure"_a = body.cd_pressure, "cd_friction"_a = body.cd_friction,
                       "y_plus_max"_a = body.y_plus_max, **entry);
    result[py::str(body.name)] = entry;
  }
  return result;
}

py::dict of_openings(const FlowResult& flow, double FlowOpening::*member) {
  py::dict result;
  for (const FlowOpening& opening : flow.openings) result[py::str(opening.name)] = opening.*member;
  return result;
}

void add_figures(py::class_<FlowResult, FlowPointer>& type) {
  type.def_property_readonly("converged", &FlowResult::converged,
                             "Whether the flow was found; otherwise no coefficient should be used.");
  type.def_property_readonly(
      "status", [](const FlowResult& f) { return name_of(f.status); },
      "'converged', or why not: 'step-limit', 'stalled', 'memory' or 'interrupted'.");
  type.def_readonly("reason", &FlowResult::reason, "Why it did not converge; empty if it did.");
  type.def_readonly("warnings", &FlowResult::warnings,
                    "What has to be known before a coefficient is used: a list of sentences.");
  type.def_readonly("lift_determined", &FlowResult::lift_determined,
                    "Whether every body has an edge that the flow leaves from.");
  type.def_property_readonly(
      "start", [](const FlowResult& f) { return name_of(f.start); },
      "'cold', 'carried' or 'refactored': what the flow was found from.");
  type.def_property_readonly(
      "origin", [](const FlowResult& f) { return name_of(f.origin); },
      "'potential', 'coarser-mesh', 'undisturbed' or 'last-flow': the state that the search began with.");
  type.def_readonly("mach", &FlowResult::mach, "The Mach number of the stream.");
  type.def_readonly("alpha", &FlowResult::alpha_deg, "The angle of attack, in degrees.");
  type.def_property_readonly(
      "cl", [](const FlowResult& f) { return if_determined(f, f.cl); },
      "The lift coefficient of all bodies; nan where lift_determined is false.");
  type.def_readonly("cd", &FlowResult::cd, "The drag coefficient of all bodies.");
  type.def_readonly("entropy_drag", &FlowResult::entropy_drag,
                    "The drag coefficient by what entropy leaves through the far field; None without one.");
  type.def_property_readonly(
      "cm", [](const FlowResult& f) { return if_determined(f, f.cm); },
      "The moment coefficient, positive nose up; nan where lift_determined is false.");
  type.def_property_readonly("bodies", &bodies_of,
                             "The parts of each wall, by name: cl, cd, cm; with friction also cd_pressure, "
                             "cd_friction and y_plus_max.");
  const auto opening = [&](const char* name, double FlowOpening::*member, const char* doc) {
    type.def_property_readonly(
        name, [member](const FlowResult& f) { return of_openings(f, member); }, doc);
  };
  opening("openings", &FlowOpening::mass_flow,
          "What enters through each inlet and outlet, by name: density times speed of "
          "sound of the stream times length.");
  opening(
      "flow_angles", &FlowOpening::flow_angle_deg,
      "The direction of the mean momentum through each inlet and outlet, by name: degrees to the x axis.");
  opening(
      "total_pressures", &FlowOpening::total_pressure,
      "The mean total pressure at each inlet and outlet, by mass flow and by name: parts of the stream's.");
  opening("static_pressures", &FlowOpening::pressure, "The mean static pressure there, likewise.");
  opening("opening_mach", &FlowOpening::mach, "The mean Mach number there, by mass flow and by name.");
  type.def_property_readonly(
      "loss_coefficient", &loss_coefficient,
      "What total pressure falls by from the only inlet to the only outlet, over total "
      "less static pressure at the inlet; None where there are other openings.");
  type.def_property_readonly(
      "model", [](const FlowResult& f) { return name_of(f.model); }, "'euler', 'laminar' or 'sa'.");
  const auto friction = [&](const char* name, double FlowFriction::*member, const char* doc) {
    type.def_property_readonly(
        name,
        [member](const FlowResult& f) {
          return f.friction ? std::optional<double>((*f.friction).*member) : std::nullopt;
        },
        doc);
  };
  friction("reynolds", &FlowFriction::reynolds,
           "The Reynolds number by the reference length; None without friction.");
  friction("cd_pressure", &FlowFriction::cd_pressure,
           "The part of cd that pressure makes; None without friction.");
  friction("cd_friction", &FlowFriction::cd_friction,
           "The part of cd that friction makes; None without friction.");
  friction("y_plus_max", &FlowFriction::y_plus_max,
           "The largest y+ of the lowest cells on walls; None without friction.");
  type.def_property_readonly(
      "wall_temperature",
      [](const FlowResult& f) { return f.friction ? f.friction->wall_temperature : std::nullopt; },
      "The temperature of walls over the stream's; None where no heat passes.");
  type.def_property_readonly(
      "heat",
      [](const FlowResult& f) {
        const bool passes = f.friction && f.friction->wall_temperature;
        return passes ? std::optional<double>(f.friction->heat) : std::nullopt;
      },
      "What all walls take, as `ch`, by the reference length; None where no heat passes.");
  type.def(
      "boundary_layer",
      [](const py::object& self) {
        return boundary_layer_of(self.cast<const FlowResult&>(), self.attr("mesh"));
      },
      "The boundary layer along walls, of a flow with friction: a dict of arrays with a value for each "
      "station, wall (a list of names), vertex, arc (along the wall), cf, y_plus, edge_speed (over the "
      "stream's), thickness (99 %), displacement_thickness, momentum_thickness (in units of the mesh; nan "
      "where the mesh has no layer that is as thick), shape_factor and ch (heat; nan where none passes).");
  type.def(
      "profiles",
      [](const py::object& self, const std::vector<double>& places) {
        return profiles_of(self.cast<const FlowResult&>(), self.attr("mesh"), places);
      },
      "places"_a,
      R"(Profiles through the boundary layer of a flow with friction: a list of dicts, one for each side of each wall
at each place, a part of its chord from 0 to 1. Each has wall, place, vertex (the nearest station) and arrays from the
wall on: height (in units of the mesh), speed along the wall, density and temperature (over the stream's),
viscosity_ratio (of turbulence over the molecular one), y_plus and u_plus. Raises ArgumentError.)");
  type.def_readonly(
      "residual", &FlowResult::residual,
      "Of the last state, over that of undisturbed flow: below `tolerance` where it was found.");
  type.def_readonly("newton_steps", &FlowResult::newton_steps, "Steps with a Jacobian of their own.");
  type.def_readonly("factorisations", &FlowResult::factorisations, "Of the whole matrix.");
  type.def_readonly("krylov_iterations", &FlowResult::krylov_iterations, "Steps with older factors.");
  type.def_property_readonly(
      "solver", [](const FlowResult& f) { return name_of(f.solver); },
      "'lu' or 'gmres': how the linear systems of the last step were solved.");
  type.def_readonly("gmres_iterations", &FlowResult::gmres_iterations, "Of all Newton steps.");
  type.def_readonly("memory_mb", &FlowResult::memory_mb,
                    "What the factors and GMRES's vectors took, the most.");
  type.def_readonly("seconds", &FlowResult::seconds, "Wall time of the search.");
  type.def_property_readonly(
      "history", [](const FlowPointer& f) { return view(f, f->history); },
      "The residuals, from the first state on.");
}

// Of a pickle: what was added to the object in Python, its mesh above all, is its __dict__.
std::pair<FlowPointer, py::dict> flow_of(const py::tuple& state) {
  require_pickle(state.size() == 2 && py::isinstance<py::dict>(state[1]), "a flow");
  auto flow = std::make_shared<FlowResult>(unpacked<FlowResult>(state[0]));
  const std::size_t points = flow->density.size();
  require_pickle(flow->velocity_x.size() == points && flow->velocity_y.size() == points &&
                     flow->pressure.size() == points && flow->status >= FlowStatus::converged &&
                     flow->status <= FlowStatus::interrupted && flow->start >= FlowStart::cold &&
                     flow->start <= FlowStart::refactored && flow->solver >= FlowSolver::lu &&
                     flow->origin >= FlowOrigin::last_flow && flow->origin <= FlowOrigin::undisturbed &&
                     flow->solver <= FlowSolver::gmres && flow->model >= FlowModel::euler &&
                     flow->model <= FlowModel::sa &&
                     (!flow->friction ||
                      (flow->friction->cf.size() == points && flow->friction->y_plus.size() == points &&
                       flow->friction->viscosity_ratio.size() == flow->friction->working.size() &&
                       (flow->friction->working.empty() || flow->friction->working.size() == points))),
                 "a flow");
  return {std::move(flow), state[1].cast<py::dict>()};
}

void add_result(py::module_& module) {
  py::class_<FlowResult, FlowPointer> type(
      module, "FlowResult", py::dynamic_attr(),
      "A flow: coefficients, and values per point of `mesh` as read-only arrays of shape (n,).");
  add_figures(type);
  type.def_property_readonly(
      "density", [](const FlowPointer& f) { return view(f, f->density); }, "Density over the stream's.");
  type.def_property_readonly(
      "velocity_x", [](const FlowPointer& f) { return view(f, f->velocity_x); },
      "Velocity along x over the stream's speed of sound: the stream's own is mach * cos(alpha).");
  type.def_property_readonly(
      "velocity_y", [](const FlowPointer& f) { return view(f, f->velocity_y); },
      "Velocity along y over the stream's speed of sound: the stream's own is mach * sin(alpha).");
  type.def_property_readonly(
      "pressure", [](const FlowPointer& f) { return view(f, f->pressure); },
      "Pressure over the stream's density times its speed of sound squared: 1 / 1.4 in the stream.");
  const auto on_walls = [&](const char* name, std::vector<double> FlowFriction::*member, const char* doc) {
    type.def_property_readonly(
        name,
        [member](const FlowPointer& f) -> py::object {
          if (!f->friction || ((*f->friction).*member).empty()) return py::none();
          return view(f, (*f->friction).*member);
        },
        doc);
  };
  on_walls("cf", &FlowFriction::cf,
           "Friction on walls over half the stream's density times speed squared, 0 elsewhere; None without "
           "friction.");
  on_walls(
      "ch", &FlowFriction::ch,
      "Heat that walls take over the stream's density times speed times cp times temperature, 0 elsewhere; "
      "None without a temperature of walls.");
  on_walls("y_plus", &FlowFriction::y_plus,
           "y+ of the lowest cells on walls, 0 elsewhere; None without friction.");
  on_walls("viscosity_ratio", &FlowFriction::viscosity_ratio,
           "Turbulent viscosity over molecular viscosity; None of flows that are not turbulent.");
  type.def_property_readonly(
      "local_mach", [](const FlowResult& f) { return copied(mach_numbers(f)); },
      "The local Mach number: speed over the local speed of sound.");
  type.def_property_readonly(
      "cp", [](const FlowResult& f) { return copied(pressure_coefficients(f)); }, "Pressure coefficients.");
  type.def_property_readonly(
      "entropy", [](const FlowResult& f) { return copied(entropy_errors(f)); },
      "p / rho**gamma over the stream's, minus 1.");
  type.def(py::pickle(
      [](const py::object& flow) {
        return py::make_tuple(packed(flow.cast<const FlowResult&>()), flow.attr("__dict__"));
      },
      &flow_of));
  type.def("__repr__", [](const FlowResult& f) {
    return std::string("FlowResult(") + name_of(f.status) + ", cl=" + std::to_string(if_determined(f, f.cl)) +
           ", cd=" + std::to_string(f.cd) + ")";
  });
}

// A solver's options: what goes on from a pickle begins cold.
py::tuple state_of(const Flows& flows) {
  const FlowOptions& o = flows.options();
  Inlets inlets;
  for (const FlowInlet& inlet : o.inlets) {
    inlets[inlet.name] = {inlet.total_pressure, inlet.total_temperature};
    if (inlet.angle_deg) inlets[inlet.name].push_back(*inlet.angle_deg);
  }
  Pairs periodic;
  for (const FlowPeriod& pair : o.periodic) periodic.emplace_back(pair.name, pair.moved);
  Outlets outlets;
  for (const FlowOutlet& outlet : o.outlets) outlets[outlet.name] = outlet.pressure;
  return py::make_tuple(o.farfield, o.tolerance, o.max_steps, o.memory_mb,
                        o.solver ? py::object(py::str(name_of(*o.solver))) : py::none(), inlets, outlets,
                        py::str(name_of(o.model)), periodic);
}

std::unique_ptr<Flows> flows_of(const py::tuple& state) {
  require_pickle(state.size() == 9, "a LivingFlow");
  return std::make_unique<Flows>(options_of(
      state[0].cast<Names>(), state[1].cast<double>(), state[2].cast<int>(), state[3].cast<double>(),
      state[4].cast<std::optional<std::string>>(), state[5].cast<Inlets>(), state[6].cast<Outlets>(),
      state[7].cast<std::string>(), state[8].cast<Pairs>()));
}

constexpr const char* solver_text =
    R"(Steady compressible flow (gamma = 1.4) around the walls of a mesh.

model: 'euler', without friction; 'laminar'; 'sa', turbulent by Spalart and Allmaras's model. The last two want the
Reynolds number of the reference length, 1 to 1e10, and a mesh with layers (generate_layered()); docs/viscous.md.
transition: with 'sa', where the boundary layers of upper and lower sides become turbulent, two parts of the chord from
0 to 1; None: at the leading edge. wall_temperature: with 'laminar' and 'sa', of all walls, as a part of the stream's
static temperature, more than 0; None: no heat passes through walls.

farfield: the boundary open to the stream, or a list of its parts. mach: 0.01 to 3; alpha: degrees, or where cl is given
the angle that the search for this lift begins with; reference: the moment's point. inlets: total pressure and total temperature of each by name, outlets: the pressure
of each, all as parts of the stream's; below Mach 1. A third number of an inlet is the angle to the x axis that gas
enters at; without it, it enters at a right angle to the boundary. periodic: pairs of names of boundaries of which one
is the other moved, beside those that a mesh knows from its domain. tolerance: residual over that of undisturbed flow, 1e-13 to 1e-2. Raises
ArgumentError; a flow that is not found is a result: FlowResult.converged, .reason. Ctrl-C ends it.
docs/flow.md has method and sources.)";

}  // namespace

FlowOptions flow_options_of(const py::object& living_flow) {
  return living_flow.cast<const Flows&>().options();
}

void add_flows(py::module_& module) {
  add_result(module);
  const FlowOptions defaults;
  const std::array<double, 2> quarter = {0.25, 0.0};
  module.def("solve_flow", &solved, "mesh"_a, py::kw_only(), "mach"_a = 0.5, "alpha"_a = 0.0,
             "cl"_a = py::none(), "reference"_a = quarter, "reference_length"_a = 1.0,
             "farfield"_a = "farfield", "tolerance"_a = defaults.tolerance,
             "max_steps"_a = defaults.max_steps, "memory_mb"_a = defaults.memory_mb, "solver"_a = py::none(),
             "inlets"_a = Inlets(), "outlets"_a = Outlets(), "reynolds"_a = 0.0, "model"_a = "euler",
             "transition"_a = py::none(), "wall_temperature"_a = py::none(), "periodic"_a = Pairs(),
             solver_text);
  py::class_<Flows>(
      module, "LivingFlow",
      R"(A flow solver that outlives its mesh: each flow is found from the one before and the factors that are
still good, whatever update() did to the mesh in between. The result depends on mesh and conditions alone, to
the tolerance. Meshes are living ones, frozen ones (also of arrays) or what an update returns. A pickle goes on with
the same options, and begins cold. After Ctrl-C the next call waits until a factorisation that was under way has ended.)")
      .def(py::init([](const Names& farfield, double tolerance, int max_steps, double memory_mb,
                       const std::optional<std::string>& solver, const Inlets& inlets, const Outlets& outlets,
                       const std::string& model, const Pairs& periodic) {
             return std::make_unique<Flows>(options_of(farfield, tolerance, max_steps, memory_mb, solver,
                                                       inlets, outlets, model, periodic));
           }),
           py::kw_only(), "farfield"_a = "farfield", "tolerance"_a = defaults.tolerance,
           "max_steps"_a = defaults.max_steps, "memory_mb"_a = defaults.memory_mb, "solver"_a = py::none(),
           "inlets"_a = Inlets(), "outlets"_a = Outlets(), "model"_a = "euler", "periodic"_a = Pairs())
      .def("solve", &Flows::solve, "mesh"_a, py::kw_only(), "mach"_a = 0.5, "alpha"_a = 0.0,
           "cl"_a = py::none(), "reference"_a = quarter, "reference_length"_a = 1.0, "reynolds"_a = 0.0,
           "transition"_a = py::none(), "wall_temperature"_a = py::none(), solver_text)
      .def(
          "gradients", &Flows::gradients, "functions"_a = py::dict(),
          R"(Derivatives of the last flow's cl, cd, cm and alpha, by their adjoint: for each a dict of points, of
shape (n, 2) (Mesh.vjp() makes derivatives by the airfoil of them), mach, alpha (a degree) and cl (by the lift that
was given), and reynolds; with friction cd_pressure too.

functions: functions of one's own, a dict of names and the derivatives of each at fixed others: a dict with any of
pressure, density, velocity_x, velocity_y (of shape (n,), by the fields of the flow), points (of shape (n, 2)) and mach.
The result has their total derivatives by name. Raises ArgumentError before the first flow, and where the last one was
not found.)")
      .def(py::pickle(&state_of, &flows_of))
      .def("forget", &Flows::forget, "The next flow is found cold.");
}

}  // namespace remodel::python
