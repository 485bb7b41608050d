#pragma once

// Feasible designs out of a designer's proposals.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "remodel/designer.h"

namespace remodel {

struct Sample {
  Proposal proposal;
  std::uint64_t refused = 0;  // infeasible proposals before it
};

// Whether a design can be meshed.
using Feasible = std::function<bool(std::span<const double>)>;

// The next feasible proposal; nothing after `limit` infeasible ones in a row.
std::optional<Sample> next_sample(Designer& designer, const Feasible& feasible, std::size_t limit);

// The design that the designer's next ones lie around, if there is one and it is feasible.
std::optional<std::vector<double>> feasible_centre(const Designer& designer, const Feasible& feasible);

// CMA-ES around the start of a shape interpolation. The least deviation is far below what a mesh or a solver
// could tell, and far above rounding (remodel/cmaes.h says why).
CmaesDesigner interpolation_designer(
    std::vector<double> start, double sigma, std::uint64_t seed,
    CmaesDesigner::AtConvergence at_convergence = CmaesDesigner::AtConvergence::go_on);

}  // namespace remodel
