#pragma once

// Designs of several sections in one farfield: some of the numbers that their domain depends on
// (coefficients_of(Domain)), coefficients of sections and where these lie.

#include <optional>

#include "aero/problem_place.h"
#include "remodel/design_problem.h"
#include "remodel/flow_space.h"

namespace remodel {

// A number of the domain that a design has, divided by `scale`: steps of a search are of one size in all
// numbers of a design. Bounds are in the number's own unit; a coefficient has none of its own.
struct ElementVariable {
  std::string name;        // "flap.rotation_deg"
  std::size_t number = 0;  // of coefficients_of(Domain)
  double scale = 1.0;
  bool is_coefficient = false;
  double low = 0.0, high = 0.0;
};

// Where the numbers of a loop begin among all of the domain's: of its curves, and of its placement (chord,
// rotation_deg, position.x, position.y).
struct LoopNumbers {
  std::size_t curves = 0, placement = 0;
};
LoopNumbers numbers_of_loop(const Domain& domain, std::size_t loop);

class ElementSpace final : public FlowSpace {
 public:
  // `start`: as airfoils_domain() makes it, the farfield the last loop.
  ElementSpace(Domain start, std::vector<ElementVariable> variables);

  // What description() has. Throws Json's exceptions and Error (format).
  static ElementSpace from_description(const std::string& text, const std::string& source);

  Domain domain_with(std::span<const double> design, int points) const override;
  DesignBounds bounds(double coefficients) const override;
  std::size_t sections() const override { return start_.loops.size() - 1; }
  CstAirfoil section(std::span<const double> design, std::size_t index) const override;
  Placement placement(std::span<const double> design, std::size_t index) const override;
  std::vector<NamedNumber> named(std::span<const double> design) const override;
  std::vector<double> gradient_of_domain(std::span<const double> by_numbers) const override;
  std::vector<double> gradient_of_section(std::size_t index,
                                          std::span<const double> by_coefficients) const override;

  std::vector<double> start() const override;
  Domain domain(std::span<const double> design) const override;
  // Within the bounds of its placements, and a valid domain: sections that touch each other are none.
  bool feasible(std::span<const double> design) const override;
  std::string text(std::span<const double> design) const override;  // a domain file
  std::string description() const override;

 private:
  Domain start_;
  std::vector<ElementVariable> variables_;
  std::vector<double> numbers_;  // of the start
};

// Of the problem's elements. Throws as validate() does.
ElementSpace space_of_elements(const DesignProblem& problem, const ProblemPlace& place);

}  // namespace remodel
