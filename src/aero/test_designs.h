#pragma once

// Design problems evaluated as a search does it, and derivatives by differences, for tests.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "remodel/design_problem.h"
#include "remodel/generate.h"
#include "remodel/living_mesh.h"
#include "remodel/remodel.h"

namespace remodel::test {

inline Mesh mesh_of_start(const DesignProblem& problem, const FlowSpace& space) {
  QualityOptions quality{.gradation = problem.gradation.value_or(problem.domain.points / 50.0)};
  quality.refine_angle_deg = angle_with_slack(quality, design_slack_deg);
  return generate(space.domain(space.start()), quality).mesh;
}

// Central differences of fourth order by each number of the design.
inline std::vector<double> differences(const std::vector<double>& about,
                                       const std::function<double(const std::vector<double>&)>& f, double h) {
  std::vector<double> result;
  for (std::size_t i = 0; i < about.size(); ++i) {
    const auto at = [&](double s) {
      std::vector<double> design = about;
      design[i] += s;
      return f(design);
    };
    result.push_back((at(-2 * h) - 8 * at(-h) + 8 * at(h) - at(2 * h)) / (12 * h));
  }
  return result;
}

// One evaluation of a design, on a mesh of its own.
class Case {
 public:
  explicit Case(const DesignProblem& problem)
      : problem_(problem), space_(design_space(problem)), mesh_(mesh_of_start(problem, *space_)) {}

  const DesignProblem& problem() const { return problem_; }
  const FlowSpace& space() const { return *space_; }
  const Mesh& mesh() const { return mesh_; }
  // As a search has it: a morph of the start's mesh.
  Mesh mesh_of(const std::vector<double>& design) const {
    Mesh mesh = mesh_;
    const RemodelResult step =
        remodel(mesh, space_->domain(design), {.strategy = info_of(design_strategy).step});
    EXPECT_TRUE(step.held);
    return mesh;
  }
  Evaluation evaluate(const std::vector<double>& design, std::size_t threads = 1) const {
    StepObserver observer;
    const Mesh mesh = mesh_of(design);
    std::unique_ptr<EvaluatorState> state;
    return flow_evaluator(problem_, *space_, threads)
        ->evaluate({.design = design,
                    .mesh = mesh,
                    .step = {},
                    .before = nullptr,
                    .gradient = true,
                    .observer = observer},
                   state);
  }
  // At the start, or about another design.
  std::vector<double> differences(const std::function<double(const std::vector<double>&)>& f, double h,
                                  const std::vector<double>& about = {}) const {
    return test::differences(about.empty() ? space_->start() : about, f, h);
  }

 private:
  DesignProblem problem_;
  std::unique_ptr<FlowSpace> space_;
  Mesh mesh_;
};

// |a - b| / |b|
inline double relative(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double wrong = 0.0, size = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i)
    wrong += (a.at(i) - b[i]) * (a.at(i) - b[i]), size += b[i] * b[i];
  return std::sqrt(wrong / size);
}

// Flows of a case's designs, one after the other, with the mesh's connectivity.
class Flows {
 public:
  explicit Flows(const Case& task) : task_(task), living_(accurate(task)) {}
  FlowResult operator()(const std::vector<double>& design) {
    FlowResult result = living_.solve(task_.mesh_of(design), task_.problem().points[0].conditions);
    EXPECT_TRUE(result.converged()) << result.reason;
    return result;
  }
  FlowGradients gradients() { return living_.gradients(); }  // of the last one

 private:
  static FlowOptions accurate(const Case& task) {
    FlowOptions options = design_flow_options(task.space(), task.problem().points[0]);
    options.tolerance = 1e-12;
    return options;
  }

  const Case& task_;
  LivingFlow living_;
};

}  // namespace remodel::test
