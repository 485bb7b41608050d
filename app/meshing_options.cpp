#include "meshing_options.h"

#include "arguments.h"
#include "number_text.h"

namespace remodel::app {
namespace {

void add_discretisation(CLI::App& app, AirfoilDomainOptions& options) {
  add_integer(app,
              {"--points", "I", "200",
               "Vertices on the airfoil before refinement, without layers: even, 8 to 100000"},
              {.low = 8, .high = 100000, .even = true}, options.points);
  add_real(
      app,
      {"--farfield-radius", "CHORDS", "25",
       "Radius of the farfield circle in chords of 1, about (0.5, 0) wherever airfoils are placed: above 1"},
      {.low = 1.0, .high = 1e6, .above_low = true}, options.farfield_radius);
  add_integer(app, {"--farfield-points", "N", "50", "Vertices on the farfield circle: 8 to 100000"},
              {.low = 8, .high = 100000}, options.farfield_points);
}

void add_quality(CLI::App& app, MeshingOptions& options) {
  QualityOptions& quality = options.quality;
  add_real(app,
           {"--gradation", "G", "I/50, or 8 with layers",
            "Triangle size grows by distance/G away from the boundary: above 0 up to 1e6, no unit"},
           {.low = 0.0, .high = 1e6, .above_low = true}, options.gradation);
  add_real(app,
           {"--resolution", "R", "1",
            "Boundary length scale is the distance to the nearest neighbour over R: above 0, no unit"},
           {.low = 0.0, .high = 1e6, .above_low = true}, quality.resolution);
  add_real(app, {"--min-angle", "DEGREES", "30", "Smallest angle of a triangle in degrees: 0 to 34"},
           {.low = 0.0, .high = 34.0}, quality.min_angle_deg);
  add_real(app,
           {"--max-gradation", "H", "0.70710678",
            "Largest circumradius over mean length scale of a triangle: above 0, no unit"},
           {.low = 0.0, .above_low = true}, quality.max_gradation);
  add_real(
      app,
      {"--min-edge", "LENGTH", "1e-12 of the domain's size or of its largest coordinate",
       "No boundary edge shorter than this is split, and no triangle of a smaller circumradius: generation "
       "goes on elsewhere and ends with exit status 3; above 0, in chords"},
      {.low = 0.0, .above_low = true}, quality.min_edge);
  add_integer(app,
              {"--max-vertices", "N", "10000000",
               "Vertex budget: generation stops there with exit status 3; 100 to 1000000000"},
              {.low = 100, .high = 1'000'000'000}, quality.max_vertices);
}

}  // namespace

QualityOptions MeshingOptions::resolved_quality() const {
  QualityOptions resolved = quality;
  resolved.gradation = gradation.value_or(discretisation.points / 50.0);
  return resolved;
}

void add_turning_share(CLI::App& app, AirfoilDomainOptions& options) {
  add_real(
      app,
      {"--turning-share", "PART", "0, of several airfoils 0.2",
       "Part of the vertices on airfoils, without layers, that follows how the surface turns, most of it "
       "at noses; the others have cosine spacing: 0 to 0.9"},
      {.low = 0.0, .high = 0.9}, [&options](double part) { options.turning_share = part; });
}

void add_fit_options(CLI::App& app, FitOptions& options) {
  add_integer(
      app,
      {"--cst-degree", "N", "5",
       "Bernstein degree of a fit, 2 to 12, or the next one whose surfaces do not cross; names of the "
       "catalogue get it exactly from 5 on; .json files have their own"},
      {.low = 2, .high = 12}, options.degree);
  add_flag(app, "--close-trailing-edge",
           "Closes the trailing edge of a coordinate file; if not given, an open one is kept as it is",
           options.close_trailing_edge);
}

void add_repeat(CLI::App& app, int& repeat) {
  add_integer(app, {"--repeat", "N", "1", "Do the work N times and report the median time: at least 1"},
              {.low = 1, .high = 1'000'000}, repeat);
}

void add_meshing_options(CLI::App& app, MeshingOptions& options) {
  add_discretisation(app, options.discretisation);
  add_quality(app, options);
  add_fit_options(app, options.fit);
}

Json to_json(const MeshingOptions& options) {
  const QualityOptions quality = options.resolved_quality();
  Json json{{"points", options.discretisation.points},
            {"gradation", quality.gradation},
            {"resolution", quality.resolution},
            {"min_angle_deg", quality.min_angle_deg},
            {"max_gradation", quality.max_gradation},
            {"farfield_radius", options.discretisation.farfield_radius},
            {"farfield_points", options.discretisation.farfield_points},
            {"cst_degree", options.fit.degree},
            {"min_edge", quality.min_edge},
            {"close_trailing_edge", options.fit.close_trailing_edge},
            {"max_vertices", quality.max_vertices}};
  if (const auto& share = options.discretisation.turning_share) json["turning_share"] = *share;
  if (quality.refine_angle_deg > quality.min_angle_deg) json["refine_angle_deg"] = quality.refine_angle_deg;
  return json;
}

void describe(Report& report, const MeshingOptions& options, bool farfield, bool points) {
  const QualityOptions quality = options.resolved_quality();
  report.data("options", to_json(options));
  if (farfield)
    report.line("discretisation",
                (points ? std::to_string(options.discretisation.points) + " points, " : std::string()) +
                    "farfield of " + std::to_string(options.discretisation.farfield_points) + " at " +
                    short_text(options.discretisation.farfield_radius) + " chords");
  const bool slack = quality.refine_angle_deg > quality.min_angle_deg;
  const std::string refined = slack ? " (refined to " + short_text(quality.refine_angle_deg) + ")" : "";
  report.line("quality asked for", "angle >= " + short_text(quality.min_angle_deg) + " degrees" + refined +
                                       ", H " + short_text(quality.max_gradation) + ", G " +
                                       short_text(quality.gradation) + ", R " +
                                       short_text(quality.resolution) + ", at most " +
                                       std::to_string(quality.max_vertices) + " vertices");
}

}  // namespace remodel::app
