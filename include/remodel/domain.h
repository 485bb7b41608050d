#pragma once

// A domain: the part of the plane to be meshed, bounded by closed loops of named, parametrised curves, with
// open chains and internal curves where there are any. The airfoil in its farfield is one case. Knows no
// mesh.

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "remodel/airfoil.h"
#include "remodel/error.h"
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
// The cubic spline through points[0] ... points[n-1], twice continuously differentiable, parametrised by
// chord length: t of a point is the length of the polygon up to it over its whole length. Natural at its
// ends; closed (last point == first point) it is periodic. Made by spline_through(); the vectors below points
// follow from them.
struct Spline {
  std::vector<Point> points;
  std::vector<double> knots;  // per point: its t; 0 to 1
  std::vector<Point> second;  // per point: the second derivative by t
  bool corner = false;        // closed, with a corner where it begins: natural there
  friend bool operator==(const Spline&, const Spline&) = default;
};
// Throws Error (argument) for fewer than 2 points (closed: 4, the first one again at the end), points that
// repeat in a row, and what is not finite. corner: see Spline; without effect where it is open. Source: C. de
// Boor, "A Practical Guide to Splines", 1978, ch. IV.
enum class SplineEnds { smooth, corner };
Spline spline_through(std::vector<Point> points, SplineEnds ends = SplineEnds::smooth);

using Shape = std::variant<CstAirfoil, Line, Polyline, Arc, Spline>;

Point point_at(const Shape& shape, double t);

// A list of numbers that its copies share, so that a copied domain, of which a design changes one loop, is
// compared with the original without a look at all stations of the others. Otherwise like a const vector.
class Parameters {
 public:
  Parameters() = default;
  Parameters(std::vector<double> values)
      : values_(std::make_shared<const std::vector<double>>(std::move(values))) {}
  Parameters(std::initializer_list<double> values) : Parameters(std::vector<double>(values)) {}
  static Parameters uniform(std::size_t pieces);  // i / pieces, from 0

  operator const std::vector<double>&() const { return values_ ? *values_ : none(); }
  const std::vector<double>& values() const { return *this; }
  std::size_t size() const { return values().size(); }
  bool empty() const { return values().empty(); }
  double operator[](std::size_t i) const { return values()[i]; }
  double front() const { return values().front(); }
  double back() const { return values().back(); }
  std::vector<double>::const_iterator begin() const { return values().begin(); }
  std::vector<double>::const_iterator end() const { return values().end(); }
  friend bool operator==(const Parameters& a, const Parameters& b) {
    return a.values_ == b.values_ || a.values() == b.values();
  }

 private:
  static const std::vector<double>& none() {
    static const std::vector<double> empty;
    return empty;
  }
  std::shared_ptr<const std::vector<double>> values_;
};

// One curve of a loop. name becomes the boundary marker of the mesh ("airfoil", "farfield", "inlet"); several
// curves may share it. parameters is the initial discretisation, strictly increasing from 0, the curve's end
// (1) left out: it is the first point of the loop's next curve.
struct Curve {
  std::string name;
  Shape shape;
  Parameters parameters;
  friend bool operator==(const Curve&, const Curve&) = default;
};

// The side of the loop that is meshed. For outer loops and holes that does not depend on their orientation.
enum class LoopRole {
  outer,     // the inside
  hole,      // the outside
  internal,  // both sides: a constraint inside the domain
  left,      // the left side of its direction, the right one is outside: a piece of a boundary, or a loop
  right
};
const char* name_of(LoopRole role);  // "outer", "hole", "internal", "left", "right"

