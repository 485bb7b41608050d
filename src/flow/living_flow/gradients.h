#pragma once

// Gradients of a living flow, by the factors that there are or by new ones.

#include "flow/living_flow/adjoint.h"
#include "flow/living_flow/kept_factors.h"
#include "flow/search/newton_search.h"

namespace remodel::flow {

class Gradients {
 public:
  Gradients(const FlowOptions& options, KeptFactors<unknown_count>& kept, WholeMatrix& matrix)
      : options_(options), kept_(kept), matrix_(matrix) {}
  // As LivingFlow::gradients() says. Factors that it makes are the next flows' too.
  FlowGradients of(const LastFlow<unknown_count>& last, const std::vector<FlowFunctional>& functions,
                   const WantedGradients& wanted);

 private:
  // None where the factors that there are do not serve.
  std::optional<std::vector<Total>> by_kept_factors(const LastFlow<unknown_count>& last, const FlowSystem& system,
                                                    std::span<const FaceDerivative> faces,
                                                    std::span<const FunctionalSlope> functions,
                                                    int& iterations);
  void guess_multipliers(const Keys& keys, std::size_t functions);

  const FlowOptions& options_;
  KeptFactors<unknown_count>& kept_;
  WholeMatrix& matrix_;
  // What the last gradients were found by, and whose positions these are.
  std::vector<Increment> multipliers_;
  Keys multiplier_keys_;
};

}  // namespace remodel::flow
