// Runs of designers and evaluators that are not the paper's.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <set>
#include <stdexcept>

#include "design/checkpoint.h"
#include "design/test_runs.h"
#include "remodel/error.h"

namespace remodel {
namespace {

namespace fs = std::filesystem;

// Ellipses in a box: two half axes.
class Ellipses : public DesignSpace {
 public:
  std::vector<double> start() const override { return {0.3, 0.3}; }
  Domain domain(std::span<const double> design) const override {
    constexpr int points = 40;
    Polyline ellipse;
    for (int i = 0; i <= points; ++i) {
      const double angle = 2.0 * std::acos(-1.0) * (i % points) / points;
      ellipse.points.push_back({design[0] * std::cos(angle), design[1] * std::sin(angle)});
    }
    Polyline box{{{-2, -2}, {2, -2}, {2, 2}, {-2, 2}, {-2, -2}}};
    return {{{LoopRole::outer, {{"box", box, Parameters::uniform(32)}}},
             {LoopRole::hole, {{"body", ellipse, Parameters::uniform(points)}}}}};
  }
  bool feasible(std::span<const double> design) const override {
    return design[0] > 0.05 && design[1] > 0.05 && DesignSpace::feasible(design);
  }
  std::string description() const override { return R"({"space": "ellipses"})"; }
};

// The area of the body is to be 1 and, as a constraint, the body at least twice as long as it is high.
Evaluation area_of(const EvaluationTask& task) {
  const double area = std::acos(-1.0) * task.design[0] * task.design[1];
  return {.objective = (area - 1.0) * (area - 1.0),
          .constraints = {2.0 * task.design[1] - task.design[0]},
          .outputs = {{"area", area}}};
}

// Keeps the number of designs that its mesh has had.
struct Counting : Evaluator {
  struct State : EvaluatorState {
    std::string bytes() const override { return std::string("\0count", 6) + std::to_string(count); }
    int count = 0;
  };
  Evaluation evaluate(const EvaluationTask& task, std::unique_ptr<EvaluatorState>& state) override {
    if (!state) state = std::make_unique<State>();
    Evaluation evaluation = area_of(task);
    evaluation.outputs["count"] = ++dynamic_cast<State&>(*state).count;
    evaluation.outputs["same"] =
        task.before != nullptr && task.mesh.changes_since(*task.before).same_connectivity();
    return evaluation;
  }
  std::unique_ptr<EvaluatorState> restore(const std::string& bytes, const Mesh&,
                                          const std::string&) override {
    auto state = std::make_unique<State>();
    state->count = std::stoi(bytes.substr(6));
    return state;
  }
  std::string description() const override { return R"({"evaluator": "counting"})"; }
};

// Throws at every third design.
struct Moody : Evaluator {
  Evaluation evaluate(const EvaluationTask& task, std::unique_ptr<EvaluatorState>&) override {
    if (std::fmod(std::abs(task.design[0]) * 1e6, 3.0) < 1.0) throw std::runtime_error("no solution");
    return area_of(task);
  }
  std::string description() const override { return R"({"evaluator": "moody"})"; }
};

// Steepest descent with steps that are halved until they pay.
class Descent : public Designer {
 public:
  explicit Descent(std::vector<double> start) : at_(std::move(start)) {}
  std::size_t population() const override { return 1; }
  Proposal ask() override { return {.design = trial(), .gradient = true}; }
  void refuse(const Proposal&) override { step_ /= 2.0; }
  void tell(const Proposal& proposal, const Evaluation& evaluation) override {
    ++told_;
    if (!gradient_.empty() && evaluation.objective >= value_) return void(step_ /= 2.0);
    at_ = proposal.design;
    value_ = evaluation.objective;
    gradient_ = evaluation.gradient;
    step_ *= 1.5;
  }
  bool finished() const override { return value_ < 1e-12; }
  std::uint64_t generation() const override { return told_; }
  std::string state() const override { return std::to_string(told_); }
  void restore(const std::string&, const std::string& source) override {
    throw Error(ErrorCode::format, source, "cannot be restored");
  }
  std::string description() const override { return R"({"designer": "descent"})"; }