// A placement says where the curves of a loop lie: scaled by chord, turned counter-clockwise about their
// origin (an airfoil's leading edge), which comes to lie at position. As it stands it changes no bit.
struct Placement {
  double chord = 1.0;
  double rotation_deg = 0.0;
  Point position = {};
  friend bool operator==(const Placement&, const Placement&) = default;
};
// A placement, ready for many points.
class Frame {
 public:
  explicit Frame(const Placement& placement);
  Point operator()(Point p) const {
    if (identity_) return p;
    return origin_ + Point{axis_.x * p.x - axis_.y * p.y, axis_.y * p.x + axis_.x * p.y};
  }

 private:
  Point axis_, origin_;
  bool identity_;
};

// Curves that follow each other: a closed loop, or an open chain. A chain runs from its first curve's
// beginning to its last curve's end, which is a station too. Its role is internal, left or right. Ends of
// chains may lie on stations of other loops and chains (and on each other): there they are joined. An open
// chain of one Line of no length is a single point.
struct Loop {
  LoopRole role = LoopRole::outer;
  std::vector<Curve> curves;
  bool open = false;
  Placement placement = {};
  // The name of the region beside it, where a domain has several: of an internal loop or chain on the left of
  // its direction, of others on the side of the domain; and what an internal one has on its right.
  std::string region = {};
  std::string right_region = {};
  friend bool operator==(const Loop&, const Loop&) = default;
};
bool is_single_point(const Loop& loop);  // one chain of one Line of no length

// One vertex of the discretised boundary.
struct BoundaryStation {
  std::size_t curve = 0;  // index over all curves of all loops, in order
  double t = 0.0;
  friend bool operator==(const BoundaryStation&, const BoundaryStation&) = default;
};

// The names of two curves of which one is the other moved, by a period, as below and above the passage
// between two blades of a row. Where several curves have the names, they correspond in their order or in the
// reverse one. They have corresponding stations, and refinement splits them alike, so that every vertex on
// one of them has its counterpart on the other.
struct PeriodicPair {
  std::string name, moved;
  friend bool operator==(const PeriodicPair&, const PeriodicPair&) = default;
};

struct Domain {
  std::vector<Loop> loops;
  std::vector<PeriodicPair> periodic = {};

  std::size_t curve_count() const;
  const Curve& curve(std::size_t index) const;  // by index over all loops
  std::size_t loop_of(std::size_t curve_index) const;
  Point at(BoundaryStation station) const;
  // The stations of one loop in order, and their points: the same, but for a search less.
  std::vector<BoundaryStation> stations(std::size_t loop) const;
  std::vector<Point> points(std::size_t loop) const;

  friend bool operator==(const Domain&, const Domain&) = default;
};

// One curve and its counterpart.
struct PeriodicCurve {
  std::size_t curve, moved;  // indices over all curves
  bool reversed;             // they run against each other, as those of one outer loop do
  Point period;
  double parameter(double t) const { return reversed ? 1.0 - t : t; }  // on the counterpart
};
// periodic_curves() has those of all pairs. It throws Error (geometry) where a name is missing, a curve is
// not the other one moved (to 1e-9), or stations do not correspond.
std::vector<PeriodicCurve> periodic_curves(const Domain& domain);

// Throws Error (geometry) unless there is a loop, every closed loop has at least three distinct consecutive
// points, parameters begin with 0 and increase strictly below 1, every curve ends where the next one of its
// loop begins (up to rounding), coordinates are finite and in the range of predicates.h, and no two segments
// of the discretised loops cross, touch or overlap, but for the ends of open chains on other stations
// (exactly decided; names the loop, the curve and the place). Airfoils must have their surfaces apart. Among
// outer loops and holes roles take turns from the outside in: outermost loops are outer, what lies directly
// inside an outer loop is a hole, what lies directly inside a hole is outer again. Where boundaries are made
// of chains (left, right), it is generate() that finds sides that contradict each other. Periodic curves are
// each other's counterparts (periodic_curves()). Loops may run either way round. About n log n: 0.2 ms for
// 700 airfoil points.
void validate(const Domain& domain);
// This is validate(domain), but its errors begin with the file that the domain is from.
void validate(const Domain& domain, const std::string& source);

