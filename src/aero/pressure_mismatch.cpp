// Inverse design: half the mean square difference of pressure coefficients at the section's stations to those
// of a target.

#include "aero/kinds.h"

namespace remodel {
namespace {

class PressureMismatch final : public FlowFunction {
  FlowValue at(const FlowView& of) const override {
    const FrozenMesh& mesh = of.frozen;
    FlowValue result{.by_flow = FlowFunctional{.pressure = std::vector<double>(mesh.points.size(), 0.0),
                                               .points = std::vector<Point>(mesh.points.size())}};
    const std::vector<double> cp = pressure_coefficients(of.flow);
    const double share = 1.0 / static_cast<double>(of.target->size());
    for (std::size_t p = 0; p < cp.size(); ++p) {
      if (mesh.curve[p] != 0 || mesh.steiner[p] != 0) continue;
      const double difference = cp[p] - of.target->at(mesh.parameter[p]);
      result.value += 0.5 * share * difference * difference;
      result.by_flow->pressure[p] = share * difference / (0.5 * of.flow.mach * of.flow.mach);
    }
    return result;
  }
  bool is_even() const override { return true; }
  bool needs_target() const override { return true; }
};

}  // namespace

extern constinit const FlowKind inverse_kind = {
    .name = "inverse", .objective = 1.0, .make = [](std::optional<std::size_t>) -> FlowFunctionPtr {
      return std::make_shared<PressureMismatch>();
    }};

}  // namespace remodel
