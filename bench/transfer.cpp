// What it costs to carry values over, as parts of the step that made it necessary:
// build/bench/transfer_cost
//
// Airfoils at I points and G = I / 50, and a hole that moves in a domain of about five thousand and of about
// a million triangles. One line each, medians of processor times, which are measured alternately.

#include <cstdio>
#include <string>
#include <vector>

#include "remodel/airfoil.h"
#include "remodel/domain.h"
#include "remodel/generate.h"
#include "remodel/mesh_state.h"
#include "remodel/remodel.h"
#include "remodel/transfer.h"
#include "seeded.h"
#include "timing.h"

namespace remodel::bench {

namespace {

constexpr int variables = 4;

struct Costs {
  std::vector<double> step, ride, remap;
  std::size_t triangles = 0, born = 0;
};

// The values of all slots, which a ride or remap has to find in the right number.
std::vector<double> values_of(const Mesh& mesh) {
  return std::vector<double>(variables * mesh.state().vertex_stars.size(), 1.0);
}

// Steps to one design and then another: those that replace something are counted.
void measure(Mesh& mesh, const std::vector<Domain>& designs, Costs& costs) {
  for (const Domain& design : designs) {
    std::vector<double> ridden = values_of(mesh), remapped = ridden;
    const Mark mark = mesh.mark();
    const CpuClock step;
    const RemodelResult result = remodel(mesh, design, {.strategy = Strategy::chain});
    const double step_seconds = step.seconds();
    if (result.full_adjustment || result.regenerated) continue;
    // The vectors grow at their end, which an owner of values does once: not a cost of the transfer.
    ridden.reserve(2 * ridden.size()), remapped.reserve(2 * remapped.size());
    const CpuClock ride;
    vertex_provenance(mesh, mark).apply(ridden, variables);
    const double ride_seconds = ride.seconds();
    const CpuClock remap;
    Transfer(mesh, mark).remap(FieldPlace::vertices, variables, remapped);
    costs.remap.push_back(remap.seconds());
    costs.step.push_back(step_seconds), costs.ride.push_back(ride_seconds);
    costs.triangles = result.triangles;
    costs.born += mesh.changes_since(mark).born.size();
  }
}

void print(const std::string& name, const Costs& costs) {
  const double step = median(costs.step);
  std::printf("%-22s %9zu %7zu %9.3f %9.3f %9.3f %7.2f %7.2f\n", name.c_str(), costs.triangles,
              costs.step.empty() ? 0 : costs.born / costs.step.size(), 1e3 * step, 1e3 * median(costs.ride),
              1e3 * median(costs.remap), median(costs.ride) / step, median(costs.remap) / step);
}

void airfoils(int points, double spread) {
  Seeded random(5);
  const CstAirfoil base = named_airfoil("rae2822", 5);
  std::vector<Domain> designs;
  while (designs.size() < 60) {
    CstAirfoil airfoil = base;
    for (std::vector<double>* surface : {&airfoil.upper, &airfoil.lower})
      for (double& c : *surface) c *= 1.0 + random.number(-spread, spread);
    if (surfaces_apart(airfoil)) designs.push_back(airfoil_domain(airfoil, {.points = points}));
  }
  Mesh mesh = generate(designs[0], {.gradation = 0.02 * points}).mesh;
  Costs costs;
  measure(mesh, designs, costs);
  print("airfoil I=" + std::to_string(points) + " " + std::to_string(spread).substr(0, 4), costs);
}

Domain two_holes(double shift, std::size_t stations) {
  const auto circle = [](LoopRole role, const char* name, Arc arc, std::size_t n) {
    return Loop{role, {{name, arc, Parameters::uniform(n)}}};
  };
  return {{circle(LoopRole::outer, "outer", Arc{.centre = {0, 0}, .radius = 10}, 64),
           circle(LoopRole::hole, "moving", Arc{.centre = {-5 + shift, 0}, .radius = 1}, 64),
           circle(LoopRole::hole, "resting", Arc{.centre = {5, 0}, .radius = 1}, stations)}};
}

void holes(std::size_t stations, double gradation) {
  std::vector<Domain> designs;
  for (int i = 0; i < 30; ++i) designs.push_back(two_holes(i % 2 == 0 ? 0.0 : 0.12, stations));
  Mesh mesh = generate(designs[0], {.gradation = gradation}).mesh;
  Costs costs;
  measure(mesh, designs, costs);
  print("hole, resting " + std::to_string(stations), costs);
}

}  // namespace

}  // namespace remodel::bench

int main() {
  using namespace remodel::bench;
  std::printf("%-22s %9s %7s %9s %9s %9s %7s %7s\n", "case", "triangles", "born", "step ms", "ride ms",
              "remap ms", "ride/", "remap/");
  for (const int points : {200, 700})
    for (const double spread : {0.05, 0.2}) airfoils(points, spread);
  holes(256, 4.0);
  holes(60000, 12.0);
}
