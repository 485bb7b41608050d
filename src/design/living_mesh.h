#pragma once

// The mesh's side of a run: one living mesh, remodelled from design to design, timed, validated, and
// regenerated where it has to be. It knows nothing of objectives.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "remodel/design_space.h"
#include "remodel/generate.h"
#include "remodel/living_mesh.h"
#include "remodel/mesh.h"
#include "remodel/optimise.h"
#include "step/step_check.h"

namespace remodel {

// The work on the mesh of one design beside the step itself.
struct StepTasks {
  std::optional<std::vector<double>> compare{};  // generate a fresh mesh of this design, to compare with
  Checked check = Checked::changes;              // how the mesh is validated
  bool generate = false;                         // the mesh is generated, not remodelled
};

// What history says of a design whose mesh met this limit.
std::string at_limit(Stopped stopped);

// The quality that a run's meshes promise.
QualityOptions quality_of(const OptimiseOptions& options);

// The design of a run's first mesh.
std::vector<double> first_design(const DesignSpace& space, const OptimiseOptions& options);

// The mesh of the first design, as a run begins with it. Anything but Stopped::done: a limit, or the
// observer, has kept it from being finished.
GenerateResult first_mesh(const DesignSpace& space, const OptimiseOptions& options,
                          StepObserver* observer = nullptr);

class LivingMesh {
 public:
  // A mesh of this design. The space must outlive it. One of so many meshes that share the designs.
  LivingMesh(const OptimiseOptions& options, const DesignSpace& space, Mesh mesh, std::vector<double> design,
             std::size_t meshes = 1);
  virtual ~LivingMesh() = default;
  LivingMesh(LivingMesh&&) = default;
  LivingMesh& operator=(LivingMesh&&) = default;

  // Remodels to the design and records what that came to. Stopped::done, or the limit that kept the mesh from
  // being finished.
  Stopped step(std::span<const double> design, const StepTasks& tasks, MeshStep& record);
  // Puts back the mesh from before a step that met a limit, and records that there was none.
  void take_back(Mesh&& before, std::vector<double> design, MeshStep& record);
  // That mesh() is of: mostly the last one.
  const std::vector<double>& design() const { return design_; }
  // The mesh of the last design.
  virtual const Mesh& mesh() const { return mesh_; }
  // The mesh of the design before, if this one was made from it.
  virtual const Mark* before() const { return before_ ? &*before_ : nullptr; }

 protected:
  // The timed part of a step: from the last design's mesh to that of this one.
  virtual RemodelResult advance(const Domain& domain);
  // Corrects what advance() says was before and is preserved. Not timed.
  virtual void count_losses(RemodelResult& result) { static_cast<void>(result); }
  // Checks what the last advance() changed, or all that it may have changed; a fresh mesh as a whole.
  virtual StepCheck check_last() const {
    return before_ ? check_changes(mesh_, *before_) : check_whole(mesh_);
  }
  // A fresh mesh takes the place of the last design's.
  virtual void put(Mesh&& fresh) { before_.reset(), mesh_ = std::move(fresh); }

  const RemodelOptions& remodel_options() const { return remodel_; }
  Mesh mesh_;

 private:
  StepCheck checked(const Domain& domain, Checked how) const;
  RemodelResult generate_instead(const Domain& domain);
  Stopped regenerate(const Domain& domain, MeshStep& record);

  const DesignSpace* space_;
  std::vector<double> design_;
  QualityOptions quality_;
  RemodelOptions remodel_;
  std::optional<Mark> before_;  // the last advance()
};

}  // namespace remodel
