#pragma once

// The problem of `remodel design`: docs/design.md describes the file.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "design_constraints.h"
#include "element_space.h"
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

// A function of a section's coefficients (upper, then lower) that is to be at most 0: bound - row * a.
struct SectionConstraint {
  std::vector<double> row;
  double bound = 0.0;
  std::size_t section = 0;
  std::string name = {};  // of the file's constraint, as of those that follow
};

// A coefficient of a point's flow, at least or at most a value; or the suction peak.
struct FlowConstraint {
  std::string of;  // "cl", "cm", "cd" or "suction"
  std::size_t point = 0;
  double sign = 1.0;  // 1: at most the value, -1: at least
  double value = 0.0;
  std::optional<std::size_t> section = {};  // of a suction peak; without: of all walls
  std::string name = {};

  // Suction peaks are large: they count in parts of what is allowed.
  double factor() const { return of == "suction" ? sign / value : sign; }
};

// Two sections are to be this far apart.
struct GapConstraint {
  std::size_t section = 0, other = 0;
  double at_least = 0.0;
  std::string name = {};
};

struct DesignProblemFile {
  std::string text;                      // the file's, for the run's settings
  std::filesystem::path directory;       // the file's: paths of airfoils in it lead on from there
  CstAirfoil start;                      // of a problem of one section
  std::optional<ElementSpace> elements;  // of one of several
  bool symmetric = false;                // the lower surface is the upper one's mirror image
  AirfoilDomainOptions domain;
  double gradation = 2.0;
  std::vector<DesignPoint> points;
  std::string objective;             // "drag", "lift", "lift_over_drag", "moment" or "inverse"
  std::optional<CstAirfoil> target;  // of inverse design
  std::vector<SectionConstraint> section;
  std::vector<FlowConstraint> flow;
  std::vector<GapConstraint> gaps;
  // For each function that an evaluation has, in their order, the name of its constraint: the kind, and its
  // number in the file where there are several of a kind.
  std::vector<std::string> constraint_names() const;
  double constraint_tolerance = default_constraint_tolerance;
  std::string designer = "sqp";
  double bounds = 0.1, trust = 0.02, sigma = 0.01;
  std::uint64_t seed = 1;
  std::size_t evaluations = 100;
  std::vector<int> verify;  // numbers of points of fresh meshes for the last design

  // Whether all flows are their own mirror images, so that half of each says all: a symmetric section closed
  // behind, along the x axis, and no word of lift, moment or suction.
  bool is_half() const;
  SectionSpaceOptions section_options() const {  // of a problem of one section
    return {.symmetric = symmetric, .half = is_half(), .domain = domain};
  }
  std::unique_ptr<FlowSpace> space() const;
};

// Throws Error (format) naming the file and the key.
DesignProblemFile read_design_problem(const std::string& file);

// Of the flows of a design. Half of one has a lift of its own, but the whole has none, and no vortex far
// away.
FlowOptions flow_options(bool half, StepObserver* observer = nullptr);
// Coefficients of the whole of a flow of which half was found.
FlowResult whole(FlowResult half);
// The suction peak of a flow, the largest -Cp at the stations of walls: of a loop of the mesh's domain, or of
// all. A mean of the highest values takes the place of the largest one, which has no derivative where another
// station becomes it: ln(sum of exp(k (-Cp))) / k with k = 10, larger than the largest by 0.1 ln n where n
// stations share it (G. Kreisselmeier and R. Steinhauser, IFAC Symposium on Computer Aided Design of Control
// Systems, 1979). With derivatives by pressures.
FlowFunctional suction_peak(const Mesh& mesh, const FrozenMesh& frozen, const FlowResult& flow,
                            std::optional<std::size_t> loop, double& value);
// A flow found cold with these options, with the coefficients of the whole.
FlowResult solve_section(const Mesh& mesh, const FlowConditions& conditions, bool half,
                         StepObserver* observer = nullptr);

// By how much a flow through a mesh violates a constraint; negative where it keeps it.
double excess_of(const FlowConstraint& constraint, const Mesh& mesh, const FlowResult& flow);

std::unique_ptr<Designer> make_designer(const DesignProblemFile& problem, const FlowSpace& space);
// The problem and space must outlive it. The flows of a problem's points are found on so many threads at
// most; times alone depend on it.
std::unique_ptr<Evaluator> make_flow_evaluator(const DesignProblemFile& problem, const FlowSpace& space,
                                               std::size_t threads = 1);

}  // namespace remodel::app
