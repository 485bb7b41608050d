#include "remodel/step_check.h"

#include <algorithm>
#include <limits>

#include "mesh/quick_check.h"
#include "remodel/adjust.h"

namespace remodel {

namespace {

class Changes {
 public:
  explicit Changes(const MeshData& mesh) : mesh_(mesh), check_(mesh) {}

  void triangle(TriangleId t) {
    if (!broken_.empty() || !mesh_.triangulation[t].alive()) return;
    broken_ = check_.triangle(t);
    if (mesh_.triangulation[t].region != Region::domain) return;
    const auto [squared_radius, shortest] = measure(mesh_.triangulation, mesh_.triangulation[t]);
    worst_ = std::max(worst_, squared_radius / shortest);
  }
  void loop(std::size_t loop) {
    if (broken_.empty()) broken_ = check_.loop(loop);
  }
  StepCheck result() && {
    return {.broken = std::move(broken_),
            .min_angle_deg = worst_ > 0.0 ? angle_of(worst_) : std::numeric_limits<double>::infinity()};
  }

 private:
  const MeshData& mesh_;
  QuickCheck check_;
  std::string broken_;
  double worst_ = 0.0;  // (radius / shortest edge)^2
};

}  // namespace

StepCheck check_whole(const Mesh& mesh) {
  return {.broken = mesh.quick_check(), .min_angle_deg = mesh.statistics().min_angle_deg};
}

StepCheck check_step(const Mesh& mesh, const RemodelResult& step) {
  if (step.refreshed || step.regenerated) return check_whole(mesh);
  const MeshData& data = mesh.data();
  Changes changes(data);
  const auto* cache = dynamic_cast<const AdjustCache*>(data.cache.get());
  if (!step.full_adjustment)
    for (const TriangleId t : data.triangulation.touched()) changes.triangle(t);
  else if (cache == nullptr)
    return check_whole(mesh);
  else
    for (const AdjustCache::Affected& a : cache->affected) changes.triangle(a.triangle);
  for (std::size_t loop = 0; loop < data.loop_heads.size(); ++loop)
    if (cache == nullptr || std::binary_search(cache->loops.begin(), cache->loops.end(), loop))
      changes.loop(loop);
  return std::move(changes).result();
}

}  // namespace remodel
