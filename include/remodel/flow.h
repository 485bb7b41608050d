#pragma once

// Steady two-dimensional flow of a perfect gas without friction (the compressible Euler equations, gamma
// = 1.4) around the walls of a mesh, at its vertices, of second order.
//
//   Mesh mesh = generate(airfoil_domain(named_airfoil("naca:0012", 5))).mesh;
//   LivingFlow flow;
//   FlowResult first = flow.solve(mesh, {.mach = 0.5, .alpha_deg = 1.25});     // cold
//   remodel(mesh, design);
//   FlowResult second = flow.solve(mesh, {.mach = 0.5, .alpha_deg = 1.25});    // from what the first one
//   left if (second.converged()) use(second.cl, second.cd);
//
// Units: density and speed of sound of the undisturbed stream are 1, so that its speed is the Mach number and
// its pressure 1 / gamma; lengths are the mesh's. Coefficients are forces over half the stream's density
// times speed squared times the reference length. Lift is perpendicular to the stream, positive to its left
// (upwards for a stream to the right); drag is along the stream; the moment is about the reference point,
// positive nose up.
//
// Boundaries: the one called `farfield` is open to the stream, those named as inlets and outlets are open too
// (FlowOptions), those named as symmetry planes have the flow's mirror image on their other side, periodic
// ones belong together, all others are walls that the flow slips along. Ducts and cascades need no far field:
// the stream is then what pressures and temperatures are measured in, and where the search for the flow
// begins. The stream far
// away has a vortex of the sum of all walls' lift, at the reference point (J. L. Thomas and M. D. Salas, AIAA
// J. 24, 1986), so that 25 chords are far enough.
//
// Method: Roe's flux on the median dual, reconstruction along edges of third order on even spacing, van
// Albada's limiter, weak boundary conditions; the exact Jacobian; Newton's method by pseudo-transient
// continuation with a line search, in stages from first order where that stalls; linear systems by GMRES with
// incomplete factors, and by sparse LU where its factors last. docs/flow.md has equations, sources and
// verification.
//
// Models with friction (FlowOptions::model) share the dual, Roe's flux, the far field and the two augmented
// unknowns. Upwind differences follow the lines of quadrilaterals, friction is linear on triangles, walls are
// strong; linear systems are preconditioned by the scheme of first order. docs/viscous.md has scheme and
// verification.
//
// Errors: Error (argument) for conditions and options out of range, for symmetry planes that are not straight
// or not along the stream, for periodic boundaries that do not fit each other, and for a mesh without a far
// field or another way in and out, without a wall, with unnamed boundary edges, with triangles that are
// clockwise or have no area, or with a far field that is the boundary of a hole. A flow that is not found is
// no error: FlowResult::status and reason say so, and no coefficient of it should be used.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "remodel/field.h"
#include "remodel/frozen_mesh.h"
#include "remodel/mesh.h"

