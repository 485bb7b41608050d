#pragma once

// Deformations of a domain as it is given: what a design may move where a section is no CstAirfoil, or the
// domain has no section at all: outlines with coves and flat backs, ducts, cascades.
//
//   Deformation shape{.domain = domain, .parts = {FreeFormBox{.on = "airfoil", .low = {0.6, -0.1},
//                                                             .high = {1.1, 0.1}, .hold = {.left = 2}}}};
//
// A design has one number, 0 at the start, for each variable of each part, in the order of the parts. A
// variable moves given points of curves (of splines, polylines, and the ends of lines) in proportion to it,
// and so does the sum of all: x = x0 + B a with a fixed matrix B. The curves go through the points that have
// moved, stations keep their parameters. Where a point is the end of two curves both follow. At 0 the domain
// is the given one, to the bit. Lengths are those of the curves, before the placement of their loop.

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "remodel/domain.h"

namespace remodel {

// Which coordinates of a point are variables: in this order where it is both.
enum class Moves { y, x, xy };
const char* name_of(Moves moves);  // "y", "x", "xy"

// All parts have these: how far a variable may go, in its own unit, from 0 on (none: as far as
// DesignProblem::bounds), and what the design divides it by.
struct DeformationRange {
  std::optional<std::array<double, 2>> bounds = {};  // lowest, not above 0, and highest, not below 0
  double scale = 1.0;                                // 1e-6 to 1e6
};

// A box whose control points lie evenly in it, `columns` along x and `rows` along y. What lies within moves
// by the sum of their displacements, each times its Bernstein polynomials (T. W. Sederberg and S. R. Parry,
// SIGGRAPH 1986). A variable is the displacement of one control point; the rows and columns that are held
// have none. With 1 of a side held the curve stays continuous where it enters the box there, with 2 its
// slope does. It may enter through sides that are held alone. Variables: "airfoil.box[column,row].y", from 0,
// the left one and the lowest one.
struct FreeFormBox {
  std::string on;  // the name of curves
  Point low, high;
  std::size_t columns = 4, rows = 2;  // 2 to 30 each
  struct Hold {
    std::size_t left = 0, right = 0, bottom = 0, top = 0;
  };
  Hold hold = {};
  Moves moves = Moves::y;
  DeformationRange range = {};
};

// Bumps on a surface of a section, the closed loop of curves of one name: in y, of height
// sin^width(pi x^(ln 0.5 / ln peak)) times the variable, x in chords from the foremost to the rearmost point
// (R. M. Hicks and P. A. Henne, J. Aircraft 15, 1978). Variables: "airfoil.upper[0.3]".
struct HicksHenneBumps {
  std::string on;
  bool upper = true;
  std::vector<double> peaks;  // in chords, 0.001 to 0.999
  double width = 3.0;         // the larger the narrower, 1 to 20
  DeformationRange range = {};
};

// Points that a curve goes through, by their place in it from 0. Variables: "wall[3].y".
struct CurvePoints {
  std::string on;  // the name of one spline or polyline
  std::vector<std::size_t> points;
  Moves moves = Moves::y;
  DeformationRange range = {};
};

using DeformationPart = std::variant<FreeFormBox, HicksHenneBumps, CurvePoints>;

struct Deformation {
  Domain domain;
  std::vector<DeformationPart> parts;
};

// Puts splines in the place of the airfoils (CstAirfoil) of that name, so that deformations can move them:
// each goes through its airfoil's stations, which stay, and through points between them, 200 or more in all.
// Says whether there was one.
bool splines_for_airfoils(Domain& domain, const std::string& name);

}  // namespace remodel
