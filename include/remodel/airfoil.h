#pragma once

// Airfoils by class-shape transformation (CST). Source: the paper's section 4.1; B. Kulfan, "Universal
// Parametric Geometry Representation Method", 2008. Lengths are in chords.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "remodel/point.h"

namespace remodel {

// y(x) of each surface is C(x) S(x) + x * te, with the class function C(x) = x^e1 (1-x)^e2 and the shape
// function S(x) = sum of coefficient_i * Bernstein_{i,n}(x). upper and lower have the same size n + 1 >= 2;
// e1 and e2 are positive.
struct CstAirfoil {
  std::vector<double> upper;
  std::vector<double> lower;
  double e1 = 0.5;
  double e2 = 1.0;
  double te_upper = 0.0;  // y of the upper surface's trailing edge
  double te_lower = 0.0;

  int degree() const { return static_cast<int>(upper.size()) - 1; }

  // The paper's airfoil function a(t), t in [0,1]: counter-clockwise from the trailing edge (t = 0) over the
  // upper surface (t < 1/2), the leading edge (t = 1/2) and the lower surface back to the trailing edge.
  // x = (1 + cos 2 pi t) / 2. at(t) and at(1-t) have the same x to the last bit; x is exactly 1 at t = 0 and
  // t = 1, exactly 0 at t = 1/2. For the paper's exponents the bits are the same on every machine.
  Point at(double t) const;

  friend bool operator==(const CstAirfoil&, const CstAirfoil&) = default;
};

// A station says where parameter t lies, and holds the row that gives y as a dot product. The row depends on
// t, the degree and the class exponents only, so a boundary vertex that is evaluated for thousands of designs
// keeps it.
struct CstStation {
  double x = 0.0;
  bool upper = true;
};
// Fills row (degree + 1 values): class function times Bernstein polynomials at the station of t.
CstStation cst_basis(double t, int degree, double e1, double e2, std::span<double> row);
// y at a station. CstAirfoil::at is made of these two calls, so cached rows give the same bits.
double cst_height(const CstAirfoil& airfoil, CstStation station, std::span<const double> row);

// Thickness and camber, for people: the largest values over x and where they are. Thickness is upper minus
// lower at the same x; camber is the mean of both (signed, the one of largest magnitude).
struct Extreme {
  double value = 0.0;
  double at = 0.0;
};
Extreme max_thickness(const CstAirfoil& airfoil);
Extreme max_camber(const CstAirfoil& airfoil);

// True where upper(x) > lower(x) for every x in (0,1), also in the limit at the leading edge; decided on the
// Bernstein coefficients of the difference by subdivision, not by sampling. A trailing edge may close with
// zero angle. For te_upper != te_lower: te_upper > te_lower is needed as well, and the test is by Bernstein
// bounds of the sum. False also for coefficients that are not finite.
bool surfaces_apart(const CstAirfoil& airfoil);

// A frame says where the chord of a section lies in the coordinates of its file, and so what became of them.
// The nose was moved to the origin, the section was turned about it until its trailing edge (midpoint of the
// two ends) lay on the x axis, and it was scaled to a chord of 1.
struct AirfoilFrame {
  Point nose = {};
  double chord = 1.0;
  Point axis = {1.0, 0.0};  // of length 1, from the nose to the trailing edge
  // y per x that was taken off besides: of sections that are drawn straight, their digits' rounding; of NACA
  // sections, whose foremost point is not where their mean line begins, up to 0.01.
  double shear = 0.0;
  double closed =
      0.0;  // the gap of the trailing edge, in chords, that was closed as rounding; crossed: below 0

