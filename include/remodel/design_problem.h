#pragma once

// A design problem: sections in a stream, what is to be made small, and what is to hold. A plain struct, that
// a program fills in, or a problem file does (docs/design.md; `remodel design`). run_design() of
// remodel/design_run.h solves it; the parts that it uses, a space, an evaluator and a designer, are made here
// for other loops.
//
//   DesignProblem problem{.airfoil = load_airfoil("naca:0012", 4), .symmetric = true};
//   problem.points = {{.conditions = {.mach = 0.8}}};
//   problem.constraints = {{.kind = "area", .of_start = 1.0}};
//
// Lengths are in chords of one section, of several in units of the domain.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "remodel/airfoil.h"
#include "remodel/crew.h"
#include "remodel/deformation.h"
#include "remodel/designer.h"
#include "remodel/domain.h"
#include "remodel/evaluator.h"
#include "remodel/flow.h"
#include "remodel/flow_function.h"
#include "remodel/flow_space.h"
#include "remodel/layers.h"
#include "remodel/living_mesh.h"

namespace remodel {

inline constexpr int usual_points_with_friction = 300;

struct DesignPoint {
  FlowConditions conditions;  // mach 0.01 to 3; cl below Mach 1 only
  double weight = 1.0;        // of the objective; 0: the point is there for its constraints alone
  FlowModel model =
      FlowModel::euler;  // with friction of all points, or of none: `conditions` has its `reynolds`
  // A deformed domain may have these, with friction too: they are FlowOptions of the same names.
  std::vector<FlowInlet> inlets = {};
  std::vector<FlowOutlet> outlets = {};
  std::vector<std::string> symmetry = {};
};

// A number of an element's placement that the search may change.
struct PlacementRange {
  double low = 0.0, high = 0.0;  // the start lies between them
  // The design has the number over this: steps of a search are of one size in all numbers. None: 1, of an
  // angle 50 degrees.
  std::optional<double> scale = {};
};

// One of several sections in one far field.
struct DesignElement {
  std::string name;  // of its boundary; neither "farfield" nor "symmetry"
  CstAirfoil airfoil;
  Placement placement = {};
  bool coefficients = false;  // whether the section's shape may change, as DesignProblem::bounds says
  std::optional<PlacementRange> chord = {}, rotation_deg = {}, x = {}, y = {};
};

// Functions of a design by its user, each of which is to be at most 0.
struct DesignView {
  const FlowSpace& space;
  std::span<const double> design;
  const Domain& domain;  // of the design
};
struct DesignValue {
  double value = 0.0;
  std::vector<double> by_design;  // derivatives: one for each number of the design
};
using DesignFunctionOf = std::function<std::vector<DesignValue>(const DesignView&)>;

// A constraint says what is to hold. `kind` is a name of constraint_kinds(), or empty where one of the own
// functions is given. What a kind has no use for is not given.
//   lift, drag, moment   a coefficient of the flow of `point`, at_least or at_most
//   pressure_drag, friction_drag    the parts of drag, likewise
//   mass_flow            what leaves through the outlets of `point`, at_least or at_most
//   total_pressure       its mean there by mass flow, a part of the stream's, likewise
//   suction              the peak of -Cp of `point`, of all walls or of one `element`, at_most
//   area, thickness      of a section, thickness at each of `x`: at_least, or of_start, a part of the start's
//   tank                 the area of a section between two stations `x`, likewise
//   box                  the thickness all over between two stations `x` (at 21); of_start: of the least
//   camber               of a section at each of `x`: at_least, at_most or both
//   trailing_edge_angle  of a section, in degrees: at_least or of_start
//   leading_edge_radius  of each surface of a section, likewise
//   contains             the section contains `airfoil`, at 39 stations of each surface
//   gap                  the least distance `between` two elements, at_least
// Of a deformed domain there are area and thickness alone, of a loop that moves: where there are several,
// `element` is the name of one of its curves. `x` is in units of the domain, thickness from the lowest to the
// highest place of the loop there.
struct DesignConstraint {
  std::string kind = {};
  std::optional<double> at_least = {}, at_most = {}, of_start = {};
  std::optional<std::size_t> point = {};      // of DesignProblem::points; none: the first
  std::optional<std::vector<double>> x = {};  // above 0 and below 1
  std::optional<CstAirfoil> airfoil = {};     // in the section's own chord
  std::optional<std::string> element = {};    // its name; given of a section among several
  std::optional<std::vector<std::string>> between = {};
  FlowFunctionOf own_flow = {};      // of the flow of `point`, at_least or at_most
  DesignFunctionOf own_design = {};  // of the design; the same number of values for each
  std::string name = {};  // in results; empty: the kind, with its number where there are several of it
};

// A design is within a constraint that it violates by so much at most, in the measure of the history's column
// `constraints`: what linearised constraints leave at the end of a search, and far above rounding.
inline constexpr double default_constraint_tolerance = 1e-5;

// A design of an earlier run of the same variables.
struct DesignStart {
  std::filesystem::path history;          // the run's directory, or its history.sqlite
  std::optional<std::uint64_t> design{};  // its number, from 1; none: the run's best
};

struct DesignProblem {
  CstAirfoil airfoil = {};                   // the start, of one section
  std::vector<DesignElement> elements = {};  // in its place: several sections
  // This takes the place of both: any domain, and what may move in it. `domain.points` is about how many
  // stations its curves have then, but for those named "farfield"; as many as they are leave them as they
  // are.
  std::optional<Deformation> deformation = {};
  // The lower surface is the upper one's mirror image, as it is of the start but for 1e-4 chords. Where all
  // flows are their own mirror images then, half of each is computed (FlowSpace::half()).
  bool symmetric = false;
  AirfoilDomainOptions domain = {.points = 100};
  // The search goes through meshes of so many points, increasing, before that of domain.points. Each begins
  // with the best design of the one before.
  std::vector<int> coarse_points = {};
  // The mesh has this gradation; none: points / 50. With friction `points` is about how many stations a
  // section has, 150 or more (usual_points_with_friction).
  std::optional<double> gradation = {};
  // All sections have this layer in flows with friction; none: of what layer_for_flow() has for the points,
  // the least first height and the largest thickness.
  std::optional<LayerOptions> layer = {};
  std::optional<WakeLine> wake = {};     // with friction: behind the start's walls, where it stays
  std::vector<DesignPoint> points = {};  // of flow: one or more
  // A name of objective_names(): the sum over points, by their weights, of drag, pressure_drag,
  // friction_drag, lift (made large), lift_over_drag (made large), moment (made large), mass_flow (made
  // large), total_pressure (made large) or inverse, half the mean square difference of pressure coefficients
  // to those of `target` at stations. With own_objective any text: that function, made small.
  std::string objective = "drag";
  FlowFunctionOf own_objective = {};
  std::optional<CstAirfoil> target = {};  // of inverse design
  std::vector<DesignConstraint> constraints = {};
  double constraint_tolerance = default_constraint_tolerance;  // 0 to 1

