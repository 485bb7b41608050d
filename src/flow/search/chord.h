#pragma once

// Steps with the factors of an earlier matrix, maybe of an earlier mesh: the chord method, accelerated.
// Sources: D. G. Anderson, J. ACM 12 (1965); H. F. Walker and P. Ni, SIAM J. Numer. Anal. 49 (2011), type II,
// for the acceleration; X.-C. Cai and M. Sarkis, SIAM J. Sci. Comput. 21 (1999), for the correction on a part
// of the mesh, here multiplicative and behind the whole.

#include <Eigen/Core>
#include <deque>
#include <optional>

#include "flow/search/newton_search.h"

namespace remodel::flow {

// Anderson acceleration of x -> x + f(x), the last `depth` steps kept.
class Anderson {
 public:
  // The step that is to be taken instead of f.
  Increment step(Increment f);
  // `taken` of the last step was taken: 1 all of it.
  void scale_last(double taken);

 private:
  static constexpr std::size_t depth = 12;
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
  // row_of: per vertex of the present mesh its row in the factors, no_index if it has none; rows: of the
  // factors. Vertices of `zone`, ascending, are corrected by the Jacobian at `state`.
  Preconditioner(const FlowSystem& system, const State& state, Factors& factors,
                 std::vector<std::uint32_t> row_of, std::size_t rows, const std::vector<std::uint32_t>& zone,
                 const FlowOptions& options);
  bool ready() const { return ready_; }
  // About minus the Newton step's opposite: what makes the residuals zero, if the factors are right.
  Increment apply(const State& state, const Vector& residual, const Augmented& augmented);
  double zone_work() const { return zone_lu_.factor_work(); }

 private:
  void correct(const Vector& right, Vector& x);

  const FlowSystem& system_;
  Factors& factors_;
  std::vector<std::uint32_t> row_of_;
  std::size_t rows_;
  BlockRows zone_;
  DirectSolver zone_lu_;
  std::array<Vector, 2> columns_;
  bool ready_ = true;
};

enum class ChordEnd {
  converged,
  slow,  // factors of its own are cheaper now, or needed
  interrupted,
};

// Steps until the flow is found or the factors no longer pay: where what is left would cost more with them
// than new ones do. `state` is the best one seen.
ChordEnd chord_steps(const Measure& measure, Preconditioner& inverse, const Factors& factors,
                     const FlowOptions& options, State& state, Search& search);

// New factors at the state as it is and steps with them, again while that leads on; from a residual within
// Newton's reach only. The factors are of this mesh then.
ChordEnd steps_with_own_factors(const FlowSystem& system, const Measure& measure, const FlowOptions& options,
                                BlockRows& matrix, Factors& factors, State& state, Search& search);

}  // namespace remodel::flow
