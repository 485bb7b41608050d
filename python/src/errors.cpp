// The library's Error becomes one of the exceptions of python/remodel/_errors.py.

#include "bindings.h"
#include "interrupts.h"
#include "remodel/io.h"
#include "remodel/mesh_derivative.h"

namespace remodel::python {
namespace {

const char* exception_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::argument:
      return "ArgumentError";
    case ErrorCode::file:
      return "FileError";
    case ErrorCode::format:
      return "FormatError";
    case ErrorCode::geometry:
      return "GeometryError";
  }
  return "Error";
}

// Options have their units in their names in C++, and none in Python, where some are called otherwise too.
std::string text_of(const Error& error) {
  static constexpr std::pair<const char*, const char*> renamed[] = {
      {"CST degree", "degree"},
      {"CMA-ES sigma", "sigma0"},
      {"CMA-ES population", "popsize"},
      {"CMA-ES start", "x0"},
      {"CMA-ES sample", "solutions"},
      {"derivatives by points", "by_points"},
      {"first layer height", "first_height"},
      {"layer thickness", "thickness"},
      {"Reynolds number", "reynolds"},
      {"wall temperature", "wall_temperature"},
      {"reference length", "reference_length"},
      {"max steps", "max_steps"},
      {"memory", "memory_mb"},
      {"total pressure", "inlets, total pressure"},
      {"total temperature", "inlets, total temperature"},
      {"pressure", "outlets, pressure"}};
  const std::string text = error.what();
  const std::size_t end = text.find(": ");
  if (error.code() != ErrorCode::argument || end == std::string::npos) return text;
  std::string place = text.substr(0, end);
  for (const auto& [from, to] : renamed)
    if (place == from) place = to;
  constexpr std::string_view unit = "_deg";
  if (place.ends_with(unit)) place.resize(place.size() - unit.size());
  return place + text.substr(end);
}

void raise(const Error& error, const char* name) {
  try {
    const py::object type = py::module_::import("remodel._errors").attr(name);
    const std::string text = text_of(error);
    const auto decoded = py::reinterpret_steal<py::object>(
        PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace"));
    PyErr_SetObject(type.ptr(), type(decoded).ptr());
  } catch (py::error_already_set& other) {
    other.restore();
  }
}

}  // namespace

void ThreadLock::acquire() {
  if (!mutex_.try_lock()) {
    if (owner_.load() == std::this_thread::get_id())
      throw Error(ErrorCode::argument, "mesh",
                  "used by a signal handler, expected the call it interrupts to end first");
    bool locked = false;
    while (!locked) {
      if (process_.load() != getpid())
        throw Error(ErrorCode::argument, "mesh",
                    "was in use by another thread when the process was forked, expected it to be idle");
      py::gil_scoped_release released;
      locked = mutex_.try_lock_for(std::chrono::milliseconds(20));
      if (!locked) {
        py::gil_scoped_acquire gil;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      }
    }
  }
  owner_ = std::this_thread::get_id();
  process_ = getpid();
}

void add_errors(py::module_&) {
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const TopologyChanged& error) {
      raise(error, "TopologyChanged");
    } catch (const Error& error) {
      raise(error, exception_of(error.code()));
    } catch (const std::filesystem::filesystem_error& error) {
      raise(file_error(error), "FileError");
    } catch (const py::cast_error&) {
      raise(Error(ErrorCode::argument, "object", "found one of another type, expected one that help() names"),
            "ArgumentTypeError");
    }
  });
}

}  // namespace remodel::python
