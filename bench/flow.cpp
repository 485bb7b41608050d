// Cost of a flow per design on a row of designs: cold on fresh meshes, from the interpolated flow before on
// fresh meshes ("rival"), and by the solver that outlives its mesh ("living").
//
//     flow [morph | reference] [lu] [I MACH SIGMA DESIGNS]...
//     flow row [DESIGNS]
//
// `morph` and `reference` remodel by these strategies instead of renew. `lu`: all linear systems by LU, the
// rival's by one factorisation and its use. `row` is one row of 1,000 designs at
// I = 200, Mach 0.5, SIGMA falling from 1e-2 to 1e-4 as an optimiser's does, by the living solver alone; it
// ends with status 1 where a flow was not found.
//
// Designs are a random walk from NACA 0012 at 1.25 degrees, SIGMA the standard deviation of each step in all
// coefficients. Flows to a residual of 1e-8; processor time, that of meshing left out. Full adjustments and
// replacements are told apart: the mean over the latter is in brackets.

#include <time.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "remodel/flow.h"
#include "remodel/generate.h"
#include "remodel/remodel.h"

namespace {

using namespace remodel;

struct Case {
  int points = 100;
  double mach = 0.5;
  double sigma = 1e-3;
  int designs = 10;
};

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Sums over full adjustments [0] and over other steps [1].
struct Cost {
  double seconds[2] = {0, 0};
  int flows[2] = {0, 0};
  int failed = 0, factorisations = 0, iterations = 0, carried = 0;
  void add(bool partial, double spent, const FlowResult& flow) {
    seconds[partial] += spent;
    ++flows[partial];
    failed += !flow.converged();
    factorisations += flow.factorisations;
    iterations += flow.krylov_iterations;
    carried += flow.start == FlowStart::carried;
  }
  double mean(int kind) const { return flows[kind] == 0 ? 0.0 : 1e3 * seconds[kind] / flows[kind]; }
  double mean() const { return 1e3 * (seconds[0] + seconds[1]) / (flows[0] + flows[1]); }
};

template <class Solve>
FlowResult timed(Cost& cost, bool partial, Solve solve) {
  const double before = processor_seconds();
  FlowResult flow = solve();
  cost.add(partial, processor_seconds() - before, flow);
  return flow;
}

double normal(std::mt19937_64& random) {
  const double u = (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53;
  const double v = static_cast<double>(random() >> 11) * 0x1p-53;
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * M_PI * v);
}

CstAirfoil walk(CstAirfoil airfoil, double sigma, std::mt19937_64& random) {
  for (;;) {
    CstAirfoil next = airfoil;
    for (auto* surface : {&next.upper, &next.lower})
      for (double& coefficient : *surface) coefficient += sigma * normal(random);
    if (surfaces_apart(next)) return next;
  }
}

// Designs around NACA 0012, as an optimiser's generations shrink: a walk would leave what airfoils are.
bool run_row(int designs) {
  std::mt19937_64 random(1);
  const CstAirfoil centre = named_airfoil("naca:0012", 5);
  CstAirfoil airfoil = centre;
  const auto domain = [&] { return airfoil_domain(airfoil, {.points = 200}); };
  const FlowConditions conditions = {.mach = 0.5, .alpha_deg = 1.25};
  Mesh mesh = generate(domain(), {.gradation = 4.0}).mesh;
  LivingFlow living({.tolerance = 1e-8});
  living.solve(mesh, conditions);
  Cost cost;
  int starts[3] = {0, 0, 0};
  for (int i = 0; i < designs; ++i) {
    airfoil = walk(centre, 1e-2 * std::pow(1e-2, static_cast<double>(i) / designs), random);
    const bool partial = !remodel::remodel(mesh, domain(), {.strategy = Strategy::renew}).full_adjustment;
    const FlowResult flow = timed(cost, partial, [&] { return living.solve(mesh, conditions); });
    ++starts[static_cast<int>(flow.start)];
    if (!flow.converged()) std::printf("design %d: %s\n", i, flow.reason.c_str());
  }
  std::printf(
      "%d designs, %d by full adjustments: %.1f s of flows (%.0f ms a full adjustment, %.0f ms else), %d "
      "factorisations; %d carried, %d refactored, %d cold; %d not found\n",
      designs, cost.flows[0], cost.seconds[0] + cost.seconds[1], cost.mean(0), cost.mean(1),
      cost.factorisations, starts[1], starts[2], starts[0], cost.failed);
  return cost.failed == 0;
}

void run(const Case& task, Strategy strategy, std::optional<FlowSolver> solver) {
  std::mt19937_64 random(1);
  CstAirfoil airfoil = named_airfoil("naca:0012", 5);
  const QualityOptions quality = {.gradation = task.points / 50.0};
  const auto domain = [&] { return airfoil_domain(airfoil, {.points = task.points}); };
  const FlowConditions conditions = {.mach = task.mach, .alpha_deg = 1.25};
  const FlowOptions options = {.tolerance = 1e-8, .solver = solver};
  Mesh mesh = generate(domain(), quality).mesh;
  LivingFlow living(options);
  FlowResult known = living.solve(mesh, conditions);
  FrozenMesh before = mesh.freeze();
  Cost cold, rival, warm;
  double largest_difference = 0.0;
  for (int i = 0; i < task.designs; ++i) {
    airfoil = walk(airfoil, task.sigma, random);
    const bool partial = !remodel::remodel(mesh, domain(), {.strategy = strategy}).full_adjustment;
    const FlowResult of_living = timed(warm, partial, [&] { return living.solve(mesh, conditions); });
    const FrozenMesh fresh = generate(domain(), quality).mesh.freeze();
    const FlowResult of_cold = timed(cold, partial, [&] { return solve_flow(fresh, conditions, options); });
    const FlowResult of_rival =
        timed(rival, partial, [&] { return solve_flow_from(before, known, fresh, conditions, options); });
    largest_difference = std::fmax(largest_difference, std::fabs(of_cold.cl - of_rival.cl));
    known = of_rival.converged() ? of_rival : of_cold;
    before = fresh;
  }
  std::printf(
      "| %d, %g, %g (%d of %d) | %.0f | %.0f (%.0f) | %.0f (%.0f) | %.0f | %.1f | %d | %d | %.1f | %d %d %d "
      "|\n",
      task.points, task.mach, task.sigma, warm.flows[0], task.designs, cold.mean(), rival.mean(),
      rival.mean(1), warm.mean(), warm.mean(1), cold.mean() / warm.mean(), rival.mean() / warm.mean(),
      warm.carried, warm.factorisations, static_cast<double>(warm.iterations) / task.designs, cold.failed,
      rival.failed, warm.failed);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "";
  if (first == "row") return run_row(argc > 2 ? std::atoi(argv[2]) : 1000) ? 0 : 1;
  const Strategy strategy = first == "morph"       ? Strategy::morph
                            : first == "reference" ? Strategy::reference
                                                   : Strategy::renew;
  int offset = strategy == Strategy::renew ? 1 : 2;
  std::optional<FlowSolver> solver;
  if (offset < argc && std::string(argv[offset]) == "lu") solver = FlowSolver::lu, ++offset;
  std::vector<Case> cases;
  for (int i = offset; i + 3 < argc; i += 4)
    cases.push_back(
        {std::atoi(argv[i]), std::atof(argv[i + 1]), std::atof(argv[i + 2]), std::atoi(argv[i + 3])});
  if (cases.empty())
    cases = {{100, 0.5, 1e-3, 10}, {100, 0.5, 1e-2, 10}, {100, 0.8, 1e-3, 10},
             {200, 0.5, 1e-4, 10}, {200, 0.5, 1e-3, 10}, {200, 0.5, 1e-2, 10}};
  std::puts(
      "| I, M, sigma (full adjustments) | cold, ms | rival (replacements) | living (replacements) | over "
      "cold | over "
      "rival | carried | factorisations | steps per design | not found "
      "|\n|---|---|---|---|---|---|---|---|---|---|");
  for (const Case& task : cases) run(task, strategy, solver);
}
