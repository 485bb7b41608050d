// Plane potential flow: PotentialSolver and PotentialFlow.

#include "apart.h"
#include "bindings.h"
#include "records.h"
#include "remodel/potential_flow.h"

namespace remodel {

template <python::Is<WallValue> T>
auto members(T& v) {
  return std::tie(v.vertex, v.point.x, v.point.y, v.speed, v.cp);
}
template <python::Is<BodyFlow> T>
auto members(T& b) {
  return std::tie(b.name, b.wall, b.trailing_edge, b.circulation, b.stream_function, b.lift, b.drag,
                  b.moment);
}
template <python::Is<PotentialFlow> T>
auto members(T& f) {
  return std::tie(f.alpha_deg, f.mach, f.supersonic, f.lift, f.lift_by_pressure, f.drag_by_pressure, f.moment,
                  f.bodies, f.stream_function, f.velocity, f.warnings, f.lift_determined);
}

}  // namespace remodel

namespace remodel::python {
namespace {

using PotentialPointer = std::shared_ptr<PotentialFlow>;

double if_determined(const PotentialFlow& flow, double value) {
  return flow.lift_determined ? value : std::numeric_limits<double>::quiet_NaN();
}

// Each body's wall: points of shape (k, 2), vertices and pressure coefficients, and its forces.
py::dict bodies_of(const PotentialFlow& flow) {
  py::dict result;
  for (const BodyFlow& body : flow.bodies) {
    const auto count = static_cast<py::ssize_t>(body.wall.size());
    py::array_t<double> points({count, py::ssize_t{2}}), cp(count), speed(count);
    py::array_t<std::uint32_t> vertices(count);
    for (py::ssize_t i = 0; i < count; ++i) {
      const WallValue& value = body.wall[static_cast<std::size_t>(i)];
      points.mutable_at(i, 0) = value.point.x, points.mutable_at(i, 1) = value.point.y;
      cp.mutable_at(i) = value.cp, speed.mutable_at(i) = value.speed, vertices.mutable_at(i) = value.vertex;
    }
    result[py::str(body.name)] = py::dict("points"_a = points, "vertices"_a = vertices, "cp"_a = cp,
                                          "speed"_a = speed, "lift"_a = if_determined(flow, body.lift),
                                          "drag"_a = body.drag, "moment"_a = if_determined(flow, body.moment),
                                          "circulation"_a = if_determined(flow, body.circulation));
  }
  return result;
}

// A solver and what it was made of, for pickles: the factors are made anew.
struct Potential {
  Potential(Snapshot from, std::vector<std::string> outer)
      : mesh(std::move(from)), farfield(std::move(outer)) {
    solver = Apart().run(std::make_shared<Stop>(), [mesh = mesh, farfield = farfield] {
      return std::make_shared<PotentialSolver>(*mesh, PotentialOptions{.farfield = farfield});
    });
  }
  Snapshot mesh;
  std::vector<std::string> farfield;
  std::shared_ptr<PotentialSolver> solver;
};

}  // namespace

void add_potential_flows(py::module_& module) {
  py::class_<PotentialFlow, PotentialPointer>(
      module, "PotentialFlow",
      "A potential flow; the free stream has speed 1, coefficients are per half chord.")
      .def(record_pickle<PotentialFlow>())
      .def_readonly("alpha", &PotentialFlow::alpha_deg, "The angle of attack, in degrees.")
      .def_readonly("mach", &PotentialFlow::mach,
                    "The Mach number that pressures and lift are corrected for.")
      .def_readonly(
          "supersonic", &PotentialFlow::supersonic,
          "Whether some pressure is below that of sonic speed, where the rule for mach does not hold.")
      .def_property_readonly(
          "lift", [](const PotentialFlow& f) { return if_determined(f, f.lift); },
          "The lift coefficient of all bodies, by circulation; nan where lift_determined is false.")
      .def_property_readonly(
          "lift_by_pressure", [](const PotentialFlow& f) { return if_determined(f, f.lift_by_pressure); },
          "The lift coefficient by pressures on walls; nan where lift_determined is false.")
      .def_readonly("drag_by_pressure", &PotentialFlow::drag_by_pressure, "An error of the mesh.")
      .def_property_readonly(
          "moment", [](const PotentialFlow& f) { return if_determined(f, f.moment); },
          "The moment coefficient by pressures on walls about (0.25, 0), positive nose up; nan where "
          "lift_determined is false.")
      .def_readonly("warnings", &PotentialFlow::warnings,
                    "What has to be known before a coefficient is used: a list of sentences.")
      .def_readonly("lift_determined", &PotentialFlow::lift_determined,
                    "Whether every body has an edge that the flow leaves from.")
      .def_property_readonly("bodies", &bodies_of,
                             "By name: points, vertices, cp and speed along the wall; lift, drag, moment.")
      .def_property_readonly(
          "stream_function", [](const PotentialPointer& f) { return view(f, f->stream_function); },
          "The stream function at each point, of shape (n,), of the incompressible flow.")
      .def_property_readonly(
          "velocity",
          [](const PotentialPointer& f) {
            return view(f, f->velocity.empty() ? nullptr : &f->velocity.front().x,
                        {static_cast<py::ssize_t>(f->velocity.size()), 2});
          },
          "The velocity at each point over the stream's speed, of shape (n, 2), of the incompressible flow.")
      .def_property_readonly(
          "cp",
          [](const PotentialFlow& f) {
            std::vector<double> cp;
            for (const Point v : f.velocity) cp.push_back(compressible_cp(1.0 - dot(v, v), f.mach));
            return copied(cp);
          },
          "The pressure coefficient at each point, of shape (n,), by the rule for mach.");
  py::class_<Potential>(
      module, "PotentialSolver",
      R"(Plane potential flow around the bodies of a mesh, by one factorisation: lift and pressures in
milliseconds, without drag. farfield: the outer boundary, or a list of its parts. Raises ArgumentError. docs/potential_flow.md has method and figures.)")
      .def(py::init([](const py::object& mesh, const Names& farfield) {
             return std::make_unique<Potential>(snapshot_of(mesh), list_of(farfield));
           }),
           "mesh"_a, py::kw_only(), "farfield"_a = "farfield")
      .def(
          "at",
          [](const Potential& s, double alpha, double mach) {
            return std::make_shared<PotentialFlow>(s.solver->at(alpha, mach));
          },
          "alpha"_a, py::kw_only(), "mach"_a = 0.0,
          R"(The flow at an angle, -90 to 90 degrees. mach, less than 1: pressures by the rule of von Karman and
Tsien, lift by circulation by Glauert's.)")
      .def(py::pickle([](const Potential& s) { return py::make_tuple(packed_mesh(s.mesh), s.farfield); },
                      [](const py::tuple& state) {
                        require_pickle(state.size() == 2 && !state[0].is_none(), "a PotentialSolver");
                        return std::make_unique<Potential>(unpacked_mesh(state[0]),
                                                           list_of(state[1].cast<Names>()));
                      }))
      .def(
          "alpha_for",
          [](const Potential& s, double lift, double mach) { return s.solver->alpha_deg_for(lift, mach); },
          "lift"_a, py::kw_only(), "mach"_a = 0.0, "The angle with that lift by circulation, in degrees.");
}

}  // namespace remodel::python