 private:
  std::vector<double> trial() const {
    std::vector<double> design = at_;
    for (std::size_t i = 0; i < gradient_.size(); ++i) design[i] -= step_ * gradient_[i];
    return design;
  }
  std::vector<double> at_, gradient_;
  double value_ = Evaluation::failed, step_ = 1.0;
  std::uint64_t told_ = 0;
};

class DesignLoop : public OptimiseRun {
 protected:
  OptimiseOptions small(const std::string& name, std::size_t evaluations = 60) const {
    OptimiseOptions result = options(name, evaluations);
    result.compare_every = 0;
    return result;
  }
  OptimiseResult run(Evaluator& evaluator, const OptimiseOptions& options,
                     OptimiseObserver* observer = nullptr) {
    CmaesDesigner designer(space_.start(), {.sigma = 0.1, .seed = 7});
    return optimise(space_, designer, evaluator, options, observer);
  }
  std::vector<EvaluationRecord> rows(const OptimiseOptions& options) const {
    return History::open(options.directory / "history.sqlite").records();
  }
  Ellipses space_;
};

TEST_F(DesignLoop, FindsTheBestDesignWithinTheConstraints) {
  Counting evaluator;
  const OptimiseResult result = run(evaluator, small("run", 400));
  EXPECT_EQ(result.stopped, OptimiseStopped::done);
  EXPECT_EQ(result.invalid_meshes, 0U) << result.detail;
  EXPECT_LT(result.objective, 1e-4);
  EXPECT_NEAR(result.outputs.at("area"), 1.0, 0.01);
  EXPECT_LE(2.0 * result.best_design[1], result.best_design[0]);
  EXPECT_EQ(read_text(root_ / "run" / "best.json"), space_.text(result.best_design));
  bool violated = false, replaced = false;
  double best = Evaluation::failed;
  for (const EvaluationRecord& row : rows(small("run"))) {
    violated |= violation_of(row.constraints) > 0.0;
    if (violation_of(row.constraints) == 0.0) best = std::min(best, row.objective);
    EXPECT_EQ(row.best_objective, best);
    EXPECT_EQ(row.outputs.at("count"), static_cast<double>(row.evaluation));  // one mesh, one state
    EXPECT_GE(row.outputs.at("same"), row.full_adjustment ? 1.0 : 0.0);
    replaced |= row.outputs.at("same") == 0.0;
  }
  EXPECT_TRUE(violated);
  EXPECT_TRUE(replaced);
  EXPECT_EQ(result.objective, best);
}

TEST_F(DesignLoop, TakesDesignsThatViolateConstraintsByTheToleranceAtMost) {
  Counting evaluator;
  OptimiseOptions given = small("run", 100);
  given.constraint_tolerance = 0.2;
  const OptimiseResult result = run(evaluator, given);
  double best = Evaluation::failed;
  bool violated = false;  // by a design that was the best one
  for (const EvaluationRecord& row : rows(given)) {
    if (violation_of(row.constraints) <= 0.2 && row.objective < best) {
      best = row.objective;
      violated |= violation_of(row.constraints) > 0.0;
    }
    EXPECT_EQ(row.best_objective, best);
  }
  EXPECT_EQ(result.objective, best);
  EXPECT_TRUE(violated);
}

TEST_F(DesignLoop, KeepsEvaluatorStatesInItsCheckpoints) {
  for (const std::size_t workers : {1, 3}) {
    const std::string name = std::to_string(workers);
    OptimiseOptions whole = small(name + "-whole"), parts = small(name + "-parts");
    whole.workers = parts.workers = workers;
    Counting evaluator;
    run(evaluator, whole);
    for (const std::uint64_t stop : {7, 26, 40}) {
      StopAfter observer(stop, stop == 26 ? StopAfter::How::kill : StopAfter::How::cancel);
      if (stop == 26)
        EXPECT_THROW(run(evaluator, parts, &observer), std::runtime_error);
      else
        run(evaluator, parts, &observer);
      parts.resume = true;
    }
    EXPECT_EQ(run(evaluator, parts).stopped, OptimiseStopped::done);
    expect_same_runs(whole.directory, parts.directory);
    const auto a = rows(whole), b = rows(parts);
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].outputs, b[i].outputs) << "row " << i;
  }
  for (const char set : {'a', 'b'})
    fs::resize_file(root_ / "3-parts" / (std::string("checkpoint-") + set + "-2.state"), 3);
  OptimiseOptions damaged = small("3-parts");
  damaged.workers = 3;
  damaged.resume = true;
  Counting evaluator;
  EXPECT_THROW(run(evaluator, damaged), Error);
}

