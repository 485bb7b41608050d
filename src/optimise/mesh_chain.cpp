#include "optimise/mesh_chain.h"

#include <chrono>
#include <utility>

#include "mesh/mesh_data.h"
#include "optimise/portable_math.h"
#include "remodel/check.h"
#include "remodel/generate.h"

namespace remodel {
namespace {

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

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

}  // namespace

MeshChain::MeshChain(const OptimiseOptions& options, Mesh mesh)
    : mesh_(std::move(mesh)), domain_of_(options), quality_(quality_of(options)), remodel_(options.remodel) {}

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
  const Stopwatch watch;
  const Domain domain = domain_of_(design);
  RemodelResult result = tasks.generate ? generate_instead(domain) : advance(domain);
  record.remodel_seconds = watch.seconds();
  count_losses(result);
  copy_figures(result, record);

  const std::string broken = broken_rule(domain, tasks);
  record.checked = tasks.full_check ? Checked::full : Checked::quick;
  record.valid = broken.empty();
  if (!broken.empty()) record.detail = broken;
  if (result.regenerated && result.stopped != Stopped::done) return result.stopped;
  if (result.stopped != Stopped::done) record.detail = name_of(result.stopped);
  if (!record.valid || result.stopped != Stopped::done) {
    if (const Stopped stopped = regenerate(domain, record); stopped != Stopped::done) return stopped;
  }
  record.min_angle_deg = mesh().statistics().min_angle_deg;
  return tasks.compare ? compare(compared_design(design, record), record) : Stopped::done;
}

std::string MeshChain::broken_rule(const Domain& domain, StepTasks tasks) const {
  const Mesh& mesh = this->mesh();
  std::string broken = mesh.quick_check();
  if (!broken.empty() || !tasks.full_check) return broken;
  const CheckResult result = check(mesh.freeze(), {.min_angle_deg = quality_.min_angle_deg,
                                                   .max_gradation = promised_gradation(mesh.options()),
                                                   .delaunay = !mesh.shows_file_triangles(),
                                                   .design = &domain,
                                                   .max_violations = 1});
  if (result.valid) return {};
  if (result.violations.empty()) return "check: not valid";
  return result.violations.front().rule + ": " + result.violations.front().detail;
}

// The time counts as remodelling: a method that has to be helped out is not faster for it.
Stopped MeshChain::regenerate(const Domain& domain, EvaluationRecord& record) {
  const Stopwatch watch;
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

// Where the optimiser has converged, designs hardly differ any more, and neither would the meshes that they
// are compared with: one mesh with many or few triangles, by chance, would decide the mean of hundreds.
CstAirfoil MeshChain::compared_design(const CstAirfoil& design, const EvaluationRecord& record) const {
  constexpr double converged = 0.003,
                   jitter = 0.001;  // standard deviation of samples; of coefficients, relative
  if (record.sigma >= converged) return design;
  portable::Generator random(record.evaluation);
  CstAirfoil jittered = design;
  for (auto* surface : {&jittered.upper, &jittered.lower})
    for (double& coefficient : *surface) coefficient *= 1.0 + jitter * random.normal();
  return domain_of_.feasible(jittered) ? jittered : design;
}

Stopped MeshChain::compare(const CstAirfoil& design, EvaluationRecord& record) const {
  const Stopwatch watch;
  const Domain domain = domain_of_(design);
  const GenerateResult fresh = generate(domain, quality_);
  record.generate_seconds = watch.seconds();
  record.generated_triangles = fresh.mesh.triangle_count();
  const GradationError error = mesh().gradation_error(), fresh_error = fresh.mesh.gradation_error();
  record.gradation_bias = error.bias;
  record.gradation_deviation = error.deviation;
  record.generated_gradation_bias = fresh_error.bias;
  record.generated_gradation_deviation = fresh_error.deviation;
  return fresh.stopped;
}

}  // namespace remodel
