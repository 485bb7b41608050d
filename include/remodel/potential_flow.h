#pragma once

// Plane potential flow around bodies on a mesh: lift and pressures in milliseconds, without drag, and a first
// guess for more. The fluid is incompressible; what a subsonic Mach number does to pressures and forces
// follows by rule.
//
// Units: the free stream has speed 1 and density 1, lengths are those of the mesh (chords). The free stream
// comes from the left and rises with the angle of attack. cp = 1 - speed^2. Coefficients are forces over half
// the reference length; lift is across the free stream, the moment raises the nose (is clockwise) where it is
// positive.
//
// Method: the stream function, linear on triangles (quadrilaterals are split), constant on each body, on the
// far field that of the free stream with a vortex in each body. A body with a trailing edge, sharp or blunt,
// has the circulation with which the flow leaves it smoothly (Kutta); others have none. Circulations and
// speeds on walls come from consistent fluxes. P. M. Gresho and R. L. Sani, "Incompressible Flow and the
// Finite Element Method", 1998, sec. 3.13 (fluxes).
//
// With a Mach number, pressures are those of the incompressible flow by the rule of T. von Karman and H.-S.
// Tsien (J. Aeronaut. Sci. 6, 1939, p. 399), forces by pressure their sums, and the lift by circulation
// follows Glauert's rule (Proc. R. Soc. A 118, 1928, p. 113). Both hold while the flow is subsonic
// everywhere: see supersonic.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "remodel/field.h"
#include "remodel/frozen_mesh.h"

namespace remodel {

struct PotentialOptions {
  // The names of the outer boundary, which is one loop; every other one is of a body.
  std::vector<std::string> farfield = {"farfield"};
  Point reference = {0.25, 0.0};  // the moment's
  double reference_length = 1.0;
};

struct WallValue {
  std::uint32_t vertex;
  Point point;
  double speed;  // along the wall, in the direction of the wall's vertices; of the incompressible flow
  double cp;
};

struct BodyFlow {
  std::string name;  // of its boundary; several are joined by '+'
  // The domain on the left: a body's are clockwise. Those of the trailing edge come first, from its upper to
  // its lower corner where it is blunt, with the mean speed of their neighbours: at a sharp edge the flow is
  // at rest in a part smaller than any triangle, behind a blunt one it is no potential flow.
  std::vector<WallValue> wall;
  // A corner of less than 60 degrees, or a base of at most 3 % of the outline between two corners.
  bool trailing_edge = false;
  double circulation = 0.0;  // clockwise
  double stream_function = 0.0;
  double lift = 0.0, drag = 0.0, moment = 0.0;  // by pressure; the drag is an error of the mesh
};

// The pressure coefficient of a gas (ratio of specific heats 1.4) where that of an incompressible fluid is
// `cp`, by the rule of von Karman and Tsien; not below that of a vacuum. mach is at least 0 and less than 1.
double compressible_cp(double cp, double mach);
// The pressure coefficient where the gas is as fast as sound; minus infinity at rest.
double sonic_cp(double mach);

struct PotentialFlow {
  double alpha_deg = 0.0;
  double mach = 0.0;
  bool supersonic = false;  // on a wall, by its pressure: the rules do not hold for such a flow
  double lift = 0.0;        // by circulation, of all bodies
  double lift_by_pressure = 0.0, drag_by_pressure = 0.0, moment = 0.0;
  std::vector<BodyFlow> bodies;
  std::vector<double> stream_function;  // per vertex
  std::vector<Point> velocity;          // per vertex
  // Each is a sentence on what has to be known before a coefficient is used: bodies whose lift is not
  // determined because they have no edge that the flow leaves from, meshes too coarse, rules that do not
  // hold.
  std::vector<std::string> warnings;
  bool lift_determined = true;  // false: a body has no edge; lift and moment mean nothing then

  // cp, and of the incompressible flow speed, stream_function and velocity, for files and pictures.
  std::vector<Field> fields() const;
};

// Solves for two angles and combines them: the flow at another angle costs no more than its arrays.
class PotentialSolver {
 public:
  // Throws Error (argument) naming `source` for a mesh without a far field around everything, without a
  // body, with edges of no named boundary, with boundaries that touch, overlapping or inverted triangles.
  explicit PotentialSolver(const FrozenMesh& mesh, const PotentialOptions& options = {},
                           const std::string& source = "mesh");
  ~PotentialSolver();
  PotentialSolver(PotentialSolver&&) noexcept;
  PotentialSolver& operator=(PotentialSolver&&) noexcept;

  // This takes the same triangles with their vertices at other points, as after a full adjustment of the
  // mesh. It is faster than a new solver, because the order of elimination is kept, and gives the same bits.
  // Throws Error (argument) for another number of points and inverted triangles; nothing has changed then.
  void move(const std::vector<Point>& points);

  // Throws Error (argument) unless |alpha| is at most 90 degrees, and mach at least 0 and less than 1.
  PotentialFlow at(double alpha_deg, double mach = 0.0) const;
  // The angle nearest to zero with that lift by circulation. Throws Error (argument) if none up to 90 degrees
  // has it.
  double alpha_deg_for(double lift, double mach = 0.0) const;

 private:
  struct Solution;
  std::unique_ptr<Solution> solution_;
};

}  // namespace remodel
