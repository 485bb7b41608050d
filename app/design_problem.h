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
#include "section_space.h"

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
  std::string designer = "sqp";
  double bounds = 0.1, trust = 0.02, sigma = 0.01;
  std::uint64_t seed = 1;
  std::size_t evaluations = 100;
  std::vector<int> verify;  // numbers of points of fresh meshes for the last design

  // Whether all flows are their own mirror images, so that half of each says all: a symmetric section closed
  // behind, along the x axis, and no word of lift or moment.
  bool is_half() const;
  SectionSpace space() const {
    return {start, {.symmetric = symmetric, .half = is_half(), .domain = domain}};
  }
};

// Throws Error (format) naming the file and the key.
DesignProblemFile read_design_problem(const std::string& file);

// Of the flows of a design. Half of one has a lift of its own, but the whole has none, and no vortex far
// away.
FlowOptions flow_options(bool half, StepObserver* observer = nullptr);
// Coefficients of the whole of a flow of which half was found.
FlowResult whole(FlowResult half);
// A flow found cold with these options, with the coefficients of the whole.
FlowResult solve_section(const Mesh& mesh, const FlowConditions& conditions, bool half);

std::unique_ptr<Designer> make_designer(const DesignProblemFile& problem, const DesignSpace& space);
// The problem and space must outlive it.
std::unique_ptr<Evaluator> make_flow_evaluator(const DesignProblemFile& problem, const SectionSpace& space);

}  // namespace remodel::app
