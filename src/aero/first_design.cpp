#include "aero/first_design.h"

#include <algorithm>
#include <cmath>

#include "remodel/design_run.h"
#include "remodel/mesh_derivative.h"

namespace remodel {
namespace {

// The numbers of a design's shape, whatever its stations are and however far the far field is.
std::vector<double> shape_numbers(const FlowSpace& space, std::span<const double> design) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < space.sections(); ++i) {
    const CstAirfoil section = space.section(design, i);
    numbers.insert(numbers.end(), section.upper.begin(), section.upper.end());
    numbers.insert(numbers.end(), section.lower.begin(), section.lower.end());
    const Placement at = space.placement(design, i);
    for (const double x : {section.e1, section.e2, section.te_upper, section.te_lower, at.chord,
                           at.rotation_deg, at.position.x, at.position.y})
      numbers.push_back(x);
  }
  if (space.sections() != 0) return numbers;
  Domain walls = space.bodies(design);
  std::erase_if(walls.loops, [](const Loop& loop) { return loop.curves.front().name == "farfield"; });
  return coefficients_of(walls);
}

bool is_same_shape(const FlowSpace& a, const FlowSpace& b, std::span<const double> design) {
  constexpr double rounding = 1e-12;
  const std::vector<double> one = shape_numbers(a, design), other = shape_numbers(b, design);
  return std::equal(one.begin(), one.end(), other.begin(), other.end(), [](double x, double y) {
    return std::fabs(x - y) <= rounding * std::max(1.0, std::fabs(x));
  });
}

std::vector<double> design_of(const DesignRun& run, const DesignStart& start, const ProblemPlace& place) {
  if (!start.design) {
    if (!run.has_best())
      place.fail("found a run without a best design (" + run.why_no_design() +
                 "), expected the number of a design");
    return run.best_design();
  }
  for (const EvaluationRecord& row : run.rows)
    if (row.evaluation == *start.design) return row.coefficients;
  place.fail("found no design " + std::to_string(*start.design) + ", expected 1 to " +
             std::to_string(run.rows.back().evaluation));
}

}  // namespace

std::vector<double> first_design_of(const DesignProblem& problem, const FlowSpace& space,
                                    const ProblemPlace& problem_place) {
  const std::size_t numbers = space.start().size();
  const ProblemPlace place =
      problem_place.inner(problem.start ? "start (" + problem.start->history.string() + ")" : "start");
  if (!problem.start && problem.first_design.empty()) return space.start();
  std::vector<double> design = problem.first_design;
  if (problem.start) {
    const std::filesystem::path& given = problem.start->history;
    const DesignRun run = [&] {
      try {
        return read_design_run(given.filename() == "history.sqlite" ? given.parent_path() : given);
      } catch (const Error& error) {
        place.fail(error.what());
      }
    }();
    design = design_of(run, *problem.start, place);
    if (design.size() == numbers && !is_same_shape(space, *run.space, design))
      place.fail(
          "found a design that is another shape by the variables of this problem, expected a run with " +
          std::string("the same variables"));
  }
  if (design.size() != numbers)
    place.fail("found a design of " + std::to_string(design.size()) + " numbers, expected " +
               std::to_string(numbers) + ", as many as this problem has variables");
  if (!space.feasible(design))
    place.fail("found a design that this problem does not allow, expected another");
  return design;
}

}  // namespace remodel
