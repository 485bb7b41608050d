#include "optimise/mesh_chain.h"

#include <stdexcept>
#include <utility>

#include "mesh/mesh_data.h"
#include "optimise/comparison.h"
#include "optimise/stopwatch.h"
#include "remodel/check.h"
#include "remodel/generate.h"
#include "remodel/strategy.h"

namespace remodel {
namespace {

void copy_figures(const RemodelResult& result, EvaluationRecord& record) {
  record.triangles_before = result.triangles_before;
  record.triangles = result.triangles;
  record.preserved = result.preserved;
  record.preserved_percent = result.preserved_percent();
  record.moved = result.moved;
  record.inserted = result.inserted;
  record.removed = result.removed;
  record.full_adjustment = result.full_adjustment;
  record.refreshed = result.refreshed;
  record.regenerated = result.regenerated;
  record.detail = result.reason;
}

// A run is long: it can afford to know K within one percent.
constexpr int calibration_samples = 20;

}  // namespace

std::optional<Mesh> first_mesh(const CstAirfoil& from, const OptimiseOptions& options) {
  const Domain domain = DesignDomains(options)(from);
  if (options.start) {
    Mesh mesh = options.start->mesh;
    if (remodel(mesh, domain, options.remodel).stopped != Stopped::done) return std::nullopt;
    return mesh;
  }
  GenerateResult generated = generate(domain, options.quality);
  if (generated.stopped != Stopped::done) return std::nullopt;
  if (options.remodel.strategy == Strategy::renew) calibrate(generated.mesh.data(), calibration_samples);
  return std::move(generated.mesh);
}

MeshChain::MeshChain(const OptimiseOptions& options, Mesh mesh, std::size_t meshes)
    : mesh_(std::move(mesh)), domain_of_(options), quality_(quality_of(options)), remodel_(options.remodel) {
  remodel_.designs_a_step = static_cast<std::uint32_t>(meshes);
}

RemodelResult MeshChain::advance(const Domain& domain) {
  return remodel(mesh_, domain, remodel_);
}

RemodelResult MeshChain::generate_instead(const Domain& domain) {
  GenerateResult fresh = generate(domain, quality_);
  RemodelResult result;
  result.stopped = fresh.stopped;
  result.regenerated = fresh.stopped != Stopped::done;  // nothing is left to be tried
  result.refreshed = !result.regenerated;
  result.triangles_before = mesh().triangle_count();
  result.removed = mesh().data().triangulation.vertex_count();
  result.inserted = fresh.mesh.data().triangulation.vertex_count();
  result.triangles = fresh.mesh.triangle_count();
  if (result.refreshed) put(std::move(fresh.mesh));
  return result;
}

Stopped MeshChain::step(const CstAirfoil& design, StepTasks tasks, EvaluationRecord& record) {
  const ThreadStopwatch watch;
  const Domain domain = domain_of_(design);
  RemodelResult result = tasks.generate ? generate_instead(domain) : advance(domain);
  record.remodel_seconds = watch.seconds();
  count_losses(result);
  copy_figures(result, record);

  const StepCheck check = checked(domain, result, tasks.check);
  record.checked = tasks.check == Checked::changes && check.whole ? Checked::quick : tasks.check;
  record.valid = check.broken.empty();
  record.min_angle_deg = check.min_angle_deg;
  if (!record.valid) record.detail = check.broken;
  if (result.regenerated && result.stopped != Stopped::done) return result.stopped;
  if (result.stopped != Stopped::done) record.detail = name_of(result.stopped);
  if (!record.valid || result.stopped != Stopped::done) {
    if (const Stopped stopped = regenerate(domain, record); stopped != Stopped::done) return stopped;
    const StepCheck fresh = check_whole(mesh());
    if (!fresh.broken.empty()) throw std::logic_error("a fresh mesh is not valid: " + fresh.broken);
    record.min_angle_deg = fresh.min_angle_deg;
  }
  return tasks.compare ? compare(design, record) : Stopped::done;
}

StepCheck MeshChain::checked(const Domain& domain, const RemodelResult& result, Checked how) const {
  if (how == Checked::changes) return check_changes(result);
  StepCheck check = check_whole(mesh());
  if (!check.broken.empty() || how != Checked::full) return check;
  const CheckResult full =
      remodel::check(mesh().freeze(), {.min_angle_deg = quality_.min_angle_deg,
                                       .max_gradation = promised_gradation(mesh().options()),
                                       .delaunay = !mesh().shows_file_triangles(),
                                       .design = &domain,
                                       .max_violations = 1});
  if (full.valid) return check;
  check.broken = full.violations.empty()
                     ? "check: not valid"
                     : full.violations.front().rule + ": " + full.violations.front().detail;
  return check;
}

// The time counts as remodelling: a method that has to be helped out is not faster for it.
Stopped MeshChain::regenerate(const Domain& domain, EvaluationRecord& record) {
  const ThreadStopwatch watch;
  GenerateResult fresh = generate(domain, quality_);
  record.remodel_seconds += watch.seconds();
  if (fresh.stopped != Stopped::done) return fresh.stopped;
  put(std::move(fresh.mesh));
  record.triangles = mesh().triangle_count();
  record.preserved = record.moved = record.inserted = record.removed = 0;
  record.preserved_percent = 0.0;
  record.full_adjustment = record.refreshed = false;
  record.regenerated = true;
  return Stopped::done;
}

Stopped MeshChain::compare(const CstAirfoil& design, EvaluationRecord& record) const {
  const FreshMesh fresh =
      fresh_mesh(domain_of_, quality_, compared_design(domain_of_, design, record.evaluation, record.sigma));
  add_comparison(fresh, mesh().gradation_error(), record);
  return fresh.stopped;
}

}  // namespace remodel
