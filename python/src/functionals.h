#pragma once

// Derivatives of a function by a flow, as Python gives them: arrays by the names of fields.

#include "bindings.h"
#include "remodel/flow.h"

namespace remodel::python {

inline std::string shape_of(const py::array& array) {
  return py::str(array.attr("shape")).cast<std::string>();
}

inline std::vector<double> numbers_of(const py::handle& values, const std::string& name, std::size_t size) {
  const Reals array = array_of(values, name);
  if (array.ndim() != 1 || static_cast<std::size_t>(array.size()) != size)
    throw Error(ErrorCode::argument, name,
                "found an array of shape " + shape_of(array) + ", expected (" + std::to_string(size) + ",)");
  return {array.data(), array.data() + array.size()};
}

inline FlowFunctional zero_functional(std::size_t size) {
  return {.pressure = std::vector<double>(size, 0.0), .points = std::vector<Point>(size)};
}

// Derivatives by one of the flow's fields, by points or by the Mach number, at fixed others. False where the
// key is none of these.
inline bool add_field(FlowFunctional& by, const std::string& key, const std::string& place,
                      const py::handle& values, std::size_t size) {
  if (key == "points") {
    by.points = points(array_of(values, place), place);
    if (by.points.size() != size)
      throw Error(ErrorCode::argument, place,
                  "found " + std::to_string(by.points.size()) + " rows, expected " + std::to_string(size));
  } else if (key == "mach") {
    by.mach = values.cast<double>();
  } else if (key == "pressure") {
    by.pressure = numbers_of(values, place, size);
  } else if (key == "density") {
    by.density = numbers_of(values, place, size);
  } else if (key == "velocity_x") {
    by.velocity_x = numbers_of(values, place, size);
  } else if (key == "velocity_y") {
    by.velocity_y = numbers_of(values, place, size);
  } else {
    return false;
  }
  return true;
}

}  // namespace remodel::python
