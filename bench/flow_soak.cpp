// Flows of random designs: how many are found, and whether any claims to be found that is not.
//
//     flow_soak FLOWS SEED [FIRST [friction]]
//
// Each is a section of the catalogue (or, one in ten, a section with a flap at Mach 0.2) with every
// coefficient disturbed by a standard deviation of 0.01, at I = 50 to 100, Mach 0.3 to 0.85 and -2 to 4
// degrees, from undisturbed flow. A flow that claims to be found is judged by itself: each body's forces must
// add up, all densities and pressures be positive, and the flow found from it on the same mesh at a hundredth
// of its tolerance have the same lift. Those before FIRST are drawn and not looked for. One line for each
// that was not found or is none; the exit status is 1 if any claims what it is not.
//
// With friction flows are turbulent, of single sections at Mach 0.15 to 0.75, -4 to 12 degrees and Reynolds
// numbers of 1e5 to 1e7, through layers on about 150 stations. A table says how many were found by Mach
// number and angle: where the flow stalls or its shock moves to and fro there is no steady one.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <string_view>

#include "remodel/airfoil.h"
#include "remodel/error.h"
#include "remodel/flow.h"
#include "remodel/flow_layer.h"
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
  FlowModel model = FlowModel::euler;
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

Case draw_with_friction(std::mt19937_64& random) {
  Case task;
  task.model = FlowModel::sa;
  task.conditions = {.mach = uniform(random, 0.15, 0.75), .alpha_deg = uniform(random, -4.0, 12.0)};
  task.conditions.reynolds = std::pow(10.0, uniform(random, 5.0, 7.0));
  Domain domain = airfoil_domain(section(random, task.name));
  space_walls(domain, {.leading_edge = 0.003, .trailing_edge = 0.003, .most = 0.016, .growth = 0.22});
  char text[100];
  std::snprintf(text, sizeof text, ", M %.4f, alpha %.3f, Re %.3g", task.conditions.mach,
                task.conditions.alpha_deg, task.conditions.reynolds);
  task.name += text;
  const LayerOptions layer = layer_for_flow(task.model, task.conditions.reynolds);
  task.mesh = generate_layered(domain, layer, {.gradation = 5.0}).mesh.freeze();
  return task;
}

// How many flows were looked for and found by Mach number (rows) and angle of attack (columns).
struct Shares {
  static constexpr std::array<double, 3> machs = {0.45, 0.6, 0.75}, alphas = {0.0, 6.0, 12.0};
  std::array<std::array<int, 3>, 3> asked = {}, found = {};

  void count(const FlowConditions& conditions, bool is_found) {
    const auto class_of = [](double value, const std::array<double, 3>& ends) {
      return value <= ends[0] ? 0u : value <= ends[1] ? 1u : 2u;
    };
    const auto row = class_of(conditions.mach, machs), column = class_of(conditions.alpha_deg, alphas);
    ++asked[row][column];
    found[row][column] += is_found ? 1 : 0;
  }
  void print() const {
    std::printf("found, of those asked for:");
    for (const double alpha : alphas) std::printf("  to %g degrees", alpha);
    for (std::size_t row = 0; row < machs.size(); ++row) {
      std::printf("\n  to Mach %-4g             ", machs[row]);
      for (std::size_t column = 0; column < alphas.size(); ++column)
        std::printf("  %5d of %-5d", found[row][column], asked[row][column]);
    }
    std::printf("\n");
  }
};

bool is_what_it_claims(const Case& task, const FlowResult& flow) {
  double sum = -flow.cl;
  for (const FlowBody& body : flow.bodies) sum += body.cl;
  if (!(std::fabs(sum) < 1e-10)) return false;
  for (std::size_t v = 0; v < flow.density.size(); ++v)
    if (!(flow.density[v] > 0.0 && flow.pressure[v] > 0.0)) return false;
  const FlowResult again =
      solve_flow_from(task.mesh, flow, task.mesh, task.conditions, {.tolerance = 1e-10, .model = task.model});
  return again.converged() && again.start != FlowStart::cold && std::fabs(again.cl - flow.cl) < 1e-5;
}

}  // namespace

int main(int argc, char** argv) {
  const int flows = argc > 1 ? std::atoi(argv[1]) : 100;
  std::mt19937_64 random(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
  const int first = argc > 3 ? std::atoi(argv[3]) : 0;
  const bool with_friction = argc > 4 && std::string_view(argv[4]) == "friction";
  Shares shares;
  int found = 0, not_found = 0, false_claims = 0, most_steps = 0;
  for (int i = 0; i < flows; ++i) {
    const Case task = with_friction ? draw_with_friction(random) : draw(random);
    if (i < first) continue;
    const FlowResult flow = solve_flow(task.mesh, task.conditions, {.tolerance = 1e-8, .model = task.model});
    shares.count(task.conditions, flow.converged());
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
  if (with_friction) shares.print();
  std::printf("%d flows: %d found in at most %d Newton steps, %d not found, %d claimed falsely\n",
              flows - first, found, most_steps, not_found, false_claims);
  return false_claims == 0 ? 0 : 1;
}