namespace remodel {

// The model says what the gas is like.
enum class FlowModel {
  euler,    // without friction
  laminar,  // viscous and heat-conducting: the Navier-Stokes equations
  sa,       // the same in the mean of a turbulent flow, with the model of Spalart and Allmaras (SA-neg-noft2:
       // ICCFD7-1902 without ft2), fully turbulent: the stream's working variable is 3 times its viscosity
};
const char* name_of(FlowModel model);  // "euler", "laminar", "sa"

struct FlowConditions {
  double mach = 0.5;       // of the stream: 0.01 to 3
  double alpha_deg = 0.0;  // its angle to the x axis, -90 to 90; where cl is given, where the search begins
  std::optional<double> cl = {};  // the lift coefficient that the angle is to be found for; not above Mach 1
  Point reference = {0.25, 0.0};
  // Coefficients and the Reynolds number are made with this length, and nothing else is: more than 0.
  double reference_length = 1.0;
  double reynolds = 0.0;  // of models with friction, by the reference length: 1 to 1e10
  // The boundary layers of upper and lower sides become turbulent there, by the model sa, as parts of the
  // chord from 0 to 1; none: at the leading edge. Ahead of it the model has no production of turbulence, in
  // the vertices whose nearest place on a wall lies there. The chord of each body is from its rearmost point
  // to the farthest one from that. Derivatives by the shape hold the zone.
  std::optional<std::array<double, 2>> transition = {};
  // The temperature of all walls, of models with friction, as a part of the stream's static temperature: more
  // than 0. None: no heat passes through walls.
  std::optional<double> wall_temperature = {};
};

// A boundary through which gas enters with a given total pressure and total temperature: parts of the
// stream's, which are p (1 + 0.2 M^2)^3.5 and T (1 + 0.2 M^2). Below Mach 1 only.
struct FlowInlet {
  std::string name;
  double total_pressure = 1.0;     // more than 0
  double total_temperature = 1.0;  // likewise
  // The direction that gas enters in, as an angle to the x axis: it leads into the domain everywhere, at less
  // than 89 degrees to the normal. None: at a right angle to the boundary.
  std::optional<double> angle_deg = {};
};

// Two boundaries of which one is the other moved, vertex for vertex: what leaves the domain by one enters it
// by the other. Between them lies one passage of an endless row (a cascade).
struct FlowPeriod {
  std::string name, moved;
};

// A boundary through which gas leaves against a given pressure, a part of the stream's. Where it leaves
// faster than sound the pressure has no effect. It is less than the largest total pressure that gas enters
// with.
struct FlowOutlet {
  std::string name;
  double pressure = 1.0;  // more than 0
};

// How the linear systems of Newton's method are solved.
enum class FlowSolver {
  lu,     // sparse LU; GMRES still where that needs more than memory_mb
  gmres,  // GMRES with incomplete factors
};
const char* name_of(FlowSolver solver);  // "lu", "gmres"

// How far a search has come. Beside fine meshes coarser ones count by themselves.
struct FlowProgress {
  int newton_step = 0;
  double residual = 0.0, cl = 0.0;
};

struct FlowOptions {
  // Boundaries that are open to the stream: the far field, which may have several parts. One alone need not
  // be there where there are openings.
  std::vector<std::string> farfield = {"farfield"};
  // Converged: the root of the sum of squares of all residuals is at most this part of what it is for
  // undisturbed flow through the same mesh, and lift and angle fit as well. 1e-13 to 1e-2.
  double tolerance = 1e-10;
  int max_steps = 200;  // Newton steps of one flow, 1 or more
  bool vortex = true;   // in the far field
  // A flow that is not found from another one (LivingFlow, solve_flow_from()) is looked for from nothing.
  bool retry_cold = true;
  // K: differences along an edge of length h below (K h / extent)^(3/2) are not limited; more than 0. The
  // extent is the largest distance between two bends of one connected wall, so that flows through meshes of
  // another size are the same: the chord of a section (of several elements that of the largest, wherever
  // they lie, and of half a section its own, without the line of symmetry), the curved part of a duct's
  // wall. Where no wall bends it is the longest wall's.
  double limiter = 30.0;
  // Factors may take this much memory. Where those of a sparse LU are estimated to take more, GMRES with
  // incomplete factors takes its place.
  double memory_mb = 4096;
  // How linear systems are solved. None: by GMRES far from a flow, where a matrix is solved with but once,
  // and by LU where its factors serve for several steps or designs, if GMRES fails, too.
  std::optional<FlowSolver> solver = {};
  StepObserver* observer = nullptr;      // asked at every step
  std::vector<FlowInlet> inlets = {};    // without a far field: at least one of each
  std::vector<FlowOutlet> outlets = {};  // their names are not of `farfield`, and not one twice
  // Boundaries beyond which the flow is its own mirror image: straight, along the stream, and no part of
  // forces, which are those of the bodies in the mesh. No lift can be asked for, and the far field has no
  // vortex. Names as those of outlets.
  std::vector<std::string> symmetry = {};
  // Beside those that the mesh is known to have (FrozenMesh::periodic). Inlets and outlets alone may end at
  // periodic boundaries; there are three rows of cells between them or more, and no far field.
  std::vector<FlowPeriod> periodic = {};
  std::function<void(const FlowProgress&)> on_step = {};  // called after each Newton step
  // With friction gas sticks to all walls, through which no heat passes where no temperature is given
  // (FlowConditions). Meshes should have layers of flat quadrilaterals there (remodel/layers.h).
  FlowModel model = FlowModel::euler;
  // Sutherland's law makes the viscosity of this temperature of the stream, in Kelvin: more than 0, or 0 for
  // a constant viscosity. Prandtl numbers are 0.72, and 0.9 of turbulence.
  double temperature_k = 300.0;
};

enum class FlowStatus {
  converged,
  step_limit,   // max_steps
  stalled,      // nothing leads on, neither straight, nor in stages from a scheme of first order, nor in
                // pseudo-time: a flow that has no steady state, or that this method does not find
  memory,       // even incomplete factors need more than memory_mb
  interrupted,  // by the observer
};
const char* name_of(FlowStatus status);  // "converged", "step-limit", "stalled", "memory", "interrupted"

// A start is what a flow was found from.
enum class FlowStart {
  cold,        // nothing that was known before: FlowOrigin says from what
  carried,     // the last flow, with the factors of an earlier one
  refactored,  // the last flow, with factors of its own
};
const char* name_of(FlowStart start);  // "cold", "carried", "refactored"

// The state that Newton's method began with, and found the flow from.
enum class FlowOrigin {
  last_flow,  // or the flow that was given
  potential,  // potential flow through the same mesh, with the density and pressure of the stream's entropy
  coarser_mesh,  // the flow through a coarser mesh of the same domain
  undisturbed,   // the stream
};
const char* name_of(FlowOrigin origin);  // "last-flow", "potential", "coarser-mesh", "undisturbed"

struct FlowBody {
  std::string name;  // of the boundary
  double cl = 0.0, cd = 0.0, cm = 0.0;
  // With friction: the parts of its drag, and the largest y+ of the cells at it.
  double cd_pressure = 0.0, cd_friction = 0.0, y_plus_max = 0.0;
};

// An opening says what passes an inlet or outlet. Means are by mass flow, over the edges of the opening.
struct FlowOpening {
  std::string name;
  // `mass_flow` is what enters, in density times speed of sound of the stream times length (of the mesh):
  // negative where gas leaves.
  double mass_flow = 0.0;
  double flow_angle_deg = 0.0;  // the direction of the mean momentum, to the x axis
  double total_pressure = 0.0;  // the mean, a part of the stream's
  double pressure = 0.0;        // likewise, of static pressure
  double mach = 0.0;            // the mean
};

// This is what friction does.
struct FlowFriction {
  double reynolds = 0.0;
  std::optional<std::array<double, 2>> transition = {};  // that was given
  double cd_pressure = 0.0, cd_friction = 0.0;           // the parts of the drag coefficient
  double y_plus_max = 0.0;
  // Walls with a temperature have these. `heat` is what all walls take from the gas in unit time, over the
  // stream's density times speed times specific enthalpy (cp times temperature) times the reference length;
  // negative where they warm the gas. `ch` has one value for each point of the frozen mesh: the same by the
  // wall's own length instead, 0 elsewhere. Over the gas's recovery temperature less the wall's, as parts of
  // the stream's, it is the Stanton number. Empty without a temperature.
  std::optional<double> wall_temperature = {};  // that was given
  double heat = 0.0;
  std::vector<double> ch = {};
  // Each has one value for each point of the frozen mesh. On walls: the friction, over half the stream's
  // density times speed squared, positive where it acts along the stream; and y+, of the lowest cell there. 0
  // elsewhere.
  std::vector<double> cf, y_plus;
  // Turbulent flow has turbulent viscosity over the molecular one there, and the working variable of the
  // model over the stream's kinematic viscosity, which solve_flow_from() begins with. Both are empty
  // otherwise.
  std::vector<double> viscosity_ratio, working;
};

struct FlowResult {
  FlowStatus status = FlowStatus::stalled;
  std::string reason;  // why it did not converge, one sentence; empty if it did
  bool converged() const { return status == FlowStatus::converged; }

