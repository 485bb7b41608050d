#include "remodel/flow_noise.h"

#include <numeric>

#include "remodel/mesh_derivative.h"

namespace remodel {
namespace {

class FlowLineObjective final : public LineObjective {
 public:
  FlowLineObjective(const FlowConditions& conditions, const FlowOptions& options)
      : conditions_(conditions), options_(options) {}
  std::vector<std::string> names() const override { return {"cl", "cd"}; }
  void forget() override { flow_.reset(); }

  LineValues values(const Mesh& mesh, std::span<const double>, StepObserver& observer) override {
    options_.observer = &observer;
    if (!flow_) flow_ = std::make_unique<LivingFlow>(options_);
    const FlowResult flow = flow_->solve(mesh, conditions_);
    if (!flow.converged()) return {.values = {}, .failure = flow.reason};
    if (!flow.lift_determined)
      return {.values = {},
              .failure = "the lift is not determined: a body has no edge that the flow leaves from"};
    return {.values = {flow.cl, flow.cd}};
  }

  // The meshes of a reference move with their airfoil.
  std::vector<double> slopes(const Mesh& mesh, std::span<const double> direction,
                             LineMeshes meshes) override {
    const std::size_t airfoil[] = {0};
    const MeshDerivative derivative =
        meshes == LineMeshes::reference ? MeshDerivative(mesh, airfoil) : MeshDerivative(mesh);
    const FlowGradients gradients = flow_->gradients({}, {.moment = false, .angle = false});
    if (gradients.interrupted) return {};
    std::vector<double> slopes;
    for (const FlowGradient* of : {&gradients.cl, &gradients.cd}) {
      // The domain's numbers begin with the airfoil's coefficients.
      const std::vector<double> by = derivative.vjp(of->points);
      slopes.push_back(std::inner_product(direction.begin(), direction.end(), by.begin(), 0.0));
    }
    return slopes;
  }

 private:
  FlowConditions conditions_;
  FlowOptions options_;
  std::unique_ptr<LivingFlow> flow_;
};

}  // namespace

std::unique_ptr<LineObjective> flow_line_objective(const FlowConditions& conditions,
                                                   const FlowOptions& options) {
  return std::make_unique<FlowLineObjective>(conditions, options);
}

}  // namespace remodel
