#pragma once

// The options of layers on walls, and their figures.

#include <optional>

#include "remodel/layers.h"
#include "report.h"

namespace CLI {
class App;
}

namespace remodel::app {

struct LayerChoice {
  bool layers = false;
  std::optional<double> reynolds, y_plus, first_height, thickness;
  std::optional<int> count;
  std::optional<double> growth;
  WallSpacing spacing;
  bool spacing_given = false;
  std::vector<std::string> walls;  // names; none: by LayerOptions' rule
  std::optional<double> wake, wake_angle_deg;
  LayerCells cells = LayerCells::quadrilaterals;
};

// G, where none is given: coarser away from the tops than a mesh without a layer is from its walls.
inline constexpr double gradation_with_layers = 8.0;

// --layers, --reynolds, those of add_layer_sizes(), --layer-cells.
void add_layer_options(CLI::App& app, LayerChoice& choice);
// --y-plus, --first-height, --growth, --layer-thickness, --layer-count, --wake, --wake-angle, --wall-spacing,
// --te-spacing, --max-spacing, --layer-wall. The defaults of height and thickness, as the help has them, are those
// of layers by y+ alone, or of a flow's (layer_for_flow()).
enum class LayerDefaults { of_y_plus, of_flow };
void add_layer_sizes(CLI::App& app, LayerChoice& choice, LayerDefaults defaults);
// --layer-cells.
void add_layer_cells(CLI::App& app, LayerCells& cells);

// Throws Error (argument) for options that exclude each other, or are given without --layers or what they
// need.
void require_consistent(const LayerChoice& choice);
// The former alone.
void require_compatible(const LayerChoice& choice);
// The line of the wake, if one is asked for. chord: in the domain's units.
std::optional<WakeLine> wake_of(const LayerChoice& choice, double chord);
void add_wake_line(const LayerChoice& choice, double chord, const LayerOptions& layers, Domain& domain);
// Precondition: --layers. Lengths are in units of the domain, in which a chord is so long.
LayerOptions resolved(const LayerChoice& choice, double chord);
// A layer in chords, with what the choice says instead.
LayerOptions adjusted(LayerOptions layer, const LayerChoice& choice, std::optional<double> reynolds);
// This layer is in chords; the result is in such units.
LayerOptions in_units(LayerOptions layer, double chord);

// Reports under layers{...} the figures of the layer.
void add_layer_figures(Report& report, const LayeredMesh& mesh);

}  // namespace remodel::app
