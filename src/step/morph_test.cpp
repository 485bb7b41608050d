#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "mesh/mesh_data.h"
#include "remodel/check.h"
#include "remodel/displacement.h"
#include "remodel/error.h"
#include "remodel/import.h"
#include "remodel/remodel.h"
#include "step/test_designs.h"

namespace remodel {
namespace {

using test::catalogue_domain;
using test::generated;

const RemodelOptions morph{.strategy = Strategy::morph};

void expect_valid(const Mesh& mesh, const Domain& design) {
  EXPECT_EQ(mesh.quick_check(), "");
  const CheckResult result = check(mesh.freeze(), {.min_angle_deg = mesh.options().min_angle_deg,
                                                   .max_gradation = mesh.promised_gradation(),
                                                   .design = &design,
                                                   .max_violations = 1});
  EXPECT_TRUE(result.valid) << (result.violations.empty() ? "" : result.violations.front().detail);
}

std::vector<std::array<std::uint32_t, 3>> joined(const Mesh& mesh) {
  std::vector<std::array<std::uint32_t, 3>> result;
  mesh.data().triangulation.for_each_domain_triangle([&](TriangleId, const Triangle& t) {
    std::array<std::uint32_t, 3> ids{t.vertex[0].index, t.vertex[1].index, t.vertex[2].index};
    std::rotate(ids.begin(), std::min_element(ids.begin(), ids.end()), ids.end());
    result.push_back(ids);
  });
  std::sort(result.begin(), result.end());
  return result;
}

TEST(Morph, EveryPairOfTheCatalogueIsValidAndKeepsMostOfItsConnectivity) {
  const std::size_t count = airfoil_catalogue().size();
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t j = (i + 1) % count;
    Mesh mesh = generated(catalogue_domain(i, 100), {.gradation = 2.0});
    const auto before = joined(mesh);
    const RemodelResult result = remodel(mesh, catalogue_domain(j, 100), morph);
    expect_valid(mesh, catalogue_domain(j, 100));
    EXPECT_TRUE(result.morphed);
    std::vector<std::array<std::uint32_t, 3>> common;
    std::ranges::set_intersection(before, joined(mesh), std::back_inserter(common));
    EXPECT_EQ(result.connected, common.size());
    EXPECT_EQ(result.triangles_before, result.connected + result.gone());
    EXPECT_EQ(result.triangles, result.connected + result.born());
    EXPECT_GE(result.connected, result.preserved);
    sum += result.connectivity_percent();
  }
  EXPECT_GT(sum / static_cast<double>(count), 95.0);
}

// Small steps, but too large for the boundary alone, leave most of the interior where it is.
TEST(Morph, SmallStepsKeepConnectivityAndMostPlaces) {
  const std::uint64_t seed = 7;
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  test::Walk walk(0, 0.01, random);
  Mesh mesh = generated(walk.domain(100), {.gradation = 2.0});
  int morphs = 0, whole = 0;
  double preserved = 0.0;
  for (int step = 0; step < 40; ++step) {
    walk.next();
    const RemodelResult result = remodel(mesh, walk.domain(100), morph);
    if (!result.morphed) continue;
    ++morphs;
    whole += result.born() == 0 ? 1 : 0;
    preserved += result.preserved_percent();
  }
  ASSERT_GT(morphs, 5);
  EXPECT_GT(whole, 8 * morphs / 10);
  EXPECT_GT(preserved, 50.0 * morphs);
}

TEST(Morph, WalksStayValidAndRepeatToTheLastBit) {
  const std::uint64_t seed = 20'250;
  SCOPED_TRACE(seed);
  const auto walk_of = [&](bool checking) {
    std::mt19937_64 random(seed);
    test::Walk walk(0, 0.01, random);
    Mesh mesh = generated(walk.domain(60), {.gradation = 1.2});
    for (int step = 0; step < 30; ++step) {
      walk.next();
      const RemodelResult result = remodel(mesh, walk.domain(60), morph);
      EXPECT_FALSE(result.regenerated);
      if (checking) expect_valid(mesh, walk.domain(60));
    }
    return mesh;
  };
  EXPECT_EQ(walk_of(true).state(), walk_of(false).state());
}

TEST(Morph, AMeshFromItsStateGoesOnAsTheOneThatNeverLeftMemory) {
  Mesh mesh = generated(catalogue_domain(0, 60), {.gradation = 1.2});
  remodel(mesh, catalogue_domain(1, 60), morph);
  Mesh read = Mesh::restore(mesh.state(), "state");
  remodel(mesh, catalogue_domain(2, 60), morph);
  remodel(read, catalogue_domain(2, 60), morph);
  EXPECT_EQ(mesh.state(), read.state());
}

TEST(Morph, ATrialLeavesTheMeshAsItWas) {
  Mesh mesh = generated(catalogue_domain(0, 60), {.gradation = 1.2});
  const MeshState before = mesh.state();
  const Mark mark = mesh.mark();
  {
    const Trial trial(mesh, catalogue_domain(3, 60), morph);
    EXPECT_TRUE(trial.result().morphed);
    EXPECT_FALSE(mesh.state() == before);
  }
  EXPECT_EQ(mesh.state(), before);
  EXPECT_TRUE(mesh.changes_since(mark).moved.empty());
}

TEST(Morph, ChangesNameTheVerticesThatMoved) {
  Mesh mesh = generated(catalogue_domain(0, 60), {.gradation = 1.2});
  const Mark mark = mesh.mark();
  const RemodelResult result = remodel(mesh, catalogue_domain(4, 60), morph);
  const Changes changes = mesh.changes_since(mark);
  EXPECT_EQ(changes.inserted.size(), result.inserted);
  EXPECT_GT(changes.moved.size(), 60U);  // the interior too
  EXPECT_GE(changes.gone.size(), result.gone());
}

TEST(Morph, ASquareTurnedByFortyDegreesInASquareStaysValid) {
  const auto turned = [](double degrees) {
    const double angle = degrees * std::numbers::pi / 180.0;
    std::vector<Point> corners;
    for (const auto& [x, y] : {Point{-0.1, -0.1}, {0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}})
      corners.push_back(
          {0.5 + x * std::cos(angle) - y * std::sin(angle), 0.5 + x * std::sin(angle) + y * std::cos(angle)});
    return test::with_holes({test::polygon(LoopRole::hole, "hole", corners, 8)});
  };
  Mesh mesh = generated(turned(0.0), {});
  for (const double degrees : {40.0, 0.0, -20.0}) {
    remodel(mesh, turned(degrees), morph);
    expect_valid(mesh, turned(degrees));
  }
}

TEST(Morph, BodiesThatMoveApartAndTogetherStayApart) {
  const auto bodies = [](double y) {
    return test::with_holes({test::circle_hole(0.35, y, 0.08), test::circle_hole(0.65, 1.0 - y, 0.08)});
  };
  Mesh mesh = generated(bodies(0.5), {});
  for (const double y : {0.56, 0.44, 0.6, 0.5}) {
    const double triangles = static_cast<double>(mesh.triangle_count());
    const RemodelResult result = remodel(mesh, bodies(y), morph);
    const bool had_surplus = triangles > 1.1 * static_cast<double>(generated(bodies(y), {}).triangle_count());
    EXPECT_TRUE(result.morphed || had_surplus);
    expect_valid(mesh, bodies(y));
  }
}

// ---- the displacement

// Nothing renews their length scales: what one morph adds where it stretches, the next does not leave behind.
TEST(Morph, ImportedMeshesDoNotGrow) {
  const FrozenMesh all = generated(catalogue_domain(0, 100), {.gradation = 2.0}).freeze();
  FrozenMesh file;
  file.points = all.points, file.triangles = all.triangles, file.boundaries = all.boundaries;
  const Mesh start = import_mesh(file, "file").mesh;
  const AirfoilPlace place = find_airfoil(start.domain(), "airfoil", "file");
  for (const Strategy strategy : {Strategy::morph, Strategy::reference}) {
    Mesh mesh = start;
    std::size_t most = 0;
    for (std::size_t step = 1; step <= 60; ++step) {
      const CstAirfoil next = airfoil_catalogue()[step % airfoil_catalogue().size()].airfoil();
      remodel(mesh, with_airfoil(start.domain(), place, next), {.strategy = strategy});
      ASSERT_EQ(mesh.quick_check(), "");
      most = std::max(most, mesh.triangle_count());
    }
    EXPECT_LT(most, 2 * start.triangle_count()) << name_of(strategy);
  }
}

class Displacement : public testing::Test {
 protected:
  Displacement() : mesh_(generated(catalogue_domain(0, 60), {.gradation = 1.2})), frozen_(mesh_.freeze()) {
    for (std::size_t i = 0; i < mesh_.domain().loops.size(); ++i)
      if (mesh_.domain().loops[i].role == LoopRole::hole) moving_.push_back(i);
  }
  // Whether a point is on a wall that moves: the far field does not come this near.
  bool moves(std::size_t i) const {
    return frozen_.curve[i] >= 0 && std::abs(frozen_.points[i].x) + std::abs(frozen_.points[i].y) < 2.0;
  }
  double random() { return static_cast<double>(random_() >> 11) * 0x1p-53 - 0.5; }

