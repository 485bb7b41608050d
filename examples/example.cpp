// The library in one page: a mesh around an airfoil, remodelled while the airfoil grows thicker.

#include <cstdio>
#include <utility>

#include "remodel/airfoil.h"
#include "remodel/check.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/io.h"
#include "remodel/remodel.h"

int main() try {
  remodel::CstAirfoil airfoil = remodel::load_airfoil("rae2822", 5);
  remodel::GenerateResult generated =
      remodel::generate(remodel::airfoil_domain(airfoil, {.points = 100}), {.gradation = 2.0});
  remodel::Mesh mesh = std::move(generated.mesh);

  for (int step = 1; step <= 10; ++step) {
    for (double& coefficient : airfoil.upper) coefficient *= 1.005;
    const remodel::RemodelResult result =
        remodel::remodel(mesh, remodel::airfoil_domain(airfoil, {.points = 100}));
    std::printf("step %d: %zu triangles, %.1f %% preserved\n", step, result.triangles,
                result.preserved_percent());
  }

  const remodel::CheckResult checked = remodel::check(mesh.freeze(), {.min_angle_deg = 30.0});
  std::printf("valid: %s, smallest angle %.2f degrees\n", checked.valid ? "yes" : "no",
              checked.min_angle_deg);
  remodel::write_mesh(mesh, "thicker.su2");
  return checked.valid ? 0 : 1;
} catch (const remodel::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());  // one line: where, what was found, what was expected
  return 2;
}
