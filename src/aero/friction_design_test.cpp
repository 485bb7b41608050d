// Designs with friction: gradients of all functions of flows against differences of whole flows, layers,
// targets.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "aero/design_mesh.h"
#include "aero/layered_space.h"
#include "aero/section_space.h"
#include "aero/test_designs.h"
#include "remodel/error.h"

namespace remodel {
namespace {

using test::Case;
using test::relative;

CstAirfoil section_with_friction(const std::string& name, int degree = 3) {
  return raise_degree(named_airfoil(name, degree), degree);
}

DesignProblem viscous_problem() {
  DesignProblem problem{.airfoil = section_with_friction("naca0012")};
  problem.domain.points = 150;
  problem.gradation = 2.5;
  problem.layer = LayerOptions{.first_height = 3e-3, .growth = 1.3, .thickness = 0.05};
  problem.points = {
      {.conditions = {.mach = 0.5, .alpha_deg = 1.0, .reynolds = 5000.0}, .model = FlowModel::laminar}};
  return problem;
}

// Of all that a design with friction is made of: pressure and friction, the layer's columns, what lies beyond
// them, and a wake that stays.
TEST(Friction, GradientsAreThoseOfWholeFlowsOnMeshesOfOneReference) {
  DesignProblem problem = viscous_problem();
  problem.wake = WakeLine{.length = 0.5};
  problem.constraints = {{.kind = "lift", .at_least = 0.0},
                         {.kind = "pressure_drag", .at_most = 1.0},
                         {.kind = "friction_drag", .at_most = 1.0},
                         {.kind = "moment", .at_most = 1.0}};
  const Case task(problem);
  const std::vector<double> start = task.space().start();
  const Evaluation evaluation = task.evaluate(start);
  EXPECT_NEAR(evaluation.objective,
              evaluation.outputs.at("cd_pressure") + evaluation.outputs.at("cd_friction"), 1e-12);
  std::vector<FlowResult> flows;  // of the differences, in their order
  LivingFlow living([&] {
    FlowOptions options = design_flow_options(task.space(), problem.points[0]);
    options.tolerance = 1e-11;
    return options;
  }());
  const auto drag = [&](const std::vector<double>& design) {
    const Mesh mesh = task.mesh_of(design);
    flows.push_back(DesignMesh(task.space(), mesh, design).solve(living, problem.points[0].conditions));
    EXPECT_TRUE(flows.back().converged()) << flows.back().reason;
    return flows.back().cd;
  };
  EXPECT_LT(relative(evaluation.gradient, task.differences(drag, 1e-4)), 2e-6);
  const std::vector<double (*)(const FlowResult&)> limited = {
      [](const FlowResult& flow) { return -flow.cl; },
      [](const FlowResult& flow) { return flow.friction->cd_pressure; },
      [](const FlowResult& flow) { return flow.friction->cd_friction; },
      [](const FlowResult& flow) { return flow.cm; }};
  for (std::size_t i = 0; i < limited.size(); ++i) {
    auto next = flows.begin();
    const auto value = [&](const std::vector<double>&) { return limited[i](*next++); };
    EXPECT_LT(relative(evaluation.constraint_gradients.at(i), task.differences(value, 1e-4)), 2e-6) << i;
  }
}

TEST(Friction, StationsAreThoseOfTheStart) {
  const Case task(viscous_problem());
  std::vector<double> design = task.space().start();
  const Domain walls = task.space().walls(design);
  EXPECT_NEAR(static_cast<double>(walls.stations(0).size()), 150.0, 3.0);
  for (double& x : design) x *= 1.2;
  const Domain thicker = task.space().walls(design);
  EXPECT_EQ(thicker.curve(0).parameters, walls.curve(0).parameters);
  EXPECT_NE(thicker.curve(0).shape, walls.curve(0).shape);
  EXPECT_TRUE(task.space().feasible(design));
  for (double& x : design) x *= -1.0;  // the surfaces cross each other
  EXPECT_FALSE(task.space().feasible(design));
}

TEST(Friction, TheWakeIsThatOfTheStart) {
  DesignProblem problem = viscous_problem();
  problem.wake = WakeLine{.length = 0.7, .direction = {1.0, 0.1}};
  const Case task(problem);
  std::vector<double> design = task.space().start();
  const Loop wake = task.space().walls(design).loops.back();
  EXPECT_EQ(wake.curves.at(0).name, "wake");
  EXPECT_NEAR(distance(std::get<Line>(wake.curves[0].shape).from, std::get<Line>(wake.curves[0].shape).to),
              0.7, 1e-12);
  for (double& x : design) x *= 1.2;
  EXPECT_EQ(task.space().walls(design).loops.back(), wake);
  EXPECT_EQ(task.space().domain_with(design, 200).loops.back(), wake);
  EXPECT_EQ(task.space().bodies(design).loops.size() + 1, task.space().walls(design).loops.size());
  const auto again = LayeredSpace::from_description(
      std::make_unique<SectionSpace>(problem.airfoil, SectionSpaceOptions{.domain = problem.domain}),
      task.space().description());
  EXPECT_EQ(again->walls(design), task.space().walls(design));
  problem.points[0].model = FlowModel::euler;
  problem.layer.reset();
  EXPECT_THROW(design_space(problem), Error);
}

// Of a row of designs, as a search has them.
class Row {
 public:
  explicit Row(const Case& task) : task_(task), evaluator_(flow_evaluator(task.problem(), task.space())) {}
  Evaluation operator()(const std::vector<double>& design, bool gradient = false) {
    StepObserver observer;
    const Mesh mesh = task_.mesh_of(design);
    return evaluator_->evaluate({.design = design,
                                 .mesh = mesh,
                                 .step = {},
                                 .before = nullptr,
                                 .gradient = gradient,
                                 .observer = observer},
                                state_);
  }

