#pragma once

// A domain: the part of the plane to be meshed, bounded by closed loops of named, parametrised curves. The
// airfoil in its farfield is one case. Knows no mesh.

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "remodel/airfoil.h"
#include "remodel/point.h"

namespace remodel {

// Curves are plain values; each maps t in [0,1] to a point.
struct Line {
  Point from, to;
  friend bool operator==(const Line&, const Line&) = default;
};
// Through points[0] ... points[n-1], uniform in t per piece.
struct Polyline {
  std::vector<Point> points;
  friend bool operator==(const Polyline&, const Polyline&) = default;
};
// Counter-clockwise for a positive sweep; angles in radians.
struct Arc {
  Point centre;
  double radius = 1.0;
  double start = 0.0;
  double sweep = 6.283185307179586;
  friend bool operator==(const Arc&, const Arc&) = default;
};
using Shape = std::variant<CstAirfoil, Line, Polyline, Arc>;

Point point_at(const Shape& shape, double t);

// One curve of a loop. name becomes the boundary marker of the mesh ("airfoil", "farfield", "inlet"); several
// curves may share it. parameters is the initial discretisation, strictly increasing from 0, the curve's end
// (1) left out: it is the first point of the loop's next curve.
struct Curve {
  std::string name;
  Shape shape;
  std::vector<double> parameters;
  friend bool operator==(const Curve&, const Curve&) = default;
};

// Which side of the loop is meshed, whatever its orientation.
enum class LoopRole { outer, hole };

struct Loop {
  LoopRole role = LoopRole::outer;
  std::vector<Curve> curves;
  friend bool operator==(const Loop&, const Loop&) = default;
};

// One vertex of the discretised boundary.
struct BoundaryStation {
  std::size_t curve = 0;  // index over all curves of all loops, in order
  double t = 0.0;
  friend bool operator==(const BoundaryStation&, const BoundaryStation&) = default;
};

struct Domain {
  std::vector<Loop> loops;

  std::size_t curve_count() const;
  const Curve& curve(std::size_t index) const;  // by index over all loops
  std::size_t loop_of(std::size_t curve_index) const;
  Point at(BoundaryStation station) const { return point_at(curve(station.curve).shape, station.t); }
  // The stations of one loop in order, and their points.
  std::vector<BoundaryStation> stations(std::size_t loop) const;

  friend bool operator==(const Domain&, const Domain&) = default;
};

// Throws Error (geometry) unless there is a loop, every loop has at least three distinct consecutive points,
// parameters begin with 0 and increase strictly below 1, every curve ends where the next one of its loop
// begins (up to rounding), coordinates are finite and in the range of predicates.h, and no two segments of
// the discretised loops cross, touch or overlap (exactly decided; names the loop, the curve and the place).
// Airfoils must have their surfaces apart. From the outside in, roles take turns: outermost loops are outer,
// what lies directly inside an outer loop is a hole, what lies directly inside a hole is outer again. Loops
// may run either way round. About n log n: 0.2 ms for 700 airfoil points.
void validate(const Domain& domain);

// Signed area of the discretised loop, positive for counter-clockwise.
double signed_area(const Domain& domain, std::size_t loop);

// True where both domains have the same loops, roles, curves, names, parameters and kinds of shape, so that
// vertices correspond one to one (the premise of the specialised method, section 4.2).
bool one_to_one(const Domain& a, const Domain& b);

// The paper's case: an airfoil of `points` vertices, x = (1 + cos 2 pi t)/2 at t = i/points, in a circle
// about (0.5, 0). Loop 0 is the airfoil, loop 1 the farfield, both counter-clockwise. Names: "airfoil",
// "farfield". An open trailing edge adds a line of the name "airfoil" to loop 0, from the lower to the upper
// end. Throws Error (argument) for options out of range and for a farfield that does not contain the airfoil;
// does not validate().
struct AirfoilDomainOptions {
  int points = 200;             // I: even, 8 to 100000
  double farfield_radius = 25;  // chords, more than 1
  int farfield_points = 50;     // 8 to 100000
};
Domain airfoil_domain(const CstAirfoil& airfoil, const AirfoilDomainOptions& options = {});

// JSON text of a domain, exact; the layout is described in src/shape/domain_json.cpp. from_json throws Error
// (format) naming the key; it does not validate(). to_json throws Error (argument) for what is not finite.
std::string domain_to_json(const Domain& domain);
Domain domain_from_json(std::string_view text, const std::string& source);

}  // namespace remodel
