// InteriorDisplacement: how the interior of a mesh goes along with its walls.

#include "remodel/displacement.h"

#include <algorithm>

#include "bindings.h"
#include "living.h"

namespace remodel::python {
namespace {

bool of_loop(const Loop& loop, const std::string& name) {
  return std::any_of(loop.curves.begin(), loop.curves.end(),
                     [&](const Curve& curve) { return curve.name == name; });
}

class Displacement {
 public:
  // Of a Mesh by its loops, which it is copied for; of any other mesh by its arrays, as they are now.
  Displacement(const py::object& mesh, const std::optional<std::vector<std::string>>& names) : names_(names) {
    if (py::isinstance<LivingMesh>(mesh))
      of_loops(mesh.cast<LivingMeshPointer>());
    else
      of_arrays(snapshot_of(mesh));
  }

  py::array jvp(const Reals& walls) const {
    const std::vector<Point> displacements = of_all_points(walls, "walls");
    for (std::size_t i = 0; i < std::min(displacements.size(), still_.size()); ++i)
      if (still_[i] && !(displacements[i] == Point{}))
        throw Error(ErrorCode::argument, "walls",
                    "moves point " + std::to_string(i) + " of a wall that rests, expected zero there");
    return view_of(field_->jvp(displacements));
  }
  py::array vjp(const Reals& by_points) const {
    return view_of(field_->vjp(of_all_points(by_points, "by_points")));
  }
  std::size_t size() const { return field_->points(); }

  py::tuple state() const { return py::make_tuple(kept_, names_); }

 private:
  void of_loops(const LivingMeshPointer& mesh) {
    const ThreadLock::Held held(mesh->lock);
    const auto own = std::make_shared<LivingMesh>();
    own->mesh = mesh->mesh;
    own->stopped = mesh->stopped;
    kept_ = py::cast(own);
    const std::vector<std::size_t> moving = loops(mesh->mesh.domain());
    field_ = std::make_unique<InteriorDisplacement>(mesh->mesh, moving);
    const Snapshot frozen = mesh->freeze();
    std::vector<bool> moves;  // per curve
    for (std::size_t i = 0; i < mesh->mesh.domain().loops.size(); ++i)
      moves.insert(moves.end(), mesh->mesh.domain().loops[i].curves.size(),
                   std::find(moving.begin(), moving.end(), i) != moving.end());
    for (const std::int32_t curve : frozen->curve)
      still_.push_back(curve >= 0 && !moves[static_cast<std::size_t>(curve)]);
  }
  void of_arrays(const Snapshot& mesh) {
    kept_ = py::cast(std::const_pointer_cast<FrozenMesh>(mesh));
    std::vector<std::string> moving;
    for (const FrozenBoundary& boundary : mesh->boundaries)
      if (boundary.name != "farfield") moving.push_back(boundary.name);
    if (names_) moving = *names_;
    field_ = std::make_unique<InteriorDisplacement>(*mesh, moving);
    still_.assign(mesh->points.size(), false);
    for (const bool moves : {false, true})
      for (const FrozenBoundary& boundary : mesh->boundaries)
        if (moves == (std::find(moving.begin(), moving.end(), boundary.name) != moving.end()))
          for (const auto& [a, b] : boundary.edges) still_[a] = still_[b] = !moves;
  }
  std::vector<Point> of_all_points(const Reals& values, const char* name) const {
    std::vector<Point> result = points(values, name);
    if (result.size() != size())
      throw Error(ErrorCode::argument, name,
                  "found " + std::to_string(result.size()) + " rows, expected " + std::to_string(size()) +
                      ", one for each point");
    return result;
  }
  std::vector<std::size_t> loops(const Domain& domain) const {
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < domain.loops.size(); ++i) {
      const bool named = names_
                             ? std::any_of(names_->begin(), names_->end(),
                                           [&](const auto& name) { return of_loop(domain.loops[i], name); })
                             : !of_loop(domain.loops[i], "farfield");
      if (named) result.push_back(i);
    }
    for (const std::string& name : names_.value_or(std::vector<std::string>()))
      if (std::none_of(domain.loops.begin(), domain.loops.end(),
                       [&](const Loop& loop) { return of_loop(loop, name); }))
        throw Error(ErrorCode::argument, "moving", "found '" + name + "', expected names of boundaries");
    return result;
  }

  std::optional<std::vector<std::string>> names_;
  py::object kept_;  // the mesh, for pickles
  std::unique_ptr<InteriorDisplacement> field_;
  std::vector<bool> still_;  // per point
};

}  // namespace

void add_displacements(py::module_& module) {
  py::class_<Displacement>(
      module, "InteriorDisplacement",
      R"(The displacement of a mesh's interior that goes with one of its walls: smooth, linear, local.

InteriorDisplacement(mesh, moving): moving are the names of the boundaries that move, all but `farfield` unless given.
mesh is a Mesh, a LayeredMesh or a FrozenMesh of any origin; layers on walls go along as all else does, which is not how
a LayeredMesh follows its design (LayeredMesh.jvp). It is the field of E. Luke, E. Collins and E. Blades (J. Comput. Phys.
231, 2012), of edges instead of nodes, at the places that the mesh has now, or if it is a Mesh that is held at those of
its reference. The mesh need not live on.)")
      .def(py::init<const py::object&, const std::optional<std::vector<std::string>>&>(), "mesh"_a,
           "moving"_a = py::none())
      .def("jvp", &Displacement::jvp, "walls"_a,
           "The displacement of every point, of shape (n, 2). walls: of the same shape, that of boundary "
           "points; those of other points are not read, those of walls that rest have to be zero.")
      .def("vjp", &Displacement::vjp, "by_points"_a,
           "Transposed: derivatives by all points become those by boundary points, zero elsewhere.")
      .def("__len__", &Displacement::size)
      .def(py::pickle([](const Displacement& d) { return d.state(); },
                      [](const py::tuple& state) {
                        if (state.size() != 2 ||
                            !(py::isinstance<LivingMesh>(state[0]) || py::isinstance<FrozenMesh>(state[0])))
                          throw Error(ErrorCode::format, "pickle", "expected an InteriorDisplacement");
                        return std::make_unique<Displacement>(
                            py::reinterpret_borrow<py::object>(state[0]),
                            state[1].cast<std::optional<std::vector<std::string>>>());
                      }));
}

}  // namespace remodel::python