  double mach = 0.0, alpha_deg = 0.0;
  double cl = 0.0, cd = 0.0, cm = 0.0;
  std::vector<FlowBody> bodies;  // the parts of each wall, which the sums are of
  // The drag coefficient by what entropy leaves through the far field; none without one. D. Destarac and J.
  // van der Vooren, Aerosp. Sci. Technol. 8 (2004).
  std::optional<double> entropy_drag = {};

  std::vector<FlowOpening> openings;  // inlets, then outlets

  // Each is a sentence on what has to be known before a coefficient is used: bodies whose lift is not
  // determined because they have no edge that the flow leaves from (below Mach 1), drag of more than ten
  // counts where nothing is faster than sound, which mesh and scheme make.
  std::vector<std::string> warnings;
  bool lift_determined = true;  // false: a body has no edge; lift and moment mean nothing then

  FlowStart start = FlowStart::cold;
  FlowOrigin origin = FlowOrigin::undisturbed;
  double residual = 0.0;        // as FlowOptions::tolerance counts it
  std::vector<double> history;  // residuals, from the first state on
  int newton_steps = 0;         // steps with a Jacobian of their own
  int factorisations = 0;       // of the whole matrix
  int coarse_steps = 0;         // of the Newton steps: on coarser meshes, and from starts that led nowhere
  int krylov_iterations = 0;    // steps with older factors
  std::size_t corrected_vertices = 0;  // where older factors were corrected because the mesh has changed
  FlowSolver solver = FlowSolver::lu;  // of the last step
  int gmres_iterations = 0;            // of all Newton steps
  double memory_mb = 0.0;              // of the factors and of GMRES's vectors, the most
  double seconds = 0.0;