TEST_F(DesignLoop, GoesOnWhereEvaluationsFail) {
  for (const std::size_t workers : {1, 3}) {
    OptimiseOptions given = small("run" + std::to_string(workers), 300);
    given.workers = workers;
    Moody evaluator;
    const OptimiseResult result = run(evaluator, given);
    EXPECT_EQ(result.stopped, OptimiseStopped::done);
    EXPECT_LT(result.objective, 1e-3);
    std::size_t failed = 0;
    for (const EvaluationRecord& row : rows(given)) {
      EXPECT_EQ(std::isinf(row.objective), row.detail == "evaluation failed: no solution") << row.detail;
      failed += std::isinf(row.objective);
    }
    EXPECT_EQ(result.failed_evaluations, failed);
    EXPECT_GT(failed, 30U);
    EXPECT_LT(failed, 200U);
  }
}

// Waits for the run to be cancelled at one of its designs.
struct Waiting : Evaluator {
  Evaluation evaluate(const EvaluationTask& task, std::unique_ptr<EvaluatorState>&) override {
    if (++designs == wait_at) {
      cancel = true;
      while (!task.observer.cancelled()) continue;
      throw std::runtime_error("cancelled");
    }
    return area_of(task);
  }
  std::string description() const override { return R"({"evaluator": "waiting"})"; }
  std::atomic<int> designs = 0;
  int wait_at = 0;
  std::atomic<bool> cancel = false;
};

struct CancelWaiting : OptimiseObserver {
  explicit CancelWaiting(Waiting& e) : evaluator(e) {}
  bool cancelled() override { return evaluator.cancel; }
  Waiting& evaluator;
};

TEST_F(DesignLoop, IsInterruptedInTheMiddleOfAnEvaluationAndGoesOnFromTheCheckpointBefore) {
  Waiting whole;
  run(whole, small("whole"));
  OptimiseOptions parts = small("parts");
  Waiting waiting;
  waiting.wait_at = 37;
  CancelWaiting observer(waiting);
  const OptimiseResult result = run(waiting, parts, &observer);
  EXPECT_EQ(result.stopped, OptimiseStopped::interrupted);
  EXPECT_EQ(result.evaluations, 36U);
  EXPECT_EQ(read_checkpoint(parts.directory).evaluation, 25U);
  parts.resume = true;
  EXPECT_EQ(run(whole, parts).stopped, OptimiseStopped::done);
  expect_same_runs(root_ / "whole", parts.directory);
}

// Sessions of a single design each, of all strategies that have a state of their own: every one gets on.
TEST_F(DesignLoop, LosesNoFinishedEvaluationWhereItIsToKeepThem) {
  for (const MeshStrategy strategy : {MeshStrategy::chain, MeshStrategy::hub, MeshStrategy::regenerate}) {
    const std::string name = info_of(strategy).name;
    OptimiseOptions whole = small(name + "-whole", 12), parts = small(name + "-parts", 12);
    whole.strategy = parts.strategy = strategy;
    whole.workers = parts.workers = 1;
    parts.keep_finished = true;
    Waiting uninterrupted;
    run(uninterrupted, whole);
    for (std::uint64_t done = 1; done < 6; ++done) {
      Waiting waiting;
      waiting.wait_at = 2;
      CancelWaiting observer(waiting);
      EXPECT_EQ(run(waiting, parts, &observer).evaluations, done);
      EXPECT_EQ(rows(parts).size(), done);
      EXPECT_EQ(read_checkpoint(parts.directory).evaluation, done);
      parts.resume = true;
    }
    EXPECT_EQ(run(uninterrupted, parts).stopped, OptimiseStopped::done);
    expect_same_runs(whole.directory, parts.directory);
  }
}

// Waits for the run to be cancelled at a design, and hands in others at once, a failure among them.
struct WaitingAt : Counting {
  Evaluation evaluate(const EvaluationTask& task, std::unique_ptr<EvaluatorState>& state) override {
    if (task.evaluation == wait_at) {
      while (!task.observer.cancelled()) continue;
      throw std::runtime_error("cancelled");
    }
    ++evaluated[task.evaluation];
    if (task.evaluation == 5) throw std::runtime_error("no solution");
    return Counting::evaluate(task, state);
  }
  std::uint64_t wait_at = 0;
  std::array<std::atomic<int>, 64> evaluated{};
};

// Cancels once these designs are finished.
struct CancelAt : OptimiseObserver {
  CancelAt(WaitingAt& given, std::vector<std::uint64_t> wanted)
      : evaluator(given), finished(std::move(wanted)) {}
  bool cancelled() override {
    return std::all_of(finished.begin(), finished.end(),
                       [&](std::uint64_t evaluation) { return evaluator.evaluated[evaluation] > 0; });
  }
  WaitingAt& evaluator;
  std::vector<std::uint64_t> finished;
};

