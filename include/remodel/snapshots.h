#pragma once

// Earlier designs and their states on one connectivity of a living mesh, combined into a start for the next
// design.
//
//   Snapshots snapshots;
//   remodel(mesh, domain);
//   const auto start = snapshots.start(mesh, design);    // nothing where there is none of this connectivity
//   ... solve from start->values ...
//   snapshots.add(mesh, design, solution);
//
// As long as steps move vertices in place, values have the same numbers, and a state is a smooth function of
// the design: the combination of earlier designs that comes nearest to the new one, applied to their states,
// is right to second order where the last state alone is right to first order. A step that replaces triangles
// ends that: what was kept is dropped.

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "remodel/changes.h"
#include "remodel/mesh.h"

namespace remodel {

struct SnapshotOptions {
  std::size_t limit = 12;  // snapshots that are kept, the latest; 1 or more
  // Weight of the coefficients' squares beside the squared distance to the new design, as a part of the
  // largest squared distance between snapshots: larger ones keep coefficients smaller. 0 or more.
  double regularisation = 1e-8;
};

struct SnapshotStart {
  std::vector<double> values;
  std::size_t snapshots = 0;  // that were combined
  std::size_t base = 0;       // the nearest one, of kept()
  // Distance of the combined design from the new one, over that of the nearest snapshot: 0 where the
  // combination is exact, 1 where it is no better than the nearest.
  double misfit = 0.0;
};

class Snapshots {
 public:
  struct Snapshot {
    std::vector<double> design, values;
  };

  // Throws Error (argument) for options out of range.
  explicit Snapshots(const SnapshotOptions& options = {});

  // The state of a design on the mesh as it is now: values in any numbering that the connectivity decides, by
  // ids or by position. Throws Error (argument) for another number of parameters or values than those kept,
  // and for values that are not finite.
  void add(Mesh& mesh, std::span<const double> design, std::vector<double> values);
  // The start is made of the designs kept: the nearest one is the base, and the coefficients of the
  // differences to all others are found by least squares. It is nothing where none is left. Throws Error
  // (argument) for another number of parameters.
  std::optional<SnapshotStart> start(const Mesh& mesh, std::span<const double> design);

  // These serve a caller who compares connectivities himself, between frozen meshes for example, and calls
  // clear() when one ends.
  void add(std::span<const double> design, std::vector<double> values);
  std::optional<SnapshotStart> start(std::span<const double> design) const;
  void clear() { kept_.clear(); }

  std::size_t size() const { return kept_.size(); }
  const std::deque<Snapshot>& kept() const { return kept_; }  // the oldest first

 private:
  void drop_if_replaced(const Mesh& mesh);
  std::size_t nearest(std::span<const double> design) const;

  SnapshotOptions options_;
  Mark mark_;  // when the connectivity of what is kept was there already
  std::deque<Snapshot> kept_;
};

}  // namespace remodel
