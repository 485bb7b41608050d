#pragma once

// Pictures of a frozen mesh, by cairo.

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "remodel/field.h"
#include "remodel/frozen_mesh.h"

namespace remodel {

enum class DrawColor {
  quality,       // minimum angle
  length_scale,  // logarithm of the mean length scale of the triangle
  age,           // how many remodelling steps ago the triangle was made
  fate,          // kept, moved or new since an earlier state of the mesh; see fates()
  region,     // the part of the domain that the triangle belongs to, where there are several
  gradation,  // ln(r / (H mean LS*)): 0 where a triangle is as large as the design allows; see GradationError
};

// A picture of a field: smooth colours from dark blue, through green, to yellow (perceptually uniform), a bar
// with ticks, and lines of equal values. Fields of several components are drawn as their length.
struct DrawField {
  Field field;
  std::string label = {};                           // of the bar; default: the field's name
  std::optional<std::array<double, 2>> range = {};  // of the colours; default: that of what is seen
  int iso_lines = 0;  // to 200: lines that divide the range into equal parts; of fields on vertices
};

struct DrawOptions {
  std::optional<std::array<double, 4>> window = {};  // x0, y0, x1, y1, chords; default: the whole mesh
  DrawColor color = DrawColor::quality;
  std::optional<DrawField> field = {};  // instead of color, and of the edges of triangles
  int width = 1600;                     // pixels; the height follows from the window
  double line = 1.0;         // thickness of lines and size of letters, over what is usual at that width
  std::string caption = {};  // last line of the legend; default: how many triangles are seen, and where
};

// .svg or .png by extension, written atomically, with a colour legend and its range. Error (argument) for
// another extension, an empty window, or a colouring whose data the mesh does not carry,
// and for a field that does not fit the mesh (require_fit()).
void draw(const FrozenMesh& mesh, const std::filesystem::path& file, const DrawOptions& options = {});

}  // namespace remodel
