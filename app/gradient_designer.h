#pragma once

// Sequential quadratic programming (SLSQP) or the method of moving asymptotes (MMA), by NLopt, in a trust
// box, as a designer that is asked and told. Sources: D. Kraft, "A software package for sequential quadratic
// programming", DFVLR-FB 88-28 (1988); K. Svanberg, SIAM J. Optim. 12 (2002); S. G. Johnson, "The NLopt
// nonlinear-optimization package".

#include <optional>
#include <string>
#include <vector>

#include "remodel/designer.h"

namespace remodel::app {

struct GradientOptions {
  std::string method = "slsqp";   // or "mma"
  double trust = 0.02;            // first half-width of the trust box
  double least_trust = 1e-5;      // the search ends below
  std::vector<double> low, high;  // bounds of the design
  // Of sqp: what second derivatives are taken to be like before any were seen, a symmetric positive matrix
  // row by row; empty: the unit matrix.
  std::vector<double> metric = {};
};

// What designers that follow gradients keep of a design.
struct KnownDesign {
  std::vector<double> design;
  Evaluation evaluation;
};
// The output "connectivity": the number of the mesh's connectivity, another one after each change; 0 where
// there is none.
double connectivity_of(const Evaluation& evaluation);
std::string json_of(const KnownDesign& known);      // without other outputs
KnownDesign known_design(const std::string& text);  // throws nlohmann's exceptions
std::string description_of(const std::string& method, const GradientOptions& options);

// The search is a program that asks for evaluations one after the other. NLopt calls functions rather than
// being asked, so the program is run again from its beginning for each new design, over the evaluations that
// are known; its own work takes milliseconds. All there is to its state are these evaluations.
//
// Each round searches the box around the best design so far. The box doubles where the round's best lies on
// it, and shrinks to a quarter where the round found nothing better or a design failed. A round ends before a
// design that is nearer to another one of its own than a hundredth of the box, and with MMA behind one
// on another connectivity (output "connectivity") that is not better. Where the mesh's connectivity is not
// that of the best design's evaluation any more, the best design is evaluated again before a round begins, so
// that designs are compared on like meshes; the last one too.
class GradientDesigner final : public Designer {
 public:
  GradientDesigner(std::vector<double> start, GradientOptions options);

  std::size_t population() const override { return 1; }
  Proposal ask() override;
  void refuse(const Proposal& proposal) override;
  void tell(const Proposal& proposal, const Evaluation& evaluation) override;
  bool finished() const override { return !pending_; }
  std::uint64_t generation() const override { return round_; }
  double step_size() const override { return trust_; }
  std::vector<double> centre() const override { return centre_; }
  std::string state() const override;
  void restore(const std::string& state, const std::string& source) override;
  std::string description() const override;

 private:
  using Known = KnownDesign;
  class Oracle;
  void advance();
  void search(Oracle& oracle);
  class Round;
  void scale(Round& round, double objective_scale) const;
  void search_box(Round& round) const;
  std::optional<std::size_t> compare_again(Oracle& oracle, Known& centre, bool unlike, double scale);

  std::vector<double> start_;
  GradientOptions options_;
  std::vector<Known> known_;
  std::optional<std::vector<double>> pending_;
  std::vector<double> centre_;
  double trust_ = 0.0;
  std::uint64_t round_ = 0;
};

}  // namespace remodel::app
