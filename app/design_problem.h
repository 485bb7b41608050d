#pragma once

// The problem of `remodel design`: docs/design.md describes the file.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "remodel/design_space.h"
#include "remodel/designer.h"
#include "remodel/evaluator.h"
#include "remodel/flow.h"
#include "report.h"

namespace remodel::app {

struct DesignPoint {
  FlowConditions conditions;
  double weight = 1.0;
};

// A function of the section's coefficients (upper, then lower) that is to be at most 0: bound - row * a.
struct SectionConstraint {
  std::vector<double> row;
  double bound = 0.0;
};

// A coefficient of a point's flow, at least or at most a value.
struct FlowConstraint {
  std::string of;  // "cl", "cm" or "cd"
  std::size_t point = 0;
  double sign = 1.0;  // 1: at most the value, -1: at least
  double value = 0.0;
};

struct DesignProblemFile {
  std::string text;  // the file's, for the run's settings
  CstAirfoil start;
  bool symmetric = false;  // the lower surface is the upper one's mirror image
  AirfoilDomainOptions domain;
  double gradation = 2.0;
  std::vector<DesignPoint> points;
  std::string objective;             // "drag", "lift_over_drag", "moment" or "inverse"
  std::optional<CstAirfoil> target;  // of inverse design
  std::vector<SectionConstraint> section;
  std::vector<FlowConstraint> flow;
  std::string designer = "slsqp";
  double bounds = 0.1, trust = 0.02, sigma = 0.01;
  std::uint64_t seed = 1;
  std::size_t evaluations = 100;
  std::vector<int> verify;  // numbers of points of fresh meshes for the last design
};

// Throws Error (format) naming the file and the key.
DesignProblemFile read_design_problem(const std::string& file);

// Designs are the coefficients of both surfaces, or of the upper one where the section is symmetric.
class SectionSpace final : public DesignSpace {
 public:
  explicit SectionSpace(const DesignProblemFile& problem)
      : problem_(problem), space_(problem.start, problem.domain) {}
  std::vector<double> coefficients(std::span<const double> design) const;  // of both surfaces
  CstAirfoil airfoil(std::span<const double> design) const { return space_.airfoil(coefficients(design)); }
  // Derivatives by the coefficients of both surfaces to those by the design.
  std::vector<double> gradient(std::span<const double> by_coefficients) const;

  std::vector<double> start() const override;
  Domain domain(std::span<const double> design) const override { return space_.domain(coefficients(design)); }
  bool feasible(std::span<const double> design) const override {
    return space_.feasible(coefficients(design));
  }
  std::string text(std::span<const double> design) const override {
    return space_.text(coefficients(design));
  }
  std::string description() const override;

 private:
  const DesignProblemFile& problem_;
  AirfoilSpace space_;
};

std::unique_ptr<Designer> make_designer(const DesignProblemFile& problem, const DesignSpace& space);
// The problem and space must outlive it.
std::unique_ptr<Evaluator> make_flow_evaluator(const DesignProblemFile& problem, const SectionSpace& space);

}  // namespace remodel::app
