#pragma once

// Polars: rows of flows on one mesh, over angles of attack or lift coefficients, each found from the last
// one.
//
//   Mesh mesh = generate(airfoil_domain(named_airfoil("naca:0012", 5))).mesh;
//   PolarOptions options;
//   options.machs = {0.3};
//   options.alphas_deg = parse_range("alpha", "0:8:1", {-90, 90});
//   const std::vector<PolarCurve> polar = find_polar(mesh, "naca:0012", options).curves;
//   write_text_atomically("polar.csv", polar_table(polar));
//   draw_plots(polar_plots(polar), 2, "polar.svg");
//
// A row begins at the value that is nearest to 0, goes up from there, then down. Where a flow is not found
// the step is halved back towards the last one that was; flows in between are kept (PolarPoint::asked). A
// value that is not reached so is a point that says why. After two of them in a row, the rest in that
// direction is not looked for, and says so. The row of each further Mach number begins with the first flow of
// the row before.
//
// Steady flows end somewhere beyond the largest lift. Where this method finds none, there may be one.

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "remodel/flow.h"
#include "remodel/frozen_mesh.h"
#include "remodel/mesh.h"
#include "remodel/plot.h"

namespace remodel {

struct ValueRange {
  double low = 0.0, high = 0.0;
};
inline constexpr std::size_t most_polar_values = 1000;  // of one range
// The numbers A, A + D, ... up to B of "A:B:D", rounded to 12 digits so that 0:1:0.1 has 0.3, or the single
// one of "A". Throws Error (argument) naming `option` for another text, a step that is not above 0, B below
// A, more than most_polar_values numbers, and numbers outside of the range.
std::vector<double> parse_range(const std::string& option, std::string_view text, ValueRange range);

struct PolarPoint {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  bool asked = true;  // false: between values that were asked for, where a halved step led
  bool converged = false;
  std::optional<FlowStatus> status = {};  // none: not looked for
  std::string reason = {};                // why there is no flow; empty if there is one
  // Not a number where there is none: without a flow the value alone that was asked for is one. Lift and
  // moment are none where they are not determined either (FlowResult::lift_determined).
  double alpha_deg = none, cl = none, cd = none, cm = none;
  double cd_pressure = none, cd_friction = none;  // cd's parts; without friction all of it is of pressure
  double y_plus_max = none;                       // of models with friction
  std::vector<FlowBody> bodies = {};              // of flows that were found: the parts of each wall
  int newton_steps = 0;
  double residual = none;
  FlowStart start = FlowStart::cold;
  double seconds = 0.0;  // of the last search at this value
  std::vector<std::string> warnings = {};
};

struct PolarCurve {
  std::string name;  // of the shape
  FlowModel model = FlowModel::euler;
  double mach = 0.0;
  double reynolds = 0.0;                                 // of models with friction
  std::optional<std::array<double, 2>> transition = {};  // as FlowConditions has it
  bool over_lift = false;                                // lifts were asked for, not angles
  std::vector<PolarPoint> points;                        // ascending
};

struct PolarOptions {
  // Flows have all of this in common but for mach, alpha_deg and cl.
  FlowConditions conditions = {};
  FlowOptions flow = {};
  std::vector<double> machs = {};       // ascending: a curve for each
  std::vector<double> alphas_deg = {};  // ascending; or, if it is empty,
  std::vector<double> lifts = {};       // ascending: lift coefficients that angles are found for
  int halvings = 3;                     // of a step: 0 to 20
  int misses = 2;                       // in a row, after which the rest is not looked for: 1 or more
  // Called before each search, with the Mach number and the angle or lift.
  std::function<void(double mach, double value)> on_search = {};
  // Called after each value, with the curves as far as they came.
  std::function<void(const std::vector<PolarCurve>& curves)> on_curves = {};
};

struct PolarResult {
  std::vector<PolarCurve> curves;
  bool interrupted = false;  // by the observer: the curves are as far as they came
  double seconds = 0.0;
};

// Curves around the bodies of one mesh, which `name` is the name of. Throws Error (argument) as
// LivingFlow::solve() does, where there are no Mach numbers, neither angles nor lifts, or both, where values
// do not ascend, and for halvings and misses out of range.
PolarResult find_polar(const Mesh& mesh, const std::string& name, const PolarOptions& options);
// This one takes meshes with layers (LayeredMesh::freeze()) and meshes of other programs.
PolarResult find_polar(const FrozenMesh& mesh, const std::string& name, const PolarOptions& options);

struct LargestLift {
  double cl = 0.0, alpha_deg = 0.0;
  // Flows with less lift were found at larger angles. Otherwise lift still grows at the largest angle of a
  // flow.
  bool passed = false;
};
// The largest lift coefficient of the flows that were found, if any has one.
std::optional<LargestLift> largest_lift(const PolarCurve& curve);

// One sentence on each kind of warning that flows have, with the angle of the first and their number.
std::vector<std::string> polar_warnings(const PolarCurve& curve);

// A row for each point, with a header: shape, mach, reynolds, asked, alpha_deg, cl, cd, cm, cd_pressure,
// cd_friction, y_plus_max, converged, status, newton_steps, residual, reason, warnings. What is not a number
// is empty. Numbers read as the same doubles. Lines end with a line feed; texts with commas or quotes are
// quoted (RFC 4180).
std::string polar_table(const std::vector<PolarCurve>& curves);

// Plots of flows that were found: lift over angle, lift over drag coefficient, moment over angle and, with
// friction, lift-to-drag ratio over angle. A curve each for each polar that has flows, by its name and, where
// they differ, its Mach number; the captions name the largest lift. Empty where no flow was found, or none
// with a lift.
std::vector<Plot> polar_plots(const std::vector<PolarCurve>& curves);

}  // namespace remodel
