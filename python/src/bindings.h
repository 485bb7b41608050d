#pragma once

// What the binding files share. Each adds the classes of one idea to the module.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "remodel/airfoil.h"
#include "remodel/domain.h"
#include "remodel/error.h"
#include "remodel/frozen_mesh.h"
#include "remodel/shape_domain.h"

namespace remodel::python {

namespace py = pybind11;
using namespace pybind11::literals;

using Snapshot = std::shared_ptr<const FrozenMesh>;
using Names = std::variant<std::string, std::vector<std::string>>;  // of boundaries: one or several
using Reals = py::array_t<double, py::array::c_style | py::array::forcecast>;

void add_errors(py::module_& module);
void add_shapes(py::module_& module);
void add_snapshots(py::module_& module);
void add_meshes(py::module_& module);
void add_steps(py::module_& module);
void add_transfers(py::module_& module);
void add_derivatives(py::module_& module);
void add_displacements(py::module_& module);
void add_layers(py::module_& module);
void add_flows(py::module_& module);
void add_potential_flows(py::module_& module);
void add_designers(py::module_& module);
void add_noise(py::module_& module);
void add_optimise(py::module_& module);
void add_polars(py::module_& module);
void add_designs(py::module_& module);
void add_sweeps(py::module_& module);

// Throws Error (argument) unless the array has one dimension.
std::vector<double> reals(const Reals& values, const char* name);
// Throws TypeError naming the argument unless the object is an array of numbers, or can be made one.
Reals array_of(const py::handle& object, const std::string& name);
// Rows of x and y. Throws Error (argument) for another shape.
std::vector<Point> points(const Reals& values, const std::string& name);
// An Airfoil, a Domain, or whatever domain_of_shapes() takes by a name or the path of a file; what it warns
// of is a UserWarning. Throws TypeError for anything else.
ShapesDomain domain_of(const py::object& shape, const AirfoilDomainOptions& options,
                       const ShapeReading& reading = {});

// The name or path that a shape is given by. Throws TypeError for what is none, Error (argument) for '-'.
std::string name_of_shape(const py::object& shape);
inline std::vector<std::string> list_of(const Names& names) {
  const auto* one = std::get_if<std::string>(&names);
  return one != nullptr ? std::vector{*one} : std::get<std::vector<std::string>>(names);
}
// Each sentence as a UserWarning.
void warn(const std::vector<std::string>& sentences);

// The name of an object's type, for messages.
std::string type_of(const py::handle& object);

// A frozen mesh as it is now: of a FrozenMesh itself, of a Mesh or LayeredMesh, or after a Step.
Snapshot snapshot_of(const py::object& mesh);
// Of a LayeredMesh; none of anything else.
Snapshot layered_snapshot(const py::object& mesh);
// After a LayeredStep; none of anything else.
Snapshot after_layered_step(const py::object& step);

// An array that owns a copy.
template <class T>
py::array_t<T> copied(const std::vector<T>& values) {
  return py::array_t<T>(static_cast<py::ssize_t>(values.size()), values.data());
}

// A read-only array over memory that `owner` keeps alive: no copy is made, and a view outlives whatever its
// mesh does next.
template <class T, class Owner>
py::array view(const std::shared_ptr<Owner>& owner, const T* data, std::vector<py::ssize_t> shape) {
  if (data == nullptr) return py::array(py::dtype::of<T>(), std::move(shape));
  auto* held = new std::shared_ptr<Owner>(owner);
  py::capsule base(held, [](void* pointer) { delete static_cast<std::shared_ptr<Owner>*>(pointer); });
  py::array result(py::dtype::of<T>(), std::move(shape), data, base);
  py::detail::array_proxy(result.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return result;
}

// Points, of shape (n, 2), which the array takes.
py::array view_of(std::vector<Point> points);

template <class T, class Owner>
py::array view(const std::shared_ptr<Owner>& owner, const std::vector<T>& values) {
  return view(owner, values.data(), {static_cast<py::ssize_t>(values.size())});
}

}  // namespace remodel::python
