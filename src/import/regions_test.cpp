// What an imported mesh keeps of its file's own structure: regions and the curves between them, and which
// points of the boundary are the design's.

#include <gtest/gtest.h>

#include <cmath>

#include "import/test_foreign.h"
#include "remodel/check.h"
#include "remodel/error.h"
#include "remodel/import.h"
#include "remodel/mesh_state.h"
#include "remodel/remodel.h"
#include "support.h"

namespace remodel {
namespace {

using Inside = bool (*)(Point);

// Regions by the centres of triangles.
FrozenMesh in_two(FrozenMesh mesh, Inside inside) {
  mesh.region_names = {"outer air", "inner air"};
  for (const auto& [a, b, c] : mesh.triangles)
    mesh.region.push_back(inside((1.0 / 3.0) * (mesh.points[a] + mesh.points[b] + mesh.points[c])) ? 1 : 0);
  return mesh;
}

const Inside partitions[] = {
    [](Point p) { return std::hypot(p.x - 0.5, p.y) < 2.0; },  // a loop around the airfoil
    [](Point p) { return p.x > 2.5; },                         // a chain from the farfield to itself
    [](Point p) { return p.y > 0.02 + 0.9 * (p.x - 0.5); },    // two chains that end on the airfoil
    [](Point p) { return std::fmod(std::abs(p.y), 1.0) > 0.7; }};

std::map<std::string, double> areas(const FrozenMesh& mesh) {
  std::map<std::string, double> result;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto [a, b, c] = mesh.triangles[i];
    result[mesh.region_names.at(mesh.region.at(i))] +=
        0.5 * cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]);
  }
  return result;
}

void expect_valid(const Mesh& mesh) {
  ASSERT_EQ(mesh.quick_check(), "");
  const CheckResult checked = check(mesh.freeze(), {.delaunay = true, .design = &mesh.domain()});
  ASSERT_TRUE(checked.valid) << checked.violations.front().rule << ": " << checked.violations.front().detail;
}

TEST(Regions, ComeBackTriangleByTriangle) {
  for (const Inside inside : partitions) {
    const FrozenMesh mesh = in_two(test::foreign_airfoil(), inside);
    const Mesh imported = import_mesh(mesh, "file.msh").mesh;
    expect_valid(imported);
    const FrozenMesh back = imported.freeze();
    ASSERT_EQ(back.triangles, mesh.triangles);
    ASSERT_EQ(back.region.size(), mesh.region.size());
    for (std::size_t i = 0; i < mesh.region.size(); ++i)
      ASSERT_EQ(back.region_names[back.region[i]], mesh.region_names[mesh.region[i]]) << i;
  }
}

TEST(Regions, KeepTheirPlaceWhateverIsRemodelled) {
  for (const Inside inside : {partitions[0], partitions[1]}) {
    const FrozenMesh mesh = in_two(test::foreign_airfoil(), inside);
    Mesh living = import_mesh(mesh, "file.msh").mesh;
    const auto before = areas(mesh);
    for (const std::size_t airfoil : {3, 5, 1, 0}) {
      const AirfoilPlace place = find_airfoil(living.domain(), "airfoil", "file.msh");
      const RemodelResult step =
          remodel(living, with_airfoil(living.domain(), place, airfoil_catalogue()[airfoil].airfoil()),
                  {.strategy = Strategy::chain});
      EXPECT_FALSE(step.regenerated);
      expect_valid(living);
      const auto after = areas(living.freeze());
      ASSERT_EQ(after.size(), 2U);
      // The one without the airfoil, or the one that it is all in, between fixed curves.
      const std::string still = inside({0.5, 0.0}) ? "outer air" : "inner air";
      EXPECT_NEAR(after.at(still), before.at(still), 1e-9 * before.at(still));
    }
    const Mesh restored = Mesh::restore(living.state(), "state");
    EXPECT_EQ(restored.freeze().region, living.freeze().region);
    EXPECT_EQ(restored.freeze().region_names, living.freeze().region_names);
  }
}