// Errors name this where a domain is from no file. from_file() is such an error with its file instead.
inline constexpr const char* nameless_domain = "domain";
Error from_file(const Error& error, const std::string& source);

// Signed area of the discretised loop, positive for counter-clockwise.
double signed_area(const Domain& domain, std::size_t loop);

// True where both domains have the same loops, roles, curves, names, parameters and kinds of shape, so that
// vertices correspond one to one (the premise of the specialised method, section 4.2). Placements may differ,
// and the ends of chains may be joined otherwise.
bool one_to_one(const Domain& a, const Domain& b);
bool one_to_one(const Loop& a, const Loop& b);

// The paper's case: an airfoil of `points` vertices, x = (1 + cos 2 pi t)/2 at t = i/points, in a circle
// about (0.5, 0), or elsewhere. Loop 0 is the airfoil, loop 1 the farfield, both counter-clockwise. Names:
// "airfoil", "farfield". An open trailing edge adds a line of the name "airfoil" to loop 0, from the lower to
// the upper end. Throws Error (argument) for options out of range and for a farfield that does not contain
// the airfoil; does not validate().
struct AirfoilDomainOptions {
  int points = 200;             // I: even, 8 to 100000
  double farfield_radius = 25;  // chords, more than 1
  int farfield_points = 50;     // 8 to 100000
  Point farfield_centre = {0.5, 0.0};
  // The part of the points, 0 to 0.9, whose density follows the turning of the surface; the others have
  // cosine spacing. 0.2 puts twice as many around noses, which flows at high lift need. It depends on the
  // shape: designs of one mesh keep the parameters of the first. None: 0, and where files or design problems
  // have several airfoils turning_share_of_elements.
  std::optional<double> turning_share = std::nullopt;
};
inline constexpr double turning_share_of_elements = 0.2;
Domain airfoil_domain(const CstAirfoil& airfoil, const AirfoilDomainOptions& options = {});

// Several airfoils in one farfield, each a loop of its own name and place, `points` vertices each; the
// farfield is the last loop. One airfoil "airfoil" at no other place is airfoil_domain(). Throws as it does.
struct PlacedAirfoil {
  std::string name = "airfoil";
  CstAirfoil airfoil;
  Placement placement = {};
  std::vector<Curve> outline = {};  // where there is one, in place of the airfoil: see outline_of()
};
// An outline as it is given, without a fit: curves through its points, which are its stations; the first one
// may be there again as the last, otherwise a line closes the outline. Splines have corners where the outline
// bends by more than 40 degrees, but for the nose, which few points may draw. 4 points or more.
enum class OutlineCurve { spline, polyline };
std::vector<Curve> outline_of(const std::vector<Point>& points, OutlineCurve curve, const std::string& name);
Domain airfoils_domain(const std::vector<PlacedAirfoil>& airfoils, const AirfoilDomainOptions& options = {});

// Finds the airfoil that a name in a domain's JSON text stands for, fitted with the degree and the trailing
// edge where it is given by points. A whole loop keeps an open trailing edge, a curve among others is closed.
// It may throw Error.
using AirfoilResolver =
    std::function<CstAirfoil(const std::string& name, int degree, TrailingEdge trailing_edge)>;
// JSON text of a domain, exact; docs/domains.md describes the layout with an example of each kind. from_json
// throws Error (format) naming the key, also for airfoils by name where there is no resolver; it does not
// validate(). to_json throws Error (argument) for what is not finite.
std::string domain_to_json(const Domain& domain);
Domain domain_from_json(std::string_view text, const std::string& source,
                        const AirfoilResolver& resolve = nullptr);
// True if a JSON text is meant to be a domain, rather than an airfoil: it has the key "loops". Throws Error
// (format) where it is no JSON.
bool holds_domain(std::string_view text, const std::string& source);

}  // namespace remodel
