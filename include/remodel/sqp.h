#pragma once

// Sequential quadratic programming in a trust box, as a designer that is asked and told: one evaluation with
// gradients a step. Source: J. Nocedal and S. J. Wright, "Numerical Optimization", 2nd ed. (2006), sections
// 18.5 (elastic constraints in a box) and 18.3 (procedure 18.2, damped BFGS of the Lagrangian); the penalty:
// M. J. D. Powell, "A fast algorithm for nonlinearly constrained optimization calculations" (1978).

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "remodel/designer.h"

namespace remodel {

struct SqpOptions {
  double trust = 0.02;        // first half-width of the trust box, in the design's numbers; > 0
  double least_trust = 1e-5;  // the search ends below
  // It ends too where its model promises less than this part of the objective's first value, once more after
  // a model that begins anew, if this is small.
  double least_promise = 1e-6;
  // It does not end so where the best design violates a constraint by more, unless the box has shrunk to
  // least_trust.
  double constraint_tolerance = 0.0;
  // The lowest and highest value of each number of the design.
  std::vector<double> low{}, high{};
  // So many designs around the start are tried in its place where its evaluation fails, ever farther from
  // it.
  std::size_t other_starts = 4;
  // Initial shape of the second derivatives, a symmetric positive matrix row by row; empty: the identity.
  std::vector<double> metric{};
};

// Each step makes a model of the objective small, a quadratic one whose second derivatives are gathered from
// the gradients of all steps, objective's and constraints', within a box around the best design and under the
// constraints, linear ones. The step is taken if the merit becomes smaller, and the box follows how well the
// model said so. The merit is the objective and a penalty on the worst violation, which follows the
// constraints' multipliers: neither their units nor the objective's size matter.
//
// A change of the mesh's connectivity (output "connectivity") shifts the objective. A design on another
// connectivity than the best one's is taken where it is better by more than twice the shifts seen lately;
// otherwise the best design is evaluated again on the present mesh, which says what the shift is, and both
// are compared once more.
class SqpDesigner final : public Designer {
 public:
  // Throws Error (argument) unless there are bounds for each number of the design.
  SqpDesigner(std::vector<double> start, SqpOptions options);

  std::size_t population() const override { return 1; }
  Proposal ask() override { return {.design = pending_, .gradient = true, .from = best_.design}; }
  void refuse(const Proposal& proposal) override;
  void tell(const Proposal& proposal, const Evaluation& evaluation) override;
  bool finished() const override { return finished_; }
  std::uint64_t generation() const override { return steps_; }
  double step_size() const override { return trust_; }
  std::vector<double> centre() const override { return best_.design; }
  std::string state() const override;
  void restore(const std::string& state, const std::string& source) override;
  // Second derivatives, penalties, a box no smaller than a part of the first, and the objective's first
  // value, by which the search ends.
  void carry(const std::string& state, const std::string& source) override;
  std::string description() const override;

 private:
  struct Known {
    std::vector<double> design;
    Evaluation evaluation;
  };
  double merit(const Evaluation& evaluation) const;
  double model(const std::vector<double>& step) const;  // less what it is without a step
  bool comparable(const Known& trial) const;
  void propose();
  void settle_penalty(const std::vector<double>& step, const std::vector<double>& multipliers);
  void propose_start();
  void begin_model();
  void judge(const Known& trial, bool failed);
  void learn(const Known& trial);

  SqpOptions options_;
  std::vector<double> pending_;
  Known best_;
  std::optional<Known> waiting_;     // for the best design's evaluation on the present mesh
  std::vector<double> curvature_;    // symmetric, row by row
  std::vector<double> multipliers_;  // of the constraints, by the last step after which all would hold
  bool learnt_ = false;              // from a step
  bool carried_ = false;             // the model is another search's, before the first design is told
  double elastic_ = 0.0;             // what a step pays for the worst violation that it leaves
  double penalty_ = 0.0;             // what the merit pays for the worst violation
  double scale_ = 1.0, trust_ = 0.0, promised_ = 0.0, shift_ = 0.0;
  double begun_at_ = 0.0;                 // merit where the model began
  std::uint64_t steps_ = 0, starts_ = 0;  // designs that failed before any did not
  bool started_ = false, finished_ = false;
};

}  // namespace remodel
