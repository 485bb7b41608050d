#include "remodel/import.h"

#include <gtest/gtest.h>

#include <cmath>

#include "import/test_foreign.h"
#include "remodel/check.h"
#include "remodel/error.h"
#include "remodel/mesh_state.h"
#include "remodel/predicates.h"
#include "remodel/remodel.h"
#include "support.h"

namespace remodel {
namespace {

using test::all_corners;

ImportResult imported(const FrozenMesh& mesh, const ImportOptions& options = {}) {
  return import_mesh(mesh, "file.su2", options);
}

std::string problem(const FrozenMesh& mesh) {
  try {
    imported(mesh);
    return "imported";
  } catch (const Error& error) {
    return error.what();
  }
}

// ---- what goes in comes out

TEST(Import, AMeshComesBackAsItWas) {
  for (const FrozenMesh& mesh : {test::foreign_airfoil(), test::foreign_holes()}) {
    const ImportResult result = imported(mesh);
    EXPECT_EQ(result.mesh.quick_check(), "");
    EXPECT_EQ(result.flipped_edges, 0U);
    const FrozenMesh back = result.mesh.freeze();
    EXPECT_EQ(back.points, mesh.points);
    EXPECT_EQ(back.triangles, mesh.triangles);
    ASSERT_EQ(back.boundaries.size(), mesh.boundaries.size());
    for (std::size_t i = 0; i < mesh.boundaries.size(); ++i) {
      EXPECT_EQ(back.boundaries[i].name, mesh.boundaries[i].name);
      const auto sorted = [](auto edges) { return std::sort(edges.begin(), edges.end()), edges; };
      EXPECT_EQ(sorted(back.boundaries[i].edges), sorted(mesh.boundaries[i].edges));
    }
    const CheckResult checked = check(back, {.design = &result.mesh.domain()});
    EXPECT_TRUE(checked.valid) << checked.violations.front().detail;
  }
}

TEST(Import, TriangulationsOfTheSamePointsOnACircleAreKept) {
  std::mt19937_64 random(1);
  const FrozenMesh mesh = test::grid(12, random);
  const ImportResult result = imported(mesh);
  EXPECT_EQ(result.mesh.quick_check(), "");
  EXPECT_EQ(result.non_delaunay_edges, 0U);
  EXPECT_GT(result.flipped_edges, 0U);
  EXPECT_EQ(result.mesh.freeze().triangles, mesh.triangles);
}

TEST(Import, MarkersKeepTheirOrderAndLoopsTheirNames) {
  std::mt19937_64 random(1);
  const FrozenMesh mesh = test::grid(4, random);
  const FrozenMesh back = imported(mesh).mesh.freeze();
  ASSERT_EQ(back.boundaries.size(), 2U);
  EXPECT_EQ(back.boundaries[0].name, "rest");
  EXPECT_EQ(back.boundaries[0].edges.size(), 12U);
  EXPECT_EQ(back.boundaries[1].name, "south");
  EXPECT_EQ(back.boundaries[1].edges.size(), 4U);
  EXPECT_TRUE(check(back).valid);
}

TEST(Import, BoundaryEdgesWithoutANameGetOne) {
  FrozenMesh mesh = test::foreign_airfoil();
  mesh.boundaries.erase(mesh.boundaries.begin());
  mesh.boundaries[0].edges.pop_back();
  const ImportResult result = imported(mesh, {.unnamed = "wall"});
  EXPECT_EQ(result.mesh.quick_check(), "");
  const FrozenMesh back = result.mesh.freeze();
  ASSERT_EQ(back.boundaries.size(), 2U);
  EXPECT_EQ(back.boundaries[1].name, "wall");
  EXPECT_EQ(back.boundaries[1].edges.size(), result.unnamed_edges);
  EXPECT_GT(result.unnamed_edges, 40U);
}

TEST(Import, ClockwiseTrianglesAreTurnedAndUnusedPointsLeftOut) {
  FrozenMesh mesh = test::foreign_holes();
  const FrozenMesh before = mesh;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
    std::swap(mesh.triangles[i][0], mesh.triangles[i][1]);
  mesh.points.push_back({7.0, 7.0});
  const ImportResult result = imported(mesh);
  EXPECT_EQ(result.turned_triangles, (mesh.triangles.size() + 2) / 3);
  EXPECT_EQ(result.unused_points, 1U);
  EXPECT_EQ(result.mesh.freeze().points, before.points);
  EXPECT_EQ(all_corners(result.mesh.freeze()), all_corners(before));
}

TEST(Import, TrianglesThatAreListedTwiceAreTakenOnce) {
  FrozenMesh mesh = test::foreign_holes();
  const FrozenMesh before = mesh;
  // Beside the triangle itself, turned, the other way around, and in another region.
  mesh.region.assign(mesh.triangles.size(), 0);
  mesh.region_names = {"all", "part"};
  const auto [a, b, c] = mesh.triangles[3];
  const std::vector<std::array<std::uint32_t, 3>> again = {{a, b, c}, {b, c, a}, {b, a, c}};
  mesh.triangles.insert(mesh.triangles.begin() + 5, again.begin(), again.end());
  mesh.region.insert(mesh.region.begin() + 5, 3, 1);
  const ImportResult result = imported(mesh);
  EXPECT_EQ(result.duplicate_triangles, 3U);
  EXPECT_EQ(result.mesh.freeze().triangles, before.triangles);
  EXPECT_EQ(result.mesh.quick_check(), "");
  // A triangle that lies on others without being one of them overlaps them; it has the file's number.
  mesh.triangles.push_back({a, b, mesh.triangles[20][0]});
  mesh.region.push_back(0);
  const std::string number = std::to_string(mesh.triangles.size() - 1);
  const std::string error = problem(mesh);
  EXPECT_NE(error.find("overlap"), std::string::npos) << error;
  EXPECT_NE(error.find(number), std::string::npos) << error;
}

// ---- meshes that are not Delaunay

TEST(Import, FlipsMakeAMeshDelaunayOrAreNotSeen) {
  const unsigned long long seed = test::seed(1);
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  for (int round = 0; round < 10; ++round) {
    const FrozenMesh delaunay = test::foreign_holes();
    FrozenMesh mesh = delaunay;
    test::flip_at_random(mesh, 1 + 5 * round, random);
    const ImportResult flipped = imported(mesh, {.non_delaunay = NonDelaunay::flip});
    const ImportResult kept = imported(mesh, {.non_delaunay = NonDelaunay::keep});
    EXPECT_EQ(flipped.mesh.quick_check(), "");
    EXPECT_EQ(kept.mesh.quick_check(), "");
    EXPECT_EQ(all_corners(flipped.mesh.freeze()), all_corners(delaunay));
    EXPECT_EQ(kept.mesh.freeze().triangles, mesh.triangles);
    EXPECT_EQ(flipped.non_delaunay_edges > 0, flipped.flipped_edges > 0);
  }
}

TEST(Import, WhatIsKeptStaysUntilSomethingTouchesIt) {
  std::mt19937_64 random(test::seed(2));
  FrozenMesh mesh = test::foreign_airfoil();
  test::flip_at_random(mesh, 60, random);
  ImportResult result = imported(mesh, {.non_delaunay = NonDelaunay::keep});
  ASSERT_GT(result.non_delaunay_edges, 10U);
  const std::set<test::Corners> before = all_corners(mesh);
  const AirfoilPlace place = find_airfoil(result.mesh.domain(), "airfoil", "file.su2");
  remodel(result.mesh, with_airfoil(result.mesh.domain(), place, airfoil_catalogue()[3].airfoil()),
          {.strategy = Strategy::chain});
  const FrozenMesh after = result.mesh.freeze();
  const CheckResult checked = check(after, {.delaunay = false, .design = &result.mesh.domain()});
  EXPECT_TRUE(checked.valid) << checked.violations.front().detail;
  EXPECT_FALSE(checked.delaunay);
  std::size_t same = 0;
  for (const auto& triangle : after.triangles)
    same += before.contains(test::corners(after, triangle)) ? 1 : 0;
  const ImportResult flipped = imported(mesh);
  std::size_t same_if_flipped = 0;
  for (const test::Corners& corners : all_corners(flipped.mesh.freeze()))
    same_if_flipped += before.contains(corners) ? 1 : 0;
  EXPECT_GT(same, same_if_flipped * 8 / 10);
  // The living mesh is Delaunay all the same.
  EXPECT_EQ(result.mesh.quick_check(), "");
}

// ---- what is promised

TEST(Import, TrianglesAwayFromAChangeStayToTheLastBit) {
  const FrozenMesh mesh = test::foreign_airfoil(100);
  const std::set<test::Corners> before = all_corners(mesh);
  for (std::size_t airfoil = 1; airfoil < airfoil_catalogue().size(); ++airfoil) {
    SCOPED_TRACE(airfoil);
    ImportResult result = imported(mesh);
    const AirfoilPlace place = find_airfoil(result.mesh.domain(), "airfoil", "file.su2");
    const RemodelResult step = remodel(
        result.mesh, with_airfoil(result.mesh.domain(), place, airfoil_catalogue()[airfoil].airfoil()),
        {.strategy = Strategy::chain});
    ASSERT_EQ(step.stopped, Stopped::done);
    ASSERT_FALSE(step.regenerated) << step.reason;
    const FrozenMesh after = result.mesh.freeze();
    std::size_t same = 0;
    for (const auto& triangle : after.triangles)
      same += before.contains(test::corners(after, triangle)) ? 1 : 0;
    EXPECT_EQ(same, step.preserved);
    EXPECT_GT(step.preserved_percent(), 50.0);
    const MeshParts parts = parts_of(after);
    EXPECT_EQ(parts.kept.triangles + parts.changed.triangles, after.triangles.size());
    const CheckResult checked = check(after, {.min_angle_deg = result.mesh.options().min_angle_deg,
                                              .max_gradation = result.mesh.options().max_gradation,
                                              .design = &result.mesh.domain()});
    EXPECT_TRUE(checked.valid) << checked.violations.front().detail;
    EXPECT_GE(checked.min_angle_deg, result.min_angle_deg * (1.0 - 1e-8));
  }
}

TEST(Import, OtherBodiesStay) {
  Domain domain = test::with_holes({test::star_hole(0.3, 0.3, 0.15), test::circle_hole(0.7, 0.7, 0.15, 32)});
  domain.loops[1].curves[0].name = "star";
  const FrozenMesh mesh = test::foreign(domain);
  ImportResult result = imported(mesh);
  const AirfoilPlace place = find_airfoil(result.mesh.domain(), "hole", "file.su2");
  const Domain next = with_airfoil(result.mesh.domain(), place, airfoil_catalogue()[0].airfoil());
  ASSERT_FALSE(remodel(result.mesh, next, {.strategy = Strategy::chain}).regenerated);
  EXPECT_EQ(result.mesh.quick_check(), "");
  const FrozenMesh after = result.mesh.freeze();
  const auto places = [](const FrozenMesh& m, const std::string& name) {
    std::set<std::pair<double, double>> points;
    for (const FrozenBoundary& boundary : m.boundaries)
      for (const auto& edge : boundary.edges)
        if (boundary.name == name) points.emplace(m.points[edge[0]].x, m.points[edge[0]].y);
    return points;
  };
  EXPECT_EQ(places(after, "star"), places(mesh, "star"));
  EXPECT_NE(places(after, "hole"), places(mesh, "hole"));
  EXPECT_EQ(after.boundaries.size(), mesh.boundaries.size());
  for (std::size_t i = 0; i < mesh.boundaries.size(); ++i)
    EXPECT_EQ(after.boundaries[i].name, mesh.boundaries[i].name);
}

// Angles of 20 to 30 degrees stay where they are; what refinement makes keeps 30.
TEST(Import, RefinedTrianglesAreBetterThanTheFiles) {
  Domain domain = airfoil_domain(airfoil_catalogue()[0].airfoil(), {.points = 60, .farfield_radius = 4});
  const FrozenMesh mesh = test::foreign(domain, {.min_angle_deg = 20.0, .gradation = 1.0});
  ImportResult result = imported(mesh);
  ASSERT_LT(result.min_angle_deg, 25.0);
  EXPECT_NEAR(result.mesh.options().min_angle_deg, result.min_angle_deg, 1e-6);
  EXPECT_EQ(result.mesh.options().refine_angle_deg, 30.0);
  const AirfoilPlace place = find_airfoil(result.mesh.domain(), "airfoil", "file.su2");
  remodel(result.mesh, with_airfoil(result.mesh.domain(), place, airfoil_catalogue()[2].airfoil()),
          {.method = Method::general, .strategy = Strategy::chain});
  const MeshParts parts = parts_of(result.mesh.freeze());
  EXPECT_GT(parts.changed.triangles, 100U);
  EXPECT_GE(parts.changed.min_angle_deg, 30.0 * (1.0 - 1e-8));
  EXPECT_GE(parts.kept.min_angle_deg, result.min_angle_deg * (1.0 - 1e-8));
  EXPECT_LT(parts.kept.min_angle_deg, 30.0);
}

TEST(Import, AnImportedMeshGoesOnFromItsNativeFile) {
  std::mt19937_64 random(test::seed(3));
  FrozenMesh mesh = test::foreign_airfoil();
  test::flip_at_random(mesh, 30, random);
  ImportResult result = imported(mesh, {.non_delaunay = NonDelaunay::keep});
  Mesh restored = Mesh::restore(result.mesh.state(), "state");
  EXPECT_EQ(restored.state(), result.mesh.state());
  EXPECT_EQ(restored.freeze().triangles, mesh.triangles);
  const AirfoilPlace place = find_airfoil(restored.domain(), "airfoil", "file.su2");
  const Domain next = with_airfoil(restored.domain(), place, airfoil_catalogue()[5].airfoil());
  remodel(result.mesh, next, {.strategy = Strategy::chain});
  remodel(restored, next, {.strategy = Strategy::chain});
  EXPECT_EQ(restored.state(), result.mesh.state());
  EXPECT_EQ(restored.freeze().triangles, result.mesh.freeze().triangles);
}

// ---- refusals

TEST(Import, WhatIsNoMeshIsRefusedByName) {
  std::mt19937_64 random(1);
  const FrozenMesh good = test::grid(3, random);
  const auto with = [&](auto change) {
    FrozenMesh mesh = good;
    change(mesh);
    return problem(mesh);
  };
  EXPECT_EQ(with([](FrozenMesh& m) { m.triangles.clear(); }),
            "file.su2: no triangle found, at least one expected");
  EXPECT_EQ(with([](FrozenMesh& m) { m.triangles[4][1] = 16; }),
            "file.su2: triangle 4: point 16 found, an index below 16 expected");
  EXPECT_EQ(
      with([](FrozenMesh& m) { m.points[5].x = NAN; }),
      "file.su2: point 5: (nan, 1) found, coordinates that are 0 or of magnitude 1e-60 to 1e60 expected");
  EXPECT_EQ(with([](FrozenMesh& m) { m.points[5] = m.points[9]; }),
            "file.su2: points 5 and 9 coincide at (1, 2), different points expected");
  EXPECT_EQ(with([](FrozenMesh& m) {
              m.triangles[2] = {0, 1, 2};
            }),
            "file.su2: triangle 2 (points 0, 1, 2) has no area, one with an area expected");
  const std::string overlap = with([](FrozenMesh& m) {
    const auto [a, b, c] = m.triangles[3];
    std::uint32_t d = 0;  // another apex on the same side
    while (d == c || orient2d(m.points[a], m.points[b], m.points[d]) <= 0) ++d;
    m.triangles.push_back({a, b, d});
  });
  EXPECT_NE(overlap.find(" and 18 overlap: both have the edge of points "), std::string::npos) << overlap;
  EXPECT_EQ(with([](FrozenMesh& m) {
              m.boundaries.push_back({"wake", {{5, 6}}});
              m.boundaries.push_back({"other", {{6, 5}}});
            }),
            "file.su2: marker 'other': the edge of points 6 and 5 is in marker 'wake' too, one name an edge "
            "expected");
  EXPECT_EQ(with([](FrozenMesh& m) {
              m.boundaries[1].edges.push_back({0, 2});
            }),
            "file.su2: marker 'south': the edge of points 0 and 2 is no triangle's, an edge of the mesh "
            "expected");
  EXPECT_EQ(with([](FrozenMesh& m) { m.boundaries[1].edges.push_back(m.boundaries[0].edges[0]); }),
            "file.su2: marker 'south': the edge of points 3 and 7 is in marker 'rest' too, one name an edge "
            "expected");
}

// Two triangles that share a point only.
TEST(Import, BoundariesThatTouchAreChainsThatAreJoined) {
  const FrozenMesh mesh{.points = {{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}},
                        .triangles = {{0, 1, 2}, {0, 3, 4}},
                        .boundaries = {},
                        .length_scale = {},
                        .vertex_ids = {},
                        .triangle_ids = {},
                        .birth = {},
                        .curve = {},
                        .parameter = {}};
  const Mesh mesh_of_it = imported(mesh).mesh;
  EXPECT_EQ(mesh_of_it.quick_check(), "");
  ASSERT_EQ(mesh_of_it.domain().loops.size(), 4U);
  for (const Loop& loop : mesh_of_it.domain().loops) {
    EXPECT_TRUE(loop.open);
    EXPECT_EQ(loop.role, LoopRole::left);
  }
  EXPECT_EQ(mesh_of_it.freeze().triangles, mesh.triangles);
  EXPECT_EQ(check(mesh_of_it.freeze()).touching_points, 1U);
}

// Two islands that touch in a point, each of two chains, and a hole by itself, which moves.
TEST(Import, AMeshWhoseHolesTouchIsRemodelled) {
  Domain domain = test::with_holes({test::square_hole(0.75, 0.7, 0.1)});
  const auto add = [&](std::vector<Point> points) {
    Loop loop = test::loop(LoopRole::left, "island", Polyline{points}, points.size() - 1);
    loop.open = true;
    domain.loops.push_back(loop);
  };
  const Point touch{0.3, 0.3};
  for (const double side : {-0.15, 0.15}) {  // clockwise
    add({touch, touch + Point{0, side}, touch + Point{side, side}});
    add({touch + Point{side, side}, touch + Point{side, 0}, touch});
  }
  const FrozenMesh file = test::foreign(domain);
  ASSERT_EQ(check(file).touching_points, 1U);
  const Mesh start = imported(file).mesh;
  EXPECT_EQ(start.quick_check(), "");
  EXPECT_EQ(all_corners(start.freeze()), all_corners(file));
  Domain moved = start.domain();
  std::size_t closed = 0;
  for (Loop& loop : moved.loops)
    if (!loop.open && loop.role == LoopRole::hole) {
      loop.placement.position = {0.02, 0.01};
      ++closed;
    }
  ASSERT_EQ(closed, 1U);
  for (const Strategy strategy : {Strategy::chain, Strategy::morph}) {
    Mesh mesh = start;
    const RemodelResult result = remodel(mesh, moved, {.strategy = strategy});
    EXPECT_FALSE(result.regenerated) << result.reason;
    EXPECT_GT(result.connectivity_percent(), 60.0);
    EXPECT_EQ(mesh.quick_check(), "");
    const CheckResult checked = check(mesh.freeze(), {.design = &mesh.domain()});
    EXPECT_TRUE(checked.valid);
    EXPECT_EQ(checked.touching_points, 1U);
  }
}

// Without some of its triangles a mesh falls into pieces that touch in points.
TEST(Import, MeshesWithMissingTrianglesAreRemodelled) {
  std::mt19937_64 random(test::seed(45));
  std::size_t touching = 0;
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE(i);
    FrozenMesh mesh = i % 2 == 0 ? test::grid(8, random) : test::foreign_holes();
    mesh.boundaries.clear();
    std::erase_if(mesh.triangles, [&](const auto&) { return random() % 12 == 0; });
    Mesh living = imported(mesh, {.refine_angle_deg = 25.0, .max_vertices = 20000}).mesh;
    const auto fault = [&] {
      const CheckResult checked = check(living.freeze(), {.delaunay = false, .design = &living.domain()});
      touching += checked.touching_points > 0;
      return living.quick_check() + (checked.valid ? "" : checked.violations[0].detail);
    };
    EXPECT_EQ(fault(), "");
    Domain moved = living.domain();
    for (Loop& loop : moved.loops)
      if (!loop.open && loop.role == LoopRole::hole) loop.placement.position = {1e-3, 5e-4};
    EXPECT_FALSE(remodel(living, moved, {.strategy = Strategy::chain}).regenerated);
    EXPECT_EQ(fault(), "");
  }
  EXPECT_GT(touching, 30U);
}

// Each triangle is fine, each edge has one on either side, and the plane is covered twice.
TEST(Import, AMeshThatWindsOverItselfIsRefused) {
  FrozenMesh mesh = test::foreign_holes();
  const auto count = static_cast<std::uint32_t>(mesh.points.size());
  for (std::uint32_t i = 0; i < count; ++i) mesh.points.push_back(mesh.points[i] + Point{0.37, 0.21});
  const std::size_t triangles = mesh.triangles.size();
  for (std::size_t i = 0; i < triangles; ++i) {
    const auto [a, b, c] = mesh.triangles[i];
    mesh.triangles.push_back({a + count, b + count, c + count});
  }
  EXPECT_EQ(problem(mesh).substr(0, 17), "file.su2: domain:") << problem(mesh);
}

// ---- anything at all

void mutate(FrozenMesh& mesh, std::mt19937_64& random) {
  const auto any = [&](std::size_t n) { return static_cast<std::uint32_t>(random() % n); };
  const auto point = [&] { return any(mesh.points.size()); };
  const auto triangle = [&]() -> auto& {
    return mesh.triangles[any(mesh.triangles.size())];
  };
  auto& edges = mesh.boundaries[any(mesh.boundaries.size())].edges;
  switch (random() % 12) {
    case 0:
      triangle()[any(3)] = point();
      break;
    case 1:
      std::swap(triangle()[0], triangle()[1]);
      break;
    case 2:
      mesh.triangles.erase(mesh.triangles.begin() + any(mesh.triangles.size()));
      break;
    case 3:
      mesh.triangles.push_back(triangle());
      break;
    case 4:
      mesh.points[point()] = mesh.points[point()];
      break;
    case 5:
      mesh.points[point()].x += 1e-3 * (static_cast<double>(any(2001)) - 1000.0);
      break;
    case 6:
      mesh.points[point()].y *= 1.0 + 1e-9 * static_cast<double>(any(2001));
      break;
    case 7:
      mesh.points[point()].y = random() % 2 == 0 ? 1e300 : NAN;
      break;
    case 8:
      if (!edges.empty()) edges.erase(edges.begin() + any(edges.size()));
      break;
    case 9:
      edges.push_back({point(), point()});
      break;
    case 10:
      std::swap(mesh.points[point()], mesh.points[point()]);
      break;
    default:
      test::flip_at_random(mesh, 3, random);
      break;
  }
}

void check_promises(const Mesh& mesh) {
  const CheckResult checked = check(mesh.freeze(), {.min_angle_deg = mesh.options().min_angle_deg,
                                                    .max_gradation = mesh.options().max_gradation,
                                                    .delaunay = !mesh.shows_file_triangles(),
                                                    .design = &mesh.domain()});
  ASSERT_TRUE(checked.valid) << checked.violations.front().detail;
}

// What was imported can be remodelled.
void remodel_to_any(Mesh& mesh, std::mt19937_64& random) {
  const AirfoilPlace place = find_airfoil(mesh.domain(), "airfoil", "file.su2");
  const CstAirfoil airfoil = airfoil_catalogue()[random() % airfoil_catalogue().size()].airfoil();
  const RemodelResult step =
      remodel(mesh, with_airfoil(mesh.domain(), place, airfoil), {.strategy = Strategy::chain});
  if (step.stopped == Stopped::done && !step.regenerated) {
    ASSERT_EQ(mesh.quick_check(), "");
  }
}

TEST(Import, AnythingIsImportedWholeOrRefusedInOneLine) {
  const unsigned long long seed = test::seed(4);
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  const std::vector<FrozenMesh> originals{test::foreign_airfoil(16), test::foreign_holes(),
                                          test::grid(6, random)};
  std::size_t imports = 0, refusals = 0;
  for (int round = 0; round < 3000; ++round) {
    FrozenMesh mesh = originals[static_cast<std::size_t>(round) % originals.size()];
    for (std::uint64_t i = random() % 3; i < 3; ++i) mutate(mesh, random);
    try {
      ImportResult result =
          imported(mesh, {.non_delaunay = round % 2 == 0 ? NonDelaunay::keep : NonDelaunay::flip});
      ++imports;
      ASSERT_EQ(result.mesh.quick_check(), "") << round;
      if (round % 10 == 0) check_promises(result.mesh);
      if (round % 3 == 0) remodel_to_any(result.mesh, random);
    } catch (const Error& error) {
      ++refusals;
      const std::string text = error.what();
      const bool named = text.starts_with("file.su2: ") || text.starts_with("domain: ");
      ASSERT_TRUE(named && text.find('\n') == std::string::npos) << text;
    }
  }
  EXPECT_GT(imports, 300U);
  EXPECT_GT(refusals, 300U);
}

}  // namespace
}  // namespace remodel
