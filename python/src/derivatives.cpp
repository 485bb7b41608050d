// Derivatives of meshes by their designs, and of flows by adjoints.

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "bindings.h"
#include "living.h"
#include "remodel/displacement.h"
#include "remodel/mesh_derivative.h"
#include "remodel/mesh_state.h"

namespace remodel::python {
namespace {

// The numbers that derivatives are by, among all of a domain's, and the loops that these move.
struct Range {
  std::vector<std::size_t> loops;
  std::size_t first, count;
};

// Where an airfoil's upper and lower coefficients lie.
Range airfoil_range(const Domain& domain, const std::string& boundary) {
  std::size_t first = 0, airfoils = 0;
  Range found{};
  for (std::size_t i = 0; i < domain.loops.size(); ++i) {
    for (const Curve& curve : domain.loops[i].curves) {
      Domain alone{.loops = {{.curves = {curve}}}};
      const std::size_t size = coefficients_of(alone).size() - 4;  // the placement's
      const auto* airfoil = std::get_if<CstAirfoil>(&curve.shape);
      if (airfoil != nullptr && (boundary.empty() || curve.name == boundary)) {
        found = {{i}, first, airfoil->upper.size() + airfoil->lower.size()};
        ++airfoils;
      }
      first += size;
    }
    first += 4;
  }
  if (airfoils != 1)
    throw Error(ErrorCode::argument, "boundary",
                "found '" + boundary + "', which names " + std::to_string(airfoils) +
                    " airfoils by coefficients, expected one" +
                    (airfoils == 0 ? ": an imported mesh has polygons, and coefficients after "
                                     "update(Domain(airfoil))"
                                   : ""));
  return found;
}

// All coefficients of the loops, of which only those of the far field never move.
Range whole_range(const Domain& domain) {
  Range all{{}, 0, coefficients_of(domain).size()};
  for (std::size_t i = 0; i < domain.loops.size(); ++i)
    if (domain.loops[i].curves.empty() || domain.loops[i].curves.front().name != "farfield")
      all.loops.push_back(i);
  return all;
}

// How a mesh goes with its design: walls by their curves, and the interior along or not.
struct Way {
  Range range;
  MeshDerivative walls;
  std::optional<InteriorDisplacement> interior;

  Way(const LivingMesh& living, const std::string& boundary, const std::string& of, const std::string& how)
      : range(range_of(living.mesh.domain(), boundary, of)), walls(living.mesh) {
    const Mesh& mesh = living.mesh;
    if (how != "own" && how != "still" && how != "along")
      throw Error(ErrorCode::argument, "interior", "found '" + how + "', expected own, still or along");
    if (how == "still" || (how == "own" && own_strategy(mesh, living.follows) != Strategy::reference)) return;
    interior.emplace(mesh, moving_loops(mesh, range.loops));
  }

