#pragma once

// Shapes as the program's commands take them, as one domain: airfoils of coordinate files, of coefficients or
// by name in a far field, files of several elements, domain files (.json), planar graphs (.poly).

#include <optional>
#include <string>
#include <vector>

#include "remodel/airfoil.h"
#include "remodel/domain.h"
#include "remodel/join.h"
#include "remodel/planar.h"

namespace remodel {

// How files of shapes are read. Errors name these members.
struct ShapeReading {
  int degree = 5;                    // of the fits of coordinate files and named sections, 2 to 12
  bool close_trailing_edge = false;  // of a coordinate file, as fit_cst_apart() does
  std::optional<OutlineCurve> as_given = std::nullopt;  // no fit: a curve through the points of the file
  // Coordinate files keep their place, incidence and units, with the far field around all of them. Otherwise
  // a file of one section is moved to the origin and scaled to a chord of 1; one of several elements is not.
  bool keep_coordinates = false;
  bool farfield_stays = false;              // as it is given, around kept coordinates too
  Crossings crossings = Crossings::insert;  // of a planar graph
  double join = default_join;               // of a planar graph or a domain file
};

struct ShapeOfDomain {
  std::string shape;                              // what load_fit() takes, a domain file, or a .poly
  std::optional<Placement> place = std::nullopt;  // of an airfoil; none: the origin, or where its file has it
  std::string name = {};  // of its boundary; none: "airfoil", of several by their files
};

// How well a coordinate file was fitted.
struct ShapeFit {
  std::string shape;
  CstFit fit;
};

// The points of a coordinate file as given, or of one of its elements.
struct ShapeOutline {
  std::string shape;
  std::size_t points = 0;
  double gap = 0.0;  // of the trailing edge, in chords
  bool kept = true;  // in the coordinates of the file, and not moved to the origin and scaled to a chord of 1
  AirfoilFrame frame = {};
};

struct ShapesDomain {
  Domain domain;
  std::optional<PlanarFindings> findings = std::nullopt;  // of a planar graph
  std::vector<ShapeFit> fits = {};                        // of coordinate files
  std::vector<ShapeOutline> outlines = {};                // of those that are not fitted
  bool in_farfield = false;                               // airfoils in the far field of the options
  double chord = 1.0;  // in units of the domain: the longest, of files whose coordinates are kept
  std::vector<std::string> warnings = {};  // sentences on what was moved, joined, mended or left out
};

// One shape or more. Several airfoils have turning_share_of_elements unless the options have another. A
// domain file or a planar graph stands alone. Airfoils are not tested against each other: validate() or
// generate() does that. Throws Error as the readers of shape_files.h, read_poly(), planar_domain() and
// outline_of() do, and Error (argument) for what does not go together.
ShapesDomain domain_of_shapes(const std::vector<ShapeOfDomain>& shapes,
                              const AirfoilDomainOptions& options = {}, const ShapeReading& reading = {});
// True if a shape is a whole domain: a domain file, or a planar graph.
bool is_whole_domain(const std::string& shape);

// For the next domain of a mesh. The discretisation that airfoil_domain() was given, read back from its
// result.
AirfoilDomainOptions discretisation_of(const Domain& domain);
// The holes of `domain` get the names of those of `before`, in their order, where there are as many and no
// name is in both.
void take_names(Domain& domain, const Domain& before);
// A new outline keeps the stations of the old one of its name, where that has curves of the same kinds. False
// where there is none.
bool take_stations(Loop& loop, const Domain& before);

}  // namespace remodel
