#include "step/step_journal.h"

#include <utility>

#include "step/adjust.h"

namespace remodel {

StepJournal::StepJournal(MeshData& mesh, const std::optional<LoopIndices>& loops)
    : mesh_(mesh),
      backup_(mesh.backup),
      structure_stays_(loops.has_value()),
      domain_triangles_(mesh.domain_triangles),
      step_(mesh.step),
      stopped_(mesh.stopped),
      reference_(mesh.reference),
      delaunay_slack_deg_(mesh.delaunay_slack_deg) {
  backup_.renewal = mesh.renewal;
  backup_.loop_heads = mesh.loop_heads;
  backup_.sides = mesh.sides;
  if (loops) {
    backup_.changing.assign(loops->begin(), loops->end());
    backup_.loops.resize(loops->size());
    for (std::size_t i = 0; i < loops->size(); ++i) backup_.loops[i] = mesh.domain.loops[(*loops)[i]];
  } else {
    backup_.loops = mesh.domain.loops;
  }
  mesh.boundary.begin();
  mesh.triangulation.begin();
  mesh.triangulation.set_step(mesh.step + 1);
}

StepJournal::~StepJournal() {
  if (committed_) return;
  mesh_.triangulation.rollback();
  mesh_.triangulation.set_step(step_);
  mesh_.boundary.rollback();
  mesh_.loop_heads.swap(backup_.loop_heads);
  mesh_.sides.swap(backup_.sides);
  if (structure_stays_)
    for (std::size_t i = 0; i < backup_.changing.size(); ++i)
      std::swap(mesh_.domain.loops[backup_.changing[i]], backup_.loops[i]);
  else
    mesh_.domain.loops.swap(backup_.loops);
  mesh_.index_curves();
  mesh_.forget_extent();
  mesh_.domain_triangles = domain_triangles_;
  mesh_.step = step_;
  mesh_.stopped = stopped_;
  mesh_.reference = std::move(reference_);
  mesh_.delaunay_slack_deg = delaunay_slack_deg_;
  std::swap(mesh_.renewal, backup_.renewal);
  if (mesh_.cache && replaced_) mesh_.cache->stale = stale_;
}

void StepJournal::replaced() {
  ++mesh_.step;
  replaced_ = true;
  mesh_.follow_cache.reset();
  if (!mesh_.cache) return;
  if (!same_rows())
    mesh_.cache.reset();
  else
    stale_ = std::exchange(mesh_.cache->stale, true);
}

void StepJournal::commit() {
  mesh_.triangulation.commit();
  mesh_.boundary.commit();
  committed_ = true;
}

// Whether what a stale cache keeps of the non-Steiner vertices holds for both domains.
bool StepJournal::same_rows() const {
  if (!structure_stays_) return false;
  for (std::size_t i = 0; i < backup_.changing.size(); ++i) {
    const Loop &a = backup_.loops[i], &b = mesh_.domain.loops[backup_.changing[i]];
    for (std::size_t c = 0; c < a.curves.size(); ++c) {
      const auto* airfoil = std::get_if<CstAirfoil>(&a.curves[c].shape);
      if (airfoil != nullptr && !same_basis(*airfoil, std::get<CstAirfoil>(b.curves[c].shape))) return false;
    }
  }
  return true;
}

}  // namespace remodel
