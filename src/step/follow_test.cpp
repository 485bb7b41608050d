// Strategy::reference.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "remodel/check.h"
#include "remodel/displacement.h"
#include "remodel/error.h"
#include "remodel/mesh_derivative.h"
#include "remodel/mesh_state.h"
#include "remodel/remodel.h"
#include "step/test_designs.h"

namespace remodel {
namespace {

using test::generated;

const RemodelOptions reference{.strategy = Strategy::reference};
constexpr int points = 100;

Domain domain_of(const CstAirfoil& airfoil) {
  return airfoil_domain(airfoil, {.points = points});
}

CstAirfoil start() {
  return airfoil_catalogue()[0].airfoil();
}

class Designs {
 public:
  Designs(std::uint64_t seed, double sigma) : random_(seed), sigma_(sigma) {}
  CstAirfoil next() {
    CstAirfoil airfoil = start();
    for (double& c : airfoil.upper) c += shift();
    for (double& c : airfoil.lower) c += shift();
    return airfoil;
  }
  double shift() { return sigma_ * (static_cast<double>(random_() >> 11) * 0x1p-52 - 1.0); }

 private:
  std::mt19937_64 random_;
  double sigma_;
};

Mesh with_slack() {
  return generated(domain_of(start()), {.gradation = 2.0, .refine_angle_deg = 32.0});
}

CheckResult checked(const Mesh& mesh, double slack_deg) {
  return check(mesh.freeze(), {.min_angle_deg = mesh.options().min_angle_deg,
                               .max_gradation = mesh.promised_gradation(),
                               .delaunay_slack_deg = slack_deg,
                               .design = &mesh.domain(),
                               .max_violations = 1});
}

void expect_valid(const Mesh& mesh) {
  EXPECT_EQ(mesh.quick_check(), "");
  EXPECT_EQ(mesh.freeze().delaunay_slack_deg, mesh.delaunay_slack_deg());
  const CheckResult result = checked(mesh, mesh.delaunay_slack_deg());
  EXPECT_TRUE(result.valid) << (result.violations.empty() ? "" : result.violations.front().detail);
}

void expect_same_mesh(const Mesh& a, const Mesh& b) {
  const FrozenMesh f = a.freeze(), g = b.freeze();
  EXPECT_EQ(f.points, g.points);
  EXPECT_EQ(f.triangles, g.triangles);
  EXPECT_EQ(f.length_scale, g.length_scale);
  EXPECT_EQ(f.vertex_keys, g.vertex_keys);
}

TEST(Reference, ADesignHasTheSameMeshWhateverCameInBetween) {
  const std::uint64_t seed = 11;
  SCOPED_TRACE(seed);
  Designs designs(seed, 0.008);
  Mesh mesh = with_slack();
  const Mesh first = mesh;
  const Domain home = domain_of(designs.next());
  ASSERT_TRUE(remodel(mesh, home, reference).held);
  const Mesh at_home = mesh;
  for (int i = 0; i < 10; ++i) {
    const RemodelResult result = remodel(mesh, domain_of(designs.next()), reference);
    EXPECT_TRUE(result.held);
    EXPECT_EQ(result.connected, result.triangles_before);
    EXPECT_EQ(result.triangles, result.triangles_before);
    expect_valid(mesh);
  }
  EXPECT_TRUE(remodel(mesh, home, reference).held);
  expect_same_mesh(mesh, at_home);
  EXPECT_TRUE(remodel(mesh, first.domain(), reference).held);
  expect_same_mesh(mesh, first);
}

TEST(Reference, AHeldMeshPassesTheCheckerWithItsSlackAndFailsWithout) {
  Designs designs(3, 0.02);
  Mesh mesh = with_slack();
  bool found = false;
  for (int i = 0; i < 20 && !found; ++i) {
    if (!remodel(mesh, domain_of(designs.next()), reference).held) continue;
    expect_valid(mesh);
    found = !checked(mesh, 20.0).delaunay;
  }
  ASSERT_TRUE(found);
  EXPECT_TRUE(checked(mesh, 20.0).valid);
  const CheckResult without = checked(mesh, 0.0);
  EXPECT_FALSE(without.valid);
  EXPECT_EQ(without.violations.front().rule, "delaunay");
  EXPECT_FALSE(checked(mesh, 1e-9).valid);
}

TEST(Reference, WithoutSlackAllMeshesAreDelaunay) {
  Designs designs(3, 0.004);
  Mesh mesh = with_slack();
  int held = 0;
  for (int i = 0; i < 12; ++i) {
    held +=
        remodel(mesh, domain_of(designs.next()), {.strategy = Strategy::reference, .delaunay_slack_deg = 0.0})
            .held;
    EXPECT_TRUE(checked(mesh, 0.0).valid);
  }
  EXPECT_GT(held, 0);
}

TEST(Reference, WhereItCannotBeHeldTheMeshOfTheDesignIsTheNewReference) {
  Mesh mesh = with_slack();
  const Domain other = test::catalogue_domain(4, points);
  const RemodelResult result = remodel(mesh, other, reference);
  EXPECT_FALSE(result.held);
  EXPECT_FALSE(mesh.held());
  EXPECT_TRUE(checked(mesh, 0.0).valid);
  const Mesh there = mesh;
  CstAirfoil near = airfoil_catalogue()[4].airfoil();
  near.upper[1] += 0.001;
  EXPECT_TRUE(remodel(mesh, domain_of(near), reference).held);
  EXPECT_TRUE(remodel(mesh, other, reference).held);
  expect_same_mesh(mesh, there);
}

TEST(Reference, OtherStrategiesStartFromTheReference) {
  Designs designs(5, 0.01);
  const Domain away = domain_of(designs.next()), far = test::catalogue_domain(6, points);
  for (const Strategy strategy : {Strategy::chain, Strategy::renew, Strategy::morph, Strategy::reference}) {
    Mesh mesh = with_slack();
    ASSERT_TRUE(remodel(mesh, away, reference).held);
    ASSERT_TRUE(remodel(mesh, mesh.domain(), reference).held || mesh.held());
    Mesh straight = mesh;
    ASSERT_TRUE(remodel(straight, with_slack().domain(), reference).held);
    const RemodelResult result = remodel(mesh, far, {.strategy = strategy});
    EXPECT_FALSE(result.held);
    EXPECT_FALSE(mesh.held());
    EXPECT_EQ(mesh.delaunay_slack_deg(), 0.0);
    EXPECT_TRUE(checked(mesh, 0.0).valid);
    remodel(straight, far, {.strategy = strategy});
    expect_same_mesh(mesh, straight);
  }
}

TEST(Reference, BackOnTheReferencesOwnDesignAnotherStrategyFindsTheReference) {
  Designs designs(5, 0.01);
  const Mesh first = with_slack();
  Mesh mesh = first;
  const Mark mark = mesh.mark();
  ASSERT_TRUE(remodel(mesh, domain_of(designs.next()), reference).held);
  const RemodelResult result = remodel(mesh, first.domain(), {.strategy = Strategy::renew});
  EXPECT_TRUE(result.full_adjustment);
  EXPECT_GT(result.moved, 100U);
  EXPECT_FALSE(mesh.held());
  expect_same_mesh(mesh, first);
  EXPECT_TRUE(mesh.changes_since(mark).moved.empty());
}

TEST(Reference, ATrialLeavesTheMeshAsItWas) {
  Designs designs(9, 0.01);
  Mesh mesh = with_slack();
  for (const bool held_before : {false, true}) {
    if (held_before) {
      ASSERT_TRUE(remodel(mesh, domain_of(designs.next()), reference).held);
    }
    const Mark mark = mesh.mark();
    const MeshState before = mesh.state();
    for (const Domain& design : {domain_of(designs.next()), test::catalogue_domain(7, points)}) {
      for (const Strategy strategy : {Strategy::reference, Strategy::renew}) {
        {
          const Trial trial(mesh, design, {.strategy = strategy});
          EXPECT_FALSE(mesh.state() == before);
        }
        EXPECT_EQ(mesh.state(), before);
        EXPECT_EQ(mesh.held(), held_before);
        EXPECT_TRUE(mesh.changes_since(mark).moved.empty());
      }
    }
  }
}

TEST(Reference, AHeldMeshFromItsStateGoesOnAsTheOneThatNeverLeftMemory) {
  Designs designs(13, 0.01);
  Mesh mesh = with_slack();
  ASSERT_TRUE(remodel(mesh, domain_of(designs.next()), reference).held);
  Mesh read = Mesh::restore(mesh.state(), "state");
  EXPECT_EQ(mesh.state(), read.state());
  expect_valid(read);
  for (const Domain& design : {domain_of(designs.next()), test::catalogue_domain(2, points)}) {
    remodel(mesh, design, reference);
    remodel(read, design, reference);
    EXPECT_EQ(mesh.state(), read.state());
  }
}

TEST(Reference, DamagedReferencesAreRefused) {
  Mesh mesh = with_slack();
  ASSERT_TRUE(remodel(mesh, domain_of(Designs(13, 0.01).next()), reference).held);
  const MeshState good = mesh.state();
  const auto refused = [&](auto damage) {
    MeshState state = good;
    damage(state);
    EXPECT_THROW(Mesh::restore(state, "state"), Error);
  };
  refused([](MeshState& s) { s.reference_coordinates.pop_back(); });
  refused([](MeshState& s) { s.reference_length_scales.clear(); });
  refused([](MeshState& s) { s.reference_domain.loops.pop_back(); });
  refused([](MeshState& s) { s.reference_domain = s.domain; });
  refused([](MeshState& s) { s.delaunay_slack_deg = 90.0; });
  refused([](MeshState& s) { s.coordinates.back() = std::nan(""); });
}

TEST(Reference, ChangesNameWhatMovedAndNothingElse) {
  Designs designs(17, 0.01);
  Mesh mesh = with_slack();
  const Mark mark = mesh.mark();
  const RemodelResult result = remodel(mesh, domain_of(designs.next()), reference);
  ASSERT_TRUE(result.held);
  const Changes changes = mesh.changes_since(mark);
  EXPECT_TRUE(changes.same_connectivity());
  EXPECT_EQ(changes.moved.size(), result.moved);
  EXPECT_GT(changes.moved.size(), static_cast<std::size_t>(points));
}

// At any held design: the mesh is linear in its walls.
TEST(Reference, TheDerivativeOfAHeldMeshIsThatOfItsWallsCarriedByTheField) {
  Designs designs(19, 0.006);
  Mesh mesh = with_slack();
  ASSERT_TRUE(remodel(mesh, domain_of(designs.next()), reference).held);
  std::vector<std::size_t> moving;
  for (std::size_t i = 0; i < mesh.domain().loops.size(); ++i)
    if (mesh.domain().loops[i].role == LoopRole::hole) moving.push_back(i);
  const MeshDerivative walls(mesh);
  const InteriorDisplacement field(mesh, moving);
  std::vector<double> direction(walls.coefficients(), 0.0);
  for (std::size_t i = 0; i < 12; ++i) direction[i] = designs.shift() / 0.006;
  const std::vector<Point> by_design = field.jvp(walls.jvp(direction));

  constexpr double h = 1e-4;
  const std::vector<double> at = coefficients_of(mesh.domain());
  const auto points_at = [&](double sign) {
    std::vector<double> there = at;
    for (std::size_t i = 0; i < there.size(); ++i) there[i] += sign * h * direction[i];
    Mesh copy = mesh;
    EXPECT_TRUE(remodel(copy, with_coefficients(mesh.domain(), there), reference).held);
    return copy.freeze().points;
  };
  const std::vector<Point> ahead = points_at(1.0), behind = points_at(-1.0);
  double size = 0.0;
  for (std::size_t i = 0; i < by_design.size(); ++i) {
    const Point difference = (0.5 / h) * (ahead[i] - behind[i]);
    EXPECT_LT(std::sqrt(squared_distance(difference, by_design[i])), 1e-9);
    size = std::max(size, dot(by_design[i], by_design[i]));
  }
  EXPECT_GT(size, 1e-4);

  std::vector<Point> by_points(field.points());
  double forward = 0.0, scale = 0.0, backward = 0.0;
  for (std::size_t i = 0; i < by_points.size(); ++i) {
    by_points[i] = {designs.shift(), designs.shift()};
    forward += dot(by_points[i], by_design[i]);
    scale += std::abs(dot(by_points[i], by_design[i]));
  }
  const std::vector<double> gradient = walls.vjp(field.vjp(by_points));
  for (std::size_t i = 0; i < gradient.size(); ++i) backward += gradient[i] * direction[i];
  EXPECT_NEAR(forward, backward, 1e-12 * scale);
}

TEST(Reference, BodiesThatMoveOneByOneAndReturnLeaveTheReference) {
  const auto bodies = [](double a, double b) {
    return test::with_holes({test::circle_hole(0.3, a, 0.08), test::circle_hole(0.7, b, 0.08)});
  };
  const Mesh first = generated(bodies(0.5, 0.5), {.refine_angle_deg = 32.0});
  Mesh mesh = first;
  for (const auto& [a, b] : {std::pair{0.505, 0.5}, {0.505, 0.495}, {0.5, 0.495}, {0.5, 0.5}}) {
    EXPECT_TRUE(remodel(mesh, bodies(a, b), reference).held);
    expect_valid(mesh);
  }
  expect_same_mesh(mesh, first);
}

TEST(Reference, RefusesSlacksBeyondSixtyDegrees) {
  Mesh mesh = with_slack();
  const Domain design = domain_of(Designs(1, 0.01).next());
  for (const double slack : {-1.0, 61.0, std::nan("")})
    EXPECT_THROW(remodel(mesh, design, {.strategy = Strategy::reference, .delaunay_slack_deg = slack}),
                 Error);
}

}  // namespace
}  // namespace remodel