 private:
  static Range range_of(const Domain& domain, const std::string& boundary, const std::string& of) {
    if (of == "airfoil") return airfoil_range(domain, boundary);
    if (of == "domain" && boundary.empty()) return whole_range(domain);
    throw Error(ErrorCode::argument, "of", "found '" + of + "', expected airfoil, or domain and no boundary");
  }
};

py::array jvp(LivingMesh& mesh, const Reals& direction, const std::string& boundary, const std::string& of,
              const std::string& how) {
  const std::vector<double> given = reals(direction, "direction");
  const ThreadLock::Held held(mesh.lock);
  const Way way(mesh, boundary, of, how);
  if (given.size() != way.range.count)
    throw Error(
        ErrorCode::argument, "direction",
        "found " + std::to_string(given.size()) + " numbers, expected " + std::to_string(way.range.count));
  std::vector<double> all(way.walls.coefficients(), 0.0);
  std::copy(given.begin(), given.end(), all.begin() + static_cast<std::ptrdiff_t>(way.range.first));
  const std::vector<Point> moved = way.walls.jvp(all);
  return view_of(way.interior ? way.interior->jvp(moved) : moved);
}

// Throws Error (argument) where derivatives know that they are of another mesh, or of another moment of it.
void require_of(const py::object& by_points, const FrozenMesh& mesh) {
  const py::object other = py::getattr(by_points, "mesh", py::none());
  if (!py::isinstance<FrozenMesh>(other)) return;
  const auto& theirs = other.cast<const FrozenMesh&>();
  if (theirs.triangles != mesh.triangles || theirs.quads != mesh.quads ||
      theirs.points.size() != mesh.points.size())
    throw Error(
        ErrorCode::argument, "by_points",
        "is of a flow on a mesh with other triangles, expected derivatives by the points of this mesh "
        "as it is now");
  double farthest = 0.0;
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    farthest = std::max(farthest, std::sqrt(squared_distance(theirs.points[i], mesh.points[i])));
  if (farthest > 0.0) {
    std::ostringstream text;
    text << "is of a flow on this mesh at another design, whose points lie up to " << farthest
         << " from where they are now, expected derivatives by the points of the mesh as it is now";
    throw Error(ErrorCode::argument, "by_points", text.str());
  }
}

py::array_t<double> vjp(LivingMesh& mesh, const py::object& by_points, const std::string& boundary,
                        const std::string& of, const std::string& how) {
  std::vector<Point> weights = points(array_of(by_points, "by_points"), "by_points");
  const ThreadLock::Held held(mesh.lock);
  if (py::hasattr(by_points, "mesh")) require_of(by_points, *mesh.freeze());
  const Way way(mesh, boundary, of, how);
  if (way.interior) weights = way.interior->vjp(weights);
  const std::vector<double> all = way.walls.vjp(weights);
  const auto begin = all.begin() + static_cast<std::ptrdiff_t>(way.range.first);
  return copied(std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(way.range.count)));
}

LivingMeshPointer at(LivingMesh& mesh, const py::object& shape, const std::string& boundary) {
  const ThreadLock::Held held(mesh.lock);
  const Domain domain = next_domain(mesh.mesh, shape, boundary);
  py::gil_scoped_release released;
  auto result = std::make_shared<LivingMesh>();
  result->mesh = mesh_at(mesh.mesh, domain, own_strategy(mesh.mesh, mesh.follows));
  result->stopped = mesh.stopped;
  result->follows = mesh.follows;
  return result;
}

}  // namespace

std::vector<std::size_t> moving_loops(const Mesh& mesh, const std::vector<std::size_t>& loops) {
  const Domain reference = mesh.held() ? mesh.state().reference_domain : mesh.domain();
  std::vector<std::size_t> moving;
  for (std::size_t i = 0; i < mesh.domain().loops.size(); ++i)
    if (std::find(loops.begin(), loops.end(), i) != loops.end() ||
        !(mesh.domain().loops[i] == reference.loops[i]))
      moving.push_back(i);
  return moving;
}

Strategy own_strategy(const Mesh& mesh, bool follows) {
  return mesh.held() || follows ? Strategy::reference : Strategy::chain;
}

AirfoilNumbers airfoil_numbers(const Domain& domain, const std::string& boundary) {
  const Range range = airfoil_range(domain, boundary);
  return {range.loops.front(), range.first, range.count};
}

void add_derivatives(py::module_& module) {
  auto type = py::reinterpret_borrow<py::class_<LivingMesh, LivingMeshPointer>>(module.attr("Mesh"));
  type.def(
      "jvp", &jvp, "direction"_a, "boundary"_a = "", py::kw_only(), "of"_a = "airfoil", "interior"_a = "own",
      R"(How the points move, of shape (n, 2), with an airfoil's coefficients in a direction (Airfoil.design's
order), at fixed connectivity: boundary vertices move with their curve. of='domain': with all numbers of
Domain.coefficients, placements, splines and polygons included. interior: 'still', as in a full adjustment; 'along', by
InteriorDisplacement; 'own': as the last step would, along after update(strategy='reference'), otherwise still.)");
  type.def(
      "vjp", &vjp, "by_points"_a, "boundary"_a = "", py::kw_only(), "of"_a = "airfoil", "interior"_a = "own",
      "Transposed: derivatives by points, of shape (n, 2), become derivatives by the coefficients. Raises "
      "ArgumentError for LivingFlow.gradients() of a flow on another mesh, or on this one before it was "
      "changed.");
  type.def(
      "at", &at, "shape"_a, py::kw_only(), "boundary"_a = "",
      "A copy at another design with the same connectivity; shape and boundary as update()'s. Its interior "
      "goes as jvp(interior='own') says: along after update(strategy='reference'), otherwise it stays. "
      "Raises TopologyChanged where there is no valid one.");
}

}  // namespace remodel::python
