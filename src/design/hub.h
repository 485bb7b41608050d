#pragma once

// MeshStrategy::hub: one mesh, the *hub*, stays near the mean of the optimiser's distribution; every design
// is tried on a copy of it, which returns to the hub when the next design comes.
//
// The hub follows lazily. At the beginning of a generation it is remodelled to the mean where all of its
// vertices can be moved there in place: that changes no triangle but those on the boundary, which every
// design changes anyway. Where they cannot, triangles inside the mesh would be replaced, which all workers
// lose: that is done only when it pays, that is when more than half of the generation before had to replace
// some too.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "design/living_mesh.h"
#include "design/triangle_snapshot.h"
#include "remodel/remodel.h"

namespace remodel {

class Hub {
 public:
  // The space must outlive it. Each of its steps stands for a generation that it follows, of so many designs.
  Hub(const OptimiseOptions& options, const DesignSpace& space, std::size_t population, Mesh mesh);

  // Counts of the generation before.
  struct Generation {
    std::uint64_t evaluated = 0;
    std::uint64_t full_adjustments = 0;
  };
  // Returns whether the strategy generated the hub afresh.
  bool follow(std::span<const double> mean, const Generation& before);

  const Mesh& mesh() const { return mesh_; }
  std::uint64_t version() const { return version_; }  // changes with the mesh; from 1

 private:
  const DesignSpace* space_;
  RemodelOptions remodel_;
  Mesh mesh_;
  std::uint64_t version_ = 1;
};

// A worker on a copy of the hub. Its losses are counted against the mesh that it solved on before.
class TrialMesh : public LivingMesh {
 public:
  // Space and hub must outlive it; solved_on is the mesh of its last design, which is `design`.
  TrialMesh(const OptimiseOptions& options, const DesignSpace& space, const Hub& hub, Mesh solved_on,
            std::vector<double> design);

  const Mesh& mesh() const override { return instead_ ? *instead_ : mesh_; }
  const Mark* before() const override { return nullptr; }

 protected:
  RemodelResult advance(const Domain& domain) override;
  void count_losses(RemodelResult& result) override;
  // The hub has moved on since the mesh before.
  StepCheck check_last() const override { return check_whole(mesh()); }
  void put(Mesh&& fresh) override;

 private:
  const Hub& hub_;
  std::uint64_t version_ = 0;    // of the hub that mesh_ is a copy of, but for the trial
  std::optional<Trial> trial_;   // of the last design
  std::optional<Mesh> instead_;  // the last design's mesh, where that is not the trial's
  TriangleSnapshot solved_on_;   // the last design's
};

}  // namespace remodel