// Three workers with two designs of each generation of six. One of the designs is interrupted when all others
// that do not wait for it are finished: at a generation's begin, behind that, and in the next generation.
TEST_F(DesignLoop, LosesNoFinishedEvaluationOfSeveralWorkers) {
  for (const MeshStrategy strategy : {MeshStrategy::chain, MeshStrategy::hub, MeshStrategy::regenerate}) {
    const std::string name = info_of(strategy).name;
    SCOPED_TRACE(name);
    OptimiseOptions whole = small(name + "-whole", 14), parts = small(name + "-parts", 14);
    whole.strategy = parts.strategy = strategy;
    whole.workers = parts.workers = whole.threads = parts.threads = 3;
    parts.keep_finished = true;
    WaitingAt uninterrupted, evaluator;
    run(uninterrupted, whole);
    const std::vector<EvaluationRecord> of = rows(whole);
    const auto session = [&](std::uint64_t waits, std::uint64_t last) {
      evaluator.wait_at = waits;
      std::vector<std::uint64_t> finished;
      for (std::uint64_t i = 1; i <= last; ++i)
        if (i < waits || of[i - 1].worker != of[waits - 1].worker) finished.push_back(i);
      CancelAt observer(evaluator, finished);
      EXPECT_EQ(run(evaluator, parts, &observer).evaluations, waits - 1);
      EXPECT_EQ(rows(parts).size(), waits - 1);
      EXPECT_EQ(read_checkpoint(parts.directory).evaluation, waits - 1);
      parts.resume = true;
    };
    std::uint64_t second = 6;  // of the worker that has the first design
    while (of[second - 1].worker != of[0].worker) --second;
    ASSERT_GT(second, 1U);
    session(1, 6);
    session(second, 6);
    session(9, 12);
    evaluator.wait_at = 0;
    EXPECT_EQ(run(evaluator, parts).stopped, OptimiseStopped::done);
    for (std::size_t i = 1; i <= 14; ++i) EXPECT_EQ(evaluator.evaluated[i], 1) << i;
    expect_same_runs(whole.directory, parts.directory);
    EXPECT_EQ(of[4].objective, Evaluation::failed);
  }
}

TEST_F(DesignLoop, ServesADesignerThatFollowsGradientsAndEndsByItself) {
  const AirfoilSpace space(load_airfoil("naca:0012", 3), {.points = 50});
  CstAirfoil target = load_airfoil("naca:0012", 3);
  for (double& coefficient : target.upper) coefficient *= 1.2;
  Descent designer(space.start());
  const auto evaluator = interpolation_evaluator(target);
  const OptimiseResult result = optimise(space, designer, *evaluator, small("run", 5000));
  EXPECT_EQ(result.stopped, OptimiseStopped::done);
  EXPECT_LT(result.evaluations, 5000U);
  EXPECT_LT(result.objective, 1e-12);
  EXPECT_GT(result.preserved_percent, 50.0);
  OptimiseOptions in_its_place = small("run", 5000);
  in_its_place.overwrite = true;
  Descent again(space.start());
  EXPECT_EQ(optimise(space, again, *evaluator, in_its_place).evaluations, result.evaluations);
}

// Its last proposal is infeasible, and with that it has ended.
class EndsRefused : public Descent {
 public:
  using Descent::Descent;
  Proposal ask() override { return told_ < 3 ? Descent::ask() : Proposal{.design = {-1.0, -1.0}}; }
  void tell(const Proposal& proposal, const Evaluation& evaluation) override {
    ++told_;
    Descent::tell(proposal, evaluation);
  }
  void refuse(const Proposal&) override { ended_ = true; }
  bool finished() const override { return ended_; }

 private:
  int told_ = 0;
  bool ended_ = false;
};

TEST_F(DesignLoop, IsDoneWhereASearchEndsWithARefusedProposal) {
  Counting evaluator;
  EndsRefused designer(space_.start());
  const OptimiseResult result = optimise(space_, designer, evaluator, small("run"));
  EXPECT_EQ(result.stopped, OptimiseStopped::done);
  EXPECT_EQ(result.evaluations, 3U);
}

TEST_F(DesignLoop, NamesThePartThatAResumedRunHasOtherwise) {
  Counting counting;
  Moody moody;
  OptimiseOptions given = small("run", 10);
  run(counting, given);
  given.resume = true;
  try {
    run(moody, given);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("evaluator"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace remodel