  Mesh mesh_;
  FrozenMesh frozen_;
  std::vector<std::size_t> moving_;
  std::mt19937_64 random_{7};
};

TEST_F(Displacement, IsTheWallsOwnAtWallsAndZeroFarAway) {
  const InteriorDisplacement field(mesh_, moving_);
  ASSERT_EQ(field.points(), frozen_.points.size());
  std::vector<Point> walls(field.points());
  for (std::size_t i = 0; i < walls.size(); ++i)
    if (moves(i)) walls[i] = {random(), random()};
  const std::vector<Point> all = field.jvp(walls);
  std::size_t moved = 0;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const bool far = std::abs(frozen_.points[i].x) + std::abs(frozen_.points[i].y) > 5.0;
    if (frozen_.curve[i] >= 0) {
      EXPECT_EQ(all[i], walls[i]);
    } else if (far) {
      EXPECT_EQ(all[i], Point{});
    }
    if (frozen_.curve[i] < 0 && !(all[i] == Point{})) ++moved;
  }
  EXPECT_GT(moved, 100U);
}

TEST_F(Displacement, TurnsAndScalesWhatIsAtAWallThatIsTurnedAndScaled) {
  const InteriorDisplacement field(mesh_, moving_);
  std::vector<Point> walls(field.points());
  const auto similar = [](Point p) { return Point{0.1 - 0.02 * p.x - 0.3 * p.y, 0.3 * p.x - 0.02 * p.y}; };
  for (std::size_t i = 0; i < walls.size(); ++i)
    if (moves(i)) walls[i] = similar(frozen_.points[i]);
  const std::vector<Point> all = field.jvp(walls);
  std::size_t near = 0;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const Point p = frozen_.points[i];
    if (frozen_.curve[i] >= 0 || p.x < 0.0 || p.x > 1.0 || std::abs(p.y) > 0.1) continue;
    ++near;
    EXPECT_LT(std::sqrt(squared_distance(all[i], similar(p))), 0.02);
  }
  EXPECT_GT(near, 20U);
}

