#pragma once

// Pictures of a frozen mesh, by cairo.

#include <array>
#include <filesystem>
#include <optional>

#include "remodel/frozen_mesh.h"

namespace remodel {

enum class DrawColor {
  quality,       // minimum angle
  length_scale,  // logarithm of the mean length scale of the triangle
  age,           // how many remodelling steps ago the triangle was made
  gradation,  // ln(r / (H mean LS*)): 0 where a triangle is as large as the design allows; see GradationError
};

struct DrawOptions {
  std::optional<std::array<double, 4>> window = {};  // x0, y0, x1, y1, chords; default: the whole mesh
  DrawColor color = DrawColor::quality;
  int width = 1600;  // pixels; the height follows from the window
};

// .svg or .png by extension, written atomically, with a colour legend and its range. Error (argument) for
// another extension, an empty window, or a colouring whose data the mesh does not carry.
void draw(const FrozenMesh& mesh, const std::filesystem::path& file, const DrawOptions& options = {});

}  // namespace remodel
