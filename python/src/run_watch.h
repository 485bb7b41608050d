#pragma once

// What runs of optimise() and design() share: figures as dicts, and what a run asks Python now and then.

#include <type_traits>

#include "bindings.h"
#include "interrupts.h"
#include "remodel/history.h"
#include "remodel/optimise.h"

namespace remodel::python {

template <class T>
py::object object_of(const T& value) {
  if constexpr (std::is_enum_v<T>)
    return py::str(name_of(value));
  else
    return py::cast(value);
}

template <class List, class Record>
py::dict figures_dict(const List& figures, const Record& record) {
  py::dict result;
  for_each_figure(figures, record,
                  [&](const auto& figure, const auto& value) { result[figure.name] = object_of(value); });
  return result;
}

inline py::list rows_of(const std::filesystem::path& file) {
  py::list rows;
  History::open(file).each(
      [&](const EvaluationRecord& record) { rows.append(figures_dict(evaluation_figures, record)); });
  return rows;
}

// What EvaluationFailed says, raised by a function of Python's.
class DesignFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Whether Ctrl-C was pressed, or a function or the callback raised.
class Watch final : public OptimiseObserver {
 public:
  explicit Watch(py::object callback) : callback_(std::move(callback)) {}
  void evaluated(const EvaluationRecord& record) override {
    callback_.tell([&] { return figures_dict(evaluation_figures, record); }, interrupts);
  }
  bool cancelled() override { return callback_.ended() || interrupts.cancelled(); }

  // Calls a function of Python's for the run, and answers for what it raises: EvaluationFailed is the failure
  // of one design; every other exception ends the run, and is the caller's. Takes the GIL.
  template <class Call>
  auto ask(Call&& call) {
    py::gil_scoped_acquire gil;
    try {
      return call();
    } catch (py::error_already_set& error) {
      fail(std::move(error));
    } catch (py::builtin_exception& error) {
      error.set_error();
      fail(py::error_already_set());
    } catch (const Error& error) {
      PyErr_SetString(py::module_::import("remodel._errors").attr("ArgumentError").ptr(), error.what());
      fail(py::error_already_set());
    }
  }

  // Runs what asks functions before there is a design that could fail. What a function raised is raised as it
  // was, whatever has become of it on the way. Needs the GIL.
  template <class Work>
  auto raising(Work&& work) {
    try {
      return work();
    } catch (const DesignFailed& error) {
      interrupts.rethrow();
      PyErr_SetString(evaluation_failed().ptr(), error.what());
      throw py::error_already_set();
    } catch (const std::exception&) {
      interrupts.rethrow();
      throw;
    }
  }

  Interrupts interrupts;

 private:
  static py::object evaluation_failed() {
    return py::module_::import("remodel._errors").attr("EvaluationFailed");
  }
  [[noreturn]] void fail(py::error_already_set error) {
    if (error.matches(evaluation_failed()))
      throw DesignFailed(py::str(error.value()).attr("encode")("utf-8", "replace").cast<std::string>());
    const std::string message = error.what();
    interrupts.keep(std::move(error));
    throw std::runtime_error(message);
  }

  Callback callback_;
};

}  // namespace remodel::python
