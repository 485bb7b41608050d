// The problem of examples/design/short.json, written out: a symmetric section at Mach 0.8 whose drag falls
// while its area stays, and a thickness of the user's own that is kept too.
//
//     design_problem DIRECTORY

#include <iostream>

#include "remodel/design_run.h"
#include "remodel/shape_files.h"

using namespace remodel;

// The first coefficient of the upper surface, which the nose follows from, stays above 0.1.
std::vector<DesignValue> nose(const DesignView& of) {
  DesignValue value{.value = 0.1 - of.design[0], .by_design = std::vector<double>(of.design.size(), 0.0)};
  value.by_design[0] = -1.0;
  return {value};
}

struct Printer : OptimiseObserver {
  void evaluated(const EvaluationRecord& record) override {
    std::cout << record.evaluation << ": " << 1e4 * record.objective << " counts\n";
  }
};

int main(int, char** arguments) {
  DesignProblem problem{.airfoil = load_airfoil("naca:0012", 4), .symmetric = true};
  problem.domain.points = 40;
  problem.points = {{.conditions = {.mach = 0.8}}};
  problem.objective = "drag";
  problem.constraints = {{.kind = "area", .of_start = 1.0}, {.own_design = nose, .name = "nose"}};
  problem.evaluations = 60, problem.bounds = 0.2, problem.trust = 0.02;
  problem.verify = {40};

  Printer printer;
  const DesignResult result = run_design(problem, {.directory = arguments[1]}, &printer);
  for (const auto& [name, violation] : result.constraints)
    std::cout << name << " violated by " << violation << '\n';
  std::cout << "from " << 1e4 * *result.start_objective << " to " << 1e4 * result.search.objective
            << " counts, on a fresh mesh " << 1e4 * result.verified.at(0).cd << '\n';
}
