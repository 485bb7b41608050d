// Derivatives of meshes by their designs, and of flows by adjoints.

#include <algorithm>

#include "bindings.h"
#include "living.h"
#include "remodel/mesh_derivative.h"

namespace remodel::python {
namespace {

py::array view_of(std::vector<Point> points) {
  const auto held = std::make_shared<const std::vector<Point>>(std::move(points));
  return view(held, held->empty() ? nullptr : &held->front().x, {static_cast<py::ssize_t>(held->size()), 2});
}

// Where an airfoil's upper and lower coefficients lie among those of a domain.
std::pair<std::size_t, std::size_t> airfoil_range(const Domain& domain, const std::string& boundary) {
  std::size_t first = 0, found = no_index, count = 0, airfoils = 0;
  for (const Loop& loop : domain.loops) {
    for (const Curve& curve : loop.curves) {
      Domain alone{.loops = {{.curves = {curve}}}};
      const std::size_t size = coefficients_of(alone).size() - 4;  // the placement's
      const auto* airfoil = std::get_if<CstAirfoil>(&curve.shape);
      if (airfoil != nullptr && (boundary.empty() || curve.name == boundary)) {
        found = first, count = airfoil->upper.size() + airfoil->lower.size();
        ++airfoils;
      }
      first += size;
    }
    first += 4;
  }
  if (airfoils != 1)
    throw Error(ErrorCode::argument, "boundary",
                "names " + std::to_string(airfoils) + " airfoils by coefficients, expected one");
  return {found, count};
}

py::array jvp(LivingMesh& mesh, const Reals& direction, const std::string& boundary) {
  const std::vector<double> by_airfoil = reals(direction, "direction");
  const ThreadLock::Held held(mesh.lock);
  const auto [first, count] = airfoil_range(mesh.mesh.domain(), boundary);
  if (by_airfoil.size() != count)
    throw Error(ErrorCode::argument, "direction",
                "found " + std::to_string(by_airfoil.size()) + " numbers, expected " + std::to_string(count));
  const MeshDerivative derivative(mesh.mesh);
  std::vector<double> all(derivative.coefficients(), 0.0);
  std::copy(by_airfoil.begin(), by_airfoil.end(), all.begin() + static_cast<std::ptrdiff_t>(first));
  return view_of(derivative.jvp(all));
}

py::array_t<double> vjp(LivingMesh& mesh, const Reals& by_points, const std::string& boundary) {
  const std::vector<Point> weights = points(by_points, "by_points");
  const ThreadLock::Held held(mesh.lock);
  const auto [first, count] = airfoil_range(mesh.mesh.domain(), boundary);
  const std::vector<double> all = MeshDerivative(mesh.mesh).vjp(weights);
  const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
  return copied(std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(count)));
}

LivingMeshPointer at(LivingMesh& mesh, const py::object& shape, const std::string& boundary) {
  const ThreadLock::Held held(mesh.lock);
  const Domain domain = next_domain(mesh, shape, boundary);
  py::gil_scoped_release released;
  auto result = std::make_shared<LivingMesh>();
  result->mesh = mesh_at(mesh.mesh, domain);
  result->stopped = mesh.stopped;
  return result;
}

}  // namespace

void add_derivatives(py::module_& module) {
  auto type = py::reinterpret_borrow<py::class_<LivingMesh, LivingMeshPointer>>(module.attr("Mesh"));
  type.def(
      "jvp", &jvp, "direction"_a, "boundary"_a = "",
      R"(How the points move, of shape (n, 2), with an airfoil's coefficients in a direction (Airfoil.design's
order), at fixed connectivity: boundary vertices move with their curve, the interior rests, as in a full adjustment.)");
  type.def("vjp", &vjp, "by_points"_a, "boundary"_a = "",
           "Transposed: derivatives by points, of shape (n, 2), become derivatives by the airfoil's "
           "coefficients.");
  type.def("at", &at, "shape"_a, py::kw_only(), "boundary"_a = "",
           "A copy at another design with the same connectivity. Raises TopologyChanged where there is no "
           "valid one.");
}

}  // namespace remodel::python
