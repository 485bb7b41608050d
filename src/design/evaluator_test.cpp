// Evaluations as the loop sees them: whatever an evaluator does, one evaluation comes of it.

#include "remodel/evaluator.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>

#include "design/airfoil_space.h"
#include "design/judge.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/shape_files.h"

namespace remodel {
namespace {

struct Fixed : Evaluator {
  explicit Fixed(std::function<Evaluation(const EvaluationTask&)> what) : evaluation(std::move(what)) {}
  Evaluation evaluate(const EvaluationTask& task, std::unique_ptr<EvaluatorState>& state) override {
    state = std::make_unique<EvaluatorState>();
    return evaluation(task);
  }
  std::string description() const override { return "{}"; }
  std::function<Evaluation(const EvaluationTask&)> evaluation;
};

struct Cancelled : StepObserver {
  explicit Cancelled(bool answer) : yes(answer) {}
  bool cancelled() override { return yes; }
  bool yes;
};

class Judged : public testing::Test {
 protected:
  Stopped judged(Evaluator& evaluator, bool cancelled = false) {
    Cancelled observer(cancelled);
    const OptimiseOptions options;
    job_ = Job{.proposal = {.design = space_.start(), .gradient = true}};
    return judge({space_, evaluator, options, 1, observer}, living_, state_, job_);
  }
  Stopped judged(std::function<Evaluation(const EvaluationTask&)> evaluation, bool cancelled = false) {
    Fixed evaluator(std::move(evaluation));
    return judged(evaluator, cancelled);
  }
  void expect_failure(const std::string& why) const {
    EXPECT_TRUE(std::isinf(job_.record.objective));
    EXPECT_TRUE(std::isinf(job_.evaluation.objective));
    EXPECT_NE(job_.record.detail.find(why), std::string::npos) << job_.record.detail;
    EXPECT_FALSE(state_);
  }
  // By a program of a shell's.
  Stopped run(const std::string& script, bool cancelled = false) {
    return judged(*command_evaluator({"/bin/sh", "-c", script, "shell"}), cancelled);
  }

  AirfoilSpace space_{load_airfoil("naca:0012", 3), {.points = 50}};
  LivingMesh living_{OptimiseOptions(), space_,
                     generate(space_.domain(space_.start()), {.gradation = 1.0}).mesh, space_.start()};
  std::unique_ptr<EvaluatorState> state_;
  Job job_;
};

TEST_F(Judged, EvaluationsGoIntoTheRow) {
  EXPECT_EQ(judged([&](const EvaluationTask& task) {
              EXPECT_EQ(&task.mesh, &living_.mesh());
              EXPECT_FALSE(task.before);
              EXPECT_TRUE(task.gradient);
              return Evaluation{.objective = 3.0, .constraints = {-1.0, 0.5}, .outputs = {{"cl", 0.5}}};
            }),
            Stopped::done);
  EXPECT_EQ(job_.record.objective, 3.0);
  EXPECT_EQ(job_.record.constraints, (std::vector{-1.0, 0.5}));
  EXPECT_EQ(job_.record.outputs.at("cl"), 0.5);
  EXPECT_TRUE(state_);
}

TEST_F(Judged, WhatIsNoEvaluationFailsWithAMessageAndLosesItsState) {
  judged([](const EvaluationTask&) -> Evaluation { throw std::runtime_error("diverged"); });
  expect_failure("diverged");
  judged([](const EvaluationTask&) -> Evaluation { throw 1; });
  expect_failure("no std::exception");
  judged([](const EvaluationTask&) { return Evaluation{.objective = std::nan("")}; });
  expect_failure("not finite");
  judged([](const EvaluationTask&) { return Evaluation{.objective = 1.0, .constraints = {std::nan("")}}; });
  expect_failure("constraint");
  judged([](const EvaluationTask&) { return Evaluation{.objective = 1.0, .gradient = {1.0}}; });
  expect_failure("found 1 derivatives, expected 8");
}

TEST_F(Judged, IsInterruptedOnlyWhereTheEvaluationWasTold) {
  const auto asks = [](const EvaluationTask& task) -> Evaluation {
    if (task.observer.cancelled()) throw std::runtime_error("told");
    return {.objective = 1.0};
  };
  EXPECT_EQ(judged(asks, true), Stopped::interrupted);
  EXPECT_EQ(judged(asks, false), Stopped::done);
  EXPECT_EQ(judged([](const EvaluationTask&) -> Evaluation { throw std::runtime_error("own"); }, true),
            Stopped::done);
  expect_failure("own");
}

TEST_F(Judged, CommandsReadTheMeshAndTheDesign) {
  EXPECT_EQ(run(R"(triangles=$(sed -n 's/NELEM= *//p' "$1")
                   printf '{"objective": %d, "outputs": {"parameters": %d}}' $triangles $(tr -cd , < "$2" | wc -c))"),
            Stopped::done);
  EXPECT_EQ(job_.record.objective, static_cast<double>(living_.mesh().triangle_count()))
      << job_.record.detail;
  EXPECT_EQ(job_.record.outputs.at("parameters"), 7.0);
}

TEST_F(Judged, CommandsThatFailSayWhy) {
  run("echo no licence >&2; exit 3");
  expect_failure("ended with status 3: no licence");
  run("kill -9 $$");
  expect_failure("ended by signal 9");
  run("echo 1.5");
  expect_failure("expected one JSON object");
  run("echo '{\"objective\": null}'");
  expect_failure("expected one JSON object");
  judged(*command_evaluator({"/nowhere/program"}));
  expect_failure("/nowhere/program: cannot be started");
  EXPECT_THROW(command_evaluator({}), Error);
}

TEST_F(Judged, CommandsEndWithACancelledRun) {
  EXPECT_EQ(run("sleep 1000", true), Stopped::interrupted);
}

// A zombie counts as ended: whoever has to wait for it may take its time.
bool runs(long process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string id, name, state;
  return file >> id >> name >> state && state != "Z" && state != "X";
}

TEST_F(Judged, WhatACommandLeavesBehindEndsWithIt) {
  EXPECT_EQ(run(R"(sleep 1000 > /dev/null & printf '{"objective": %d}' $!)"), Stopped::done);
  const auto left = static_cast<long>(job_.record.objective);
  for (int i = 0; i < 1000 && runs(left); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_FALSE(runs(left)) << left;
}

TEST(Violation, IsTheLargestAndNothingWhereAllAreSatisfied) {
  EXPECT_EQ(violation_of({}), 0.0);
  EXPECT_EQ(violation_of({-1.0, 0.0}), 0.0);
  EXPECT_EQ(violation_of({-1.0, 0.5, 0.25}), 0.5);
  EXPECT_TRUE(std::isinf(violation_of({std::nan(""), -1.0})));
}

}  // namespace
}  // namespace remodel
