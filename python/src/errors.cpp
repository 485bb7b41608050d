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

void raise(const Error& error, const char* name) {
  try {
    const py::object type = py::module_::import("remodel._errors").attr(name);
    PyErr_SetObject(type.ptr(),
                    type(py::str(PyUnicode_DecodeUTF8(
                             error.what(), static_cast<py::ssize_t>(std::strlen(error.what())), "replace")))
                        .ptr());
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
      PyErr_SetString(PyExc_TypeError, "found an object of another type, expected one that help() names");
    }
  });
}

}  // namespace remodel::python