  std::string designer = "sqp";   // a name of designer_names()
  std::size_t evaluations = 100;  // designs, at most
  double bounds = 0.1;            // sqp: how far a coefficient, or a deformation, may go from the start
  double trust = 0.02;            // sqp: how far a number may go in the first step
  double least_promise = 1e-6;    // sqp: SqpOptions::least_promise
  double sigma = 0.01;            // cmaes: the first standard deviation
  std::uint64_t seed = 1;         // cmaes
  // cmaes: living meshes, 1 to 1000. The designs of a generation are handed out to them, and evaluated at
  // once.
  std::size_t workers = 1;
  // The search begins with this design in the place of the space's start, which bounds and parts `of_start`
  // go on being of: one of an earlier run, or the numbers of one.
  std::optional<DesignStart> start = {};
  std::vector<double> first_design = {};
  // Points on each section of fresh meshes, even: on each the best design is evaluated at the end.
  std::vector<int> verify = {};

  // A JSON object as which the run's settings, its history and its page have the problem; empty: they have
  // design_problem_json(). A reader of problem files keeps the file's here.
  std::string text = {};
  // A reader of its files leaves here what a person has to know: sections that were turned, sheared or
  // closed.
  std::vector<std::string> warnings = {};
};

// How the meshes of a search follow its designs: as long as one reference holds, their objective is a smooth
// function of the design, and its gradient is exact.
inline constexpr MeshStrategy design_strategy = MeshStrategy::reference;
inline constexpr double design_slack_deg = 1.0;  // OptimiseOptions::reference_slack_deg

std::vector<std::string> objective_names();
std::vector<std::string> constraint_kinds();
std::vector<std::string> designer_names();

// Throws Error (argument) naming the place in the problem, what was found and what was expected. `source`
// names the problem.
void validate(const DesignProblem& problem, const std::string& source = "design problem");

// Validates a problem and returns it with the numbers of `start` in that one's place: another run's history
// is read once.
DesignProblem with_first_design(DesignProblem problem, const std::string& source = "design problem");

// Reads the file of a problem: docs/design.md describes it. Paths in it lead on from its directory. Throws
// Error naming the file and the place in it.
DesignProblem read_design_problem(const std::string& file);
// This one reads the text of such a file. `source` names it in messages; paths in it lead on from its
// directory.
DesignProblem parse_design_problem(const std::string& text, const std::string& source);
// The problem's own text, or one made of its members; own functions are named in it, no more.
std::string design_problem_json(const DesignProblem& problem);

// The space says what the numbers of a design mean. Throws as validate() does.
std::unique_ptr<FlowSpace> design_space(const DesignProblem& problem);
// The names are those of the constraints that the functions of an evaluation are of, one for each function,
// in their order: of sections and domains first, gaps behind them, then of flows.
std::vector<std::string> constraint_names(const DesignProblem& problem);
// Flows of all points on the living mesh, and their gradients by the design: exact ones of the discrete flow
// on the meshes of one reference (Strategy::reference). With friction the living mesh is what lies beyond the
// layers. Outputs: cl, cd, cm, with friction cd_pressure and cd_friction, alpha_deg (of the second point cl_2
// ...), connectivity, factorisations, flow_seconds, gradient_seconds. The space must outlive it. The flows of
// the points are found on so many threads at most; times alone depend on it. `ranks`: by the crew that works
// on these, which does flow_points_work(). `on_step`: DesignRunOptions::on_flow_step.
std::unique_ptr<Evaluator> flow_evaluator(const DesignProblem& problem, const FlowSpace& space,
                                          std::size_t threads = 1, PostedJobs* ranks = nullptr,
                                          std::function<void(const FlowProgress&)> on_step = {});
CrewWork flow_points_work(const DesignProblem& problem);
std::unique_ptr<Designer> make_designer(const DesignProblem& problem, const FlowSpace& space);

// Options of the flows of a point. Half of a flow has a lift of its own, but the whole has none, and no
// vortex far away.
FlowOptions design_flow_options(const FlowSpace& space, const DesignPoint& point,
                                StepObserver* observer = nullptr);
// The coefficients of the whole of a flow of which half was found.
FlowResult whole_of(FlowResult half);
// A design's flow found cold with these options, with the coefficients of the whole. The mesh is one of
// space.domain(design).
FlowResult solve_design_flow(const FlowSpace& space, const Mesh& mesh, std::span<const double> design,
                             const DesignPoint& point, StepObserver* observer = nullptr);

}  // namespace remodel
