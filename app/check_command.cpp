// remodel check MESH: the independent validator, on any readable format.

#include "remodel/check.h"

#include <cmath>
#include <memory>
#include <optional>

#include "arguments.h"
#include "command.h"
#include "figures.h"
#include "layer_options.h"
#include "mesh_input.h"
#include "number_text.h"
#include "remodel/mesh_state.h"
#include "warnings.h"

namespace remodel::app {
namespace {

struct CheckCommand {
  std::string mesh;
  std::optional<double> min_angle;
  std::optional<double> max_gradation;
  std::optional<double> delaunay_slack;
  bool json = false;
};

// The mesh of triangles of a native file, which with layers is what lies beyond them; null for others.
const Mesh* triangles_of(const MeshInput& input) {
  if (input.layered) return &input.layered->outer();
  return input.living ? &*input.living : nullptr;
}

// Why refinement of the whole mesh ended.
Stopped ended(const Mesh& mesh) {
  return static_cast<Stopped>(mesh.state().stopped);
}

// The bounds of a mesh that a limit ended are a wish: what is beyond them is counted, unless the command line
// asks for them. A native mesh is checked against its own design and options; any other mesh against the
// rules of every triangulation and the options of the command line. `walls`: keeps the design of a layered
// one.
CheckOptions rules_for(const CheckCommand& command, const MeshInput& input, Domain& walls) {
  CheckOptions options;
  const Mesh* triangles = triangles_of(input);
  if (input.layered)
    options.design = &(walls = input.layered->meshed_domain()), options.design_rounding = 1e-14;
  if (input.living) options.design = &input.living->domain();
  if (triangles != nullptr) {
    options.min_angle_deg = triangles->options().min_angle_deg;
    options.max_gradation = triangles->promised_gradation();
    options.delaunay = !triangles->shows_file_triangles();
    options.delaunay_slack_deg = triangles->delaunay_slack_deg();
  } else {
    options.delaunay = false;
    options.unused_points = true;
  }
  options.bounds = triangles == nullptr || ended(*triangles) == Stopped::done || command.min_angle ||
                   command.max_gradation;
  options.delaunay_slack_deg = command.delaunay_slack.value_or(options.delaunay_slack_deg);
  options.min_angle_deg = command.min_angle.value_or(options.min_angle_deg);
  options.max_gradation = command.max_gradation.value_or(options.max_gradation);
  return options;
}

Json to_json(const std::vector<Violation>& violations) {
  Json list = Json::array();
  for (const Violation& violation : violations) {
    list.push_back({{"rule", violation.rule}, {"ids", violation.ids}, {"detail", violation.detail}});
  }
  return list;
}

void add_violations(Report& report, const std::vector<Violation>& violations) {
  report.data("violations", to_json(violations));
  constexpr std::size_t shown = 10;
  for (std::size_t i = 0; i < violations.size() && i < shown; ++i) {
    report.line("broken rule " + violations[i].rule, violations[i].detail);
  }
  if (violations.size() > shown) {
    report.line("more violations", std::to_string(violations.size() - shown) + " (all with --json)");
  }
}

// None without length scales, which only meshes of ours have.
void add_gradation(Report& report, const CheckResult& result, const MeshInput& input) {
  if (std::isnan(result.max_gradation)) return report.data("max_gradation", nullptr);
  const Mesh* triangles = triangles_of(input);
  const double keep = triangles != nullptr ? triangles->keep() : 1.0;
  report.figure("max_gradation",
                keep > 1.0  ? "largest r / (keep H mean LS)"
                : triangles ? "largest r / (H mean LS)"
                            : "largest r / (H mean LS), H = sqrt(1/2) or as given",
                result.max_gradation);
}

void add_corner_angles(Report& report, const CheckResult& result) {
  if (result.quadrilaterals == 0) return;
  report.figure("corner_min_deg", "smallest corner of quadrilaterals", result.least_corner_deg, "degrees");
  report.figure("corner_max_deg", "largest corner of quadrilaterals", result.largest_corner_deg, "degrees");
}

// Those that the reader left out, and those that edges of a boundary have without a cell.
void add_unused_points(Report& report, const CheckResult& result, const MeshInput& input) {
  const std::size_t unused = input.unused_points + result.unused_points;
  report.data("unused_points", unused);
  if (unused == 0) return;
  report.line("left out", std::to_string(unused) +
                              (result.quadrilaterals > 0 ? " points of no cell" : " points of no triangle"));
}

void warn_of_result(const CheckCommand& command, const MeshInput& input, const CheckOptions& options,
                    const CheckResult& result) {
  if (result.touching_points > 0)
    warn(command.mesh + ": loops of the boundary touch in " + std::to_string(result.touching_points) +
         (result.touching_points == 1 ? " point" : " points"));
  if (!options.bounds)
    warn(command.mesh + ": refinement ended at a limit (" + name_of(ended(*triangles_of(input))) +
         "): the mesh is valid but below its quality, " + std::to_string(result.beyond_bounds) +
         " times beyond its bounds of " + short_text(options.min_angle_deg) + " degrees and of H");
}

Status run(const CheckCommand& command) {
  const MeshInput input = read_any_mesh(command.mesh);
  Domain walls;
  const CheckOptions options = rules_for(command, input, walls);
  const CheckResult result = check(input.frozen, options);

  Report report;
  report.line("mesh", command.mesh);
  report.figure(
      "rules", "rules",
      triangles_of(input) != nullptr ? "native: the design and the options in the file" : "topology");
  report.figure("valid", "valid", result.valid);
  add_violations(report, result.violations);
  warn_of_result(command, input, options, result);
  add_cell_counts(report, result.triangles, result.quadrilaterals);
  add_corner_angles(report, result);
  report.figure("vertices", "vertices", result.vertices);
  add_unused_points(report, result, input);
  if (std::isnan(result.min_angle_deg))
    report.data("min_angle_deg", nullptr);
  else
    report.figure("min_angle_deg", "smallest angle", result.min_angle_deg, "degrees");
  add_exemption_figures(report, result.exempt_triangles, result.min_held_angle_deg);
  report.data("beyond_bounds", result.beyond_bounds);
  report.data("touching_points", result.touching_points);
  add_gradation(report, result, input);
  report.figure("delaunay", "Delaunay", result.delaunay);
  add_boundary_figures(report, result.boundary);
  Json regions = Json::object();
  for (const auto& [name, count] : result.regions) {
    regions[name] = count;
    report.line("region " + name,
                std::to_string(count) + (result.quadrilaterals > 0 ? " cells" : " triangles"));
  }
  report.data("regions", regions);
  if (input.layered) add_layer_figures(report, *input.layered);
  report.figure("area", "area", result.area, "square chords");
  report.print(command.json);
  return result.valid ? Status::done : Status::answer_is_no;
}

}  // namespace

void add_check_command(CLI::App& program, Action& action) {
  auto command = std::make_shared<CheckCommand>();
  CLI::App& app = add_command(program, "check",
                              "Validates a mesh with rational arithmetic; exit status 1 if it is invalid",
                              command, action);
  add_mesh_argument(app, command->mesh);
  add_real(app,
           {"--min-angle", "DEGREES", "the mesh's own, or not tested",
            "Smallest angle that is valid, in degrees: 0 (not tested) to 60"},
           {.low = 0.0, .high = 60.0}, command->min_angle);
  add_real(app,
           {"--max-gradation", "H", "the mesh's own, or not tested",
            "Largest circumradius over mean length scale, for meshes with length scales: above 0, no unit"},
           {.low = 0.0, .above_low = true}, command->max_gradation);
  add_real(app,
           {"--delaunay-slack", "DEGREES", "the mesh's own, or 0",
            "How far beyond 180 degrees the angles opposite an inner edge may sum up: 0 to 60"},
           {.low = 0.0, .high = 60.0}, command->delaunay_slack);
  add_json_flag(app, command->json);
}

}  // namespace remodel::app
