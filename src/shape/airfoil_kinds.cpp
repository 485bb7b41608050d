// Files that are no coordinates of an airfoil, told by how they begin.

#include <algorithm>
#include <string>

#include "airfoil_rows.h"
#include "remodel/error.h"

namespace remodel {
namespace {

struct Kind {
  std::string_view words;  // somewhere in the beginning, in lower case
  const char* what;
  bool at_start = false;
};

constexpr std::string_view expected_coordinates = ", expected coordinates of an airfoil: lines of x and y";

constexpr Kind kinds[] = {
    {"\xff\xfe", "a text in UTF-16", true},
    {"\xfe\xff", "a text in UTF-16", true},
    {"%pdf", "a PDF document", true},
    {"pk\x03\x04", "a ZIP archive", true},
    {"<", "an XML, SVG or HTML document", true},
    {"{", "a JSON text, which a file called .json may hold", true},
    {"iso-10303-21", "a STEP file"},
    {"\nsection\n  2\nheader", "a DXF drawing"},
    {"section\n2\nheader", "a DXF drawing"},
    {"facet normal", "an STL surface"},
    {"$meshformat", "a mesh of Gmsh, which `check`, `convert`, `update` and `flow` take"},
    {"ndime=", "a mesh of SU2, which `check`, `convert`, `update` and `flow` take"},
    {"math_problem", "a configuration of SU2, whose MESH_FILENAME names the mesh"},
    {"mach_number=", "a configuration of SU2, whose MESH_FILENAME names the mesh"},
    {"foamfile", "a file of OpenFOAM"},
    {"bezier airfoil", "control points of OpenVSP's Bezier airfoil, which do not lie on its outline"},
    {"airfoilinfo",
     "an AirfoilInfo file of OpenFAST's AeroDyn, with a table of lift and drag; its line NumCoords "
     "names the file of the coordinates"},
    {"numaftabs",
     "an AirfoilInfo file of OpenFAST's AeroDyn, with a table of lift and drag; its line NumCoords "
     "names the file of the coordinates"},
    {"calculated polar for", "a polar of XFOIL"},
    {"alpha    cl", "a polar of XFOIL"},
    {"xflr5", "a file of results of XFLR5"},
};

std::string beginning_of(std::string_view text) {
  std::string begin(text.substr(0, 4096));
  std::erase(begin, '\r');
  std::transform(begin.begin(), begin.end(), begin.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return begin.substr(std::min(begin.find_first_not_of(" \t\n"), begin.size()));
}

}  // namespace

void refuse_other_kinds(std::string_view text, const std::string& source) {
  const std::string begin = beginning_of(text);
  for (const Kind& kind : kinds) {
    const std::size_t at = begin.find(kind.words);
    if (kind.at_start ? at == 0 : at != begin.npos)
      throw Error(ErrorCode::format, source,
                  "found what seems to be " + std::string(kind.what) + std::string(expected_coordinates));
  }
}

}  // namespace remodel
