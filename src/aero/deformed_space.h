#pragma once

// Designs that deform a domain: its numbers (coefficients_of(Domain)) are those of the start and a fixed
// matrix times the design. It has no sections by coefficients, whatever its curves look like.

#include "aero/deformation.h"
#include "remodel/flow_space.h"

namespace remodel {

class DeformedSpace final : public FlowSpace {
 public:
  // `points`: about how many stations the curves have but the far field; as many as the start's leave them
  // as they are.
  DeformedSpace(Domain start, std::vector<DeformationVariable> variables, int points);

  // What description() has. Throws Json's exceptions and Error (format).
  static DeformedSpace from_description(const std::string& text, const std::string& source);

  Domain domain_with(std::span<const double> design, int points) const override;
  DesignBounds bounds(double coefficients) const override;
  // The mean square of the slopes of the displacement along the curves, as SectionSpace::metric().
  std::vector<double> metric() const override;
  std::size_t sections() const override { return 0; }
  CstAirfoil section(std::span<const double> design, std::size_t index) const override;  // throws: none
  std::vector<NamedNumber> named(std::span<const double> design) const override;
  std::vector<double> gradient_of_domain(std::span<const double> by_numbers) const override;
  std::vector<double> gradient_of_section(
      std::size_t index,
      std::span<const double> by_coefficients) const override;  // likewise
  // The loops that designs move, by index.
  std::vector<std::size_t> moving_loops() const;

  std::vector<double> start() const override { return std::vector<double>(variables_.size(), 0.0); }
  Domain domain(std::span<const double> design) const override;
  // Within the bounds that variables have of their own, and a valid domain.
  bool feasible(std::span<const double> design) const override;
  std::string text(std::span<const double> design) const override;  // a domain file
  std::string description() const override;

 private:
  Domain start_;
  std::vector<DeformationVariable> variables_;
  int points_;
  std::vector<double> numbers_;  // of the start
};

// Stations on all curves but those of the name "farfield".
std::size_t stations_on_walls(const Domain& domain);

}  // namespace remodel
