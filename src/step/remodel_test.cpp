#include "remodel/remodel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <tuple>

#include "mesh/mesh_data.h"
#include "remodel/check.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "step/test_designs.h"
#include "support.h"

namespace remodel {
namespace {

using test::catalogue_domain;

Mesh generated(const Domain& domain, double gradation = 4.0) {
  Mesh mesh = test::generated(domain, {.gradation = gradation});
  EXPECT_EQ(mesh.quick_check(), "");
  return mesh;
}

// The slow and independent check, with the design.
std::string full_check(const Mesh& mesh, double angle = 30.0) {
  const CheckResult result = check(mesh.freeze(), {.min_angle_deg = angle,
                                                   .max_gradation = mesh.options().max_gradation,
                                                   .design = &mesh.domain(),
                                                   .max_violations = 1});
  if (result.valid) return {};
  return result.violations.empty() ? "not valid"
                                   : result.violations[0].rule + ": " + result.violations[0].detail;
}

CstAirfoil scaled(CstAirfoil airfoil, double factor) {
  for (std::vector<double>* surface : {&airfoil.upper, &airfoil.lower})
    for (double& c : *surface) c *= factor;
  return airfoil;
}

// A triangle as who looks at the frozen view sees it: ids and places of its vertices.
using Seen = std::array<std::tuple<std::uint32_t, double, double>, 3>;
std::multiset<Seen> seen(const FrozenMesh& mesh) {
  std::multiset<Seen> result;
  for (const auto& triangle : mesh.triangles) {
    Seen one;
    for (std::size_t k = 0; k < 3; ++k)
      one[k] = {mesh.vertex_ids[triangle[k]], mesh.points[triangle[k]].x, mesh.points[triangle[k]].y};
    std::sort(one.begin(), one.end());
    result.insert(one);
  }
  return result;
}

std::size_t preserved_by_brute_force(const FrozenMesh& before, const FrozenMesh& after) {
  const std::multiset<Seen> old = seen(before), now = seen(after);
  std::vector<Seen> common;
  std::set_intersection(old.begin(), old.end(), now.begin(), now.end(), std::back_inserter(common));
  return common.size();
}

// What a mesh without small input angles keeps besides what quick_check() sees; empty if it does. No vertex
// is outside of the domain; the length scale of a boundary vertex is what its curve and its factor give; no
// segment is encroached.
std::string unkept(const MeshData& data) {
  const Triangulation& t = data.triangulation;
  for (std::uint32_t i = 0; i < t.triangle_slots(); ++i) {
    const Triangle& triangle = t[TriangleId{i}];
    if (!triangle.alive() || triangle.region != Region::domain) continue;
    for (int k = 0; k < 3; ++k) {
      const Point apex = t.point(triangle.vertex[k]);
      if (triangle.link[k].constrained() &&
          dot(t.point(triangle.vertex[next3(k)]) - apex, t.point(triangle.vertex[previous3(k)]) - apex) < 0.0)
        return "triangle " + std::to_string(i) + " encroaches upon its segment";
    }
  }
  std::size_t boundary = 0;
  for (const std::uint32_t head : data.loop_heads) {
    std::uint32_t k = head;
    do {
      const double expected = data.base_length_scale(k) * data.at(k).scale_factor;
      if (std::abs(data.length_scale(k) - expected) > 1e-9 * expected)
        return "boundary vertex " + std::to_string(k) + " has a length scale of " +
               std::to_string(data.length_scale(k)) + ", not " + std::to_string(expected);
      if (t[data.at(k).vertex].boundary == k) ++boundary;  // joints have several entries
      k = data.at(k).next;
    } while (k != head && k != no_index);
  }
  std::size_t inner = 0;
  for (std::uint32_t v = 1; v < t.vertex_slots(); ++v) {
    if (!t[VertexId{v}].alive() || t[VertexId{v}].boundary != no_index) continue;
    if (t[t.star(VertexId{v}).triangle].region != Region::domain)
      return "vertex " + std::to_string(v) + " is outside of the domain";
    ++inner;
  }
  return boundary + inner == t.vertex_count() ? "" : "there are other vertices";
}

// Remodels by the paper's method, and checks all that must hold after any step.
RemodelResult step(Mesh& mesh, const Domain& domain, RemodelOptions options = {}) {
  options.strategy = Strategy::chain;
  const FrozenMesh before = mesh.freeze();
  const std::uint32_t steps = mesh.step();
  const RemodelResult result = remodel(mesh, domain, options);
  EXPECT_EQ(mesh.quick_check(), "");
  EXPECT_EQ(unkept(mesh.data()), "");
  EXPECT_EQ(result.stopped, Stopped::done);
  EXPECT_EQ(mesh.domain(), domain);
  EXPECT_LE(mesh.step(), steps + 1);
  EXPECT_EQ(result.triangles_before, before.triangles.size());
  EXPECT_EQ(result.triangles, mesh.triangle_count());
  const FrozenMesh after = mesh.freeze();
  EXPECT_EQ(result.triangles, after.triangles.size());
  EXPECT_EQ(result.regenerated, !result.reason.empty());
  if (!result.regenerated) {
    EXPECT_EQ(result.preserved, preserved_by_brute_force(before, after));
  }
  return result;
}

// ---- the specialised method

TEST(Remodel, ToTheSameDesignChangesNothing) {
  for (const Method method : {Method::automatic, Method::specialised, Method::general}) {
    Mesh mesh = generated(catalogue_domain(2, 100));
    const MeshState before = mesh.state();
    const RemodelResult result =
        remodel(mesh, catalogue_domain(2, 100), {.method = method, .strategy = Strategy::chain});
    EXPECT_TRUE(mesh.state() == before);
    EXPECT_TRUE(result.full_adjustment);
    EXPECT_EQ(result.preserved, mesh.triangle_count());
    EXPECT_EQ(result.moved + result.inserted + result.removed, 0U);
  }
}

TEST(Remodel, ThereAndBackIsValidAndAboutAsLarge) {
  for (const Method method : {Method::specialised, Method::general})
    for (std::size_t a = 0; a < airfoil_catalogue().size(); ++a) {
      SCOPED_TRACE(airfoil_catalogue()[a].name);
      Mesh mesh = generated(catalogue_domain(a, 50));
      const std::size_t fresh = mesh.triangle_count();
      for (int round = 0; round < 5; ++round) {
        step(mesh, catalogue_domain((a + 3) % 10, 50), {.method = method});
        step(mesh, catalogue_domain(a, 50), {.method = method});
      }
      EXPECT_EQ(full_check(mesh), "");
      EXPECT_LT(static_cast<double>(mesh.triangle_count()), 1.6 * static_cast<double>(fresh));
      EXPECT_GT(static_cast<double>(mesh.triangle_count()), 0.6 * static_cast<double>(fresh));
    }
}

TEST(FullAdjustment, LeavesConnectivityByteIdentical) {
  int full = 0;
  for (std::size_t a = 0; a < airfoil_catalogue().size(); ++a)
    for (const int points : {50, 200}) {
      const CstAirfoil airfoil = airfoil_catalogue()[a].airfoil();
      Mesh mesh = generated(airfoil_domain(airfoil, {.points = points}));
      const MeshState before = mesh.state();
      const FrozenMesh old = mesh.freeze();
      const RemodelResult result = step(mesh, airfoil_domain(scaled(airfoil, 1.00001), {.points = points}));
      if (!result.full_adjustment) continue;
      ++full;
      const MeshState after = mesh.state();
      EXPECT_EQ(after.triangle_vertices, before.triangle_vertices);
      EXPECT_EQ(after.triangle_links, before.triangle_links);
      EXPECT_EQ(after.triangle_regions, before.triangle_regions);
      EXPECT_EQ(after.vertex_stars, before.vertex_stars);
      EXPECT_EQ(after.vertex_generations, before.vertex_generations);
      EXPECT_EQ(result.inserted + result.removed, 0U);
      const FrozenMesh now = mesh.freeze();
      std::size_t touched = 0, born = 0, moved = 0;
      for (std::size_t p = 0; p < now.points.size(); ++p) moved += now.points[p] == old.points[p] ? 0 : 1;
      for (std::size_t t = 0; t < now.triangles.size(); ++t) {
        const auto& v = now.triangles[t];
        if (std::any_of(v.begin(), v.end(),
                        [&](std::uint32_t p) { return !(now.points[p] == old.points[p]); }))
          ++touched;
        if (now.birth[t] == mesh.step()) ++born;
      }
      EXPECT_EQ(result.preserved, result.triangles_before - touched);
      EXPECT_EQ(result.moved, moved);
      EXPECT_EQ(born, touched);
    }
  EXPECT_GE(full, 15) << "of 20 tiny changes";
}

// Paper, section 4.2: the trailing and leading edges never move.
TEST(FullAdjustment, OfAThousandthIsTheRule) {
  int full = 0, steps = 0;
  for (std::size_t a = 0; a < airfoil_catalogue().size(); ++a) {
    CstAirfoil airfoil = airfoil_catalogue()[a].airfoil();
    Mesh mesh = generated(airfoil_domain(airfoil, {.points = 50}));
    for (int k = 0; k < 10; ++k, ++steps) {
      airfoil = scaled(airfoil, 1.001);
      full += step(mesh, airfoil_domain(airfoil, {.points = 50})).full_adjustment ? 1 : 0;
    }
  }
  EXPECT_GE(full, steps * 8 / 10);
}

TEST(PartialSteps, KeepTheIdsAndPlacesOfWhatSurvives) {
  Mesh mesh = generated(catalogue_domain(0, 100));
  for (const std::size_t to : {1U, 7U, 3U, 9U, 0U}) {
    const MeshState before = mesh.state();
    const RemodelResult result = step(mesh, catalogue_domain(to, 100));
    ASSERT_FALSE(result.full_adjustment);
    const MeshState after = mesh.state();
    std::size_t same_vertices = 0;
    for (std::size_t v = 1; v < before.vertex_stars.size(); ++v) {
      if (before.vertex_stars[v] == no_index || before.vertex_curves[v] >= 0) continue;
      if (before.vertex_generations[v] != after.vertex_generations[v]) continue;
      EXPECT_TRUE(after.vertex_stars[v] == no_index ||
                  (before.coordinates[2 * v] == after.coordinates[2 * v] &&
                   before.coordinates[2 * v + 1] == after.coordinates[2 * v + 1]))
          << "interior vertex " << v << " has moved";
      ++same_vertices;
    }
    EXPECT_GT(same_vertices, 100U);
    for (std::size_t t = 0; t < before.triangle_births.size(); ++t) {  // an old birth is an old triangle
      if (after.triangle_vertices[3 * t] == no_index || after.triangle_births[t] == mesh.step()) continue;
      ASSERT_EQ(after.triangle_births[t], before.triangle_births[t]);
      for (std::size_t k = 3 * t; k < 3 * t + 3; ++k)
        ASSERT_EQ(after.triangle_vertices[k], before.triangle_vertices[k]) << "triangle " << t;
      for (std::size_t k = 3 * t; k < 3 * t + 3; ++k)  // at its old place
        for (const std::size_t c : {0, 1}) {
          const std::size_t coordinate = 2 * std::size_t{before.triangle_vertices[k]} + c;
          ASSERT_EQ(after.coordinates[coordinate], before.coordinates[coordinate]) << "triangle " << t;
        }
    }
  }
}

TEST(PartialSteps, KeepTheBoundaryVerticesThatCanBeRelocated) {
  CstAirfoil airfoil = airfoil_catalogue()[0].airfoil();
  Mesh mesh = generated(airfoil_domain(airfoil, {.points = 100}));
  for (const double factor : {1.05, 1.0 / 1.05, 0.93, 1.1}) {
    const MeshState before = mesh.state();
    airfoil = scaled(airfoil, factor);
    ASSERT_FALSE(step(mesh, airfoil_domain(airfoil, {.points = 100})).full_adjustment);
    const MeshState after = mesh.state();
    std::size_t boundary = 0, kept = 0;
    for (std::size_t v = 1; v < before.vertex_stars.size(); ++v) {
      if (before.vertex_stars[v] == no_index || before.vertex_curves[v] < 0) continue;
      ++boundary;
      kept +=
          after.vertex_stars[v] != no_index && before.vertex_generations[v] == after.vertex_generations[v];
    }
    EXPECT_GT(10 * kept, 9 * boundary) << kept << " of " << boundary;
  }
}

TEST(PartialSteps, NeverGiveAnIdOutTwiceWithinOneStep) {
  Mesh mesh = generated(catalogue_domain(0, 50));
  for (std::size_t to = 1; to < 40; ++to) {
    const MeshState before = mesh.state();
    step(mesh, catalogue_domain(to % 10, 50), {.method = to % 3 == 0 ? Method::general : Method::automatic});
    const MeshState after = mesh.state();
    for (std::size_t v = 0; v < before.vertex_generations.size(); ++v) {
      const std::uint32_t given_out = after.vertex_generations[v] - before.vertex_generations[v];
      ASSERT_LE(given_out, before.vertex_stars[v] == no_index ? 1U : 0U) << "vertex " << v << ", step " << to;
    }
  }
}

TEST(EveryPairOfTheCatalogue, RemodelsByBothMethods) {
  std::map<std::string, int> reasons;
  for (const Method method : {Method::specialised, Method::general})
    for (std::size_t a = 0; a < airfoil_catalogue().size(); ++a) {
      const Mesh start = generated(catalogue_domain(a, 50));
      for (std::size_t b = 0; b < airfoil_catalogue().size(); ++b) {
        SCOPED_TRACE(std::string(airfoil_catalogue()[a].name) + " to " +
                     std::string(airfoil_catalogue()[b].name) + ", " + name_of(method));
        Mesh mesh = start;
        const RemodelResult result = step(mesh, catalogue_domain(b, 50), {.method = method});
        if (result.regenerated) ++reasons[result.reason];
        EXPECT_EQ(result.method, a == b ? Method::specialised : method);
        if ((a + b) % 4 != 0) continue;
        EXPECT_EQ(full_check(mesh), "");
      }
    }
  for (const auto& [reason, count] : reasons) ADD_FAILURE() << count << " were generated afresh: " << reason;
}

TEST(Distance, OfRemovalNeverMakesAStepInvalidAndLargerOnesPreserveLess) {
  std::size_t preserved[4] = {};
  for (std::size_t a = 0; a < airfoil_catalogue().size(); ++a) {
    const Mesh start = generated(catalogue_domain(a, 100));
    std::size_t i = 0;
    for (const double distance : {0.0, 1.0, 4.0, 20.0}) {
      Mesh mesh = start;
      preserved[i++] += step(mesh, catalogue_domain((a + 1) % 10, 100), {.distance = distance}).preserved;
    }
  }
  EXPECT_LE(preserved[1], preserved[0] * 101 / 100);
  EXPECT_LT(preserved[2], preserved[1]);
  EXPECT_LT(preserved[3], preserved[2]);
}

TEST(RefusedDesigns, LeaveTheMeshIdentical) {
  Mesh mesh = generated(catalogue_domain(4, 50));
  const MeshState before = mesh.state();
  const auto refuse = [&](const Domain& domain, RemodelOptions options, ErrorCode expected) {
    try {
      remodel(mesh, domain, options);
      ADD_FAILURE() << "was not refused";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), expected) << error.what();
    }
    EXPECT_TRUE(mesh.state() == before);
  };
  CstAirfoil crossing = airfoil_catalogue()[4].airfoil();
  crossing.upper.back() = -1.0;
  CstAirfoil swapped = airfoil_catalogue()[4].airfoil();
  swapped.upper.swap(swapped.lower);
  for (const Method method : {Method::automatic, Method::specialised, Method::general}) {
    refuse(airfoil_domain(crossing, {.points = 50}), {.method = method}, ErrorCode::geometry);
    refuse(airfoil_domain(swapped, {.points = 50}), {.method = method}, ErrorCode::geometry);
  }
  refuse(catalogue_domain(1, 60), {.method = Method::specialised}, ErrorCode::argument);
  refuse(catalogue_domain(1, 50), {.distance = -1.0}, ErrorCode::argument);
  refuse(catalogue_domain(1, 50), {.distance = std::nan("")}, ErrorCode::argument);
  refuse(Domain{}, {}, ErrorCode::geometry);
  Domain bad = catalogue_domain(4, 50);
  std::get<Arc>(bad.loops[1].curves[0].shape).radius = 0.6;
  std::get<Arc>(bad.loops[1].curves[0].shape).centre = {3.0, 0.0};
  for (const double distance : {0.0, 0.3, 1.0}) refuse(bad, {.distance = distance}, ErrorCode::geometry);
  EXPECT_EQ(step(mesh, catalogue_domain(5, 50)).stopped, Stopped::done);
}