TEST_F(Displacement, VjpIsTheTransposeOfJvp) {
  const InteriorDisplacement field(mesh_, moving_);
  std::vector<Point> walls(field.points()), by_points(field.points());
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (moves(i)) walls[i] = {random(), random()};
    by_points[i] = {random(), random()};
  }
  const std::vector<Point> all = field.jvp(walls), by_walls = field.vjp(by_points);
  double forward = 0.0, backward = 0.0, size = 0.0;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    forward += dot(all[i], by_points[i]);
    backward += dot(walls[i], by_walls[i]);
    size += std::abs(dot(all[i], by_points[i]));
    if (frozen_.curve[i] < 0) {
      EXPECT_EQ(by_walls[i], Point{});
    }
  }
  EXPECT_NEAR(forward, backward, 1e-12 * size);
}

TEST_F(Displacement, OfTheFrozenMeshIsThatOfTheLivingOne) {
  std::vector<std::string> names;
  for (const FrozenBoundary& boundary : frozen_.boundaries)
    if (boundary.name != "farfield") names.push_back(boundary.name);
  const InteriorDisplacement living(mesh_, moving_), frozen(frozen_, names);
  std::vector<Point> walls(living.points());
  for (std::size_t i = 0; i < walls.size(); ++i)
    if (moves(i)) walls[i] = {random(), random()};
  const std::vector<Point> a = living.jvp(walls), b = frozen.jvp(walls);
  // Loops begin elsewhere, and so do the halves that are taken together from far away.
  for (std::size_t i = 0; i < walls.size(); ++i) EXPECT_LT(squared_distance(a[i], b[i]), 1e-4) << i;
  EXPECT_THROW(InteriorDisplacement(frozen_, std::vector<std::string>{"nobody"}), Error);
}

TEST_F(Displacement, RefusesOtherSizesAndLoopsThatThereAreNot) {
  const InteriorDisplacement field(mesh_, moving_);
  EXPECT_THROW(field.jvp(std::vector<Point>(3)), Error);
  EXPECT_THROW(field.vjp(std::vector<Point>(3)), Error);
  EXPECT_THROW(InteriorDisplacement(mesh_, std::vector<std::size_t>{99}), Error);
}

}  // namespace
}  // namespace remodel
