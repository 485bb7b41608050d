#include "flow/living_flow/kept_factors.h"

#include <algorithm>
#include <utility>

#include "flow/search/policy.h"

namespace remodel::flow {

namespace {

void fill_ring(const FlowMesh& mesh, const Keys& keys, std::size_t v, Keys& ring) {
  ring.clear();
  for (const RingEntry& entry : mesh.ring(v)) ring.push_back(keys[entry.vertex]);
  std::sort(ring.begin(), ring.end());
}

}  // namespace

bool Worth::pays() {
  if (gone_by_ >= pause_) return true;
  ++gone_by_;
  return false;
}

void Worth::given_up() {
  if (!served_) pause_ = std::min(2 * pause_ + 1, SearchPolicy::longest_pause), gone_by_ = 0;
}

template <std::size_t N>
void KeptFactors<N>::belong(const FlowMesh& mesh, const Keys& keys) {
  ready_ = factors.ready();
  rent_ = 0.0;
  worth.made();
  keys_ = keys;
  rings_.resize(keys.size());
  for (std::size_t v = 0; v < keys.size(); ++v) fill_ring(mesh, keys, v, rings_[v]);
}

template <std::size_t N>
void KeptFactors<N>::drop() {
  if (std::exchange(ready_, false)) worth.given_up();
}

template <std::size_t N>
Overlap KeptFactors<N>::overlap(const FlowMesh& mesh, const Keys& keys) const {
  const KeyTable table(keys_);
  Overlap result{.row_of = std::vector<std::uint32_t>(mesh.size()), .rows = keys_.size(), .zone = {}};
  std::vector<std::uint32_t>& zone = result.zone;
  std::vector<bool> in_zone(mesh.size(), false);
  const auto note = [&](std::uint32_t v) {
    if (in_zone[v]) return;
    in_zone[v] = true;
    zone.push_back(v);
  };
  Keys ring;
  for (std::uint32_t v = 0; v < mesh.size(); ++v) {
    const std::uint32_t row = result.row_of[v] = table.find(keys[v]);
    fill_ring(mesh, keys, v, ring);
    if (row == no_index || ring != rings_[row]) note(v);
  }
  for (int rings = 0; rings < 2; ++rings)
    for (std::size_t i = 0, n = zone.size(); i < n; ++i)
      for (const RingEntry& entry : mesh.ring(zone[i])) note(entry.vertex);
  std::sort(zone.begin(), zone.end());
  return result;
}

template <std::size_t N>
bool KeptFactors<N>::is_small(const Overlap& overlap) {
  return static_cast<double>(overlap.zone.size()) <=
         SearchPolicy::largest_zone * static_cast<double>(overlap.row_of.size());
}

template <std::size_t N>
void KeptFactors<N>::charge(int iterations, int own_iterations, double zone_work) {
  rent_ += std::max(0, iterations - own_iterations) * factors.solve_work() + zone_work;
}

template <std::size_t N>
double KeptFactors<N>::solves_left() const {
  return (factors.factor_work() - rent_) / factors.solve_work();
}

template class KeptFactors<4>;
template class KeptFactors<5>;

}  // namespace remodel::flow
