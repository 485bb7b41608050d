#include "optimise/hub.h"

#include <utility>

#include "remodel/count_control.h"

namespace remodel {

Hub::Hub(const OptimiseOptions& options, std::size_t population, Mesh mesh)
    : domain_of_(options), remodel_(options.remodel), mesh_(std::move(mesh)) {
  remodel_.designs_a_step = static_cast<std::uint32_t>(population);
}

bool Hub::follow(const CstAirfoil& mean, const Generation& before) {
  const Domain domain = domain_of_(mean);
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

HubChain::HubChain(const OptimiseOptions& options, const Hub& hub, Mesh solved_on)
    : MeshChain(options, Mesh()), hub_(hub), instead_(std::move(solved_on)), solved_on_(instead_->data()) {}

RemodelResult HubChain::advance(const Domain& domain) {
  trial_.reset();
  instead_.reset();
  if (version_ != hub_.version()) {
    mesh_ = hub_.mesh();
    // Whether the count is worth a look is the hub's affair, not that of every trial; and a replacement that
    // is tried renews, however many the hub has kept.
    mesh_.data().renewal.full_adjustments = 0;
    mesh_.data().renewal.until_renewal = 0;
    know_interior_size(mesh_.data());  // once for all trials
    version_ = hub_.version();
  }
  trial_.emplace(mesh_, domain, remodel_options());
  return trial_->result();
}

void HubChain::count_losses(RemodelResult& result) {
  result.triangles_before = solved_on_.size();
  result.preserved = solved_on_.common_with(mesh().data());
  solved_on_ = TriangleSnapshot(mesh().data());
}

void HubChain::put(Mesh&& fresh) {
  trial_.reset();
  instead_ = std::move(fresh);
  solved_on_ = TriangleSnapshot(instead_->data());
}

}  // namespace remodel
