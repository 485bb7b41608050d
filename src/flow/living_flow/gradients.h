#pragma once

// Gradients of a living flow, by the factors that there are or by new ones.

#include "flow/living_flow/adjoint.h"
#include "flow/living_flow/kept_factors.h"
#include "flow/search/search.h"

namespace remodel::flow {

// Derivatives of a function of the flow, which follows the parameters.
struct Total {
  ShapeSlope shape;
  double condition = 0.0;  // by the angle of attack, a radian; where lift is given, by the lift
};
// scale: the function that is reported, over the one that these are of.
FlowGradient gradient_of(Total total, double scale, const Stream& stream);
// Throws Error (argument) where there is no last flow.
void require_gradients(bool found);

template <std::size_t N>
class Gradients {
 public:
  Gradients(const FlowOptions& options, KeptFactors<N>& kept, BlockWholeMatrix<N>& matrix)
      : options_(options), kept_(kept), matrix_(matrix) {}
  // The multipliers of functions with these derivatives by the unknowns, at the last flow, whose Jacobian `matrix_`
  // has; none if the observer ended it. Factors that it makes are the next flows' too. `result` gets what it took.
  // Throws Error (argument) where they are not found.
  const std::vector<BlockIncrement<N>>* multipliers(const LastFlow<N>& last, const BlockSystem<N>& system,
                                                    std::span<const BlockIncrement<N>> functions,
                                                    FlowGradients& result);

 private:
  // False where the factors that there are do not serve.
  bool by_kept_factors(const LastFlow<N>& last, const BlockSystem<N>& system,
                       std::span<const BlockIncrement<N>> functions, int& iterations);
  void guess_multipliers(const Keys& keys, std::size_t functions);

  const FlowOptions& options_;
  KeptFactors<N>& kept_;
  BlockWholeMatrix<N>& matrix_;
  // What the last gradients were found by, and whose positions these are.
  std::vector<BlockIncrement<N>> multipliers_;
  Keys multiplier_keys_;
};

}  // namespace remodel::flow
