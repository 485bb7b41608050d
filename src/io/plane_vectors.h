#pragma once

// Vectors of the plane in files. VTK, ParaView and Gmsh take arrays of three components alone for vectors: a
// field of two components is written with a third one, 0, and a mark that says so. The reader takes the third
// one away again where the mark is and all of them are still 0. Files of other programs have no mark, and
// their fields keep what they have.

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace remodel::io {

// The attribute of an array of a .vtu or .vtkhdf file, of the value 2. Other readers pass over it.
inline constexpr const char* plane_mark = "remodel_components";

std::vector<double> with_third_component(std::span<const double> of_two);
// Changes nothing, and says false, where one of the third components is not 0.
bool take_third_component(std::vector<double>& of_three);

// The mark of .msh files: a line among their $Comments with the numbers of the sections of data, from 1 on,
// that hold such fields. Empty where none does.
std::string plane_note(std::span<const std::size_t> sections);
std::set<std::size_t> sections_in_plane(std::string_view text);

}  // namespace remodel::io
