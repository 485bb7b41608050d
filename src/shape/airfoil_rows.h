#pragma once

// A coordinate file as rows of numbers, an element after the other, and what became of them: the steps
// between text and surfaces.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "remodel/airfoil.h"

namespace remodel {

struct AirfoilRow {
  Point point;
  int line = 0;  // of the file, from 1
};
using AirfoilRowList = std::vector<AirfoilRow>;

// The rows of one element in the order of the file. first_surface: where the file lists two surfaces one
// after the other, both from the leading edge, the number of rows of the first one; otherwise 0.
struct AirfoilElement {
  AirfoilRowList rows;
  std::size_t first_surface = 0;
};

struct AirfoilText {
  std::string name;  // empty where the file has no name line
  std::vector<AirfoilElement> elements;
  std::vector<std::string> notes;  // sentences on what was read otherwise than it stands there
};

// Longer texts are no airfoils.
inline constexpr std::size_t airfoil_text_limit = std::size_t{16} << 20;

// The lines. Throws Error (format) for the first line that is not what a coordinate file may hold, and for
// what is a file of another kind, which it names.
AirfoilText read_airfoil_rows(std::string_view text, const std::string& source);

// Throws Error (format) where a text is of another kind, by how such files begin: a document, a mesh, a
// polar.
void refuse_other_kinds(std::string_view text, const std::string& source);

// Twice the area of the polygon, positive where it is counter-clockwise.
double twice_area_of(const AirfoilRowList& rows);

// A closed outline, counter-clockwise, without repetitions: from the upper end of the trailing edge around
// the leading edge to its lower end, which is the first point again where the edge is closed.
struct AirfoilLoop {
  AirfoilRowList rows;
  double gap = 0.0;     // between the ends as the file has them, negative where they are crossed
  bool closed = false;  // by us: a gap of rounding
};
// Whatever point the file begins with, and whichever way it runs. Throws Error (format) for fewer than 3
// points and for what encloses nothing.
AirfoilLoop loop_of_element(const AirfoilElement& element, const std::string& source);
// Without the points that draw the base of a blunt trailing edge, from which the surfaces of a fit begin.
AirfoilLoop without_base(AirfoilLoop loop);

// The frame of a loop without its base, and the points beside its nose, which are one where it is on a point.
struct AirfoilNose {
  AirfoilFrame frame;
  std::size_t before = 0, after = 0;
};
// The nose is the point farthest from the trailing edge on a smooth curve through all points: through the arc
// around the nose, whether there is a point on it or not. Where the trailing edge lies straight behind the
// foremost point, the file says itself where its nose is: there.
AirfoilNose nose_of(const AirfoilRowList& rows);
// The foremost point whatever lies behind it; what is left of an inclination is sheared off.
AirfoilNose foremost_nose(const AirfoilRowList& rows);
Point in_frame(const AirfoilFrame& frame, Point p);

// The surfaces of an outline that runs from the trailing edge around the leading edge back to the trailing
// edge, in either direction, by foremost_nose(): of what is in its frame already. A point that is there twice
// in a row counts once. Throws Error (format) where it is no airfoil's.
AirfoilCoordinates surfaces_of_outline(std::string name, AirfoilRowList outline, const std::string& source);

}  // namespace remodel
