// What a step costs on each rung of the ladder (docs/morph.md), over a generation of the same run.
//
//     rungs [I SIGMA]...
//
// Random designs about NACA 0012, each coefficient by a normal deviate of SIGMA, are tried on one mesh of
// NACA 0012 by each strategy, and each trial is counted by the rung on which it ended. Reference meshes have
// angle_with_slack().

#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "remodel/airfoil.h"
#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "timing.h"

namespace remodel::bench {
namespace {

constexpr std::size_t design_count = 40;

struct Case {
  int points;
  double sigma;
};

// Their surfaces are apart. The generator of the standard is the same everywhere; its normal deviates need
// not be.
std::vector<Domain> designs(const Case& task) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> deviate(0.0, task.sigma);
  const CstAirfoil start = named_airfoil("naca:0012", 5);
  std::vector<Domain> result;
  while (result.size() < design_count) {
    CstAirfoil airfoil = start;
    for (std::vector<double>* surface : {&airfoil.upper, &airfoil.lower})
      for (double& coefficient : *surface) coefficient += deviate(random);
    if (surfaces_apart(airfoil)) result.push_back(airfoil_domain(airfoil, {.points = task.points}));
  }
  return result;
}

const char* rung_of(const RemodelResult& result, std::size_t vertices) {
  if (result.regenerated) return "generated afresh";
  if (result.refreshed) return "refreshed";
  if (result.held) return "held: interior moved, reference's connectivity";
  // Where walls move alone most of the interior stays.
  if (result.morphed && 2 * result.moved < vertices) return "walls alone, relaxed";
  if (result.morphed) return result.born() == 0 ? "interior moved" : "interior moved, repaired";
  if (result.full_adjustment) return "boundary alone";
  return result.method == Method::specialised ? "replaced along the boundary" : "general method";
}

void run(const Case& task) {
  const std::vector<Domain> tried = designs(task);
  QualityOptions quality{.gradation = 0.02 * task.points};
  std::vector<double> generations;
  for (std::size_t i = 0; i < 5; ++i) {
    const CpuClock clock;
    generate(tried[i], quality);
    generations.push_back(clock.seconds());
  }
  const double generation = median(generations);
  const Domain start = airfoil_domain(named_airfoil("naca:0012", 5), {.points = task.points});
  for (const Strategy strategy : {Strategy::renew, Strategy::morph, Strategy::reference}) {
    if (strategy == Strategy::reference) quality.refine_angle_deg = angle_with_slack(quality);
    Mesh mesh = generate(start, quality).mesh;
    const std::size_t vertices = mesh.freeze().points.size();
    // What depends on the start alone is computed by the first trial.
    { const Trial first(mesh, tried.front(), {.strategy = strategy}); }
    struct Rung {
      std::vector<double> seconds{}, changed{};
    };
    std::map<std::string, Rung> rungs;
    for (const Domain& design : tried) {
      const CpuClock clock;
      const Trial trial(mesh, design, {.strategy = strategy});
      const double seconds = clock.seconds();
      Rung& rung = rungs[rung_of(trial.result(), vertices)];
      rung.seconds.push_back(seconds);
      rung.changed.push_back(static_cast<double>(trial.result().born() + trial.result().gone()));
    }
    for (const auto& [name, rung] : rungs)
      std::printf("| %d | %g | %s | %s | %zu | %.0f | %.3f | %.2f |\n", task.points, task.sigma,
                  name_of(strategy), name.c_str(), rung.seconds.size(), median(rung.changed),
                  1e3 * median(rung.seconds), median(rung.seconds) / generation);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace remodel::bench

int main(int argc, char** argv) {
  using remodel::bench::Case;
  std::vector<Case> cases;
  for (int i = 1; i + 1 < argc; i += 2) cases.push_back({std::atoi(argv[i]), std::atof(argv[i + 1])});
  if (cases.empty())
    for (const int points : {200, 400, 700})
      for (const double sigma : {1e-4, 1e-3, 1e-2}) cases.push_back({points, sigma});
  std::puts("| I | sigma | strategy | rung | steps | triangles born and gone | ms | over a generation |");
  std::puts("|---|---|---|---|---|---|---|---|");
  for (const Case& task : cases) {
    if (task.points < 8 || task.points % 2 != 0 || !(task.sigma > 0.0)) {
      std::fputs("rungs: error: expected pairs of I (even, at least 8) and SIGMA (above 0)\n", stderr);
      return 2;
    }
    remodel::bench::run(task);
  }
}
