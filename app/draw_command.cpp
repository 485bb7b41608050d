// remodel draw MESH -o FILE: a picture.

#include "remodel/draw.h"

#include <array>
#include <filesystem>
#include <memory>

#include "arguments.h"
#include "command.h"
#include "figures.h"
#include "outputs.h"
#include "remodel/error.h"
#include "remodel/io.h"
#include "remodel/mesh.h"

namespace remodel::app {
namespace {

struct DrawCommand {
  std::string mesh;
  std::string output;
  DrawOptions options;
  bool json = false;
};

void set_window(DrawCommand& command, const std::string& text) {
  const std::vector<double> corners = parse_reals("--window", text, 4);
  if (!(corners[0] < corners[2] && corners[1] < corners[3])) {
    throw Error(ErrorCode::argument, "--window", "found '" + text + "', expected x0 < x1 and y0 < y1");
  }
  command.options.window = std::array{corners[0], corners[1], corners[2], corners[3]};
}

void require_picture(const std::string& file) {
  const std::string extension = std::filesystem::path(file).extension().string();
  if (extension != ".svg" && extension != ".png") {
    throw Error(ErrorCode::argument, file, "found extension '" + extension + "', expected .svg or .png");
  }
  require_writable(file);
}

// Gradation errors are a matter of the living mesh: its design and its options.
FrozenMesh read(const DrawCommand& command) {
  if (command.options.color != DrawColor::gradation) return read_frozen_mesh(command.mesh);
  const Mesh mesh = read_mesh(command.mesh);
  FrozenMesh frozen = mesh.freeze();
  frozen.gradation_error = mesh.gradation_errors(frozen);
  return frozen;
}

Status run(const DrawCommand& command) {
  require_picture(command.output);
  const FrozenMesh mesh = read(command);
  draw(mesh, command.output, command.options);
  Report report;
  report.figure("mesh", "mesh", command.mesh);
  report.figure("triangles", "triangles", mesh.triangles.size());
  add_output_figures(report, {command.output});
  report.print(command.json);
  return Status::done;
}

}  // namespace

void add_draw_command(CLI::App& program, Action& action) {
  auto command = std::make_shared<DrawCommand>();
  CLI::App& app = add_subcommand(program, "draw", "Draws a mesh as SVG or PNG",
                                 [command, &action] { action = [command] { return run(*command); }; });
  add_mesh_argument(app, command->mesh);
  add_text(app, {"-o,--output", "FILE", "", "Picture to write, format by extension: .svg or .png"},
           Presence::required, command->output);
  add_text(app, {"--window", "X0,Y0,X1,Y1", "the whole mesh", "Part of the plane to draw: corners in chords"},
           Presence::optional, [command](const std::string& text) { set_window(*command, text); });
  static constexpr std::array colors{DrawColor::quality, DrawColor::length_scale, DrawColor::age,
                                     DrawColor::gradation};
  add_choice(
      app,
      {"--color", "COLOR", "quality",
       "quality (smallest angle), length-scale (its logarithm), age (remodelling steps) or gradation (size "
       "against what the design alone asks for; native meshes)"},
      {"quality", "length-scale", "age", "gradation"},
      [command](std::size_t choice) { command->options.color = colors[choice]; });
  add_integer(app, {"--width", "PIXELS", "1600", "Width in pixels, 16 to 20000; the height follows"},
              {.low = 16, .high = 20000},
              [command](std::int64_t value) { command->options.width = static_cast<int>(value); });
  add_json_flag(app, command->json);
}

}  // namespace remodel::app
