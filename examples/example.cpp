// The library in one page: a mesh around an airfoil, which lives on while the airfoil grows thicker.

#include <cstdio>

#include "remodel/check.h"
#include "remodel/generate.h"
#include "remodel/io.h"
#include "remodel/remodel.h"
#include "remodel/shape_files.h"

int main() {
  remodel::CstAirfoil airfoil = remodel::load_airfoil("rae2822", 5);
  const auto domain = [&] { return remodel::airfoil_domain(airfoil, {.points = 200}); };
  remodel::Mesh mesh = remodel::generate(domain(), {.gradation = 4.0}).mesh;
  for (int design = 1; design <= 10; ++design) {
    for (double& coefficient : airfoil.upper) coefficient *= 1.005;
    const auto step = remodel::remodel(mesh, domain(), {.strategy = remodel::Strategy::renew});
    std::printf("design %d: %zu triangles, %.1f %% kept\n", design, step.triangles, step.preserved_percent());
  }
  remodel::write_mesh(mesh, "thicker.su2");
  return remodel::check(mesh.freeze(), {.min_angle_deg = 30.0}).valid ? 0 : 1;
}
