#pragma once

// The designer of a run: it proposes designs (ask) and learns what came of them (tell). It knows neither what
// a design is nor how it is evaluated: a design is a vector of numbers, whose meaning the design space has
// (remodel/design_space.h). CMA-ES is one; an algorithm that follows gradients is another.
//
// The loop (optimise(), remodel/optimise.h) asks for a design and looks whether it is feasible. If not, it
// says so by refuse() and asks again. The designs of one generation do not depend on each other's
// evaluations, so that they may be evaluated at once; they are told in the order in which they were asked
// for. All calls come from the thread that runs the loop. What a designer throws ends the run, as if the
// process had been killed.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "remodel/cmaes.h"
#include "remodel/evaluation.h"

namespace remodel {

struct Proposal {
  std::vector<double> design;
  bool gradient = false;  // whether the evaluation should come with gradients
  // The evaluated design that this one is a step from, or is itself once more; empty: none in particular.
  std::vector<double> from = {};
};

class Designer {
 public:
  virtual ~Designer() = default;

  // The designs of a generation: at least 1, always the same.
  virtual std::size_t population() const = 0;
  // The next design of this generation, or of the next one when all designs of this one have been told.
  virtual Proposal ask() = 0;
  // The last proposal is no feasible design, and will not be told.
  virtual void refuse(const Proposal& proposal) { static_cast<void>(proposal); }
  // The result of a proposal. An evaluation that failed has an infinite objective.
  virtual void tell(const Proposal& proposal, const Evaluation& evaluation) = 0;
  // True if the search has ended by itself; asked between evaluations.
  virtual bool finished() const { return false; }

  virtual std::uint64_t generation() const = 0;  // completed ones
  // How far designs lie around centre(): a standard deviation, the radius of a trust region. For the history.
  virtual double step_size() const { return 0.0; }
  // The design that the next ones lie around, if there is one: living meshes may keep near it.
  virtual std::vector<double> centre() const { return {}; }

  // Restored from its state, a designer goes on to the same proposals, also in the middle of a generation.
  // Throws Error (format) naming `source` for a text that is no such state.
  virtual std::string state() const = 0;
  virtual void restore(const std::string& state, const std::string& source) = 0;
  // Goes on, on another mesh, from what the search of this state has learnt, with its own start. The state is
  // of a designer of the same kind. By default nothing is carried.
  virtual void carry(const std::string& state, const std::string& source) {
    static_cast<void>(state), static_cast<void>(source);
  }
  // A JSON object says what the proposals depend on: a run can be resumed with the same alone.
  virtual std::string description() const = 0;
};

// CMA-ES (remodel/cmaes.h). Designs are ranked by an augmented Lagrangian of objective and constraints, whose
// coefficients are adapted once a generation (src/design/augmented_lagrangian.h has method and sources): the
// search comes to the constrained optimum from both sides, so that half of its designs or more violate an
// active constraint, by less and less. Behind all others rank designs whose evaluation failed, or has a
// constraint that is not finite, or not as many constraints as the others. Without constraints, or where none
// is ever violated, the search is that of the objective alone, to the bit.
class CmaesDesigner final : public Designer {
 public:
  // This says whether the search ends where it has converged. It has where designs hardly differ any more:
  // the largest standard deviation is within ten times CmaesOptions::least_deviation, above which it wavers.
  enum class AtConvergence { go_on, end };
  // Throws Error (argument) as Cmaes does.
  CmaesDesigner(std::vector<double> start, const CmaesOptions& options,
                AtConvergence at_convergence = AtConvergence::go_on);
  ~CmaesDesigner() override;
  CmaesDesigner(CmaesDesigner&&) noexcept;
  CmaesDesigner& operator=(CmaesDesigner&&) noexcept;

  std::size_t population() const override;
  Proposal ask() override;
  void tell(const Proposal& proposal, const Evaluation& evaluation) override;
  bool finished() const override;
  std::uint64_t generation() const override;
  double step_size() const override;
  std::vector<double> centre() const override;
  std::string state() const override;
  void restore(const std::string& state, const std::string& source) override;
  std::string description() const override;

 private:
  struct Constrained;

  CmaesOptions options_;
  AtConvergence at_convergence_;
  Cmaes cmaes_;
  std::unique_ptr<Constrained> constrained_;
};

}  // namespace remodel
