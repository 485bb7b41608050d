#include "design/living_mesh.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "base/stopwatch.h"
#include "design/comparison.h"
#include "design/run_mesh.h"
#include "mesh/mesh_data.h"
#include "mesh/renew_policy.h"
#include "remodel/check.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "step/strategy.h"

namespace remodel {
namespace {

constexpr std::array<MeshStrategyInfo, 7> mesh_infos{{
    {MeshStrategy::chain, "chain", "the paper's method to the letter, and all that imported meshes have",
     Strategy::chain},
    {MeshStrategy::renew, "renew", "length scales are renewed, what is too dense is coarsened",
     Strategy::renew},
    {MeshStrategy::pool, "pool", "renew, with as many workers as samples per generation", Strategy::renew},
    {MeshStrategy::hub, "hub", "renew, all designs from one mesh near their mean", Strategy::renew},
    {MeshStrategy::regenerate, "regenerate", "chain, and generation where a criterion asks for it",
     Strategy::chain},
    {MeshStrategy::morph, "morph", "renew, but the interior moves along with the boundary where it can",
     Strategy::morph},
    {MeshStrategy::reference, "reference", "every design's mesh is the morph of one reference mesh",
     Strategy::reference},
}};

constexpr const char* checked_names[] = {"changes", "quick", "full"};

void copy_figures(const RemodelResult& result, MeshStep& record) {
  record.triangles_before = result.triangles_before;
  record.triangles = result.triangles;
  record.preserved = result.preserved;
  record.preserved_percent = result.preserved_percent();
  record.connected = result.connected;
  record.connectivity_percent = result.connectivity_percent();
  record.moved = result.moved;
  record.inserted = result.inserted;
  record.removed = result.removed;
  record.flipped = result.flipped;
  record.full_adjustment = result.full_adjustment;
  record.morphed = result.morphed;
  record.refreshed = result.refreshed;
  record.regenerated = result.regenerated;
  record.detail = result.reason;
}

}  // namespace

const char* name_of(Checked checked) {
  return checked_names[static_cast<std::size_t>(checked)];
}

Checked checked_named(const std::string& name) {
  const auto* found = std::find(std::begin(checked_names), std::end(checked_names), name);
  if (found == std::end(checked_names))
    throw std::invalid_argument("expected changes, quick or full under `checked`");
  return static_cast<Checked>(found - std::begin(checked_names));
}

std::string at_limit(Stopped stopped) {
  return std::string("the mesh of this design ended at its limit, ") + name_of(stopped);
}

std::span<const MeshStrategyInfo> mesh_strategies() {
  return mesh_infos;
}

const MeshStrategyInfo& info_of(MeshStrategy strategy) {
  return mesh_infos[static_cast<std::size_t>(strategy)];
}

MeshStrategy mesh_strategy(const std::string& name) {
  std::string expected;
  for (const MeshStrategyInfo& info : mesh_infos) {
    if (info.name == name) return info.strategy;
    expected += (expected.empty() ? "" : ", ") + std::string(info.name);
  }
  throw Error(ErrorCode::argument, "strategy", "found '" + name + "', expected one of " + expected);
}

RemodelOptions step_options(const OptimiseOptions& options) {
  RemodelOptions step = options.remodel;
  step.strategy = info_of(options.strategy).step;
  return step;
}

QualityOptions quality_of(const OptimiseOptions& options) {
  if (options.start) return options.start->mesh.options();
  QualityOptions quality = options.quality;
  if (options.strategy == MeshStrategy::reference)
    quality.refine_angle_deg = angle_with_slack(quality, options.reference_slack_deg);
  return quality;
}

std::vector<double> first_design(const DesignSpace& space, const OptimiseOptions& options) {
  return options.first_design.empty() ? space.start() : options.first_design;
}

GenerateResult first_mesh(const DesignSpace& space, const OptimiseOptions& options, StepObserver* observer) {
  const Domain domain = space.domain(first_design(space, options));
  RemodelOptions step = step_options(options);
  step.observer = observer;
  if (options.start) {
    Mesh mesh = options.start->mesh;
    const Stopped stopped = remodel(mesh, domain, step).stopped;
    return {std::move(mesh), stopped};
  }
  GenerateResult generated = generate(domain, quality_of(options), observer);
  if (generated.stopped != Stopped::done || step.strategy == Strategy::chain) return generated;
  calibrate(generated.mesh.data(), RenewPolicy::samples_before_a_run, observer);
  if (observer != nullptr && observer->cancelled()) generated.stopped = Stopped::interrupted;
  return generated;
}

LivingMesh::LivingMesh(const OptimiseOptions& options, const DesignSpace& space, Mesh mesh,
                       std::vector<double> design, std::size_t meshes)
    : mesh_(std::move(mesh)),
      space_(&space),
      design_(std::move(design)),
      quality_(quality_of(options)),
      remodel_(step_options(options)) {
  remodel_.designs_a_step = static_cast<std::uint32_t>(meshes);
}

RemodelResult LivingMesh::advance(const Domain& domain) {
  before_ = mesh_.mark();
  return remodel(mesh_, domain, remodel_);
}

RemodelResult LivingMesh::generate_instead(const Domain& domain) {
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

Stopped LivingMesh::step(std::span<const double> design, const StepTasks& tasks, MeshStep& record) {
  const ThreadStopwatch watch;
  const Domain domain = space_->domain(design);
  RemodelResult result = tasks.generate ? generate_instead(domain) : advance(domain);
  record.remodel_seconds = watch.seconds();
  count_losses(result);
  copy_figures(result, record);
  if (result.stopped == Stopped::interrupted) return result.stopped;
  design_.assign(design.begin(), design.end());

  const StepCheck check = checked(domain, tasks.check);
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
  if (!tasks.compare) return Stopped::done;
  const FreshMesh fresh = fresh_mesh(*space_, quality_, *tasks.compare);
  add_comparison(fresh, mesh().gradation_error(), record);
  return fresh.stopped;
}

void LivingMesh::take_back(Mesh&& before, std::vector<double> design, MeshStep& record) {
  put(std::move(before));
  design_ = std::move(design);
  const double seconds = record.remodel_seconds;
  record = {};
  record.remodel_seconds = seconds;
  record.triangles_before = record.triangles = record.preserved = record.connected = mesh().triangle_count();
  record.preserved_percent = record.connectivity_percent = 100.0;
  record.min_angle_deg = check_whole(mesh()).min_angle_deg;
}

StepCheck LivingMesh::checked(const Domain& domain, Checked how) const {
  if (how == Checked::changes) return check_last();
  StepCheck check = check_whole(mesh());
  if (!check.broken.empty() || how != Checked::full) return check;
  const bool layered = space_->layers() != nullptr;
  const Domain walls = layered ? space_->walls(design_) : domain;
  const FrozenMesh view = layered ? with_layers(*space_, mesh(), design_).freeze() : mesh().freeze();
  const CheckResult full = remodel::check(view, {.min_angle_deg = quality_.min_angle_deg,
                                                 .max_gradation = mesh().promised_gradation(),
                                                 .delaunay = !mesh().shows_file_triangles(),
                                                 .delaunay_slack_deg = mesh().delaunay_slack_deg(),
                                                 .design = &walls,
                                                 .max_violations = 1});
  if (full.valid) return check;
  check.broken = full.violations.empty()
                     ? "check: not valid"
                     : full.violations.front().rule + ": " + full.violations.front().detail;
  return check;
}

// The time counts as remodelling: a method that has to be helped out is not faster for it.
Stopped LivingMesh::regenerate(const Domain& domain, MeshStep& record) {
  const ThreadStopwatch watch;
  GenerateResult fresh = generate(domain, quality_);
  record.remodel_seconds += watch.seconds();
  if (fresh.stopped != Stopped::done) return fresh.stopped;
  put(std::move(fresh.mesh));
  record.triangles = mesh().triangle_count();
  record.preserved = record.connected = record.moved = record.inserted = record.removed = record.flipped = 0;
  record.preserved_percent = record.connectivity_percent = 0.0;
  record.full_adjustment = record.morphed = record.refreshed = false;
  record.regenerated = true;
  return Stopped::done;
}

}  // namespace remodel