 private:
  const Case& task_;
  std::unique_ptr<Evaluator> evaluator_;
  std::unique_ptr<EvaluatorState> state_;
};

// All functions of flows, at an angle and, as the second point, at a lift.
std::vector<DesignConstraint> limits_of_all_kinds(std::size_t points) {
  std::vector<DesignConstraint> limits;
  for (std::size_t point = 0; point < points; ++point)
    for (const char* kind : {"drag", "pressure_drag", "friction_drag", "moment", "lift", "suction"})
      if (point == 0 || std::string(kind) != "lift")
        limits.push_back({.kind = kind, .at_most = 1.0, .point = point});
  return limits;
}

struct ModelOfFlow {
  FlowModel model;
  double reynolds;
  std::optional<std::array<double, 2>> transition = {};
};

class FrictionOfAllKinds : public testing::TestWithParam<ModelOfFlow> {};

TEST_P(FrictionOfAllKinds, GradientsAreThoseOfWholeFlows) {
  DesignProblem problem = viscous_problem();
  problem.airfoil = section_with_friction("naca2412", 2);
  const auto& [model, reynolds, transition] = GetParam();
  if (model == FlowModel::sa)
    problem.layer = LayerOptions{.first_height = 2e-4, .growth = 1.4, .thickness = 0.04};
  problem.points = {{.conditions = {.mach = 0.5, .alpha_deg = 1.0}},
                    {.conditions = {.mach = 0.4, .cl = 0.3}}};
  if (transition) problem.points.pop_back();
  for (DesignPoint& point : problem.points) {
    point.model = model;
    point.conditions.reynolds = reynolds, point.conditions.transition = transition;
  }
  problem.objective = "inverse";
  problem.target = section_with_friction("naca0012", 2);
  problem.constraints = limits_of_all_kinds(problem.points.size());
  const Case task(problem);
  const std::vector<double> start = task.space().start();
  Row row(task);
  const Evaluation at = row(start, true);
  EXPECT_GT(at.objective, 1e-4);
  std::vector<Evaluation> others;  // of the differences, in their order
  const auto objective = [&](const std::vector<double>& design) {
    others.push_back(row(design));
    return others.back().objective;
  };
  EXPECT_LT(relative(at.gradient, task.differences(objective, 2e-4)), 5e-6);
  ASSERT_EQ(at.constraints.size(), problem.constraints.size());
  for (std::size_t i = 0; i < at.constraints.size(); ++i) {
    auto next = others.begin();
    const auto value = [&](const std::vector<double>&) { return (next++)->constraints.at(i); };
    EXPECT_LT(relative(at.constraint_gradients.at(i), task.differences(value, 2e-4)), 5e-6)
        << problem.constraints[i].kind << " of point " << *problem.constraints[i].point;
  }
}

INSTANTIATE_TEST_SUITE_P(Models, FrictionOfAllKinds,
                         testing::Values(ModelOfFlow{FlowModel::laminar, 3000.0},
                                         ModelOfFlow{FlowModel::sa, 1e6},
                                         ModelOfFlow{FlowModel::sa, 1e6, {{0.1, 0.15}}}));

// By those of lift and drag, which the test above has.
TEST(Friction, DragOverLiftFollowsBoth) {
  DesignProblem problem = viscous_problem();
  problem.airfoil = section_with_friction("naca2412");
  problem.constraints = {{.kind = "drag", .at_most = 1.0}, {.kind = "lift", .at_most = 1.0}};
  problem.objective = "lift_over_drag";
  const Case task(problem);
  const Evaluation at = task.evaluate(task.space().start());
  const double cd = at.outputs.at("cd"), cl = at.outputs.at("cl");
  EXPECT_NEAR(at.objective, cd / cl, 1e-12);
  for (std::size_t i = 0; i < at.gradient.size(); ++i) {
    const double by = at.constraint_gradients[0][i] / cl - cd / (cl * cl) * at.constraint_gradients[1][i];
    EXPECT_NEAR(at.gradient[i], by, 1e-10 * (1.0 + std::fabs(by)));
  }
}

// At the target itself nothing is to be done.
TEST(Friction, InverseDesignHasTheTargetsLayer) {
  DesignProblem problem = viscous_problem();
  problem.objective = "inverse";
  problem.target = problem.airfoil;
  const Case task(problem);
  EXPECT_LT(task.evaluate(task.space().start()).objective, 1e-16);
  CstAirfoil& thin = problem.target.emplace(problem.airfoil);
  for (double& x : thin.upper) x = -x;  // the surfaces are one
  try {
    validate(problem);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("'target' that has no layer"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace remodel
