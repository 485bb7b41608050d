#pragma once

// The mesh's side of a run: one living mesh, remodelled from design to design, timed, validated, and
// regenerated where it has to be.

#include <optional>
#include <string>

#include "optimise/design_domains.h"
#include "remodel/airfoil.h"
#include "remodel/history.h"
#include "remodel/mesh.h"
#include "remodel/optimise.h"
#include "remodel/step_check.h"

namespace remodel {

// What else is done with the mesh of one design.
struct StepTasks {
  bool compare = false;              // generate a fresh mesh
  Checked check = Checked::changes;  // how the mesh is validated
  bool generate = false;             // the mesh is generated, not remodelled
};

// The mesh of the start, as a chain begins with it. None where a limit keeps it from being finished.
std::optional<Mesh> first_mesh(const CstAirfoil& from, const OptimiseOptions& options);

class MeshChain {
 public:
  // One of so many meshes that share the designs.
  MeshChain(const OptimiseOptions& options, Mesh mesh, std::size_t meshes = 1);
  virtual ~MeshChain() = default;
  MeshChain(MeshChain&&) = default;
  MeshChain& operator=(MeshChain&&) = default;

  // Remodels to the design and fills in the record's figures of the mesh. Stopped::done, or the limit that
  // kept the mesh from being finished.
  Stopped step(const CstAirfoil& design, StepTasks tasks, EvaluationRecord& record);
  // Of the last design.
  virtual const Mesh& mesh() const { return mesh_; }

 protected:
  // The timed part of a step: from the last design's mesh to that of this one.
  virtual RemodelResult advance(const Domain& domain);
  // Corrects what advance() says was before and is preserved. Not timed.
  virtual void count_losses(RemodelResult& result) { static_cast<void>(result); }
  // What the last advance() changed, or all that it may have changed.
  virtual StepCheck check_changes(const RemodelResult& result) const { return check_step(mesh_, result); }
  // A fresh mesh takes the place of the last design's.
  virtual void put(Mesh&& fresh) { mesh_ = std::move(fresh); }

  const RemodelOptions& remodel_options() const { return remodel_; }
  Mesh mesh_;

 private:
  StepCheck checked(const Domain& domain, const RemodelResult& result, Checked how) const;
  RemodelResult generate_instead(const Domain& domain);
  Stopped regenerate(const Domain& domain, EvaluationRecord& record);
  Stopped compare(const CstAirfoil& design, EvaluationRecord& record) const;

  DesignDomains domain_of_;
  QualityOptions quality_;
  RemodelOptions remodel_;
};

}  // namespace remodel
