#pragma once

// What a LivingFlow is inside, for each number of unknowns.

#include <memory>
#include <variant>

#include "flow/living_flow/last_flow.h"
#include "remodel/flow.h"

namespace remodel::flow {

using AnyLastFlow = std::variant<LastFlow<4>, LastFlow<5>>;

class LivingSolver {
 public:
  explicit LivingSolver(const FlowOptions& options) : options_(options) {}
  virtual ~LivingSolver() = default;
  LivingSolver(const LivingSolver&) = delete;
  LivingSolver& operator=(const LivingSolver&) = delete;

  const FlowOptions& options() const { return options_; }
  // living: the mesh that was frozen, or nullptr.
  virtual FlowResult solve(const FrozenMesh& frozen, const Mesh* living,
                           const FlowConditions& conditions) = 0;
  virtual FlowGradients gradients(const std::vector<FlowFunctional>& functions,
                                  const WantedGradients& wanted) = 0;
  // The last flow that was found; it has no mesh before the first one.
  virtual AnyLastFlow last() const = 0;
  virtual void go_on_from(const AnyLastFlow& last) = 0;

 protected:
  const FlowOptions options_;
};

// For the model of these options.
std::unique_ptr<LivingSolver> living_solver(const FlowOptions& options);

}  // namespace remodel::flow
