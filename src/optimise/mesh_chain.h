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

namespace remodel {

// What else is done with the mesh of one design.
struct StepTasks {
  bool compare = false;     // generate a fresh mesh
  bool full_check = false;  // check() too
};

// The mesh of the start, as a chain begins with it. None where a limit keeps it from being finished.
std::optional<Mesh> first_mesh(const CstAirfoil& from, const OptimiseOptions& options);

class MeshChain {
 public:
  MeshChain(const OptimiseOptions& options, Mesh mesh);

  // Remodels to the design and fills in the record's figures of the mesh. Stopped::done, or the limit that
  // kept the mesh from being finished.
  Stopped step(const CstAirfoil& design, StepTasks tasks, EvaluationRecord& record);
  const Mesh& mesh() const { return mesh_; }

 private:
  std::string broken_rule(const Domain& domain, StepTasks tasks) const;
  Stopped regenerate(const Domain& domain, EvaluationRecord& record);
  Stopped compare(const CstAirfoil& design, EvaluationRecord& record) const;

  DesignDomains domain_of_;
  QualityOptions quality_;
  RemodelOptions remodel_;
  Mesh mesh_;
};

}  // namespace remodel
