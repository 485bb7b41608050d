#include "remodel/import.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "generate/recovery_error.h"
#include "generate/require_option.h"
#include "import/flat_layers.h"
#include "import/graft.h"
#include "import/loops.h"
#include "import/scales.h"
#include "import/sound.h"
#include "remodel/error.h"

namespace remodel {

namespace {

// Beyond this, refinement runs on for ever on some meshes.
constexpr double largest_refine_angle = 33.0;

void validate(const ImportOptions& options) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  require_option(options.refine_angle_deg >= 1.0 && options.refine_angle_deg <= largest_refine_angle,
                 "refine_angle_deg", options.refine_angle_deg, "1 to 33 degrees");
  require_option(positive(options.max_gradation), "max_gradation", options.max_gradation,
                 "a positive number");
  require_option(options.gradation == 0.0 || positive(options.gradation), "gradation", options.gradation,
                 "0 or a positive number");
  require_option(positive(options.resolution), "resolution", options.resolution, "a positive number");
}

double angle_deg(double squared_radius_edge) {
  return std::asin(std::min(1.0, 0.5 / std::sqrt(squared_radius_edge))) * 180.0 / std::numbers::pi;
}

// By its sine, e_min / 2r, as the validator measures it: what a mesh promises is compared with what it finds.
double smallest_angle_deg(const std::array<Point, 3>& p) {
  double shortest = INFINITY, product = 1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double length = std::hypot(p[(k + 1) % 3].x - p[k].x, p[(k + 1) % 3].y - p[k].y);
    shortest = std::min(shortest, length);
    product *= length;
  }
  const double area = std::abs(cross(p[1] - p[0], p[2] - p[0])) / 2.0;
  const double sine = shortest / (2.0 * (product / (4.0 * area)));
  return std::isnan(sine) ? 0.0 : std::asin(std::min(1.0, sine)) * 180.0 / std::numbers::pi;
}

std::array<Point, 3> corners(const std::vector<Point>& points, const std::array<std::uint32_t, 3>& t) {
  return {points[t[0]], points[t[1]], points[t[2]]};
}

// The angle that the mesh promises: a part in 10^9 below that of its worst triangle, which QualityBounds asks
// for, the file's triangles that freeze() may show included.
void set_promises(const ImportOptions& options, const std::string& source, MeshData& data) {
  const double worst = worst_squared_radius_edge(data);
  if (!std::isfinite(worst))
    throw Error(ErrorCode::geometry, source,
                "a triangle too flat to compute its circle found, angles of at least 1e-5 degrees expected");
  const double own = angle_deg(worst * (1.0 + 4e-9));
  data.options.min_angle_deg = std::min(own, options.refine_angle_deg);
  data.options.refine_angle_deg = options.refine_angle_deg;
  set_length_scales(data);
  data.options.gradation = options.gradation > 0.0 ? options.gradation : measured_gradation(data);
}

// Without the points that refinement added when the mesh was made its boundary is coarser: where that is none
// that can be meshed, they all count as the design's.
void take_design_of(const SoundMesh& sound, const LoopsOfMesh& loops, MeshData& data) {
  DesignOfMesh design = design_of(sound, loops);
  if (design.domain == loops.domain) return;
  try {
    validate(design.domain);
  } catch (const Error&) {
    return;
  }
  take_design(std::move(design), data);
}

void build(const SoundMesh& sound, const ImportOptions& options, const std::string& source,
           ImportResult& result) {
  MeshData& data = result.mesh.data();
  LoopsOfMesh loops = loops_of(sound);
  // What the triangles cover, each place once, follows from their orientation and a boundary that is simple
  // and nests: that is decided here.
  validate(loops.domain);
  data.domain = loops.domain;
  data.options.max_gradation = options.max_gradation;
  data.options.resolution = options.resolution;
  data.options.max_vertices = options.max_vertices;
  graft(sound, loops, data);
  take_design_of(sound, loops, data);
  data.imported.markers = sound.markers;
  const Flips flips =
      make_delaunay(sound, options.non_delaunay == NonDelaunay::keep ? Record::all : Record::ties, data);
  result.non_delaunay_edges = flips.non_delaunay;
  result.flipped_edges = flips.flipped;
  set_promises(options, source, data);
  data.domain_triangles = data.count_domain_triangles();
}

}  // namespace

ImportResult import_mesh(const FrozenMesh& mesh, const std::string& source, const ImportOptions& options) {
  validate(options);
  if (options.layers == FlatLayers::refuse) refuse_flat_layers(mesh, source);
  const SoundMesh sound =
      make_sound(mesh.quads.empty() ? mesh : without_quads(mesh, source), source, options.unnamed);
  ImportResult result;
  result.turned_triangles = sound.turned;
  result.duplicate_triangles = sound.duplicates;
  result.unused_points = sound.unused;
  result.unnamed_edges = sound.unnamed;
  result.min_angle_deg = 180.0;
  for (const auto& t : sound.triangles)
    result.min_angle_deg = std::min(result.min_angle_deg, smallest_angle_deg(corners(sound.points, t)));
  try {
    build(sound, options, source, result);
  } catch (const RecoveryError& error) {
    throw Error(ErrorCode::geometry, source, error.what());
  } catch (const Error& error) {
    const std::string text = error.what();
    throw Error(error.code(), source, text.starts_with(source) ? text.substr(source.size() + 2) : text);
  }
  return result;
}

MeshParts parts_of(const FrozenMesh& mesh) {
  MeshParts parts;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    MeshPart& part = i < mesh.birth.size() && mesh.birth[i] > 0 ? parts.changed : parts.kept;
    const double angle = smallest_angle_deg(corners(mesh.points, mesh.triangles[i]));
    part.min_angle_deg = part.triangles == 0 ? angle : std::min(part.min_angle_deg, angle);
    ++part.triangles;
  }
  return parts;
}

}  // namespace remodel
