// The acceptance case: a solver's tutorial mesh.

#include <gtest/gtest.h>

#include "remodel/check.h"
#include "remodel/import.h"
#include "remodel/io.h"
#include "remodel/remodel.h"
#include "remodel/shape_files.h"
#include "support.h"

namespace remodel {
namespace {

TEST(Import, TheSharedMesh) {
  REMODEL_SHARED_FILE(file, "meshes/mesh_NACA0012_inv.su2");
  REMODEL_SHARED_FILE(shape, "airfoils/rae2822.dat");
  const FrozenMesh mesh = read_frozen_mesh(file);
  ImportResult result = import_mesh(mesh, file.string());
  EXPECT_EQ(result.flipped_edges, 0U);
  EXPECT_EQ(result.mesh.freeze().triangles, mesh.triangles);
  const AirfoilPlace place = find_airfoil(result.mesh.domain(), "airfoil", file.string());
  EXPECT_EQ(place.leading, (Point{0.0, 0.0}));
  EXPECT_EQ(place.trailing, (Point{1.0, 0.0}));
  EXPECT_EQ(place.parameters.size(), 200U);
  const RemodelResult step =
      remodel(result.mesh, with_airfoil(result.mesh.domain(), place, load_airfoil(shape.string(), 5)),
              {.strategy = Strategy::chain});
  EXPECT_GT(step.preserved_percent(), 90.0);
  const CheckResult checked =
      check(result.mesh.freeze(),
            {.min_angle_deg = result.min_angle_deg * (1.0 - 1e-9), .design = &result.mesh.domain()});
  EXPECT_TRUE(checked.valid);
}

}  // namespace
}  // namespace remodel
