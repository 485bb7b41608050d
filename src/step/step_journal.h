#pragma once

// How a step is taken back. The triangulation and the boundary table keep journals of their own; whatever
// else a step changes is copied before, in the mesh's own storage.

#include <cstddef>
#include <optional>

#include "mesh/mesh_data.h"

namespace remodel {

using LoopIndices = List<std::size_t>;  // of a domain, ascending

class StepJournal {
 public:
  // The step changes these loops at most, and keeps their structure: any loops in any way, if not given.
  StepJournal(MeshData& mesh, const std::optional<LoopIndices>& loops);
  StepJournal(const StepJournal&) = delete;
  StepJournal& operator=(const StepJournal&) = delete;
  // Takes the mesh back to the last bit, unless the step was committed. The adjustment cache stays: it holds
  // for the mesh as it was before the step.
  ~StepJournal();

  // A replacement is complete: the mesh is that of the new design, and can still be taken back.
  void replaced();
  void commit();

 private:
  bool same_rows() const;

  MeshData& mesh_;
  StepBackup& backup_;
  bool structure_stays_;
  std::size_t domain_triangles_;
  std::uint32_t step_;
  Stopped stopped_;
  std::shared_ptr<const MeshReference> reference_;
  double delaunay_slack_deg_;
  bool replaced_ = false, stale_ = false;  // stale_: of the cache, before replaced()
  bool committed_ = false;
};

}  // namespace remodel
