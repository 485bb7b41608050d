#include "design/hub.h"

#include <utility>

namespace remodel {

Hub::Hub(const OptimiseOptions& options, const DesignSpace& space, std::size_t population, Mesh mesh)
    : space_(&space), remodel_(step_options(options)), mesh_(std::move(mesh)) {
  remodel_.designs_a_step = static_cast<std::uint32_t>(population);
}

bool Hub::follow(std::span<const double> mean, const Generation& before) {
  const Domain domain = space_->domain(mean);
  if (mesh_.domain() == domain) return false;
  Trial trial(mesh_, domain, remodel_);
  const RemodelResult& result = trial.result();
  const bool pays = 2 * before.full_adjustments < before.evaluated;
  const bool in_place = result.full_adjustment || result.refreshed;
  if (result.stopped != Stopped::done || !(in_place || pays)) return false;
  trial.keep();
  ++version_;
  return result.refreshed;
}

TrialMesh::TrialMesh(const OptimiseOptions& options, const DesignSpace& space, const Hub& hub, Mesh solved_on,
                     std::vector<double> design)
    : LivingMesh(options, space, Mesh(), std::move(design)),
      hub_(hub),
      instead_(std::move(solved_on)),
      solved_on_(instead_->data()) {}

RemodelResult TrialMesh::advance(const Domain& domain) {
  trial_.reset();
  instead_.reset();
  if (version_ != hub_.version()) {
    mesh_ = hub_.mesh();
    // Whether the count is worth a look is the hub's affair, not that of every trial; and a replacement that
    // is tried renews, however many the hub has kept.
    mesh_.data().renewal.full_adjustments = 0;
    mesh_.data().renewal.until_renewal = 0;
    version_ = hub_.version();
  }
  trial_.emplace(mesh_, domain, remodel_options());
  return trial_->result();
}

void TrialMesh::count_losses(RemodelResult& result) {
  result.triangles_before = solved_on_.size();
  const TriangleSnapshot::Common common = solved_on_.common_with(mesh().data());
  result.preserved = common.same;
  result.connected = common.joined;
  solved_on_ = TriangleSnapshot(mesh().data());
}

void TrialMesh::put(Mesh&& fresh) {
  trial_.reset();
  instead_ = std::move(fresh);
  solved_on_ = TriangleSnapshot(instead_->data());
}

}  // namespace remodel
