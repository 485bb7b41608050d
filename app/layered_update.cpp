#include "layered_update.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "figures.h"
#include "interrupt.h"
#include "layer_options.h"
#include "new_airfoil.h"
#include "remodel/error.h"
#include "remodel/io.h"
#include "timing.h"
#include "warnings.h"

namespace remodel::app {
namespace {

// Puts an airfoil in the place of another one: on the same stations, with a base where the trailing edge is
// open, of as many pieces as the old one or as the spacing beside it asks for.
void replace_airfoil(Loop& loop, const CstAirfoil& airfoil) {
  Curve& curve = loop.curves.front();
  const double beside =
      distance(airfoil.at(0.0), airfoil.at(curve.parameters.size() > 1 ? curve.parameters[1] : 0.5));
  curve.shape = airfoil;
  const bool open = airfoil.te_upper != airfoil.te_lower;
  if (!open) {
    loop.curves.resize(1);
    return;
  }
  const Line base{airfoil.at(1.0), airfoil.at(0.0)};
  if (loop.curves.size() == 2) {
    loop.curves[1].shape = base;
    return;
  }
  const double pieces = std::clamp(std::floor(distance(base.from, base.to) / beside + 0.5), 1.0, 1000.0);
  loop.curves.push_back({.name = curve.name,
                         .shape = base,
                         .parameters = Parameters::uniform(static_cast<std::size_t>(pieces))});
}

bool is_airfoil(const Loop& loop) {
  return std::holds_alternative<CstAirfoil>(loop.curves.front().shape) && loop.curves.size() <= 2;
}

ShapesDomain with_single_airfoil(const LayeredUpdate& update, const Domain& walls) {
  const std::string& shape = update.shapes.shapes.front();
  ShapesDomain input;
  const CstFit fit = fit_shape(shape, update.fit, input.fits);
  input.domain = walls_with_airfoil(walls, fit.airfoil, update.mesh);
  return input;
}

// The wake line of the mesh behind the new walls: as long as it was, in its direction, with its stations.
void keep_wake(const LayeredMesh& mesh, Domain& domain) {
  for (const Loop& loop : mesh.domain().loops) {
    const Curve& wake = loop.curves.front();
    const Line* line = std::get_if<Line>(&wake.shape);
    if (loop.role != LoopRole::internal || wake.name != "wake" || !line) continue;
    const double length = distance(line->from, line->to);
    add_wake(domain, {.length = length, .direction = line->to - line->from, .first = length, .most = length},
             mesh.options());
    domain.loops.back().curves.front().parameters = wake.parameters;
  }
}

ShapesDomain with_whole_domain(const LayeredUpdate& update, const LayeredMesh& mesh) {
  const Domain& walls = mesh.domain();
  DomainInputOptions shapes = update.shapes;
  shapes.farfield_stays = true;
  ShapesDomain input = read_domain(shapes, discretisation_of(walls), update.fit);
  if (input.in_farfield && shapes.names.empty()) take_names(input.domain, walls);
  validate_input(shapes, input.domain);
  if (!input.in_farfield) return input;
  const bool several = std::count_if(input.domain.loops.begin(), input.domain.loops.end(),
                                     [](const Loop& loop) { return loop.role == LoopRole::hole; }) > 1;
  for (Loop& loop : input.domain.loops) {
    if (loop.role != LoopRole::hole || take_stations(loop, walls)) continue;
    const std::vector<Parameters> stations = wall_stations(loop, WallSpacing{}.times(input.chord), several);
    for (std::size_t c = 0; c < loop.curves.size(); ++c) loop.curves[c].parameters = stations[c];
  }
  keep_wake(mesh, input.domain);
  return input;
}

void warn_of_step(const LayeredUpdate& update, const LayeredRemodelResult& result) {
  const std::string lost = std::to_string(result.triangles_before - result.preserved) + " of " +
                           std::to_string(result.triangles_before) + " cells were not preserved";
  if (result.abandoned)
    warn(update.mesh + ": cannot be completed without generating the mesh afresh: " + result.reason +
         "; nothing was written");
  else if (result.regenerated)
    warn(update.mesh + ": generated afresh outside the layer, " + lost + ": " + result.reason);
  else if (!result.same_columns)
    warn(update.mesh +
         ": the layer has other columns than before, as its walls have other stations or corners");
}

void print_report(const LayeredUpdate& update, const ShapesDomain& input, const LayeredMesh& mesh,
                  const LayeredRemodelResult& result, double seconds, const Cargo& cargo, bool written) {
  Report report;
  report.line("mesh", update.mesh);
  for (const std::string& shape : update.shapes.shapes) report.line("shape", shape);
  add_findings(report, input);
  report.figure("strategy", "strategy", name_of(update.remodelling.strategy));
  add_step_figures(report, result, "cells");
  const FrozenMesh view = mesh.freeze();  // whose cells the step counts, whatever files have
  add_cell_counts(report, view.triangles.size(), view.quads.size());
  report.figure("vertices", "vertices", view.points.size());
  report.figure("same_columns", "columns as before", result.same_columns);
  add_layer_figures(report, mesh);
  const MeshStatistics outside = mesh.outer().statistics();
  report.figure("min_angle_deg", "smallest angle outside the layer", outside.min_angle_deg, "degrees");
  add_exemption_figures(report, outside.exempt_triangles, outside.min_held_angle_deg);
  report.figure("keep", "kept triangles take up to", mesh.outer().keep(), "H");
  report.figure("max_gradation", "largest r / (keep H mean LS) outside", outside.max_gradation);
  report.figure("seconds", update.repeat > 1 ? "remodelling, median" : "remodelling", seconds, "seconds");
  report.figure("stopped", "stopped", name_of(result.stopped));
  cargo.add_figures(report);
  if (written) add_output_figures(report, update.outputs.files());
  report.print(update.json);
}

}  // namespace

Domain walls_with_airfoil(const Domain& walls, const CstAirfoil& airfoil, const std::string& mesh) {
  airfoil_of(walls, mesh);
  Domain result = walls;
  replace_airfoil(*std::find_if(result.loops.begin(), result.loops.end(), is_airfoil), airfoil);
  return result;
}

const Curve& airfoil_of(const Domain& walls, const std::string& mesh) {
  const auto loop = std::find_if(walls.loops.begin(), walls.loops.end(), is_airfoil);
  if (loop == walls.loops.end())
    throw Error(ErrorCode::argument, mesh,
                "found a mesh without an airfoil of coefficients, expected one, or a whole domain for SHAPE");
  return loop->curves.front();
}

std::string boxes_of_layered(const std::string& file) {
  std::size_t ignored = 0;
  return without_surface_points(read_su2_boxes(file), ignored);
}

Status run_layered_update(const LayeredUpdate& update) {
  const LayeredMesh original = read_layered_mesh(update.mesh);
  const FrozenMesh before = original.freeze();
  const std::string boxes = boxes_of_layered(update.mesh);
  Cargo cargo(update.mesh, before, update.carry);
  const ShapesDomain input = is_single_airfoil(update.shapes) ? with_single_airfoil(update, original.domain())
                                                              : with_whole_domain(update, original);
  InterruptObserver observer;
  RemodelOptions options = update.remodelling;
  options.observer = &observer;
  LayeredMesh mesh;
  LayeredRemodelResult result;
  std::vector<double> seconds;
  for (int i = 0; i < update.repeat && result.stopped != Stopped::interrupted; ++i) {
    mesh = original;
    const Stopwatch watch;
    result = remodel(mesh, input.domain, options);
    seconds.push_back(watch.seconds());
  }
  const bool given_up = result.abandoned || result.stopped == Stopped::interrupted;
  if (!given_up) {
    const FrozenMesh after = mesh.freeze();
    cargo.carry(before, after);
    update.outputs.with_boxes(boxes).write(mesh, update.cells, cargo.fields());
    cargo.write_state(after);
  }
  warn_of_step(update, result);
  warn_of_limit(result.stopped, mesh.outer());
  print_report(update, input, mesh, result, median(seconds), cargo, !given_up);
  if (result.abandoned) return Status::answer_is_no;
  return result.stopped == Stopped::done ? Status::done : Status::limit;
}

}  // namespace remodel::app
