// The extension module remodel._core. What users see is the package around it, python/remodel.

#include "apart.h"
#include "bindings.h"
#include "remodel/version.h"

namespace remodel::python {

std::vector<double> reals(const Reals& values, const char* name) {
  if (values.ndim() != 1)
    throw Error(ErrorCode::argument, name,
                "found an array of " + std::to_string(values.ndim()) + " dimensions, expected one dimension");
  return {values.data(), values.data() + values.size()};
}

std::vector<Point> points(const Reals& values, const std::string& name) {
  if (values.ndim() != 2 || values.shape(1) != 2)
    throw Error(ErrorCode::argument, name, "expected an array of shape (n, 2)");
  std::vector<Point> result;
  for (py::ssize_t i = 0; i < values.shape(0); ++i)
    result.push_back({*values.data(i, 0), *values.data(i, 1)});
  return result;
}

Reals array_of(const py::handle& object, const std::string& name) {
  constexpr std::string_view numbers = "biufO";  // NumPy makes numbers of strings and dates too
  const py::array any = py::array::ensure(object);
  if (any && !object.is_none() && numbers.find(any.dtype().kind()) != std::string_view::npos) {
    Reals values = Reals::ensure(any);
    if (values) return values;
  }
  PyErr_Clear();
  throw py::type_error(name + ": found " + type_of(object) + ", expected an array of numbers");
}

py::array view_of(std::vector<Point> points) {
  const auto held = std::make_shared<const std::vector<Point>>(std::move(points));
  return view(held, held->empty() ? nullptr : &held->front().x, {static_cast<py::ssize_t>(held->size()), 2});
}

std::string type_of(const py::handle& object) {
  return py::str(py::type::handle_of(object).attr("__name__"));
}

// What Class.__new__(Class) makes without __init__ has no value of its class. pybind11 would hand out memory
// that nobody has written; that memory is asked for here.
void refuse_unmade_objects(const py::module_& module) {
  for (const auto& [name, member] : module.attr("__dict__").cast<py::dict>()) {
    if (!PyType_Check(member.ptr())) continue;
    if (auto* const info = py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(member.ptr())))
      info->operator_new = [](std::size_t) -> void* {
        throw Error(ErrorCode::argument, "object", "was made by __new__ alone, expected a call of its class");
      };
  }
}

}  // namespace remodel::python

PYBIND11_MODULE(_core, module) {
  using namespace remodel::python;
  module.doc() = "The compiled part of remodel. Import remodel instead.";
  module.attr("__version__") = REMODEL_VERSION;
  add_errors(module);
  add_apart(module);
  add_shapes(module);
  add_snapshots(module);
  add_meshes(module);
  add_steps(module);
  add_transfers(module);
  add_derivatives(module);
  add_displacements(module);
  add_layers(module);
  add_flows(module);
  add_potential_flows(module);
  add_polars(module);
  add_designers(module);
  add_noise(module);
  add_optimise(module);
  add_designs(module);
  add_sweeps(module);
  refuse_unmade_objects(module);
}
