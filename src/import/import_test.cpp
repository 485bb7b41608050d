#include "remodel/import.h"

#include <gtest/gtest.h>

#include "remodel/check.h"
#include "remodel/io.h"
#include "remodel/remodel.h"
#include "support.h"

namespace remodel {
namespace {

TEST(Import, SharedMesh) {
  REMODEL_SHARED_FILE(file, "meshes/mesh_NACA0012_inv.su2");
  const FrozenMesh mesh = read_frozen_mesh(file);
  ImportResult imported = import_mesh(mesh, file.string());
  EXPECT_EQ(imported.mesh.quick_check(), "");
  const FrozenMesh same = imported.mesh.freeze();
  EXPECT_EQ(same.triangles, mesh.triangles);
  EXPECT_EQ(same.points, mesh.points);
  std::printf("min %g promised %.10g refine %g G %g flipped %zu nd %zu\n", imported.min_angle_deg,
              imported.mesh.options().min_angle_deg, imported.mesh.options().refine_angle_deg,
              imported.mesh.options().gradation, imported.flipped_edges, imported.non_delaunay_edges);
  const AirfoilPlace place = find_airfoil(imported.mesh.domain(), "airfoil", "f");
  std::printf("place %g %g %g %g n %zu base %zu t1 %.17g t50 %g\n", place.leading.x, place.leading.y,
              place.trailing.x, place.trailing.y, place.parameters.size(), place.base.size(),
              place.parameters[1], place.parameters[50]);
  const CstFit fit = fit_airfoil(imported.mesh.domain(), place, 5);
  std::printf("fit %g %g\n", fit.max_error, fit.rms_error);
  Mesh m2 = imported.mesh;
  for (const CstAirfoil& a : {load_airfoil("rae2822", 5), fit.airfoil}) {
    Mesh m = imported.mesh;
    RemodelResult r = remodel(m, with_airfoil(m.domain(), place, a));
    MeshParts parts = parts_of(m.freeze());
    std::printf(
        "before %zu after %zu preserved %zu (%.2f%%) ins %zu rem %zu regen %d %s kept %zu %g refined %zu %g "
        "qc '%s'\n",
        r.triangles_before, r.triangles, r.preserved, r.preserved_percent(), r.inserted, r.removed,
        r.regenerated, r.reason.c_str(), parts.kept.triangles, parts.kept.min_angle_deg,
        parts.refined.triangles, parts.refined.min_angle_deg, m.quick_check().c_str());
  }
}

}  // namespace
}  // namespace remodel
#include <algorithm>
#include <cmath>
#include "remodel/generate.h"
namespace remodel {
TEST(Import, Calibrate) {
  for (int points : {50, 100, 200, 400}) {
    GenerateResult g = generate(airfoil_domain(airfoil_catalogue()[0].airfoil(), {.points = points}),
                                {.gradation = points / 50.0});
    FrozenMesh f = g.mesh.freeze();
    std::vector<double> sum(f.points.size()), n(f.points.size()), ratio;
    double inv = 1 / g.mesh.options().max_gradation;
    for (auto& t : f.triangles) {
      Point a = f.points[t[0]], b = f.points[t[1]], c = f.points[t[2]];
      double r = std::sqrt(squared_distance(a, b) * squared_distance(b, c) * squared_distance(c, a)) /
                 (2 * std::abs(cross(b - a, c - a)));
      for (auto v : t) sum[v] += r * inv, n[v] += 1;
    }
    for (std::size_t i = 0; i < sum.size(); ++i)
      if (f.curve[i] < 0) ratio.push_back(f.length_scale[i] / (sum[i] / n[i]));
    std::sort(ratio.begin(), ratio.end());
    std::printf("points %d n %zu ratio q10 %g q25 %g median %g q75 %g q90 %g\n", points, ratio.size(),
                ratio[ratio.size() / 10], ratio[ratio.size() / 4], ratio[ratio.size() / 2],
                ratio[ratio.size() * 3 / 4], ratio[ratio.size() * 9 / 10]);
  }
}
}  // namespace remodel
