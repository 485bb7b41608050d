// remodel draw MESH -o FILE: a picture of a mesh or of a field on it.

#include "remodel/draw.h"

#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "arguments.h"
#include "command.h"
#include "figures.h"
#include "outputs.h"
#include "picture_options.h"
#include "remodel/error.h"
#include "remodel/field.h"
#include "remodel/io.h"
#include "remodel/mesh.h"

namespace remodel::app {
namespace {

constexpr std::array mesh_colors{DrawColor::quality, DrawColor::length_scale, DrawColor::age,
                                 DrawColor::fate,    DrawColor::region,       DrawColor::gradation};
// Colours that are the field of that name.
constexpr std::array field_colors{"mach", "cp", "pressure", "entropy"};

struct DrawCommand {
  std::string mesh;
  bool color_given = false;
  std::string color_field;  // of --color
  std::string field;        // of --field
  std::optional<std::array<double, 2>> range;
  int iso_lines = 0;
  std::string since;  // an earlier state of it, for fates
  std::string output;
  DrawOptions options;
  bool json = false;
};

std::array<double, 2> parse_range(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos)
    throw Error(ErrorCode::argument, "--range", "found '" + text + "', expected two numbers A:B");
  const double low = parse_real("--range", text.substr(0, colon), {});
  const double high = parse_real("--range", text.substr(colon + 1), {});
  if (!(low < high)) throw Error(ErrorCode::argument, "--range", "found '" + text + "', expected A < B");
  return {low, high};
}

// Gradation errors need the living mesh, with its design and options.
FrozenMesh read(const DrawCommand& command) {
  if (command.options.color == DrawColor::fate) {
    FrozenMesh frozen = read_frozen_mesh(command.mesh);
    frozen.fate = fates(read_frozen_mesh(command.since), frozen);
    return frozen;
  }
  if (command.options.color != DrawColor::gradation) return read_frozen_mesh(command.mesh);
  const Mesh mesh = read_mesh(command.mesh);
  FrozenMesh frozen = mesh.freeze();
  frozen.gradation_error = mesh.gradation_errors(frozen);
  return frozen;
}

void require_together(const DrawCommand& command) {
  const bool fate = command.options.color == DrawColor::fate;
  if (fate && command.since.empty())
    throw Error(ErrorCode::argument, "--since", "found nothing with --color fate, expected an earlier mesh");
  if (!fate && !command.since.empty())
    throw Error(ErrorCode::argument, "--since", "found without --color fate, expected with it");
}

// The name of the field to draw; empty if the mesh itself is drawn.
std::string field_asked_for(const DrawCommand& command) {
  if (!command.field.empty() && command.color_given)
    throw Error(ErrorCode::argument, "--field", "found with --color, expected one of them");
  const std::string name = command.field.empty() ? command.color_field : command.field;
  for (const auto& [option, found] :
       {std::pair{"--range", command.range.has_value()}, {"--iso", command.iso_lines > 0}}) {
    if (found && name.empty())
      throw Error(ErrorCode::argument, option, "found without a field, expected with --field NAME");
  }
  return name;
}

DrawField read_field(const DrawCommand& command, const std::string& name) {
  const std::vector<Field> fields = read_fields(command.mesh);
  const Field* found = find_field(fields, name);
  if (found == nullptr) {
    std::string names;
    for (const Field& field : fields) names += (names.empty() ? "'" : ", '") + field.name + "'";
    throw Error(ErrorCode::argument, command.mesh,
                "no field '" + name + "' found, expected " +
                    (names.empty() ? "a file with fields: this one has none" : "one of " + names));
  }
  return {.field = *found,
          .label = name == "cp"     ? "Cp"
                   : name == "mach" ? "Mach number"
                                    : name,
          .range = command.range,
          .iso_lines = command.iso_lines};
}

Status run(const DrawCommand& command) {
  require_together(command);
  const std::string field = field_asked_for(command);
  require_writable_as(command.output, {".svg", ".png"});
  const FrozenMesh mesh = read(command);
  DrawOptions options = command.options;
  if (!field.empty()) options.field = read_field(command, field);
  draw(mesh, command.output, options);
  Report report;
  report.figure("mesh", "mesh", command.mesh);
  add_cell_counts(report, mesh.triangles.size(), mesh.quads.size());
  if (!field.empty()) report.figure("field", "field", field);
  add_output_figures(report, {command.output});
  report.print(command.json);
  return Status::done;
}

}  // namespace

void add_draw_command(CLI::App& program, Action& action) {
  auto command = std::make_shared<DrawCommand>();
  CLI::App& app =
      add_command(program, "draw", "Draws a mesh or a field on it as SVG or PNG", command, action);
  add_mesh_argument(app, command->mesh);
  add_text(app, {"-o,--output", "FILE", "", "Picture to write, format by extension: .svg or .png"},
           Presence::required, command->output);
  add_window(app, "the whole mesh", command->options);
  add_choice(
      app,
      {"--color", "COLOR", "quality",
       "quality (smallest angle), length-scale (its logarithm), age (remodelling steps), fate (kept, "
       "moved or new since the mesh of --since), region, gradation (size "
       "against what the design alone asks for; native meshes), or mach, cp, pressure or entropy: the field "
       "of that name"},
      {"quality", "length-scale", "age", "fate", "region", "gradation", "mach", "cp", "pressure", "entropy"},
      [command](std::size_t choice) {
        command->color_given = true;
        if (choice < mesh_colors.size()) {
          command->options.color = mesh_colors[choice];
        } else {
          command->color_field = field_colors[choice - mesh_colors.size()];
        }
      });
  add_text(app,
           {"--field", "NAME", "", "Draw a field of the file instead, of several components their length"},
           Presence::optional, command->field);
  add_text(app, {"--range", "A:B", "that of what is seen", "Values at the ends of the field's colours"},
           Presence::optional, [command](const std::string& text) { command->range = parse_range(text); });
  add_integer(app,
              {"--iso", "N", "0", "Number of lines of equal values, at equal distances in the range, to 200"},
              {.low = 0, .high = 200}, command->iso_lines);
  add_text(app, {"--since", "MESH", "", "Earlier state of the same mesh, for --color fate"},
           Presence::optional, command->since);
  add_integer(app, {"--width", "PIXELS", "1600", "Width in pixels, 100 to 8000; the height follows"},
              {.low = 100, .high = 8000}, command->options.width);
  add_json_flag(app, command->json);
}

}  // namespace remodel::app
