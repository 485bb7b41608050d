#pragma once

// Steps with the factors of an earlier matrix, maybe of an earlier mesh: the chord method, accelerated.
// Sources: D. G. Anderson, J. ACM 12 (1965); H. F. Walker and P. Ni, SIAM J. Numer. Anal. 49 (2011), type II,
// for the acceleration; X.-C. Cai and M. Sarkis, SIAM J. Sci. Comput. 21 (1999), for the correction on a part
// of the mesh, here multiplicative and behind the whole.

#include <Eigen/Core>
#include <deque>
#include <optional>

#include "flow/linear/overlap.h"
#include "flow/search/newton_search.h"

namespace remodel::flow {

// Anderson acceleration of x -> x + f(x), some of the last steps kept.
class Anderson {
 public:
  // The step that is to be taken instead of f.
  Increment step(Increment f);
  // `taken` of the last step was taken: 1 all of it.
  void scale_last(double taken);

 private:
  struct Difference {
    Increment f, x;  // of f, and of the state, between two steps
  };
  void add(Difference difference);

  std::deque<Difference> differences_;
  Eigen::MatrixXd products_;       // of the differences of f with each other
  std::optional<Increment> last_;  // f of the last step
  Increment taken_;                // the last step
};

// The inverse of the matrix that `factors` belong to, used for the matrix of another mesh: rows of vertices
// that both have serve, and where the meshes differ an exact solve with the present matrix follows.
class Preconditioner {
 public:
  // Vertices of the overlap's zone are corrected by the Jacobian at `state`.
  Preconditioner(const FlowSystem& system, const State& state, Factors& factors, Overlap overlap,
                 double memory_mb);
  bool ready() const { return ready_; }
  // Approximate Newton step: minus the inverse times the residuals.
  Increment apply(const State& state, const Residuals& residuals);
  double zone_work() const { return zone_lu_.factor_work(); }

 private:
  void correct(const Vector& right, Vector& x);

  const FlowSystem& system_;
  Factors& factors_;
  Overlap overlap_;
  BlockRows zone_;
  DirectSolver<unknown_count> zone_lu_;
  std::array<Vector, augmented_count> columns_;
  bool ready_ = true;
};

enum class ChordEnd {
  converged,
  slow,  // factors of its own are cheaper now, or needed
  interrupted,
};

// Steps until the flow is found or the search's factors no longer pay: where what is left would cost more
// with them than new ones do. `state` is the best one seen.
ChordEnd chord_steps(const Measure& measure, Preconditioner& inverse, NewtonSearch& search, State& state);

// New factors at the state as it is and steps with them, again while that leads on; from a residual within
// Newton's reach only. The factors are of this mesh then.
ChordEnd steps_with_own_factors(const Measure& measure, NewtonSearch& search, State& state);

}  // namespace remodel::flow
