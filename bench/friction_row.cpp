// Cost of a turbulent flow per design on a row of designs: cold; on fresh outer meshes, from the interpolated
// flow before ("rival"); on the living mesh by Newton's method from the last flow ("warm"); by the solver
// that outlives its mesh ("living").
//
//     friction_row [renew|morph|reference] [MACH ALPHA SIGMA DESIGNS [SECTION]]
//
// Designs are a random walk from SECTION (naca:0012), SIGMA the standard deviation of each step in all
// coefficients. Re 6e6, the layer that the program makes, flows to a residual of 1e-8; processor time, that
// of meshing left out.

#include <time.h>

#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "remodel/airfoil.h"
#include "remodel/flow.h"
#include "remodel/layers.h"

namespace {

using namespace remodel;

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double normal(std::mt19937_64& random) {
  const double u = (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53;
  const double v = static_cast<double>(random() >> 11) * 0x1p-53;
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * M_PI * v);
}

CstAirfoil walk(CstAirfoil airfoil, double sigma, std::mt19937_64& random) {
  for (auto* surface : {&airfoil.upper, &airfoil.lower})
    for (double& coefficient : *surface) coefficient += sigma * normal(random);
  return airfoil;
}

// With the stations of an earlier one.
Domain domain_of(const CstAirfoil& airfoil, const Domain* earlier = nullptr) {
  Domain domain = airfoil_domain(airfoil);
  space_walls(domain, WallSpacing{});
  for (std::size_t l = 0; earlier != nullptr && l < domain.loops.size(); ++l)
    for (std::size_t c = 0; c < domain.loops[l].curves.size(); ++c)
      domain.loops[l].curves[c].parameters = earlier->loops[l].curves[c].parameters;
  return domain;
}

// One way to find each flow.
struct Row {
  const char* name;
  double seconds = 0.0, slowest = 0.0;
  int flows = 0, failed = 0, newton = 0, chord = 0, gmres = 0, factorisations = 0;
  template <class Solve>
  FlowResult time(Solve solve) {
    const double before = processor_seconds();
    FlowResult flow = solve();
    const double spent = processor_seconds() - before;
    seconds += spent, slowest = std::max(slowest, spent), ++flows;
    failed += !flow.converged(), newton += flow.newton_steps, chord += flow.krylov_iterations;
    gmres += flow.gmres_iterations, factorisations += flow.factorisations;
    std::fprintf(stderr,
                 "%-7s %8.3f s, %s, %s, CL %.6f, CD %.7f, %d Newton, %d chord, %d GMRES, %d factors, zone "
                 "%zu, %.0f MB\n",
                 name, spent, name_of(flow.status), name_of(flow.start), flow.cl, flow.cd, flow.newton_steps,
                 flow.krylov_iterations, flow.gmres_iterations, flow.factorisations, flow.corrected_vertices,
                 flow.memory_mb);
    return flow;
  }
  void print(double cold) const {
    std::printf("| %s | %.3f (slowest %.3f) | %.1f | %.1f | %.1f | %.1f | %.1f | %d of %d |\n", name,
                seconds / flows, slowest, cold * flows / seconds, 1.0 * newton / flows, 1.0 * chord / flows,
                1.0 * gmres / flows, 1.0 * factorisations / flows, flows - failed, flows);
  }
};

}  // namespace

int main(int count, char** arguments) {
  std::vector<std::string> given(arguments + 1, arguments + count);
  RemodelOptions how;
  if (!given.empty() && std::isalpha(given[0][0]))
    how.strategy = strategy_named(given[0]), given.erase(given.begin());
  const auto number = [&](std::size_t i, double otherwise) {
    return i < given.size() ? std::atof(given[i].c_str()) : otherwise;
  };
  const double mach = number(0, 0.5), sigma = number(2, 1e-3);
  const FlowConditions conditions = {.mach = mach, .alpha_deg = number(1, 2.0), .reynolds = 6e6};
  FlowOptions options;
  options.model = FlowModel::sa, options.tolerance = 1e-8;
  FlowOptions by_gmres = options;
  by_gmres.solver = FlowSolver::gmres;
  const LayerOptions layer = {.first_height = first_height(1.0, conditions.reynolds),
                              .thickness = 1.2 * boundary_layer_thickness(conditions.reynolds)};
  const QualityOptions quality = {.gradation = 8.0};
  std::mt19937_64 random(1);
  CstAirfoil airfoil = named_airfoil(given.size() > 4 ? given[4] : "naca:0012", 5);
  LayeredMesh mesh = generate_layered(domain_of(airfoil), layer, quality).mesh;
  Row cold = {"cold"}, rival = {"rival"}, warm = {"warm"}, living = {"living"};
  LivingFlow outlives(options), from_last(by_gmres);
  FrozenMesh before = mesh.freeze();
  FlowResult last = cold.time([&] { return solve_flow(before, conditions, options); });
  std::printf("%zu vertices, M %g, %g degrees, sigma %g\n", before.points.size(), mach, conditions.alpha_deg,
              sigma);
  outlives.solve(before, conditions), from_last.solve(before, conditions);
  for (int i = 0; i < static_cast<int>(number(3, 10)); ++i) {
    airfoil = walk(airfoil, sigma, random);
    const Domain domain = domain_of(airfoil, &mesh.domain());
    if (remodel::remodel(mesh, domain, how).abandoned)
      return std::fprintf(stderr, "a design was refused\n"), 1;
    const FrozenMesh now = mesh.freeze();
    living.time([&] { return outlives.solve(now, conditions); });
    warm.time([&] { return from_last.solve(now, conditions); });
    const FrozenMesh fresh = generate_layered(domain, layer, quality).mesh.freeze();
    last = rival.time([&] { return solve_flow_from(before, last, fresh, conditions, by_gmres); });
    before = fresh;
  }
  std::printf(
      "| | s a flow | cold over it | Newton steps | with older factors | GMRES | factorisations | found |\n");
  for (const Row* row : {&cold, &rival, &warm, &living}) row->print(cold.seconds);
  return cold.failed + rival.failed + warm.failed + living.failed > 0;
}
