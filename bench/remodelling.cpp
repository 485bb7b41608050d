#include "contestants.h"
#include "measurements.h"
#include "remodel/airfoil.h"
#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "timing.h"

namespace remodel::bench {

namespace {

// RAE 2822 with the upper surface scaled.
Domain design(const AirfoilDomainOptions& options, double factor) {
  CstAirfoil airfoil = named_airfoil("rae2822", 5);
  for (double& c : airfoil.upper) c *= factor;
  return airfoil_domain(airfoil, options);
}

// The median time in seconds of steps back and forth between designs, without the first step; `full` counts
// the full adjustments among them.
double step_seconds(Mesh& mesh, const std::vector<Domain>& designs, int rounds, int& full) {
  std::vector<double> seconds;
  for (int round = 0; round <= rounds; ++round)
    for (const Domain& domain : designs) {
      const CpuClock clock;
      const RemodelResult result = remodel(mesh, domain, {.strategy = Strategy::chain});
      if (round == 0) continue;
      seconds.push_back(clock.seconds());
      full += result.full_adjustment ? 1 : 0;
    }
  return median(seconds);
}

}  // namespace

Rows adjustment(int rounds) {
  constexpr AirfoilDomainOptions options{.points = 700};
  Mesh mesh = generate(design(options, 1.0), {.gradation = 14.0}).mesh;
  const std::size_t on_boundary = mesh.statistics().steiner_boundary_vertices + 700;
  std::vector<Domain> designs;
  for (int i = 0; i < 16; ++i) designs.push_back(design(options, 1.0 + 1e-6 * ((7 * i) % 16)));
  std::vector<double> seconds, ratios;
  int full = 0;
  for (int round = 0; round < rounds; ++round) {
    const double y = yardstick();
    seconds.push_back(step_seconds(mesh, designs, 4, full));
    ratios.push_back(seconds.back() / static_cast<double>(on_boundary) / y);
  }
  return {{{"I", 700},
           {"boundary vertices", on_boundary},
           {"microseconds a step", 1e6 * median(seconds)},
           {"ns a boundary vertex", 1e9 * median(seconds) / static_cast<double>(on_boundary)},
           {"in Y", median(ratios)},
           {"steps", rounds * 4 * 16},
           {"of them full", full}}};
}

Rows step_scale(int rounds) {
  struct Case {
    double gradation;
    int farfield;
  };
  Rows rows;
  std::vector<double> whole, partial;
  for (const auto& [gradation, farfield] : {Case{4.0, 50}, Case{105.0, 50}, Case{4.0, 95'000}}) {
    const AirfoilDomainOptions options{.points = 200, .farfield_points = farfield};
    Mesh mesh = generate(design(options, 1.0), {.gradation = gradation}).mesh;
    int full = 0, none = 0;
    const double adjusted =
        step_seconds(mesh, {design(options, 1.0 + 1e-6), design(options, 1.0)}, rounds, full);
    const double replaced = step_seconds(mesh, {design(options, 1.05), design(options, 1.0)}, rounds, none);
    whole.push_back(adjusted);
    partial.push_back(replaced);
    rows.push_back({{"G", gradation},
                    {"farfield stations", farfield},
                    {"triangles", mesh.triangle_count()},
                    {"full adjustment, microseconds", 1e6 * adjusted},
                    {"over the first", adjusted / whole.front()},
                    {"partial step, microseconds", 1e6 * replaced},
                    {"partial, over the first", replaced / partial.front()}});
  }
  return rows;
}

}  // namespace remodel::bench
