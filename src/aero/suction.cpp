// The suction peak of a flow, the largest -Cp at the stations of walls: of one loop of the mesh's domain, or
// of all. A mean of the highest values takes the place of the largest one, which has no derivative where
// another station becomes it: ln(sum of exp(k (-Cp))) / k with k = 10, larger than the largest by 0.1 ln n
// where n stations share it (G. Kreisselmeier and R. Steinhauser, IFAC Symposium on Computer Aided Design of
// Control Systems, 1979).

#include <algorithm>
#include <cmath>
#include <limits>

#include "aero/kinds.h"

namespace remodel {
namespace {

class Suction final : public FlowFunction {
 public:
  explicit Suction(std::optional<std::size_t> loop) : loop_(loop) {}

  FlowValue at(const FlowView& of) const override {
    constexpr double sharpness = 10.0;
    FlowValue result{.by_flow = FlowFunctional{.pressure = std::vector<double>(of.frozen.points.size(), 0.0),
                                               .points = std::vector<Point>(of.frozen.points.size())}};
    std::vector<double>& share = result.by_flow->pressure;
    const std::vector<double> cp = pressure_coefficients(of.flow);
    double most = -std::numeric_limits<double>::infinity(), sum = 0.0;
    for (std::size_t p = 0; p < cp.size(); ++p)
      if (is_asked_for(of, p)) most = std::max(most, -cp[p]);
    for (std::size_t p = 0; p < cp.size(); ++p)
      if (is_asked_for(of, p)) sum += share[p] = std::exp(sharpness * (-cp[p] - most));
    for (double& x : share) x *= -1.0 / (sum * 0.5 * of.flow.mach * of.flow.mach);
    result.value = most + std::log(sum) / sharpness;
    return result;
  }
  bool is_of_walls() const override { return true; }
  // Peaks are large: they count in parts of what is allowed.
  double unit(double limit) const override { return limit; }

 private:
  bool is_asked_for(const FlowView& of, std::size_t p) const {
    if (of.frozen.curve[p] < 0 || of.frozen.steiner[p] != 0) return false;
    const auto curve = static_cast<std::size_t>(of.frozen.curve[p]);
    if (loop_) return of.domain.loop_of(curve) == *loop_;
    const std::string& name = of.domain.curve(curve).name;
    return name != "farfield" && name != "symmetry";
  }

  std::optional<std::size_t> loop_;
};

}  // namespace

extern constinit const FlowKind suction_kind = {
    .name = "suction",
    .at_most = Limits{0.1, 1000.0},
    .of_element = true,
    .make = [](std::optional<std::size_t> loop) -> FlowFunctionPtr {
      return std::make_shared<Suction>(loop);
    }};

}  // namespace remodel
