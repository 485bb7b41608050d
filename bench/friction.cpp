// Flows with friction beside their references, on grids of its own: friction CASE [SIZE], where SIZE is 1, 2
// or 3. It prints a row of docs/viscous.md.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "flow/test_grids.h"
#include "remodel/flow.h"

namespace {

using namespace remodel;

FlowResult found(const FrozenMesh& mesh, const FlowConditions& conditions, FlowOptions options) {
  options.tolerance = 1e-9;
  options.on_step = [](const FlowProgress& at) {
    std::fprintf(stderr, "%3d %.3e CL %.5f\n", at.newton_step, at.residual, at.cl);
  };
  FlowResult flow = solve_flow(mesh, conditions, options);
  std::printf(
      "%zu vertices: %s, CL %.6f, CD %.7f (pressure %.7f, friction %.7f), y+ %.2f, %d steps, %d of GMRES, "
      "%.0f MB, "
      "%.1f s\n",
      mesh.points.size(), name_of(flow.status), flow.cl, flow.cd, flow.friction->cd_pressure,
      flow.friction->cd_friction, flow.friction->y_plus_max, flow.newton_steps, flow.gmres_iterations,
      flow.memory_mb, flow.seconds);
  return flow;
}

void plate(FlowModel model, int size) {
  FlowOptions options;
  options.model = model, options.symmetry = {"symmetry"},
  options.outlets = {{.name = "outlet", .pressure = 1.0}};
  const auto n = static_cast<std::uint32_t>(size);
  test::PlateSize grid;
  if (model == FlowModel::laminar)
    grid = {.start = -4,
            .length = 4,
            .height = 10,
            .first = 6e-4 / n,
            .at_edge = 2e-3 / n,
            .before = 24 * n,
            .along = 64 * n,
            .up = 40 * n};
  else
    grid = {.first = 2e-6 / n, .at_edge = 2e-3 / n, .before = 12 * n, .along = 32 * n, .up = 32 * n};
  const double reynolds = model == FlowModel::laminar ? 1e5 : 5e6;
  options.temperature_k = model == FlowModel::laminar ? 0.0 : 300.0;
  const FrozenMesh mesh = test::plate_grid(grid).frozen();
  const FlowResult flow = found(mesh, {.mach = 0.2, .reynolds = reynolds}, options);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Point p = mesh.points[v];
    if (p.y == 0.0 && p.x > 0.05 && p.x < 1.1)
      std::printf("x %.4f cf %.6f over Blasius %.5f\n", p.x, flow.friction->cf[v],
                  flow.friction->cf[v] / (0.664115 / std::sqrt(reynolds * p.x)));
  }
}

void section(FlowModel model, double mach, double reynolds, double alpha_deg, int size) {
  FlowOptions options;
  options.model = model;
  const auto n = static_cast<std::uint32_t>(size);
  test::CGridSize grid = {
      .half = 40 * n, .wake = 20 * n, .up = 32 * n, .at_nose = 4e-3 / n, .at_edge = 4e-3 / n};
  grid.first = (model == FlowModel::laminar ? 2e-3 : 2e-5) / n;
  found(test::c_grid(grid).frozen(), {.mach = mach, .alpha_deg = alpha_deg, .reynolds = reynolds}, options);
}

}  // namespace

int main(int count, char** arguments) {
  const std::string name = count > 1 ? arguments[1] : "";
  const int size = count > 2 ? std::clamp(std::atoi(arguments[2]), 1, 4) : 2;
  if (name == "blasius") return plate(FlowModel::laminar, size), 0;
  if (name == "plate") return plate(FlowModel::sa, size), 0;
  if (name == "laminar") return section(FlowModel::laminar, 0.5, 5000, 0, size), 0;
  if (name == "naca0") return section(FlowModel::sa, 0.15, 6e6, 0, size), 0;
  if (name == "naca10") return section(FlowModel::sa, 0.15, 6e6, 10, size), 0;
  std::fprintf(stderr, "friction blasius|plate|laminar|naca0|naca10 [1|2|3]\n");
  return 2;
}
