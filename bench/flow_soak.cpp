// Flows of random designs: how many are found, and whether any claims to be found that is not.
//
//     flow_soak FLOWS SEED [FIRST]
//
// Each is a section of the catalogue (or, one in ten, a section with a flap at Mach 0.2) with every
// coefficient disturbed by a standard deviation of 0.01, at I = 50 to 100, Mach 0.3 to 0.85 and -2 to 4
// degrees, from undisturbed flow. A flow that claims to be found is judged by itself: each body's forces must
// add up, all densities and pressures be positive, and the flow found from it on the same mesh at a hundredth
// of its tolerance have the same lift. Those before FIRST are drawn and not looked for. One line for each
// that was not found or is none; the exit status is 1 if any claims what it is not.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

#include "remodel/airfoil.h"
#include "remodel/error.h"
#include "remodel/flow.h"
#include "remodel/generate.h"

namespace {

using namespace remodel;

double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}
double normal(std::mt19937_64& random) {
  return std::sqrt(-2.0 * std::log(1.0 - uniform(random, 0, 1))) * std::cos(uniform(random, 0, 2.0 * M_PI));
}

// A section of the catalogue, disturbed, whose surfaces do not cross.
CstAirfoil section(std::mt19937_64& random, std::string& name) {
  const auto& catalogue = airfoil_catalogue();
  const CatalogueEntry& entry = catalogue[random() % catalogue.size()];
  name = entry.name;
  for (;;) {
    CstAirfoil airfoil = entry.airfoil();
    for (auto* surface : {&airfoil.upper, &airfoil.lower})
      for (double& coefficient : *surface) coefficient += 0.01 * normal(random);
    if (surfaces_apart(airfoil)) return airfoil;
  }
}

struct Case {
  std::string name;
  FrozenMesh mesh;
  FlowConditions conditions;
};

Case draw(std::mt19937_64& random) {
  Case task;
  const int points = 2 * (25 + static_cast<int>(random() % 26));
  task.conditions = {.mach = uniform(random, 0.3, 0.85), .alpha_deg = uniform(random, -2.0, 4.0)};
  const CstAirfoil airfoil = section(random, task.name);
  Domain domain = airfoil_domain(airfoil, {.points = points});
  if (random() % 10 == 0) {
    task.conditions.mach = 0.2;
    const double angle = uniform(random, -30.0, 0.0);
    domain = airfoils_domain({{.name = "main", .airfoil = airfoil},
                              {.name = "flap", .airfoil = airfoil, .placement = {0.3, angle, {1.03, -0.05}}}},
                             {.points = points});
    task.name += " with a flap at " + std::to_string(angle);
  }
  task.name += ", I " + std::to_string(points) + ", M " + std::to_string(task.conditions.mach) + ", alpha " +
               std::to_string(task.conditions.alpha_deg);
  task.mesh = generate(domain, {.gradation = points / 50.0}).mesh.freeze();
  return task;
}

bool is_what_it_claims(const Case& task, const FlowResult& flow) {
  double sum = -flow.cl;
  for (const FlowBody& body : flow.bodies) sum += body.cl;
  if (!(std::fabs(sum) < 1e-10)) return false;
  for (std::size_t v = 0; v < flow.density.size(); ++v)
    if (!(flow.density[v] > 0.0 && flow.pressure[v] > 0.0)) return false;
  const FlowResult again = solve_flow_from(task.mesh, flow, task.mesh, task.conditions, {.tolerance = 1e-10});
  return again.converged() && again.start != FlowStart::cold && std::fabs(again.cl - flow.cl) < 1e-5;
}

}  // namespace

int main(int argc, char** argv) {
  const int flows = argc > 1 ? std::atoi(argv[1]) : 100;
  std::mt19937_64 random(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
  const int first = argc > 3 ? std::atoi(argv[3]) : 0;
  int found = 0, not_found = 0, false_claims = 0, most_steps = 0;
  for (int i = 0; i < flows; ++i) {
    const Case task = draw(random);
    if (i < first) continue;
    const FlowResult flow = solve_flow(task.mesh, task.conditions, {.tolerance = 1e-8});
    if (!flow.converged()) {
      ++not_found;
      std::printf("not found: %d: %s: %s\n", i, task.name.c_str(), flow.reason.c_str());
      std::fflush(stdout);
      continue;
    }
    ++found;
    most_steps = std::max(most_steps, flow.newton_steps);
    if (is_what_it_claims(task, flow)) continue;
    ++false_claims;
    std::printf("false claim: %d: %s\n", i, task.name.c_str());
  }
  std::printf("%d flows: %d found in at most %d Newton steps, %d not found, %d claimed falsely\n",
              flows - first, found, most_steps, not_found, false_claims);
  return false_claims == 0 ? 0 : 1;
}
