// remodel convert MESH -o MESH...: the same mesh in other formats, with its fields.

#include <algorithm>
#include <memory>

#include "arguments.h"
#include "command.h"
#include "figures.h"
#include "mesh_input.h"
#include "outputs.h"
#include "remodel/field.h"
#include "remodel/io.h"
#include "warnings.h"

namespace remodel::app {
namespace {

struct ConvertCommand {
  std::string mesh;
  MeshOutputs outputs;
  bool json = false;
};

// Nothing where there are none.
void add_field_names(Report& report, const std::string& key, const std::string& label,
                     std::span<const Field> fields) {
  if (fields.empty()) return;
  Json names = Json::array();
  std::string text;
  for (const Field& field : fields) {
    names.push_back(field.name);
    text += (text.empty() ? "" : ", ") + field.name;
  }
  report.data(key, names);
  report.line(label, text);
}

void warn_of_fields(const MeshOutputs& outputs, std::size_t fields) {
  for (const std::string& file : outputs.files())
    if (const MeshFormat format = mesh_format(file);
        fields > 0 && (format == MeshFormat::su2 || format == MeshFormat::foam))
      warn(file + ": " + std::to_string(fields) + (fields == 1 ? " field" : " fields") +
           " left out, for which the format has no place");
}

Status run(const ConvertCommand& command) {
  command.outputs.require_possible();
  const MeshInput input = read_any_mesh(command.mesh);
  std::vector<Field> fields = read_fields(command.mesh);
  // Those with infinities or NaN are left out: not every format can hold them.
  const auto left_out = std::stable_partition(fields.begin(), fields.end(), is_finite);
  const auto kept = std::span(fields.begin(), left_out);
  // A native copy of a native mesh keeps its state.
  write_with_fields(command.outputs.with_boxes(input.su2_boxes), input, kept);
  warn_of_fields(command.outputs, kept.size());
  Report report;
  report.figure("mesh", "mesh", command.mesh);
  add_cell_counts(report, input.frozen.triangles.size(), input.frozen.quads.size());
  report.figure("vertices", "vertices", input.frozen.points.size());
  add_field_names(report, "fields", "fields", kept);
  add_field_names(report, "fields_left_out", "not finite, left out", std::span(left_out, fields.end()));
  add_output_figures(report, command.outputs.files());
  report.print(command.json);
  return Status::done;
}

}  // namespace

void add_convert_command(CLI::App& program, Action& action) {
  auto command = std::make_shared<ConvertCommand>();
  CLI::App& app =
      add_command(program, "convert", "Writes a mesh and its fields in other formats", command, action);
  add_mesh_argument(app, command->mesh);
  command->outputs.add_options(app, Presence::required);
  add_json_flag(app, command->json);
}

}  // namespace remodel::app
