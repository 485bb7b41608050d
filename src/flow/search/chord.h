#pragma once

// Steps with the factors of an earlier matrix, maybe of an earlier mesh: the chord method, accelerated.
// Sources: D. G. Anderson, J. ACM 12 (1965); H. F. Walker and P. Ni, SIAM J. Numer. Anal. 49 (2011), type II,
// for the acceleration; X.-C. Cai and M. Sarkis, SIAM J. Sci. Comput. 21 (1999), for the correction on a part
// of the mesh, here multiplicative and behind the whole.

#include <Eigen/Core>
#include <deque>
#include <optional>

#include "flow/linear/overlap.h"
#include "flow/search/policy.h"
#include "flow/search/search.h"

namespace remodel::flow {

// All that follows is compiled for blocks of N = 4 and 5.

// Anderson acceleration of x -> x + f(x), some of the last steps kept.
template <std::size_t N>
class Anderson {
 public:
  // The step that is to be taken instead of f.
  BlockIncrement<N> step(BlockIncrement<N> f);
  // `taken` of the last step was taken: 1 all of it.
  void scale_last(double taken);

 private:
  struct Difference {
    BlockIncrement<N> f, x;  // of f, and of the state, between two steps
  };
  void add(Difference difference);

  std::deque<Difference> differences_;
  Eigen::MatrixXd products_;               // of the differences of f with each other
  std::optional<BlockIncrement<N>> last_;  // f of the last step
  BlockIncrement<N> taken_;                // the last step
};

// The inverse of the matrix that `factors` belong to, used for the matrix of another mesh: rows of vertices
// that both have serve, and where the meshes differ an exact solve with the present matrix follows.
template <std::size_t N>
class Preconditioner {
 public:
  // Vertices of the overlap's zone are corrected by the Jacobian at `state`, and the augmented equations are those
  // there.
  Preconditioner(const BlockSystem<N>& system, const BlockState<N>& state, BlockFactors<N>& factors,
                 Overlap overlap, double memory_mb);
  bool ready() const { return ready_; }
  // Approximate Newton step: minus the inverse times the residuals.
  BlockIncrement<N> apply(const BlockResiduals<N>& residuals);
  double zone_work() const { return zone_lu_.factor_work(); }

 private:
  void correct(const BlockVector<N>& right, BlockVector<N>& x);

  BlockFactors<N>& factors_;
  Overlap overlap_;
  BlockMatrix<N> zone_;
  DirectSolver<N> zone_lu_;
  std::array<BlockVector<N>, augmented_count> columns_;
  BlockAugmentedRows<N> rows_;
  bool ready_ = true;
};

enum class ChordEnd {
  converged,
  slow,  // factors of its own are cheaper now, or needed
  interrupted,
};

// Steps until the flow is found or the search's factors no longer pay: where what is left would cost more
// with them than new ones do. `state` is the best one seen.
template <std::size_t N>
ChordEnd chord_steps(const BlockMeasure<N>& measure, Preconditioner<N>& inverse, BlockSearch<N>& search,
                     BlockState<N>& state);

// New factors at the state as it is and steps with them, again while that leads on; from a residual within
// Newton's reach only. The factors are of this mesh then.
template <std::size_t N>
ChordEnd steps_with_own_factors(const BlockMeasure<N>& measure, BlockSearch<N>& search, BlockState<N>& state);

}  // namespace remodel::flow
