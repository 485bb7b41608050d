// A three-element airfoil whose slat and flap are set anew again and again, in one living mesh:
//
//   high_lift [SETTINGS] [SEED] [STRATEGY] [PREFIX]
//
// STRATEGY is chain (the usual), renew, morph or reference; meshes for the last have angle_with_slack(). A
// row for every setting; with PREFIX the first and the last mesh as PREFIX-first.vtkhdf and
// PREFIX-last.vtkhdf. Settings whose elements would touch are refused and drawn again. Exit status 1 if a
// mesh is invalid.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

#include "remodel/airfoil.h"
#include "remodel/check.h"
#include "remodel/domain.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/io.h"
#include "remodel/remodel.h"
#include "remodel/shape_files.h"

namespace {

using namespace remodel;

// Deflections in degrees, nose up negative; the gap of the flap and of the slat in chords of the whole.
struct Setting {
  double slat_deg = 25.0, slat_gap = 0.02;
  double flap_deg = 30.0, flap_gap = 0.02, flap_shift = 0.0;
};

Domain three_elements(const Setting& setting) {
  const CstAirfoil thin = load_airfoil("naca:2408", 5), main = load_airfoil("naca:4412", 5);
  return airfoils_domain(
      {{.name = "slat",
        .airfoil = thin,
        .placement = {0.18, setting.slat_deg, {-0.17, -0.06 - setting.slat_gap}}},
       {.name = "main", .airfoil = main, .placement = {1.0, 0.0, {}}},
       {.name = "flap",
        .airfoil = thin,
        .placement = {0.3, -setting.flap_deg, {1.0 + setting.flap_shift, -0.01 - setting.flap_gap}}}},
      {.points = 120});
}

// The same on every machine, unlike the distributions of the standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  Setting setting() {
    return {.slat_deg = between(5, 40),
            .slat_gap = between(0.01, 0.05),
            .flap_deg = between(0, 40),
            .flap_gap = between(0.01, 0.06),
            .flap_shift = between(-0.02, 0.3)};
  }

 private:
  std::mt19937_64 engine_;
};

bool valid(const Mesh& mesh) {
  return mesh.quick_check().empty() && check(mesh.freeze(), {.min_angle_deg = mesh.options().min_angle_deg,
                                                             .max_gradation = mesh.promised_gradation(),
                                                             .delaunay_slack_deg = mesh.delaunay_slack_deg(),
                                                             .design = &mesh.domain()})
                                           .valid;
}

int run(int settings, std::uint64_t seed, Strategy strategy, const std::string& prefix) {
  Random random(seed);
  QualityOptions quality{.gradation = 2.4};
  if (strategy == Strategy::reference) quality.refine_angle_deg = angle_with_slack(quality);
  Mesh mesh = generate(three_elements({}), quality).mesh;
  if (!prefix.empty()) write_mesh(mesh, prefix + "-first.vtkhdf");
  std::puts(
      "setting,slat_deg,flap_deg,flap_shift,triangles,preserved_percent,connectivity_percent,changed,min_"
      "angle_"
      "deg,exempt,method,valid");
  int invalid = 0, regenerated = 0, refused = 0;
  double preserved = 0.0, connected = 0.0, least_connected = 100.0, changed = 0.0, smallest = 90.0;
  for (int i = 1; i <= settings;) {
    const Setting setting = random.setting();
    RemodelResult result;
    try {
      result = remodel::remodel(mesh, three_elements(setting), {.strategy = strategy});
    } catch (const Error&) {
      ++refused;
      continue;
    }
    const bool fine = valid(mesh);
    const MeshStatistics statistics = mesh.statistics();
    std::printf("%d,%.2f,%.2f,%.3f,%zu,%.2f,%.2f,%zu,%.4f,%zu,%s,%s\n", i, setting.slat_deg, setting.flap_deg,
                setting.flap_shift, result.triangles, result.preserved_percent(),
                result.connectivity_percent(), result.born() + result.gone(), statistics.min_angle_deg,
                statistics.exempt_triangles, name_of(result.method), fine ? "yes" : "NO");
    invalid += fine ? 0 : 1;
    regenerated += result.regenerated ? 1 : 0;
    preserved += result.preserved_percent() / settings;
    connected += result.connectivity_percent() / settings;
    least_connected = std::min(least_connected, result.connectivity_percent());
    changed += static_cast<double>(result.born() + result.gone()) / settings;
    smallest = std::min(smallest, statistics.min_held_angle_deg);
    ++i;
  }
  std::fprintf(stderr,
               "%d settings, %d refused: %d invalid, %d generated afresh, %.1f %% preserved on average, "
               "%.1f %% joined as before (least %.1f), %.0f triangles born and gone, smallest angle "
               "%.4f degrees, %zu triangles at the end, %zu in a fresh mesh\n",
               settings, refused, invalid, regenerated, preserved, connected, least_connected, changed,
               smallest, mesh.triangle_count(),
               generate(mesh.domain(), mesh.options()).mesh.triangle_count());
  if (!prefix.empty()) write_mesh(mesh, prefix + "-last.vtkhdf");
  return invalid == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc > 1 ? std::atoi(argv[1]) : 500, argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1,
               strategy_named(argc > 3 ? argv[3] : "chain"), argc > 4 ? argv[4] : "");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "high_lift: error: %s\n", error.what());
    return 2;
  }
}
