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
  // What the last journal lists.
  void journal() {
    const Triangulation& triangulation = mesh_.triangulation;
    for (const TriangleId t : triangulation.touched()) triangle(t);
    triangulation.for_each_moved_only([this](TriangleId t) { triangle(t); });
  }
  // The loop, and the triangles at it that the step left as they were, but for their length scales.
  void loop(std::size_t loop) {
    if (broken_.empty()) broken_ = check_.loop(loop);
    if (!broken_.empty()) return;
    mesh_.walk(mesh_.loop_heads[loop], [&](std::uint32_t k) {
      mesh_.triangulation.for_each_corner(mesh_.at(k).vertex, [&](Corner c) {
        if (mesh_.triangulation[c.triangle].birth != mesh_.step) triangle(c.triangle);
      });
    });
  }
  StepCheck result() && {
    return {.broken = std::move(broken_),
            .min_angle_deg = worst_ > 0.0 ? angle_of(worst_) : std::numeric_limits<double>::infinity(),
            .whole = false};
  }

 private:
  const MeshData& mesh_;
  QuickCheck check_;
  std::string broken_;
  double worst_ = 0.0;  // (radius / shortest edge)^2
};

bool changes_are_known(const RemodelResult& step) {
  return step.stopped == Stopped::done && !step.refreshed && !step.regenerated &&
         !(step.full_adjustment && step.moved == 0);
}

}  // namespace

StepCheck check_whole(const Mesh& mesh) {
  return {.broken = mesh.quick_check(), .min_angle_deg = mesh.statistics().min_angle_deg, .whole = true};
}

StepCheck check_step(const Mesh& mesh, const RemodelResult& step) {
  const MeshData& data = mesh.data();
  const auto* cache = dynamic_cast<const AdjustCache*>(data.cache.get());
  const bool specialised = step.method == Method::specialised && cache != nullptr;
  if (!changes_are_known(step) || (step.full_adjustment && !specialised)) return check_whole(mesh);
  Changes changes(data);
  if (step.full_adjustment)
    for (const AdjustCache::Affected& a : cache->affected) changes.triangle(a.triangle);
  else
    changes.journal();
  for (std::size_t loop = 0; loop < data.loop_heads.size(); ++loop)
    if (!specialised || std::binary_search(cache->loops.begin(), cache->loops.end(), loop))
      changes.loop(loop);
  return std::move(changes).result();
}

}  // namespace remodel