// ---- long walks

struct WalkCase {
  double sigma;
  int points;
};
class RandomWalk : public testing::TestWithParam<WalkCase> {};

TEST_P(RandomWalk, OfThreeHundredStepsIsValidAtEveryStep) {
  const unsigned long long seed = test::seed(7);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  test::Walk walk(random() % 10, GetParam().sigma, random);
  Mesh mesh = generated(walk.domain(GetParam().points));
  int regenerated = 0;
  for (int i = 0; i < 300 && !HasFailure(); ++i) {
    SCOPED_TRACE("step " + std::to_string(i));
    walk.next();
    const RemodelResult result = step(mesh, walk.domain(GetParam().points));
    if (result.regenerated && ++regenerated) std::printf("step %d: %s\n", i, result.reason.c_str());
    if (i % 30 != 0) continue;
    ASSERT_EQ(full_check(mesh), "");
  }
  EXPECT_LE(regenerated, 3);
  std::size_t fresh = generated(walk.domain(GetParam().points)).triangle_count();
  EXPECT_LT(mesh.triangle_count(), 2 * fresh);
}

INSTANTIATE_TEST_SUITE_P(Sigma, RandomWalk,
                         testing::Values(WalkCase{0.01, 50}, WalkCase{0.05, 50}, WalkCase{0.25, 50},
                                         WalkCase{0.01, 100}, WalkCase{0.05, 100}, WalkCase{0.25, 100}));

