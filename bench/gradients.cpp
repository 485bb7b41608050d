// Gradients of flows by the adjoint: how exact they are, and what they cost.
//
//     gradients [AIRFOIL I MACH STEPS]...
//
// For each case: processor time of a cold flow, of the living solver's flows on a walk of ten designs (each
// coefficient changes by 1e-3 as a standard deviation), of the gradient of CD alone after each, and of those
// of CL, CD and CM by a solver of their own, all with flows to 1e-8; and the relative error of the gradients,
// as vectors of all coefficients, against central differences of fourth order of whole flows, to 1e-12. STEPS
// partial remodellings (coefficients change by 1e-2) come before all that.

#include <time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "remodel/airfoil.h"
#include "remodel/flow.h"
#include "remodel/generate.h"
#include "remodel/mesh_derivative.h"
#include "remodel/remodel.h"

namespace {

using namespace remodel;

struct Case {
  std::string airfoil = "naca:2412";
  int points = 100;
  double mach = 0.5;
  int partial_steps = 0;
};

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

template <class Call>
double seconds_of(Call call) {
  const double before = processor_seconds();
  call();
  return processor_seconds() - before;
}

double uniform(std::mt19937_64& random, double size) {
  return size * (static_cast<double>(random() >> 11) * 0x1p-52 - 1.0);
}

void change(CstAirfoil& airfoil, double sigma, std::mt19937_64& random) {
  const CstAirfoil before = airfoil;
  do {
    airfoil = before;
    for (auto* surface : {&airfoil.upper, &airfoil.lower})
      for (double& coefficient : *surface) coefficient += uniform(random, std::sqrt(3.0) * sigma);
  } while (!surfaces_apart(airfoil));
}

using Values = std::array<double, 3>;

Values coefficients(LivingFlow& living, const Mesh& mesh, const FlowConditions& conditions) {
  const FlowResult flow = living.solve(mesh, conditions);
  if (!flow.converged()) return {NAN, NAN, NAN};
  return {flow.cl, flow.cd, flow.cm};
}

// The largest relative error of the three gradients; not a number where a flow was not found.
double error(LivingFlow& living, const Mesh& mesh, const FlowConditions& conditions, double h) {
  if (std::isnan(coefficients(living, mesh, conditions)[0])) return NAN;
  const FlowGradients gradients = living.gradients();
  const MeshDerivative derivative(mesh);
  const std::vector<double> found[3] = {derivative.vjp(gradients.cl.points),
                                        derivative.vjp(gradients.cd.points),
                                        derivative.vjp(gradients.cm.points)};
  const std::vector<double> at = coefficients_of(mesh.domain());
  const auto there = [&](std::size_t i, double s) {
    std::vector<double> numbers = at;
    numbers[i] += s;
    return coefficients(living, mesh_at(mesh, with_coefficients(mesh.domain(), numbers)), conditions);
  };
  const auto& section = std::get<CstAirfoil>(mesh.domain().curve(0).shape);
  double wrong[3] = {}, size[3] = {};
  for (std::size_t i = 0; i < 2 * section.upper.size(); ++i) {
    const Values a = there(i, -2 * h), b = there(i, -h), c = there(i, h), d = there(i, 2 * h);
    for (std::size_t k = 0; k < 3; ++k) {
      const double slope = (a[k] - 8 * b[k] + 8 * c[k] - d[k]) / (12 * h);
      wrong[k] += (found[k][i] - slope) * (found[k][i] - slope), size[k] += slope * slope;
    }
  }
  double worst = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double of_one = std::sqrt(wrong[k] / size[k]);
    if (std::isnan(of_one)) return NAN;
    worst = std::max(worst, of_one);
  }
  return worst;
}

void run(const Case& task) {
  std::mt19937_64 random(1);
  CstAirfoil airfoil = named_airfoil(task.airfoil, 5);
  const auto domain = [&] { return airfoil_domain(airfoil, {.points = task.points}); };
  const FlowConditions conditions = {.mach = task.mach, .alpha_deg = 1.25};
  Mesh mesh = generate(domain(), {.gradation = task.points / 50.0}).mesh;
  const CstAirfoil start = airfoil;
  int partial = 0;
  for (int i = 0; i < 100 * task.partial_steps && partial < task.partial_steps; ++i) {
    airfoil = start;
    change(airfoil, 1e-2, random);
    partial += !remodel::remodel(mesh, domain(), {.strategy = Strategy::chain}).full_adjustment;
  }
  LivingFlow exact({.tolerance = 1e-12}), living({.tolerance = 1e-8});
  // Long steps have errors of their own, short ones those of the flows' residuals, and meshes just before a
  // flip follow short ones alone: the least error says what the gradient's can be at most.
  double worst = NAN;
  for (const double h : {1e-4, 1e-5, 3e-6, 1e-6}) {
    try {
      worst = std::fmin(worst, error(exact, mesh, conditions, h));
    } catch (const TopologyChanged&) {
    }
  }
  constexpr int designs = 10;
  constexpr WantedGradients drag_alone = {.lift = false, .moment = false, .angle = false};
  double warm = 0.0, gradient = 0.0, three = 0.0;
  int iterations = 0, factorisations = 0;
  const double cold = seconds_of([&] { living.solve(mesh, conditions); });
  LivingFlow of_three({.tolerance = 1e-8});
  of_three.solve(mesh, conditions);
  for (int i = 0; i < designs; ++i) {
    change(airfoil, 1e-3, random);
    remodel::remodel(mesh, domain(), {.strategy = Strategy::chain});
    warm += seconds_of([&] { living.solve(mesh, conditions); }) / designs;
    FlowGradients gradients;
    gradient += seconds_of([&] { gradients = living.gradients({}, drag_alone); }) / designs;
    of_three.solve(mesh, conditions);
    three += seconds_of([&] { of_three.gradients(); }) / designs;
    iterations += gradients.krylov_iterations, factorisations += gradients.factorisations;
  }
  std::printf("| %s, %d, %g, %d | %.1e | %.0f | %.1f | %.1f | %.1f | %.2f | %.0f | %.1f | %d |\n",
              task.airfoil.c_str(), task.points, task.mach, partial, worst, 1e3 * cold, 1e3 * warm,
              1e3 * three, 1e3 * gradient, gradient / warm, cold / gradient,
              static_cast<double>(iterations) / designs, factorisations);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<Case> cases;
  for (int i = 1; i + 3 < argc; i += 4)
    cases.push_back({argv[i], std::atoi(argv[i + 1]), std::atof(argv[i + 2]), std::atoi(argv[i + 3])});
  if (cases.empty())
    for (const int points : {100, 200})
      for (const double mach : {0.5, 0.8})
        for (const int steps : {0, 50})
          for (const char* airfoil : {"naca:0012", "naca:2412", "rae2822"})
            cases.push_back({airfoil, points, mach, steps});
  std::puts(
      "| airfoil, I, M, partial steps before | error | cold, ms | warm, ms | CL, CD, CM, ms | CD, ms | over "
      "warm | cold "
      "over gradient | solves | factorisations |\n|---|---|---|---|---|---|---|---|---|---|");
  for (const Case& task : cases) run(task);
}
