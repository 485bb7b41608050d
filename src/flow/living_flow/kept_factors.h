#pragma once

// Factors that outlive their mesh: rows by key, with the keys of each row's neighbours, and what using them
// has cost.

#include "flow/linear/factors.h"
#include "flow/linear/overlap.h"
#include "flow/living_flow/last_flow.h"

namespace remodel::flow {

// Decides whether new factors are worth their time: they are if those made before have served other flows
// than their own. If not, flows go by without, more each time (1, 3, 7, ...), before it is tried again.
class Worth {
 public:
  bool pays();
  void made() { served_ = false; }
  void served() { served_ = true, pause_ = gone_by_ = 0; }
  void given_up();

 private:
  bool served_ = false;
  int pause_ = 0, gone_by_ = 0;
};

template <std::size_t N>
class KeptFactors {
 public:
  BlockFactors<N> factors;
  Worth worth;

  bool ready() const { return ready_; }
  // What was made in `factors` last belongs to this mesh.
  void belong(const FlowMesh& mesh, const Keys& keys);
  // Drops factors that no longer converge.
  void drop();
  // Makes room for others, without judging these.
  void replace() { ready_ = false; }

  // The difference between this mesh and the one they belong to, and whether it is worth a correction.
  Overlap overlap(const FlowMesh& mesh, const Keys& keys) const;
  static bool is_small(const Overlap& overlap);

  // Ski rental: they serve until they have cost as much as new ones.
  void charge(int iterations, int own_iterations, double zone_work);
  double solves_left() const;
  bool are_fresh() const { return rent_ == 0.0; }

 private:
  bool ready_ = false;
  Keys keys_;
  std::vector<Keys> rings_;
  double rent_ = 0.0;  // what they have cost beyond new ones
};

}  // namespace remodel::flow
