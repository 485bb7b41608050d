#include "design/design_search.h"

#include <utility>

namespace remodel {

std::optional<Sample> next_sample(Designer& designer, const Feasible& feasible, std::size_t limit) {
  for (std::uint64_t refused = 0; refused < limit; ++refused) {
    Proposal proposal = designer.ask();
    if (feasible(proposal.design)) return Sample{std::move(proposal), refused};
    designer.refuse(proposal);
    if (designer.finished()) break;  // it has nothing else to propose
  }
  return std::nullopt;
}

std::optional<std::vector<double>> feasible_centre(const Designer& designer, const Feasible& feasible) {
  std::vector<double> centre = designer.centre();
  if (centre.empty() || !feasible(centre)) return std::nullopt;
  return centre;
}

CmaesDesigner interpolation_designer(std::vector<double> start, double sigma, std::uint64_t seed,
                                     CmaesDesigner::AtConvergence at_convergence) {
  return CmaesDesigner(std::move(start), {.sigma = sigma, .seed = seed, .least_deviation = 1e-12},
                       at_convergence);
}

}  // namespace remodel