TEST(Regions, CurvesInsideThatTheFileNamesStayUnderTheirNames) {
  FrozenMesh mesh = in_two(test::foreign_airfoil(), partitions[0]);
  Mesh unnamed = import_mesh(mesh, "file.msh").mesh;
  FrozenBoundary ring{"ring", {}};
  for (const FrozenBoundary& boundary : unnamed.freeze().boundaries)
    if (boundary.name == "interface") ring.edges = boundary.edges;
  ASSERT_GT(ring.edges.size(), 8U);
  mesh.boundaries.push_back(ring);
  mesh.region.clear();
  mesh.region_names.clear();
  Mesh named = import_mesh(mesh, "file.msh").mesh;
  expect_valid(named);
  const FrozenMesh back = named.freeze();
  EXPECT_EQ(back.boundaries.back().name, "ring");
  EXPECT_EQ(back.boundaries.back().edges.size(), ring.edges.size());
  EXPECT_TRUE(back.region.empty());
}

TEST(Regions, ThatAreNoneAreRefused) {
  FrozenMesh mesh = in_two(test::foreign_airfoil(), partitions[0]);
  const auto problem = [](const FrozenMesh& changed) -> std::string {
    try {
      import_mesh(changed, "file.msh");
      return "imported";
    } catch (const Error& error) {
      return error.what();
    }
  };
  FrozenMesh changed = mesh;
  changed.region.pop_back();
  EXPECT_NE(problem(changed).find("regions of triangles found"), std::string::npos);
  changed = mesh;
  changed.region[7] = 2;
  EXPECT_NE(problem(changed).find("triangle 7: region 2 found, an index below 2 expected"),
            std::string::npos);
}

// Any partition at all, of any mesh, is kept or refused in one line.
TEST(Regions, OfAnyShapeAreKept) {
  const unsigned long long seed = test::seed(6);
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  for (int round = 0; round < 60; ++round) {
    FrozenMesh mesh = round % 2 == 0 ? test::foreign_airfoil(16) : test::foreign_holes();
    mesh.region_names = {"a", "b", "c"};
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      mesh.region.push_back(random() % 40 == 0 ? 1 + static_cast<std::uint32_t>(random() % 2) : 0);
    const Mesh living = import_mesh(mesh, "file.msh").mesh;
    expect_valid(living);
    const FrozenMesh back = living.freeze();
    for (std::size_t i = 0; i < mesh.region.size(); ++i)
      ASSERT_EQ(back.region_names[back.region[i]], mesh.region_names[mesh.region[i]]) << i;
  }
}

// ---- points of the design

TEST(SteinerPoints, OfAFileAreNoneOfTheDesigns) {
  Mesh original = generate(airfoil_domain(airfoil_catalogue()[0].airfoil(),
                                          {.points = 24, .farfield_radius = 4, .farfield_points = 12}),
                           {.min_angle_deg = 30, .gradation = 4.0})
                      .mesh;
  const std::size_t added = original.statistics().steiner_boundary_vertices;
  ASSERT_GT(added, 4U);
  FrozenMesh mesh = test::bare(original.freeze());
  EXPECT_EQ(import_mesh(mesh, "file.su2").mesh.statistics().steiner_boundary_vertices, 0U);
  mesh.steiner = original.freeze().steiner;
  Mesh living = import_mesh(mesh, "file.su2").mesh;
  expect_valid(living);
  EXPECT_EQ(living.statistics().steiner_boundary_vertices, added);
  EXPECT_EQ(living.freeze().steiner, mesh.steiner);
  EXPECT_EQ(living.freeze().triangles, mesh.triangles);
  EXPECT_EQ(Mesh::restore(living.state(), "state").freeze().steiner, mesh.steiner);
  const AirfoilPlace place = find_airfoil(living.domain(), "airfoil", "file.su2");
  EXPECT_EQ(place.parameters.size() + place.base.size(), 24U);
  // Vertices correspond one to one: the paper's own method moves them to another airfoil of as many points.
  const RemodelResult step =
      remodel(living, with_airfoil(living.domain(), place, airfoil_catalogue()[2].airfoil()),
              {.strategy = Strategy::chain});
  EXPECT_EQ(step.method, Method::specialised);
  EXPECT_FALSE(step.regenerated);
  expect_valid(living);
}

TEST(SteinerPoints, AnyClaimIsTakenOrPassedOver) {
  const unsigned long long seed = test::seed(7);
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  for (int round = 0; round < 60; ++round) {
    FrozenMesh mesh = round % 2 == 0 ? test::foreign_airfoil(16) : test::foreign_holes();
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
      mesh.steiner.push_back(
          static_cast<std::uint8_t>(random() % (2 + static_cast<unsigned>(round) % 3) != 0));
    Mesh living = import_mesh(mesh, "file.su2").mesh;
    expect_valid(living);
    EXPECT_EQ(living.freeze().triangles, mesh.triangles);
  }
}

}  // namespace
}  // namespace remodel
