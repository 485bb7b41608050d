#include "start_mesh.h"

#include <algorithm>
#include <array>

#include "arguments.h"
#include "number_text.h"
#include "remodel/error.h"
#include "remodel/io.h"
#include "warnings.h"

namespace remodel::app {
namespace {

// Reads the file as a living mesh; nothing if it is not a native one.
std::optional<Mesh> read_native(const std::string& file) {
  try {
    return read_mesh(file);
  } catch (const Error& error) {
    // The file is not a native mesh, as opposed to a damaged one.
    if (error.code() != ErrorCode::argument) throw;
    return std::nullopt;
  }
}

// A remodelled mesh has other points.
std::string boxes_alone(const std::string& su2_boxes, const std::string& file) {
  std::size_t surface_points = 0;
  std::string boxes = without_surface_points(su2_boxes, surface_points);
  if (surface_points > 0)
    warn(file + ": " + std::to_string(surface_points) +
         " surface points of FFD boxes, which name points of this mesh, are left out: SU2_DEF with DV_KIND= "
         "FFD_SETTING finds them anew");
  return boxes;
}

void refuse_for_native(bool given, const char* option, const std::string& file) {
  if (!given) return;
  throw Error(ErrorCode::argument, option,
              "given for '" + file + "', a mesh of another program's expected: a native mesh has its own");
}

std::string names_of(const Domain& domain) {
  std::string names;
  for (std::size_t i = 0; i < domain.curve_count(); ++i) {
    const std::string quoted = "'" + domain.curve(i).name + "'";
    if (names.find(quoted) == std::string::npos) names += (names.empty() ? "" : ", ") + quoted;
  }
  return names;
}

// The boundary that is changed if none is named: a CstAirfoil, or the only body of a mesh that was imported
// before.
std::string boundary_of(const StartMesh& start, const StartMeshOptions& options) {
  if (!options.boundary.empty()) return options.boundary;
  const Domain& domain = start.mesh.domain();
  std::vector<const Loop*> bodies;
  for (const Loop& loop : domain.loops) {
    if (std::holds_alternative<CstAirfoil>(loop.curves.front().shape)) return loop.curves.front().name;
    if (loop.role == LoopRole::hole) bodies.push_back(&loop);
  }
  if (!start.imported && bodies.size() == 1) return bodies.front()->curves.front().name;
  throw Error(ErrorCode::argument, "--boundary",
              "not given, the airfoil's name in " + start.source + " expected, one of " + names_of(domain));
}

Json to_json(const MeshPart& part) {
  Json result{{"triangles", part.triangles}};
  result["min_angle_deg"] = part.triangles > 0 ? Json(part.min_angle_deg) : Json(nullptr);
  return result;
}

std::string to_text(const MeshPart& part) {
  std::string text = std::to_string(part.triangles);
  if (part.triangles > 0) text += ", smallest angle " + short_text(part.min_angle_deg) + " degrees";
  return text;
}

}  // namespace

void add_start_mesh_options(CLI::App& app, StartMeshOptions& options) {
  add_text(app,
           {"--boundary", "NAME", "the airfoil of a native mesh",
            "Marker or physical name of the airfoil in the mesh: the loop that is replaced"},
           Presence::optional, options.boundary);
  add_real(app,
           {"--refine-angle", "DEGREES", short_text(ImportOptions{}.refine_angle_deg),
            "Smallest angle of new triangles in an imported mesh, in degrees: 1 to 33"},
           {.low = 1.0, .high = 33.0}, options.refine_angle_deg);
  static constexpr std::array choices{NonDelaunay::flip, NonDelaunay::keep};
  add_choice(
      app,
      {"--non-delaunay", "WHAT", "flip",
       "Triangles of an imported mesh that are not Delaunay: flip them, or keep them where nothing changes"},
      {"flip", "keep"}, [&](std::size_t choice) { options.non_delaunay = choices[choice]; });
  add_flag(app, "--dissolve-layers",
           "Take an imported mesh with quadrilaterals, or with triangles flatter than 20 to 1 on a wall: "
           "quadrilaterals are split, and remodelling dissolves its layers",
           options.dissolve_layers);
}

StartMesh read_start_mesh(const std::string& file, const StartMeshOptions& options) {
  const KeptPipes once;
  if (std::optional<Mesh> native = read_native(file)) {
    refuse_for_native(options.refine_angle_deg.has_value(), "--refine-angle", file);
    refuse_for_native(options.gradation.has_value(), "--gradation", file);
    refuse_for_native(options.non_delaunay.has_value(), "--non-delaunay", file);
    refuse_for_native(options.dissolve_layers, "--dissolve-layers", file);
    return {.mesh = std::move(*native),
            .source = file,
            .imported = std::nullopt,
            .su2_boxes = boxes_alone(read_su2_boxes(file), file)};
  }
  ImportOptions import;
  import.refine_angle_deg = options.refine_angle_deg.value_or(import.refine_angle_deg);
  import.gradation = options.gradation.value_or(import.gradation);
  import.non_delaunay = options.non_delaunay.value_or(import.non_delaunay);
  import.layers = options.dissolve_layers ? FlatLayers::dissolve : FlatLayers::refuse;
  ReadNotes notes;
  ImportResult imported = import_mesh(read_frozen_mesh(file, &notes), file, import);
  warn_of(notes);
  imported.duplicate_triangles += notes.repeated_triangles;
  imported.unused_points += notes.unused_points;
  StartMesh start{.mesh = std::move(imported.mesh),
                  .source = file,
                  .imported = std::nullopt,
                  .su2_boxes = boxes_alone(notes.su2_boxes, file)};
  imported.mesh = Mesh();
  start.imported = std::move(imported);
  return start;
}

AirfoilPlace place_in(const StartMesh& start, const StartMeshOptions& options) {
  AirfoilPlace place = find_airfoil(start.mesh.domain(), boundary_of(start, options), start.source);
  return options.points ? with_points(std::move(place), *options.points) : place;
}

void add_import_figures(Report& report, const StartMesh& start) {
  if (!start.imported) return;
  const ImportResult& import = *start.imported;
  const QualityOptions& promised = start.mesh.options();
  report.data("import", {{"min_angle_deg", import.min_angle_deg},
                         {"promised_angle_deg", promised.min_angle_deg},
                         {"refine_angle_deg", promised.refine_angle_deg},
                         {"gradation", promised.gradation},
                         {"turned_triangles", import.turned_triangles},
                         {"duplicate_triangles", import.duplicate_triangles},
                         {"unused_points", import.unused_points},
                         {"unnamed_edges", import.unnamed_edges},
                         {"non_delaunay_edges", import.non_delaunay_edges},
                         {"flipped_edges", import.flipped_edges}});
  report.line("imported", "smallest angle " + short_text(import.min_angle_deg) + " degrees, G " +
                              short_text(promised.gradation) + ", new triangles refined to " +
                              short_text(promised.refine_angle_deg) + " degrees");
  const auto line = [&](std::size_t count, const char* label, const char* what) {
    if (count > 0) report.line(label, std::to_string(count) + what);
  };
  line(import.turned_triangles, "turned", " clockwise triangles");
  line(import.duplicate_triangles, "taken once", " triangles that the file lists again");
  line(import.unused_points, "left out", " points of no triangle");
  line(import.unnamed_edges, "named 'boundary'", " boundary edges without a marker");
  line(import.non_delaunay_edges, "not Delaunay", " edges");
}

double smallest_angle(const Mesh& mesh) {
  if (!mesh.imported()) return mesh.statistics().min_angle_deg;
  const MeshParts parts = parts_of(mesh.freeze());
  double angle = 180.0;
  for (const MeshPart& part : {parts.kept, parts.changed})
    if (part.triangles > 0) angle = std::min(angle, part.min_angle_deg);
  return angle;
}

void add_part_figures(Report& report, const Mesh& mesh) {
  if (!mesh.imported()) return;
  const MeshParts parts = parts_of(mesh.freeze());
  report.data("kept", to_json(parts.kept));
  report.data("changed", to_json(parts.changed));
  report.line("kept triangles", to_text(parts.kept));
  report.line("changed triangles", to_text(parts.changed));
}

}  // namespace remodel::app