  double incidence_deg() const;  // at which the section is drawn, nose up; to 1e-9 degrees
};

// A coordinate file as read: surfaces from leading edge to trailing edge, in the frame of its chord.
//
// CST is y over x with a vertical tangent at the nose, so the nose is the point farthest from the trailing
// edge on a smooth curve through the points (the middle one of a flat nose), whether one of them lies there
// or not; both surfaces begin with it. Where the trailing edge lies straight behind the foremost point, up to
// 1e-5 chords, that is the nose. Nothing is distorted. x is in [0,1], but for a trailing edge that is cut at
// an angle, which may reach beyond 1.
struct AirfoilCoordinates {
  std::string name;
  std::vector<Point> upper;
  std::vector<Point> lower;
  AirfoilFrame frame = {};
  // Sentences on what was done beyond rounding: turned by 0.1 degrees or more, scaled or moved by 1 % of the
  // chord, a column left out, a crossed trailing edge; each begins with the file's name.
  std::vector<std::string> warnings = {};
};
// Reads Selig, Lednicer, MSES, OpenFAST and OpenVSP (.af) files, found by content. Accepts CRLF, byte order
// marks, blank lines, comment lines (#, !, %), spaces, tabs, commas and semicolons between numbers, decimal
// commas, three columns of which one is the same everywhere, numbers such as -.0228, open and closed trailing
// edges, outlines that begin anywhere and run either way, and lines of text before and after the coordinates:
// the first line is the name. A point that is there twice in a row counts once, ends that are closer than
// 1e-5 chords are one. At most 16 MiB. Throws Error (file, format) naming file and line, also for files of
// another kind, which it names, for several elements, fewer than 3 points a surface, x that turns back,
// surfaces that cross, ends that do not meet in x. read_airfoil() of remodel/shape_files.h reads a file.
AirfoilCoordinates parse_airfoil(std::string_view text, const std::string& source);

// parse_outlines() reads the same files as closed outlines of any shape, one for each element, in the
// coordinates of the file. They run counter-clockwise from the upper end of the trailing edge, which is the
// last point too where it is closed.
struct AirfoilOutline {
  std::string name;
  std::vector<Point> points;
  AirfoilFrame frame = {};
  double gap = 0.0;  // between the first and the last point, in chords
};
struct AirfoilOutlines {
  std::vector<AirfoilOutline> elements;
  std::vector<std::string> warnings;  // as above
};
AirfoilOutlines parse_outlines(std::string_view text, const std::string& source);
// The surfaces of one of them. Throws Error (format) as parse_airfoil() does.
AirfoilCoordinates surfaces_of(const AirfoilOutline& outline, const std::string& source);

// This says what a fit does with a trailing edge that is open: te_upper and te_lower are the file's, or 0. A
// gap of less than 1e-5 chords, or a crossed one, is the rounding of the file's digits: that is closed in any
// case.
enum class TrailingEdge { kept, closed };

// Least squares at the file's points, both surfaces apart; the coefficients are of what the gap, removed
// linearly in x, leaves.
struct CstFit {
  CstAirfoil airfoil;
  double max_error = 0.0;  // largest and root-mean-square distance in y at the file's points, in chords
  double rms_error = 0.0;
  double gap = 0.0;                        // the file's own: of its upper end over its lower one, in chords
  AirfoilFrame frame = {};                 // of the coordinates
  std::vector<std::string> warnings = {};  // of the coordinates, and of another degree than the one asked for
};
// degree: 2 to 12. Throws Error (argument), also where a surface has fewer points between its edges than
// coefficients.
CstFit fit_cst(const AirfoilCoordinates& coordinates, int degree,
               TrailingEdge trailing_edge = TrailingEdge::kept);
// This is fit_cst() with the first degree whose surfaces are apart: the given one, those above it, those
// below it. Where there is none, it is the fit of the given one, whose surfaces cross.
CstFit fit_cst_apart(const AirfoilCoordinates& coordinates, int degree,
                     TrailingEdge trailing_edge = TrailingEdge::kept);

// NACA sections that exist in closed form, as dense points: 4-digit ("2412") and 5-digit ("23012", reflexed
// "23112" too) with the closed trailing edge coefficient (-0.1036); both also modified ("0012-64"), whose
// trailing edge is open by a fiftieth of the thickness; 6- and 6A-series ("63-206", "65(1)-412", "64A010",
// "63-206 a=.8") by Ladson's approximation (docs/guide.md has how near that is). Throws Error (argument) for
// other designations. Sources: naca.cpp.
AirfoilCoordinates naca_airfoil(std::string_view digits);

// The built-in catalogue: the paper's ten airfoils as fitted coefficients.
struct CatalogueEntry {
  std::string_view name;         // e.g. "rae2822": what the command line takes
  std::string_view description;  // e.g. "RAE 2822"
  int degree;
  std::vector<double> upper;
  std::vector<double> lower;
  double fit_max_error;  // in chords
  double fit_rms_error;
  CstAirfoil airfoil() const { return {.upper = upper, .lower = lower}; }
};
const std::vector<CatalogueEntry>& airfoil_catalogue();

// A section by name: "naca:2412", fitted with that degree, 2 to 12, or a name of the catalogue, whose own
// degree is 5, as with_degree() has it. Throws Error (argument), which lists the names. load_airfoil() of
// remodel/shape_files.h takes files too.
CstAirfoil named_airfoil(const std::string& name, int degree);
// The .json of `remodel fit`: degree, upper[], lower[], e1, e2, te_upper, te_lower (the last four optional),
// exact. from_json ignores name, max_error, rms_error, thickness and camber, which `remodel fit` reports
// beside them, and throws Error (format) naming the key for any other key, kind, size or range. to_json
// throws Error (argument) for what is not finite.
std::string airfoil_to_json(const CstAirfoil& airfoil);
CstAirfoil airfoil_from_json(std::string_view text, const std::string& source);

}  // namespace remodel
