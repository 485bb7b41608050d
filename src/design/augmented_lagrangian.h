#pragma once

// Constraints (satisfied where at most 0) for a search that ranks designs by one number. With a multiplier l
// and a penalty m of each constraint g that number is the objective and, added up,
//
//   l g + m g^2 / 2, or that term's minimum -l^2 / (2 m) where g is below -l / m:
//
// its minimum is the constrained one where the multipliers are right, whatever the penalties. Both are
// adapted once a generation, so that the designs of a generation are ranked by the same.
//
// Sources: A. Atamna, A. Auger, N. Hansen, "Linearly convergent evolution strategies via augmented Lagrangian
// constraint handling", FOGA 2017, algorithm 1, how both are adapted; P. Dufosse, N. Hansen, "Augmented
// Lagrangian, penalty techniques and surrogate modeling for constrained optimization with CMA-ES", GECCO
// 2021, by how much, as their Python package `cma` has it, from which the thought is too that first values
// come from the spread of objective and constraint. Where we depart:
//  (1) the mean of the distribution is not evaluated: its objective and constraints are recombined from those
//      of the best designs as the mean is from the designs, which is exact for linear ones;
//  (2) multipliers start at 0, and penalties with the first design that violates the constraint; while all
//      designs of a generation violate it, the penalty is at least what it would start with;
//  (3) a penalty stays as it is while its constraint is inactive.

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

#include "remodel/evaluation.h"

namespace remodel {

class AugmentedLagrangian {
 public:
  explicit AugmentedLagrangian(int dimension) : dimension_(dimension) {}

  // The numbers that rank a generation, with which the coefficients are adapted for the next one. Evaluations
  // are finite, at least one, with the same number of constraints in every generation; weights are those of
  // the best designs, best first.
  std::vector<double> rank(std::span<const Evaluation> generation, std::span<const double> weights);

  std::size_t constraints() const { return terms_.size(); }  // 0: no generation was ranked yet
  nlohmann::json state() const;
  void restore(const nlohmann::json& state);  // throws std::exception for what is none

 private:
  struct Term {
    double multiplier = 0.0;
    double penalty = 0.0;  // 0: the constraint was never violated, and is left out
  };
  void raise_penalties(std::span<const Evaluation> generation);
  void adapt(Evaluation mean);
  double penalised(const Evaluation& evaluation) const;

  int dimension_;
  std::vector<Term> terms_{};
  Evaluation mean_{};  // of the generation before
};

}  // namespace remodel
