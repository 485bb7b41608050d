#pragma once

// A flow space has what a design problem asks of a design space beyond DesignSpace: sections, how far numbers
// may go, and derivatives by the design. design_space() of remodel/design_problem.h makes one.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "remodel/airfoil.h"
#include "remodel/design_space.h"
#include "remodel/domain.h"
#include "remodel/frozen_mesh.h"

namespace remodel {

// The lowest and the highest value of each number of a design.
struct DesignBounds {
  std::vector<double> low, high;
};

// A number of a design in its own unit, with a name for people.
struct NamedNumber {
  std::string name;
  double value = 0.0;
};

class FlowSpace : public DesignSpace {
 public:
  // True if the domain is the upper half of one whose flows are their own mirror images.
  virtual bool half() const { return false; }
  // walls() without the line of a wake, where they have one.
  virtual Domain bodies(std::span<const double> design) const { return walls(design); }
  // walls() of a design with this number of points on each section, about so many where there are layers.
  virtual Domain domain_with(std::span<const double> design, int points) const = 0;
  // `coefficients`: how far a coefficient of a section may go from the start.
  virtual DesignBounds bounds(double coefficients) const = 0;

  // SqpOptions::metric; empty: nothing is known.
  virtual std::vector<double> metric() const { return {}; }

  // Sections in their own chords, and where they lie. A deformed domain has none.
  virtual std::size_t sections() const { return 1; }
  virtual CstAirfoil section(std::span<const double> design, std::size_t index) const = 0;
  virtual Placement placement(std::span<const double> design, std::size_t index) const {
    static_cast<void>(design), static_cast<void>(index);
    return {};
  }
  virtual std::vector<NamedNumber> named(std::span<const double> design) const {
    static_cast<void>(design);
    return {};
  }

  // Derivatives by the design of a function of walls(), of those by its numbers (coefficients_of(Domain)).
  virtual std::vector<double> gradient_of_domain(std::span<const double> by_numbers) const = 0;
  // These are derivatives by the design of a function of a section, of those by its coefficients, upper
  // surface first.
  virtual std::vector<double> gradient_of_section(std::size_t index,
                                                  std::span<const double> by_coefficients) const = 0;
};

// A mesh above the x axis with its mirror image; values at its points likewise, `sign` times as much below.
FrozenMesh mirrored(const FrozenMesh& half);
std::vector<double> mirrored(const FrozenMesh& half, const std::vector<double>& values, double sign = 1.0);

}  // namespace remodel