  // Each has one value for each point of the frozen mesh.
  std::vector<double> density, velocity_x, velocity_y, pressure;

  FlowModel model = FlowModel::euler;
  std::optional<FlowFriction> friction = {};  // of models with it
};

// The loss coefficient of what passes from the only inlet to the only outlet: what total pressure falls by,
// over total less static pressure at the inlet, all means by mass flow. None where there are other openings,
// or the two mass flows differ by a thousandth, as with a far field.
std::optional<double> loss_coefficient(const FlowResult& flow);

// Each has one value for each point: the local Mach number; the pressure coefficient; p / rho^gamma over the
// stream's, minus 1, which is 0 where nothing is lost.
std::vector<double> mach_numbers(const FlowResult& flow);
std::vector<double> pressure_coefficients(const FlowResult& flow);
std::vector<double> entropy_errors(const FlowResult& flow);
// density, velocity, pressure, mach, cp and entropy, with friction also cf, y_plus, (turbulent)
// viscosity_ratio and (with a temperature of walls) ch, for files and pictures.
std::vector<Field> fields_of(const FlowResult& flow);

// The flow through a mesh, found from potential flow where there is one and up to Mach .75, otherwise from
// undisturbed flow.
// `source` names the mesh in messages.
FlowResult solve_flow(const FrozenMesh& mesh, const FlowConditions& conditions,
                      const FlowOptions& options = {}, const std::string& source = "mesh");

// This is the flow through Mesh::freeze(). From Mach 0.6 on, fine meshes (of 1,500 vertices and more) begin
// with the flow through a coarser mesh of the same domain, generated with every second station and half the
// gradation's G, which begins likewise; below, those of 4,000 and more do where potential flow does not lead
// on. Where the domain has open chains or that does not lead on either, they begin as above. Steps,
// factorisations, memory and seconds count coarser meshes too.
FlowResult solve_flow(const Mesh& mesh, const FlowConditions& conditions, const FlowOptions& options = {},
                      const std::string& source = "mesh");

// This begins with the flow through another mesh, interpolated. It makes one factorisation and uses it until
// the flow is found: the best that can be done where meshes are generated afresh.
FlowResult solve_flow_from(const FrozenMesh& before, const FlowResult& flow, const FrozenMesh& mesh,
                           const FlowConditions& conditions, const FlowOptions& options = {},
                           const std::string& source = "mesh");

// Derivatives of a function of the flow, where the flow follows: exact ones of the discrete equations, found
// by their adjoint.
struct FlowGradient {
  // These are derivatives by the coordinates of each point of the frozen mesh, at fixed connectivity.
  // MeshDerivative::vjp() (remodel/mesh_derivative.h) makes derivatives by the design of them.
  std::vector<Point> points;
  double mach = 0.0;
  double alpha_deg = 0.0;  // a degree; 0 where lift is given
  double cl = 0.0;         // by the lift that is given; 0 where the angle is
  double reynolds = 0.0;   // with friction
};

// A function of the flow, by its derivatives at fixed flow: of pressures, points and the Mach number, and of
// densities and velocities where these are not empty.
struct FlowFunctional {
  std::vector<double> pressure;  // per point of the frozen mesh, in the units of FlowResult::pressure
  std::vector<Point> points;     // likewise
  double mach = 0.0;
  std::vector<double> density = {}, velocity_x = {}, velocity_y = {};  // as pressure, or empty
};

// Which derivatives are wanted. Each takes a row of solves of its own.
struct WantedGradients {
  bool lift = true, drag = true, moment = true;
  bool angle = true;  // of the angle of attack, where lift is given
  bool entropy_drag = false;
  bool pressure_drag = true;  // of flows with friction, where that of drag is wanted
};

// The gradients are those of the last flow that was found. Where lift is given the angle of attack follows
// too: cl has no derivative but that by itself, and alpha_deg says how the angle follows.
struct FlowGradients {
  FlowGradient cl, cd, cm;    // empty if they were not wanted
  FlowGradient alpha_deg;     // of the angle, in degrees: 0 but by itself where it is given
  FlowGradient entropy_drag;  // empty if it was not wanted
  FlowGradient
      cd_pressure;  // with friction, if wanted: of the drag of pressure; the rest of cd's is friction's
  std::vector<FlowGradient> functions;  // that were asked for
  bool interrupted = false;             // by the observer: then there are none
  int factorisations = 0;               // 1 where the factors that there were did not serve
  int krylov_iterations = 0;
  double seconds = 0.0;
};

// A flow that a LivingFlow has found, to be gone on from later. Copies share what they hold.
class KeptFlow {
 public:
  bool empty() const { return flow_ == nullptr; }

