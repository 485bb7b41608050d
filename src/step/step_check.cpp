#include "step/step_check.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "mesh/quick_check.h"

namespace remodel {

namespace {

class ChangesCheck {
 public:
  explicit ChangesCheck(const MeshData& mesh)
      : mesh_(mesh), check_(mesh), seen_(mesh.triangulation.triangle_slots(), false) {}

  void triangle(TriangleId t) {
    if (!broken_.empty() || t.index >= seen_.size() || seen_[t.index]) return;
    seen_[t.index] = true;
    if (!mesh_.triangulation[t].alive()) return;
    broken_ = check_.triangle(t);
    if (mesh_.triangulation[t].region != Region::domain) return;
    const auto [squared_radius, shortest] = measure(mesh_.triangulation, mesh_.triangulation[t]);
    worst_ = std::max(worst_, squared_radius / shortest);
  }
  // The triangles at a vertex that was there already and has moved.
  void moved(const ChangeRecord::VertexThen& then) {
    if (!then.alive || then.id.index >= mesh_.triangulation.vertex_slots()) return;
    const Vertex& now = mesh_.triangulation[then.id];
    if (!now.alive() || now.point == then.point) return;
    mesh_.triangulation.for_each_corner(then.id, [&](Corner c) { triangle(c.triangle); });
  }
  // The loop, and the triangles at it: their length scales are others.
  void loop(std::size_t loop) {
    if (broken_.empty()) broken_ = check_.loop(loop);
    if (!broken_.empty()) return;
    mesh_.walk(mesh_.loop_heads[loop], [&](std::uint32_t k) {
      mesh_.triangulation.for_each_corner(mesh_.at(k).vertex, [&](Corner c) { triangle(c.triangle); });
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
  std::vector<bool> seen_;
  std::string broken_;
  double worst_ = 0.0;  // (radius / shortest edge)^2
};

bool nothing_noted(const ChangeRecord& record) {
  return record.vertices().empty() && record.triangles().empty();
}

}  // namespace

StepCheck check_whole(const Mesh& mesh) {
  return {.broken = mesh.quick_check(), .min_angle_deg = mesh.statistics().min_angle_deg, .whole = true};
}

StepCheck check_changes(const Mesh& mesh, const Mark& since) {
  const MeshData& data = mesh.data();
  const ChangeRecord& record = data.marked.of(since);
  if (record.exchanged() || nothing_noted(record)) return check_whole(mesh);
  ChangesCheck check(data);
  for (const ChangeRecord::TriangleThen& then : record.triangles()) check.triangle(then.id);
  for (const ChangeRecord::VertexThen& then : record.vertices()) check.moved(then);
  for (std::size_t loop = 0; loop < data.loop_heads.size(); ++loop)
    if (record.loop_changed(loop)) check.loop(loop);
  return std::move(check).result();
}

}  // namespace remodel
