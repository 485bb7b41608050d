#include "design/judge.h"

#include <cmath>
#include <exception>
#include <stdexcept>
#include <string>

#include "design/run_mesh.h"

namespace remodel {
namespace {

// Remembers whether the evaluation has been told that the run is cancelled.
class RememberingObserver final : public StepObserver {
 public:
  explicit RememberingObserver(StepObserver& asked) : asked_(asked) {}
  bool cancelled() override { return told_ = told_ || asked_.cancelled(); }
  bool told() const { return told_; }

 private:
  StepObserver& asked_;
  bool told_ = false;
};

std::string found_expected(const char* what, std::size_t found, std::size_t expected) {
  return std::string("found ") + std::to_string(found) + " " + what + ", expected " +
         std::to_string(expected);
}

void require_good(const Evaluation& evaluation, std::size_t dimension) {
  const auto require_finite = [](double value, const std::string& what) {
    if (!std::isfinite(value)) throw std::runtime_error("found " + what + " that is not finite");
  };
  require_finite(evaluation.objective, "an objective");
  for (const double constraint : evaluation.constraints) require_finite(constraint, "a constraint");
  for (const auto& [name, value] : evaluation.outputs) require_finite(value, "an output '" + name + "'");
  const auto require_gradient = [&](const std::vector<double>& gradient) {
    if (!gradient.empty() && gradient.size() != dimension)
      throw std::runtime_error(found_expected("derivatives", gradient.size(), dimension));
  };
  require_gradient(evaluation.gradient);
  for (const std::vector<double>& gradient : evaluation.constraint_gradients) require_gradient(gradient);
  if (const std::size_t rows = evaluation.constraint_gradients.size();
      rows != 0 && rows != evaluation.constraints.size())
    throw std::runtime_error(found_expected("gradients of constraints", rows, evaluation.constraints.size()));
}

void record(const Evaluation& evaluation, EvaluationRecord& row) {
  row.objective = evaluation.objective;
  row.constraints = evaluation.constraints;
  row.outputs = evaluation.outputs;
}

}  // namespace

Stopped judge(const Evaluating& evaluating, const LivingMesh& living, std::unique_ptr<EvaluatorState>& state,
              Job& job) {
  RememberingObserver observer(evaluating.observer);
  const Proposal& proposal = job.proposal;
  std::string problem;
  try {
    EvaluationTask task{proposal.design,       living.mesh(),     job.record,
                        living.before(),       proposal.gradient, observer,
                        job.record.evaluation, proposal.from};
    if (evaluating.space.layers() != nullptr)
      task.with_layers = [&] { return with_layers(evaluating.space, living.mesh(), proposal.design); };
    job.evaluation = evaluating.evaluator.evaluate(task, state);
    require_good(job.evaluation, proposal.design.size());
    record(job.evaluation, job.record);
    return Stopped::done;
  } catch (const std::exception& thrown) {
    problem = thrown.what();
  } catch (...) {
    problem = "an exception that is no std::exception";
  }
  state.reset();
  if (observer.told()) return Stopped::interrupted;
  fail(job, "evaluation failed: " + problem);
  return Stopped::done;
}

void fail(Job& job, const std::string& reason) {
  job.evaluation = {};
  record(job.evaluation, job.record);
  std::string& detail = job.record.detail;
  detail += (detail.empty() ? "" : "; ") + reason;
}

}  // namespace remodel
