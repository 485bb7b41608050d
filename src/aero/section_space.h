#pragma once

// What the numbers of a section's design mean: coefficients of both surfaces, or of the upper one alone where
// the section is symmetric.
//
// Flow along the x axis around a symmetric section is its own mirror image. Then the domain is the half above
// the axis: upper surface, half of the far field, and the axis before and behind the section, a boundary
// called "symmetry" that the flow slips along. The mesh of the whole, mirrored, is symmetric to the last bit
// and Delaunay (no circle over an edge of the axis holds a point), the flow has no lift, and costs half as
// much.

#include "aero/problem_place.h"
#include "remodel/flow_space.h"

namespace remodel {

struct SectionSpaceOptions {
  bool symmetric = false;  // the lower surface is the upper one's mirror image
  bool half = false;       // symmetric, closed behind: the domain is the upper half
  AirfoilDomainOptions domain = {};
};

class SectionSpace final : public FlowSpace {
 public:
  SectionSpace(const CstAirfoil& start, const SectionSpaceOptions& options);

  std::vector<double> coefficients(std::span<const double> design) const;  // of both surfaces
  CstAirfoil airfoil(std::span<const double> design) const { return space_.airfoil(coefficients(design)); }
  // Of derivatives by the coefficients of both surfaces, those by the design.
  std::vector<double> gradient(std::span<const double> by_coefficients) const;
  // The same domain with this number of points on the section.
  Domain domain_of(const CstAirfoil& airfoil, int points) const;

  bool half() const override { return options_.half; }
  Domain domain_with(std::span<const double> design, int points) const override {
    return domain_of(airfoil(design), points);
  }
  DesignBounds bounds(double coefficients) const override;
  // The mean square of the surfaces' slopes, as drag has it in linear theory of supersonic flow (J. Ackeret,
  // Z. Flugtechnik Motorluftschiffahrt 16 (1925)), by the angle theta of x = (1 + cos theta) / 2, so that it
  // is finite at round noses. Coefficients of Bernstein polynomials by themselves are badly scaled: of high
  // degrees, large alternating ones change the section little.
  std::vector<double> metric() const override;
  CstAirfoil section(std::span<const double> design, std::size_t) const override { return airfoil(design); }
  std::vector<double> gradient_of_domain(std::span<const double> by_numbers) const override;
  std::vector<double> gradient_of_section(std::size_t,
                                          std::span<const double> by_coefficients) const override {
    return gradient(by_coefficients);
  }

  std::vector<double> start() const override;
  Domain domain(std::span<const double> design) const override {
    return domain_of(airfoil(design), options_.domain.points);
  }
  bool feasible(std::span<const double> design) const override {
    return space_.feasible(coefficients(design));
  }
  std::string text(std::span<const double> design) const override {
    return space_.text(coefficients(design));
  }
  std::string description() const override;

 private:
  CstAirfoil like_;
  SectionSpaceOptions options_;
  AirfoilSpace space_;
  std::vector<std::vector<double>> rows_;  // half: of each point of the polyline, y by the coefficients
};

// The airfoil with the upper surface's mirror image as its lower one. Throws where these differ by more than
// the rounding of coordinates.
CstAirfoil symmetric_start(CstAirfoil airfoil, const ProblemPlace& place);

}  // namespace remodel