 private:
  friend class LivingFlow;
  friend KeptFlow changed(const KeptFlow& flow, const KeptFlow& from, const KeptFlow& to);
  struct Flow;
  std::shared_ptr<const Flow> flow_;
};

// The flow, changed as another one has from `from` to `to`: on to's mesh, with what `to` has beyond `from` at
// each vertex. A start for a new shape at one condition, where the flows of both shapes at another condition
// are known. Throws Error (argument) where one is empty, or of another model.
KeptFlow changed(const KeptFlow& flow, const KeptFlow& from, const KeptFlow& to);

// A solver that outlives its mesh. It keeps the last flow and the factors of a matrix, by the keys of
// vertices, and uses both for the next flow, whatever was done to the mesh in between: older factors go on
// serving while most of the mesh is what it was, corrected by an exact solve where it is not. It factors
// again when that is cheaper (counted in operations, not in time), and begins cold when nothing else works;
// FlowResult::start says which it was. What it kept decides how long a flow takes and nothing else: the
// residual is of the mesh and conditions given.
//
// The meshes should be one living mesh, its copies, and trials on it; with any other mesh the result is the
// same, but later. The same row of calls gives the same bits.
class LivingFlow {
 public:
  explicit LivingFlow(const FlowOptions& options = {});
  ~LivingFlow();
  LivingFlow(LivingFlow&&) noexcept;
  LivingFlow& operator=(LivingFlow&&) noexcept;

  // Cold flows begin as those of solve_flow() of a Mesh do.
  FlowResult solve(const Mesh& mesh, const FlowConditions& conditions);
  // This takes Mesh::freeze(); cold flows begin without coarser meshes. Throws Error (argument) where
  // vertices have no keys.
  FlowResult solve(const FrozenMesh& mesh, const FlowConditions& conditions);
  // Gradients of the last flow that was found. They take the factors that there are, transposed, where these
  // serve; otherwise new ones, which the next flows have too. Throws Error (argument) before the first flow,
  // where functionals are of another size, and with friction for the drag of entropy and where there are
  // inlets or outlets. Neither the turbulence model nor distances from walls are frozen.
  FlowGradients gradients(const std::vector<FlowFunctional>& functions = {},
                          const WantedGradients& wanted = {});
  // The next flow is found cold.
  void forget();
  // The last flow that was found, without its factors; empty before the first one.
  KeptFlow keep() const;
  // The next flow begins with that one, as if it had been the last, with the factors that there are. Where
  // flows are not unique it decides which of them is found. Nothing happens if it is empty. Throws Error
  // (argument) where it is of another model.
  void go_on_from(const KeptFlow& kept);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace remodel
