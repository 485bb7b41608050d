// What Mesh::changes_since() says is what a comparison of the two meshes finds.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>

#include "mesh/mesh_data.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "step/strategy.h"
#include "step/test_designs.h"
#include "support.h"

namespace remodel {
namespace {

using Corners = std::array<VertexKey, 3>;

// A mesh at one moment: all vertices and domain triangles by name.
struct Snapshot {
  std::map<VertexKey, Point> vertices;
  std::map<TriangleId, Corners> triangles;

  explicit Snapshot(const Mesh& mesh) {
    const Triangulation& t = mesh.data().triangulation;
    const auto key = [&](VertexId v) { return VertexKey{v, t.generation(v)}; };
    for (std::uint32_t i = 1; i < t.vertex_slots(); ++i)
      if (t[VertexId{i}].alive()) vertices[key(VertexId{i})] = t.point(VertexId{i});
    for (std::uint32_t i = 0; i < t.triangle_slots(); ++i) {
      const Triangle& triangle = t[TriangleId{i}];
      if (!triangle.alive() || triangle.region != Region::domain) continue;
      Corners corners{key(triangle.vertex[0]), key(triangle.vertex[1]), key(triangle.vertex[2])};
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      triangles[TriangleId{i}] = corners;
    }
  }
};

Changes changes_between(const Snapshot& then, const Snapshot& now) {
  Changes changes;
  for (const auto& [key, point] : then.vertices) {
    const auto found = now.vertices.find(key);
    if (found == now.vertices.end())
      changes.removed.push_back(key);
    else if (!(found->second == point))
      changes.moved.push_back(key);
  }
  for (const auto& [key, point] : now.vertices)
    if (!then.vertices.contains(key)) changes.inserted.push_back(key);
  const auto is_in = [](const Snapshot& other, TriangleId id, const Corners& corners) {
    const auto found = other.triangles.find(id);
    return found != other.triangles.end() && found->second == corners;
  };
  for (const auto& [id, corners] : then.triangles)
    if (!is_in(now, id, corners)) changes.gone.push_back(id);
  for (const auto& [id, corners] : now.triangles)
    if (!is_in(then, id, corners)) changes.born.push_back(id);
  return changes;
}

void expect_same(const Changes& found, const Changes& expected) {
  EXPECT_EQ(found.moved, expected.moved);
  EXPECT_EQ(found.inserted, expected.inserted);
  EXPECT_EQ(found.removed, expected.removed);
  EXPECT_EQ(found.born, expected.born);
  EXPECT_EQ(found.gone, expected.gone);
}

class ChangesOf : public testing::TestWithParam<std::tuple<Method, Strategy>> {};

// Marks of several ages, over full adjustments and replacements, and trials that are taken back or kept.
TEST_P(ChangesOf, AnyRowOfStepsAreThoseThatAComparisonFinds) {
  const auto seed = test::seed(81);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const auto [method, strategy] = GetParam();
  const RemodelOptions options{.method = method, .strategy = strategy};
  test::Walk walk(random() % 10, 0.05, random);
  Mesh mesh = generate(walk.domain(60), {.gradation = 2.0}).mesh;
  std::map<int, std::pair<Mark, Snapshot>> marks;  // of the last step, of some before
  int same = 0, others = 0;
  for (int i = 0; i < 40; ++i) {
    marks.insert_or_assign(0, std::pair(mesh.mark(), Snapshot(mesh)));
    if (i % 7 == 0) marks.insert_or_assign(1 + i % 2, std::pair(mesh.mark(), Snapshot(mesh)));
    if (i % 4 == 0) walk.next();
    const Domain design = airfoil_domain(i % 4 == 0 ? walk.airfoil() : walk.sample(1e-5), {.points = 60});
    if (i % 5 == 4) {
      Trial trial(mesh, design, options);
      for (const auto& [age, then] : marks)
        expect_same(mesh.changes_since(then.first), changes_between(then.second, Snapshot(mesh)));
      if (i % 2 == 0) trial.keep();
    } else {
      remodel(mesh, design, options);
    }
    for (const auto& [age, then] : marks) {
      SCOPED_TRACE("step " + std::to_string(i) + ", mark " + std::to_string(age));
      expect_same(mesh.changes_since(then.first), changes_between(then.second, Snapshot(mesh)));
      if (HasFailure()) return;
    }
    const Changes last = mesh.changes_since(marks.at(0).first);
    ++(last.same_connectivity() ? same : others);
  }
  EXPECT_GT(others, 3);
  if (method == Method::automatic) {
    EXPECT_GT(same, 3);
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, ChangesOf,
                         testing::Combine(testing::Values(Method::automatic, Method::general),
                                          testing::Values(Strategy::chain, Strategy::renew)),
                         [](const auto& given) {
                           return std::string(name_of(std::get<0>(given.param))) + "_" +
                                  name_of(std::get<1>(given.param));
                         });

// A budget of vertices that the new design does not fit in: the mesh is generated afresh, as far as it goes.
TEST(Changes, OfARegenerationAreAllVerticesAndNoKeyIsGivenOutAgain) {
  Mesh mesh = generate(test::catalogue_domain(0, 100), {.gradation = 2.0}).mesh;
  std::set<VertexKey> known;
  for (int i = 1; i < 4; ++i) {
    const Snapshot before(mesh);
    for (const auto& [key, point] : before.vertices) known.insert(key);
    const Mark mark = mesh.mark();
    mesh.data().options.max_vertices =
        static_cast<std::uint32_t>(mesh.data().triangulation.vertex_count()) + 1;
    ASSERT_TRUE(
        remodel(mesh, test::catalogue_domain(static_cast<std::size_t>(i), 100), {.strategy = Strategy::chain})
            .regenerated);
    const Changes changes = mesh.changes_since(mark);
    expect_same(changes, changes_between(before, Snapshot(mesh)));
    EXPECT_EQ(changes.removed.size(), before.vertices.size());
    for (const VertexKey key : changes.inserted) ASSERT_FALSE(known.contains(key)) << key.value();
  }
}

// Steps that reuse slots, a regeneration, and steps that need new slots: in the life of a mesh no vertex has
// the key of another.
TEST(Changes, InsertNoKeyThatWasThereBefore) {
  const auto seed = test::seed(82);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  test::Walk walk(random() % 10, 0.1, random);
  Mesh mesh = generate(walk.domain(60), {.gradation = 2.0}).mesh;
  std::set<VertexKey> known;
  for (const auto& [key, point] : Snapshot(mesh).vertices) known.insert(key);
  for (int i = 0; i < 60; ++i) {
    walk.next();
    const Mark mark = mesh.mark();
    const std::uint32_t budget = mesh.data().options.max_vertices;
    if (i % 20 == 19) mesh.data().options.max_vertices = 10;
    const RemodelResult result = remodel(mesh, walk.domain(60), {.strategy = Strategy::chain});
    mesh.data().options.max_vertices = budget;
    EXPECT_TRUE(i % 20 != 19 || result.regenerated || result.full_adjustment);
    for (const VertexKey key : mesh.changes_since(mark).inserted)
      ASSERT_TRUE(known.insert(key).second) << "step " << i << ", vertex " << key.id.index;
  }
}

TEST(Changes, OfAnotherMeshAreRefused) {
  Mesh mesh = generate(test::catalogue_domain(0, 60), {.gradation = 2.0}).mesh;
  const Mark mark = mesh.mark();
  const Mesh copy = mesh;
  EXPECT_THROW(copy.changes_since(mark), Error);
  EXPECT_THROW(mesh.changes_since(Mark()), Error);
  EXPECT_TRUE(mesh.changes_since(mark).same_connectivity());
  const Mesh moved = std::move(mesh);
  EXPECT_TRUE(moved.changes_since(mark).moved.empty());
}

// A mark that is set while a trial lasts is of a mesh that never was, once the trial is taken back.
TEST(Changes, SinceAMomentOfATrialThatWasTakenBackAreRefused) {
  Mesh mesh = generate(test::catalogue_domain(0, 60), {.gradation = 2.0}).mesh;
  const Mark before = mesh.mark();
  Mark during;
  {
    Trial trial(mesh, test::catalogue_domain(1, 60), {.strategy = Strategy::chain});
    during = mesh.mark();
    EXPECT_TRUE(mesh.changes_since(during).same_connectivity());
    EXPECT_FALSE(mesh.changes_since(before).same_connectivity());
  }
  EXPECT_THROW(mesh.changes_since(during), Error);
  EXPECT_TRUE(mesh.changes_since(before).same_connectivity());
}

}  // namespace
}  // namespace remodel
