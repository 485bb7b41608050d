#pragma once

// An objective of Python's as the evaluator of a run.

#include "living.h"
#include "remodel/evaluator.h"
#include "run_watch.h"

namespace remodel::python {

// An objective in Python: evaluate(design, mesh, step) -> number, or a dict with what Evaluation has.
class PythonEvaluator final : public Evaluator {
 public:
  // Needs the GIL.
  PythonEvaluator(py::object evaluate, Watch& watch) : evaluate_(std::move(evaluate)), watch_(watch) {
    const py::dict description("evaluator"_a = "python", "function"_a = evaluate_.attr("__name__"));
    description_ = py::module_::import("json").attr("dumps")(description).cast<std::string>();
  }

  Evaluation evaluate(const EvaluationTask& task, std::unique_ptr<EvaluatorState>&) override {
    auto mesh = std::make_shared<FrozenMesh>(task.freeze());
    const std::vector<double> design(task.design.begin(), task.design.end());
    try {
      return watch_.ask([&] {
        return evaluation_of(
            evaluate_(copied(design), std::move(mesh), figures_dict(mesh_step_figures, task.step)));
      });
    } catch (...) {
      task.observer.cancelled();  // what ends the run is no failure of the design
      throw;
    }
  }
  std::string description() const override { return description_; }

 private:
  static Evaluation evaluation_of(const py::object& answer) {
    Evaluation result;
    if (!py::isinstance<py::dict>(answer)) {
      result.objective = py::float_(answer).cast<double>();
      return result;
    }
    for (const auto& [key, value] : answer.cast<py::dict>()) {
      const auto name = key.cast<std::string>();
      if (name == "objective")
        result.objective = value.cast<double>();
      else if (name == "constraints")
        result.constraints = value.cast<std::vector<double>>();
      else if (name == "outputs")
        result.outputs = value.cast<std::map<std::string, double>>();
      else
        throw Error(ErrorCode::argument, "objective",
                    "returned the key '" + name + "', expected objective, constraints or outputs");
    }
    return result;
  }

  py::object evaluate_;
  Watch& watch_;
  std::string description_;  // with the function's name, which is all that a run knows it by
};

}  // namespace remodel::python
