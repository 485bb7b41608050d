#include "layer_options.h"

#include <string>

#include "arguments.h"
#include "number_text.h"
#include "remodel/error.h"
#include "remodel/flow_layer.h"

namespace remodel::app {
namespace {

void refuse(bool found, const char* option, const char* problem) {
  if (found) throw Error(ErrorCode::argument, option, problem);
}

void add_spacings(CLI::App& app, LayerChoice& choice) {
  const auto add = [&](const char* name, double& target, const std::string& where) {
    add_real(
        app,
        {name, "CHORDS", short_text(target), "With a layer: distance of stations " + where + ": 1e-6 to 1"},
        {.low = 1e-6, .high = 1.0}, [&](double value) { target = value, choice.spacing_given = true; });
  };
  add("--wall-spacing", choice.spacing.leading_edge, "at the leading edge");
  add("--te-spacing", choice.spacing.trailing_edge, "at the trailing edge and other corners");
  add("--max-spacing", choice.spacing.most, "where it is largest");
}

void add_wake_options(CLI::App& app, LayerChoice& choice) {
  add_real(app,
           {"--wake", "CHORDS", "none",
            "With a layer: length of a line of fine triangles behind the trailing edge that lies farthest "
            "downstream: above 0"},
           {.low = 0.0, .high = 1e3, .above_low = true}, [&](double value) { choice.wake = value; });
  add_real(
      app,
      {"--wake-angle", "DEGREES", "0", "Angle of the wake, counter-clockwise from the x axis: -90 to 90"},
      {.low = -90.0, .high = 90.0}, [&](double value) { choice.wake_angle_deg = value; });
}

}  // namespace

void add_layer_cells(CLI::App& app, LayerCells& cells) {
  add_choice(app,
             {"--layer-cells", "WHAT", "quads",
              "Cells of layers in the files that are written: quads, or triangles, two of each"},
             {"quads", "triangles"}, [&](std::size_t choice) {
               cells = choice == 0 ? LayerCells::quadrilaterals : LayerCells::triangles;
             });
}

void add_layer_options(CLI::App& app, LayerChoice& choice) {
  add_flag(app, "--layers", "Put layers of flat quadrilaterals on walls, for flows with friction",
           choice.layers);
  add_real(app,
           {"--reynolds", "RE", "", "Reynolds number, which the first height and the thickness follow from"},
           {.low = 1.0, .high = 1e12}, [&](double value) { choice.reynolds = value; });
  add_layer_sizes(app, choice, LayerDefaults::of_y_plus);
  add_layer_cells(app, choice.cells);
}

void add_layer_sizes(CLI::App& app, LayerChoice& choice, LayerDefaults defaults) {
  const bool of_flow = defaults == LayerDefaults::of_flow;
  add_real(app,
           {"--y-plus", "Y",
            of_flow ? "1, at most 0.033 Re^(-1/2) high; with --model laminar 0.01 Re^(-1/2)" : "1",
            "y+ of the first layer's height on a flat plate at --reynolds: above 0"},
           {.low = 0.0, .high = 1e4, .above_low = true}, [&](double value) { choice.y_plus = value; });
  add_real(app,
           {"--first-height", "CHORDS", "", "The first layer's height itself, in place of --y-plus: above 0"},
           {.low = 0.0, .high = 1e3, .above_low = true}, [&](double value) { choice.first_height = value; });
  add_real(app, {"--growth", "RATIO", "1.2", "Height of a cell over that of the cell below it: 1.02 to 2"},
           {.low = 1.02, .high = 2.0}, [&](double value) { choice.growth = value; });
  add_real(
      app,
      {"--layer-thickness", "CHORDS",
       of_flow ? "1.2 times 0.37 Re^(-1/5), with --model laminar 5 Re^(-1/2), at most 0.5, where that is more"
               : "1.2 times 0.37 Re^(-1/5), or 0.02 without --reynolds",
       "Thickness of the whole layer, which is thinner in gaps and corners: above 0"},
      {.low = 0.0, .high = 1e3, .above_low = true}, [&](double value) { choice.thickness = value; });
  add_integer(
      app,
      {"--layer-count", "K", "", "Number of cells across the layer, in place of its thickness: 1 to 1000"},
      {.low = 1, .high = 1000}, [&](std::int64_t value) { choice.count = static_cast<int>(value); });
  add_wake_options(app, choice);
  add_spacings(app, choice);
  add_texts(app,
            {"--layer-wall", "NAME",
             "all holes; of an outer loop with an inlet, outlet, symmetry plane or periodic curves all else",
             "Boundary that gets a layer; may be given several times"},
            Presence::optional, choice.walls);
}

std::optional<WakeLine> wake_of(const LayerChoice& choice, double chord) {
  if (!choice.wake) return std::nullopt;
  WakeLine wake = wake_at(*choice.wake, choice.wake_angle_deg.value_or(0.0));
  for (double* length : {&wake.length, &wake.first, &wake.most}) *length *= chord;
  return wake;
}

void add_wake_line(const LayerChoice& choice, double chord, const LayerOptions& layers, Domain& domain) {
  if (const auto wake = wake_of(choice, chord)) add_wake(domain, *wake, layers);
}

void require_consistent(const LayerChoice& choice) {
  if (!choice.layers) {
    constexpr const char* alone = "given without --layers, expected both";
    refuse(choice.reynolds.has_value(), "--reynolds", alone);
    refuse(choice.y_plus.has_value(), "--y-plus", alone);
    refuse(choice.first_height.has_value(), "--first-height", alone);
    refuse(choice.thickness.has_value(), "--layer-thickness", alone);
    refuse(choice.count.has_value(), "--layer-count", alone);
    refuse(choice.growth.has_value(), "--growth", alone);
    refuse(choice.wake.has_value(), "--wake", alone);
    refuse(choice.wake_angle_deg.has_value(), "--wake-angle", alone);
    refuse(!choice.walls.empty(), "--layer-wall", alone);
    refuse(choice.spacing_given, "--wall-spacing, --te-spacing or --max-spacing", alone);
    return;
  }
  require_compatible(choice);
  refuse(!choice.first_height && !choice.reynolds, "--layers",
         "given without --reynolds and --first-height, expected one of them");
  refuse(choice.y_plus && !choice.reynolds, "--y-plus", "given without --reynolds, expected both");
}

void require_compatible(const LayerChoice& choice) {
  refuse(choice.first_height && choice.y_plus, "--first-height", "given with --y-plus, expected one of them");
  refuse(choice.thickness && choice.count, "--layer-count",
         "given with --layer-thickness, expected one of them");
  refuse(choice.wake_angle_deg && !choice.wake, "--wake-angle", "given without --wake, expected both");
}

LayerOptions in_units(LayerOptions layer, double chord) {
  layer.first_height *= chord, layer.thickness *= chord;
  return layer;
}

LayerOptions adjusted(LayerOptions layer, const LayerChoice& choice, std::optional<double> reynolds) {
  if (!choice.walls.empty()) layer.walls = choice.walls;
  if (choice.growth) layer.growth = *choice.growth;
  if (choice.first_height)
    layer.first_height = *choice.first_height;
  else if (choice.y_plus)
    layer.first_height = first_height(*choice.y_plus, *reynolds);
  if (choice.thickness)
    layer.thickness = *choice.thickness;
  else if (choice.count)
    layer.thickness = thickness_of(layer.first_height, layer.growth, *choice.count);
  return layer;
}

LayerOptions resolved(const LayerChoice& choice, double chord) {
  LayerOptions layer{.first_height = 0.0};
  if (choice.reynolds) {
    layer.first_height = first_height(1.0, *choice.reynolds);
    layer.thickness = 1.2 * boundary_layer_thickness(*choice.reynolds);
  }
  return in_units(adjusted(layer, choice, choice.reynolds), chord);
}

void add_layer_figures(Report& report, const LayeredMesh& mesh) {
  const LayerStatistics layer = mesh.statistics();
  report.data("layers", {{"columns", layer.columns},
                         {"cells", layer.cells},
                         {"levels", mesh.levels()},
                         {"first_height", layer.first_height},
                         {"thickness", {{"least", layer.thickness.least}, {"most", layer.thickness.most}}},
                         {"growth", {{"least", layer.growth.least}, {"most", layer.growth.most}}},
                         {"aspect_max", layer.aspect_max},
                         {"corner_min_deg", layer.corner_min_deg},
                         {"area_jump", {{"median", layer.area_jump_median}, {"max", layer.area_jump_max}}},
                         {"split_tops", layer.split_tops},
                         {"shrunk", layer.shrunk}});
  const auto range = [](const LeastAndMost& values) {
    return values.least == values.most ? short_text(values.most)
                                       : short_text(values.least) + " to " + short_text(values.most);
  };
  report.line("layer", std::to_string(layer.columns) + " columns of " + std::to_string(mesh.levels()) +
                           " levels, " + std::to_string(layer.cells) + " cells, the first " +
                           short_text(layer.first_height) + " chords high");
  report.line("layer's thickness", range(layer.thickness) + " chords, growth " + range(layer.growth));
  report.line("layer's cells", "aspect up to " + short_text(layer.aspect_max) + ", corners from " +
                                   short_text(layer.corner_min_deg) +
                                   " degrees; over their tops areas differ " +
                                   short_text(layer.area_jump_median) + " times (median), up to " +
                                   short_text(layer.area_jump_max));
  if (layer.shrunk > 0) report.line("layer gave way", "in " + std::to_string(layer.shrunk) + " columns");
}

}  // namespace remodel::app
