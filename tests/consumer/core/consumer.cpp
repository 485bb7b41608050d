// Generates a mesh, makes one step of remodelling and validates the result, with remodel::core alone.

#include <remodel/airfoil.h>
#include <remodel/check.h>
#include <remodel/generate.h>
#include <remodel/remodel.h>
#include <remodel/version.h>

#include <cstdio>
#include <utility>

int main() {
  remodel::CstAirfoil airfoil = remodel::named_airfoil("naca:0012", 5);
  remodel::Mesh mesh =
      std::move(remodel::generate(remodel::airfoil_domain(airfoil, {.points = 50}), {.gradation = 1.0}).mesh);
  for (double& coefficient : airfoil.upper) coefficient *= 1.01;
  const remodel::RemodelResult step =
      remodel::remodel(mesh, remodel::airfoil_domain(airfoil, {.points = 50}));
  const remodel::CheckResult checked = remodel::check(mesh.freeze(), {.min_angle_deg = 30.0});
  std::printf("remodel %s: %zu triangles, %.1f %% preserved, %s\n", REMODEL_VERSION, step.triangles,
              step.preserved_percent(), checked.valid ? "valid" : "invalid");
  return checked.valid && step.triangles > 0 ? 0 : 1;
}