// Coarse and fine boundaries, small and large steps, airfoils and polygons: about two in five steps are
// partial adjustments, and what they leave in the holes comes into the domain at a later step.
TEST(RandomWalks, OfManyKindsAreValidAtEveryStep) {
  const auto seed = test::seed(1);
  SCOPED_TRACE("seed " + std::to_string(seed));
  int steps = 0, partial = 0, regenerated = 0;
  for (unsigned long long round = 0; round < 300; ++round) {
    std::mt19937_64 random(seed + round);
    const auto uniform = [&](double low, double high) { return test::uniform(random, low, high); };
    const int points = std::array{8, 20, 50, 100}[random() % 4];
    const double sigma = std::array{0.02, 0.1, 0.3, 1.0}[random() % 4];
    test::Walk walk(random() % 10, sigma, random);
    const auto design = [&] {
      if (round % 3 == 0) {
        walk.next();
        return walk.domain(points);
      }
      const double x = uniform(0.35, 0.65), y = uniform(0.35, 0.65), size = uniform(0.1, 0.3);
      return test::with_holes(
          {round % 3 == 1 ? test::star_hole(x, y, size) : test::square_hole(x, y, size, 3)});
    };
    const double gradation = std::array{1.0, 4.0, 20.0}[random() % 3];
    Mesh mesh = generated(design(), gradation);
    for (int k = 0; k < 10; ++k, ++steps) {
      const double distance = std::array{0.0, 1.0}[random() % 2];
      const RemodelResult result =
          remodel(mesh, design(), {.distance = distance, .strategy = Strategy::chain});
      ASSERT_EQ(mesh.quick_check(), "") << "round " << round << ", step " << k;
      regenerated += result.regenerated ? 1 : 0;
      partial += !result.full_adjustment && result.moved > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(partial, steps / 5);
  EXPECT_LT(regenerated, steps / 100);
}

// Few stations, so that refinement splits edges; loops on both sides of a hole, and next to each other
// outside. Any of them move, little or much.
TEST(RandomWalks, OfOuterBoundariesAndIslandsAreValidAtEveryStep) {
  const auto seed = test::seed(5);
  SCOPED_TRACE("seed " + std::to_string(seed));
  int partial = 0, regenerated = 0, steps = 0;
  for (unsigned long long round = 0; round < 120; ++round) {
    std::mt19937_64 random(seed + round);
    const auto uniform = [&](double low, double high) { return test::uniform(random, low, high); };
    std::vector<std::vector<Point>> corners = {{{0, 0}, {10, 0}, {11, 9}, {1, 10}},
                                               {{3, 3}, {7, 3}, {7, 7}, {3, 7}},
                                               {{4.3, 4.3}, {5.7, 4.3}, {5, 5.9}},
                                               {{14, 1}, {19, 4}, {14, 8}}};
    const std::size_t pieces = 1 + random() % 3;
    const auto domain = [&] {
      const LoopRole roles[] = {LoopRole::outer, LoopRole::hole, LoopRole::outer, LoopRole::outer};
      Domain result;
      for (std::size_t i = 0; i < corners.size(); ++i)
        result.loops.push_back(test::polygon(roles[i], "loop" + std::to_string(i), corners[i], pieces));
      return result;
    };
    Mesh mesh = generated(domain(), std::array{1.0, 4.0}[random() % 2]);
    const RemodelOptions options{.distance = std::array{0.0, 0.3, 1.0}[random() % 3],
                                 .strategy = random() % 2 == 0 ? Strategy::chain : Strategy::renew};
    for (int k = 0; k < 12; ++k, ++steps) {
      const double size = std::array{0.001, 0.05, 0.4}[random() % 3];
      for (std::vector<Point>& loop : corners)
        if (random() % 2 == 0)
          for (Point& p : loop) p = p + Point{uniform(-size, size), uniform(-size, size)};
      RemodelResult result;
      try {
        result = remodel(mesh, domain(), options);
      } catch (const Error&) {  // loops cross or touch by now
        EXPECT_THROW(generate(domain(), {}), Error);
        break;
      }
      ASSERT_EQ(mesh.quick_check(), "") << "round " << round << ", step " << k;
      regenerated += result.regenerated ? 1 : 0;
      partial += !result.full_adjustment && result.moved > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(steps, 400);
  EXPECT_GT(partial, steps / 3);
  EXPECT_LT(regenerated, steps / 50);
}

TEST(AMeshThatWasSaved, GoesOnToTheSameStateAsOneThatNeverLeftMemory) {
  const unsigned long long seed = test::seed(3);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  test::Walk walk(1, 0.03, random);
  Mesh mesh = generated(walk.domain(50)), saved = mesh;
  for (int i = 0; i < 50; ++i) {
    walk.next();
    const Method method = i % 5 == 4 ? Method::general : Method::automatic;
    const RemodelResult a = remodel(mesh, walk.domain(50), {.method = method, .strategy = Strategy::chain});
    saved = Mesh::restore(saved.state(), "saved");
    const RemodelResult b = remodel(saved, walk.domain(50), {.method = method, .strategy = Strategy::chain});
    EXPECT_EQ(a.preserved, b.preserved);
    EXPECT_EQ(a.full_adjustment, b.full_adjustment);
    ASSERT_TRUE(mesh.state() == saved.state()) << "step " << i;
  }
}

// ---- what a mesh keeps from step to step

TEST(ChangesOfDegree, AreNoTrouble) {
  const CstAirfoil base = airfoil_catalogue()[0].airfoil();
  CstAirfoil low = base, high = base, blunt = base;
  low.upper.resize(base.upper.size() - 2, 0.1);
  low.lower.resize(base.lower.size() - 2, -0.1);
  high.upper.push_back(0.2);
  high.lower.push_back(-0.1);
  blunt.e1 = 0.45;
  Mesh mesh = generated(airfoil_domain(base, {.points = 50}));
  for (int round = 0; round < 3; ++round)
    for (const CstAirfoil& airfoil : {low, high, blunt, base})
      for (const double factor : {1.0, 1.00001, 1.1}) {
        SCOPED_TRACE(std::to_string(airfoil.degree()) + " " + std::to_string(factor));
        step(mesh, airfoil_domain(scaled(airfoil, factor), {.points = 50}));
      }
}

TEST(ChangesOfTheDiscretisation, AreNoTrouble) {
  Mesh mesh = generated(catalogue_domain(0, 50));
  for (int i = 0; i < 12; ++i) {
    const int points = i / 3 % 2 == 0 ? 64 : 40;
    const RemodelResult result = step(mesh, catalogue_domain(static_cast<std::size_t>(i) % 10, points));
    EXPECT_EQ(result.method, i % 3 == 0 ? Method::general : Method::specialised);
  }
}

TEST(ChangesOfTheFarfield, AreNoTrouble) {
  Mesh mesh = generated(catalogue_domain(0, 50));
  const CstAirfoil airfoil = airfoil_catalogue()[1].airfoil();
  for (const double radius : {25.0, 24.9, 20.0, 30.0, 10.0})
    step(mesh, airfoil_domain(airfoil, {.points = 50, .farfield_radius = radius}));
}

// ---- the general method

TEST(GeneralMethod, RemodelsSquaresToStarsToCircles) {
  Mesh mesh = generated(test::with_holes({test::square_hole(0.5, 0.5, 0.2)}));
  for (int round = 0; round < 4; ++round)
    for (const Loop& hole : {test::star_hole(0.5, 0.5, 0.3), test::circle_hole(0.45, 0.55, 0.2),
                             test::star_hole(0.6, 0.5, 0.2, 7), test::circle_hole(0.6, 0.6, 0.05, 40),
                             test::square_hole(0.4, 0.4, 0.2, 5)}) {
      const RemodelResult result = step(mesh, test::with_holes({hole}));
      EXPECT_FALSE(result.regenerated) << result.reason;
      EXPECT_EQ(full_check(mesh), "");
    }
}

TEST(GeneralMethod, LetsHolesAppearAndVanish) {
  const Loop square = test::square_hole(0.25, 0.25, 0.1), circle = test::circle_hole(0.7, 0.7, 0.15),
             star = test::star_hole(0.3, 0.7, 0.15);
  Mesh mesh = generated(test::with_holes({}));
  for (const std::vector<Loop>& holes : {std::vector<Loop>{square, circle},
                                         {circle},
                                         {star, circle},
                                         {},
                                         {circle, square, star},
                                         {star, square},
                                         {}}) {
    const RemodelResult result = step(mesh, test::with_holes(holes));
    EXPECT_FALSE(result.regenerated) << result.reason;
    EXPECT_EQ(full_check(mesh), "");
  }
}

TEST(GeneralMethod, DoesNotTouchWhatIsFarFromTheChange) {
  const Loop far = test::circle_hole(0.8, 0.8, 0.1);
  Mesh mesh = generated(test::with_holes({far, test::square_hole(0.2, 0.2, 0.05)}));
  const MeshState before = mesh.state();
  step(mesh, test::with_holes({far, test::circle_hole(0.2, 0.2, 0.06)}));
  const MeshState after = mesh.state();
  for (std::size_t v = 1; v < before.vertex_stars.size(); ++v) {
    const double x = before.coordinates[2 * v], y = before.coordinates[2 * v + 1];
    if (before.vertex_stars[v] == no_index || (x < 0.6 && y < 0.6)) continue;
    EXPECT_EQ(after.coordinates[2 * v], x);
    EXPECT_EQ(after.coordinates[2 * v + 1], y);
    EXPECT_EQ(after.vertex_generations[v], before.vertex_generations[v]);
  }
}

// The designs share the corner at (1/2, 1/2). Its length scale falls, and triangles from before the step, out
// of reach of the removal, become too large for it. A soak of 793,564 steps found this; the pairs were found
// by trial, and which of them show it depends on the order in which refinement goes.
TEST(GeneralMethod, JudgesTheTrianglesOfASharedVertexAnew) {
  const auto wedge = [](Point a, Point b) {
    return test::with_holes({test::polygon(LoopRole::hole, "hole", {{0.5, 0.5}, a, b}, 4)});
  };
  const Domain pairs[][2] = {
      {wedge({0.7, 0.57}, {0.671, 0.64}), wedge({0.716, 0.525}, {0.608, 0.564})},
      {wedge({0.72, 0.5}, {0.574, 0.706}), wedge({0.632, 0.614}, {0.517, 0.681})},
      {wedge({0.69, 0.649}, {0.636, 0.727}), wedge({0.671, 0.547}, {0.596, 0.641})},
      {wedge({0.694, 0.724}, {0.568, 0.74}), wedge({0.645, 0.666}, {0.634, 0.696})},
  };
  for (const auto& [from, to] : pairs) {
    Mesh mesh = generated(from);
    const RemodelResult result = step(mesh, to, {.distance = 0.0, .method = Method::general});
    EXPECT_FALSE(result.regenerated);
  }
}

TEST(GeneralMethod, ReversesAndReordersLoops) {
  Mesh mesh =
      generated(test::with_holes({test::square_hole(0.3, 0.3, 0.1), test::circle_hole(0.7, 0.7, 0.1)}));
  step(mesh, test::with_holes({test::circle_hole(0.7, 0.7, 0.1), test::square_hole(0.3, 0.3, 0.1)}));
  Domain reversed = test::with_holes({test::square_hole(0.3, 0.3, 0.12)});
  auto& corners = std::get<Polyline>(reversed.loops[1].curves[0].shape).points;
  std::reverse(corners.begin(), corners.end());
  step(mesh, reversed);
  EXPECT_EQ(full_check(mesh), "");
}

TEST(GeneralMethod, ChangesTheOuterBoundaryToo) {
  Mesh mesh = generated(test::with_holes({test::circle_hole(0.5, 0.5, 0.1)}));
  for (const double size : {1.2, 0.7, 3.0, 1.0}) {
    Domain domain = test::with_holes({test::circle_hole(0.5, 0.5, 0.1)});
    domain.loops[0] = test::rectangle(LoopRole::outer, "outer", {1 - size, 1 - size}, {size, size}, 3);
    const RemodelResult result = step(mesh, domain, {.method = Method::general});
    EXPECT_EQ(full_check(mesh), "") << size << ' ' << result.reason;
  }
}

// A hole's corner comes to lie on the side of a dent that the outline's stations do not show.
TEST(GeneralMethod, NeverPutsAVertexOnAnotherBoundary) {
  Domain domain{{test::loop(LoopRole::outer, "outer",
                            Polyline{{{0, 0}, {1, 0}, {1, 1}, {0.5, 0.75}, {0, 1}, {0, 0}}}, 5)}};
  domain.loops[0].curves[0].parameters = {0,    0.05, 0.1, 0.15, 0.2, 0.25, 0.3,
                                          0.35, 0.4,  0.8, 0.85, 0.9, 0.95};
  Mesh mesh = generated(domain);
  domain.loops.push_back(
      test::polygon(LoopRole::hole, "hole", {{0.84375, 0.921875}, {0.8, 0.5}, {0.7, 0.5}}));
  const RemodelResult result = remodel(mesh, domain, {.strategy = Strategy::chain});
  EXPECT_TRUE(result.regenerated);
  EXPECT_NE(result.reason.find("lies on a curve of another loop"), std::string::npos) << result.reason;
  EXPECT_EQ(mesh.data().triangulation.check(), "");
  EXPECT_EQ(check_boundary(mesh.data()), "");
}

// ---- chains

// The unit square with a chain from the middle of its lower side to a joint, and one from there on: no two
// edges meet at less than 60 degrees.
Loop chain(std::string name, Point from, Point to, std::size_t pieces) {
  Loop result = test::loop(LoopRole::internal, std::move(name), Line{from, to}, pieces);
  result.open = true;
  return result;
}
Domain with_chains(Point joint, Point tip, std::size_t pieces = 2) {
  return test::with_holes({chain("stem", {0.5, 0}, joint, pieces), chain("twig", joint, tip, pieces)});
}
Domain with_stem(Point tip) {
  return test::with_holes({chain("stem", {0.5, 0}, tip, 2)});
}
std::size_t entries_at(const MeshData& data, Point p) {
  std::size_t count = 0;
  for (const std::uint32_t head : data.loop_heads)
    data.walk(head, [&](std::uint32_t k) { count += data.point(k) == p ? 1 : 0; });
  return count;
}

TEST(Chains, AreReplacedWhileTheOnesThatTheyJoinStay) {
  const Point joint{0.5, 0.5};
  Mesh mesh = generated(with_chains(joint, {0.8, 0.8}));
  for (const Point tip : {Point{0.2, 0.8}, Point{0.8, 0.6}, Point{0.51, 0.51}, Point{0.8, 0.8}}) {
    const RemodelResult result = step(mesh, with_chains(joint, tip));
    EXPECT_EQ(result.method, Method::general);  // what is joined does not move in place
    EXPECT_FALSE(result.regenerated) << result.reason;
    EXPECT_EQ(entries_at(mesh.data(), joint), 2U);
    EXPECT_EQ(entries_at(mesh.data(), {0.5, 0}), 2U);
    EXPECT_EQ(full_check(mesh), "");
  }
}

TEST(Chains, AndTheirJointsMoveAppearAndVanish) {
  Mesh mesh = generated(with_chains({0.5, 0.5}, {0.8, 0.8}));
  const unsigned long long seed = test::seed(12);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53 - 0.5; };
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    const Point joint{0.5 + 0.2 * uniform(), 0.5 + 0.2 * uniform()};
    const Point tip{0.8 + 0.2 * uniform(), 0.8 + 0.2 * uniform()};
    const Domain designs[] = {with_chains(joint, tip), with_chains(joint, tip, 1 + random() % 6),
                              with_stem(joint), with_stem(tip), test::with_holes({})};
    const RemodelResult result = step(mesh, designs[random() % 5]);
    EXPECT_FALSE(result.regenerated) << result.reason;
    if (i % 10 == 0) {
      EXPECT_EQ(full_check(mesh), "");
    }
  }
}

TEST(Chains, ThatAreFreeMoveInPlace) {
  const auto crack = [](double x, double y) {
    return test::with_holes({chain("crack", {0.3 + x, 0.3 + y}, {0.7 + x, 0.5 - y}, 3)});
  };
  Mesh mesh = generated(crack(0, 0));
  for (const double x : {0.001, 0.002, 0.05, -0.1, -0.101, 0.1}) {
    SCOPED_TRACE(x);
    const RemodelResult result = step(mesh, crack(x, 0.5 * x));
    EXPECT_EQ(result.method, Method::specialised);
    EXPECT_FALSE(result.regenerated) << result.reason;
    EXPECT_EQ(full_check(mesh), "");
  }
}

// A free end that comes to lie on a station of the square, and leaves it again.
TEST(Chains, MayJoinAndPartWithoutChangingTheirNumber) {
  const auto crack = [](Point from) { return test::with_holes({chain("crack", from, {0.5, 0.6}, 3)}); };
  Mesh mesh = generated(crack({0.5, 0.2}));
  for (const Point from : {Point{0.5, 0}, Point{0.5, 0.1}, Point{0.25, 0}, Point{0.4, 0.3}, Point{0.5, 1}}) {
    SCOPED_TRACE(std::to_string(from.x) + ", " + std::to_string(from.y));
    step(mesh, crack(from));
    EXPECT_EQ(full_check(mesh), "");
  }
}

TEST(SpecialisedMethod, MovesPolygonsAndArcs) {
  Mesh mesh = generated(test::with_holes({test::star_hole(0.5, 0.5, 0.2), test::circle_hole(0.2, 0.2, 0.1)}));
  const unsigned long long seed = test::seed(11);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53 - 0.5; };
  for (int i = 0; i < 100; ++i) {
    const double size = i % 2 == 0 ? 0.002 : 0.08;
    const RemodelResult result =
        step(mesh, test::with_holes({test::star_hole(0.5 + size * uniform(), 0.5 + size * uniform(), 0.2),
                                     test::circle_hole(0.2, 0.2 + 0.5 * size * uniform(), 0.1)}));
    EXPECT_EQ(result.method, Method::specialised);
    EXPECT_FALSE(result.regenerated) << result.reason;
  }
  EXPECT_EQ(full_check(mesh), "");
}

TEST(Remodel, RefusesAnEmptyMeshAndOneThatWasMovedFrom) {
  const Domain domain = test::catalogue_domain(0, 30);
  Mesh none;
  EXPECT_THROW(remodel(none, domain, {.strategy = Strategy::chain}), Error);
  Mesh from = test::generated(domain, {.gradation = 1.0});
  const Mesh to = std::move(from);
  EXPECT_THROW(remodel(from, domain, {.strategy = Strategy::chain}),
               Error);  // NOLINT(bugprone-use-after-move)
  EXPECT_TRUE(from.empty());
  EXPECT_EQ(from.triangle_count(), 0U);
  EXPECT_TRUE(from.freeze().points.empty());
  EXPECT_EQ(from.statistics().triangles, 0U);
  EXPECT_EQ(from.quick_check(), "");
  EXPECT_TRUE(Mesh(from).empty());
  from = to;
  EXPECT_FALSE(remodel(from, test::catalogue_domain(1, 30), {.strategy = Strategy::chain}).regenerated);
}

// A budget ended generation: bad triangles stay wherever no step comes, and every step says so.
TEST(Remodel, OfAMeshThatALimitEndedSaysSoUntilNoTriangleIsBad) {
  const Domain domain = test::catalogue_domain(0, 60);
  GenerateResult cut = generate(domain, {.gradation = 2.0, .max_vertices = 700});
  ASSERT_EQ(cut.stopped, Stopped::vertex_budget);
  ASSERT_NE(cut.mesh.quick_check(), "");
  CstAirfoil design = airfoil_catalogue()[0].airfoil();
  design.upper[2] += 1e-9;
  Mesh mesh = Mesh::restore(cut.mesh.state(), "state");
  const RemodelResult result =
      remodel(mesh, airfoil_domain(design, {.points = 60}), {.strategy = Strategy::chain});
  EXPECT_EQ(result.stopped, Stopped::vertex_budget);
  mesh.data().options.max_vertices = 100000;
  for (int i = 0; i < 5; ++i) {
    const Stopped stopped = remodel(mesh, test::catalogue_domain(static_cast<std::size_t>(1 + i), 60),
                                    {.strategy = Strategy::chain})
                                .stopped;
    EXPECT_EQ(stopped == Stopped::done, mesh.quick_check().empty()) << "step " << i;
  }
}

}  // namespace
}  // namespace remodel
