#pragma once

// Files of shapes: airfoil coordinates, CST coefficients, domains. What their texts mean is in airfoil.h and
// domain.h; these functions open files. All throw Error (file) where a file cannot be read or is larger than
// 16 MiB, and whatever the text's own reader throws, with the file's name.

#include <filesystem>
#include <string>
#include <vector>

#include "remodel/airfoil.h"
#include "remodel/domain.h"
#include "remodel/join.h"

namespace remodel {

// parse_airfoil() and parse_outlines() of a file.
AirfoilCoordinates read_airfoil(const std::filesystem::path& file);
AirfoilOutlines read_outlines(const std::filesystem::path& file);
// True if a section lies about where everything else assumes it: with a chord of 1, to a quarter, from the
// origin on, to a tenth. Otherwise moved_to_origin() has the points in chords from the nose, neither turned
// nor sheared.
bool lies_in_chords(const AirfoilFrame& frame);
std::vector<Point> moved_to_origin(const AirfoilOutline& outline);

// SHAPE of the command line: a coordinate file, a .json file of CST coefficients, or what named_airfoil()
// takes. What exists as a file, contains '/' or '.', or is '-' (standard input) is a file. degree and
// trailing_edge are used for coordinate files, as fit_cst_apart() takes them; degree as named_airfoil() does
// too.
CstAirfoil load_airfoil(const std::string& shape, int degree,
                        TrailingEdge trailing_edge = TrailingEdge::kept);
// This is load_airfoil() with what is known of the fit: its errors, the frame of a coordinate file, and
// warnings, which begin with the file's name. Errors are those of the catalogue's table for its names, with
// what a lower degree adds, and 0 for a .json file.
CstFit load_fit(const std::string& shape, int degree, TrailingEdge trailing_edge = TrailingEdge::kept);
// True if a SHAPE is a coordinate file: by its name, or what comes through a pipe by its content.
bool is_coordinate_file(const std::string& shape);

// domain_from_json() of a file, where airfoils may be named as load_airfoil() takes them; their files are
// looked for in the file's own directory first, and their warnings are added to those given. Then
// join_ends(): what was joined goes to `joins`; and validate(), so that its errors name the file.
Domain load_domain(const std::filesystem::path& file, double join = default_join, Joins* joins = nullptr,
                   std::vector<std::string>* warnings = nullptr);
// holds_domain() of the text of a JSON file: one called .json, or a pipe whose text begins with '{'.
bool holds_domain(const std::filesystem::path& file);

}  // namespace remodel
