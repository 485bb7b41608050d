// The flow around a row of designs on one living mesh: NACA 0012 becomes thicker in twenty steps, and each
// flow is found from the one before.

#include "remodel/flow.h"

#include <cstdio>

#include "remodel/generate.h"
#include "remodel/remodel.h"

int main() {
  using namespace remodel;
  const AirfoilDomainOptions discretisation = {.points = 100};
  CstAirfoil airfoil = named_airfoil("naca:0012", 5);
  Mesh mesh = generate(airfoil_domain(airfoil, discretisation), {.gradation = 2.0}).mesh;

  LivingFlow solver;
  const FlowConditions conditions = {.mach = 0.5, .alpha_deg = 1.25};
  int factorisations = 0;
  for (int step = 0; step <= 20; ++step) {
    const FlowResult flow = solver.solve(mesh, conditions);
    if (!flow.converged()) {
      std::printf("step %d: %s\n", step, flow.reason.c_str());
      return 1;
    }
    factorisations += flow.factorisations;
    std::printf("%2d  CL %.6f  CD %.6f  %-10s %2d steps, %.0f ms\n", step, flow.cl, flow.cd,
                name_of(flow.start), flow.newton_steps + flow.krylov_iterations, 1e3 * flow.seconds);
    for (double& coefficient : airfoil.upper) coefficient += 1e-3;
    for (double& coefficient : airfoil.lower) coefficient -= 1e-3;
    remodel::remodel(mesh, airfoil_domain(airfoil, discretisation));
  }
  std::printf("%d factorisations\n", factorisations);
}
