// Rides: values stay with their vertices, and new ones are interpolated.

#include "remodel/transfer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "mesh/mesh_data.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "step/test_designs.h"
#include "transfer/test_transfers.h"

namespace remodel {
namespace {

using test::values_by_id;

// Vectors of values per slot: two components, one linear in the coordinates, one at random.
std::vector<double> state_of(const Mesh& mesh, FieldPlace place, std::mt19937_64& random) {
  std::vector<double> values = values_by_id(mesh, place, 2, [&](Point p, std::size_t k) {
    return k == 0 ? test::linear(p) : test::uniform(random, -1.0, 1.0);
  });
  return values;
}

double dot_product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// Old values by key: what a vertex that is still there keeps.
std::map<std::uint64_t, std::pair<double, double>> by_key(const Mesh& mesh,
                                                          const std::vector<double>& values) {
  std::map<std::uint64_t, std::pair<double, double>> result;
  const FrozenMesh frozen = mesh.freeze();
  for (std::size_t i = 0; i < frozen.points.size(); ++i) {
    const std::size_t v = frozen.vertex_ids[i];
    result[frozen.vertex_keys[i]] = {values[2 * v], values[2 * v + 1]};
  }
  return result;
}

// Steps of airfoils, flaps and ducts, with a row of marks.
class Rides : public testing::TestWithParam<test::Family> {};

struct Moment {
  Mark mark;
  FrozenMesh frozen;
  std::vector<double> values;
  std::map<std::uint64_t, std::pair<double, double>> known;
};

void expect_kept(const Mesh& mesh, const Moment& then, const std::vector<double>& values) {
  const FrozenMesh frozen = mesh.freeze();
  for (std::size_t i = 0; i < frozen.points.size(); ++i) {
    const auto found = then.known.find(frozen.vertex_keys[i]);
    if (found == then.known.end()) continue;
    const std::size_t v = frozen.vertex_ids[i];
    ASSERT_EQ(values[2 * v], found->second.first);
    ASSERT_EQ(values[2 * v + 1], found->second.second);
  }
}

// New vertices have the value of the linear function where they stand.
void expect_linear(const Transfer& transfer, const Mesh& mesh, const std::vector<double>& values) {
  for (const std::uint32_t v : transfer.vertices().rows) {
    const Point p = mesh.data().triangulation.point(VertexId{v});
    ASSERT_NEAR(values[2 * v], test::linear(p), 1e-11 * (1.0 + std::abs(p.x) + std::abs(p.y)));
  }
}

void expect_transposed(const ValueMap& map, std::mt19937_64& random) {
  std::vector<double> before(2 * map.size_before), after(2 * map.size_after);
  for (double& value : before) value = test::uniform(random, -1.0, 1.0);
  for (double& value : after) value = test::uniform(random, -1.0, 1.0);
  for (const std::uint32_t v : map.gone) before[2 * v] = before[2 * v] + 1.0;
  std::vector<double> mapped = before, back = after;
  map.apply(mapped, 2);
  map.apply_transposed(back, 2);
  const double scale = std::sqrt(dot_product(mapped, mapped) * dot_product(after, after));
  EXPECT_NEAR(dot_product(after, mapped), dot_product(back, before), 1e-12 * scale);
}

// Between frozen meshes the same comes out: at rest, on the way, and where vertices are new.
void expect_same_between(const Moment& then, const Mesh& mesh, const std::vector<double>& values) {
  const FrozenMesh now = mesh.freeze();
  std::vector<double> dense;
  for (const std::uint32_t id : then.frozen.vertex_ids)
    dense.insert(dense.end(), {then.values[2 * id], then.values[2 * id + 1]});
  Transfer(then.frozen, now, {.outside = Outside::extrapolate}).ride(FieldPlace::vertices, 2, dense);
  for (std::size_t i = 0; i < now.points.size(); ++i)
    ASSERT_NEAR(dense[2 * i], values[2 * now.vertex_ids[i]], 1e-11 * (1.0 + std::abs(dense[2 * i])));
}

TEST_P(Rides, KeepWhatStaysAndAreExactOnLinearFieldsOverAnyRowOfSteps) {
  const auto seed = test::seed(231);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  test::Designs designs(GetParam(), random);
  Mesh mesh = generate(designs.next(), {.gradation = 2.0}).mesh;
  const int steps = 334 * test::effort();
  std::map<int, Moment> marks;
  const auto set_mark = [&](int age) {
    Moment moment{mesh.mark(), mesh.freeze(), state_of(mesh, FieldPlace::vertices, random), {}};
    moment.known = by_key(mesh, moment.values);
    marks.insert_or_assign(age, std::move(moment));
  };
  std::size_t rows = 0;
  for (int i = 0; i < steps; ++i) {
    set_mark(0);
    if (i % 5 == 0) set_mark(1);
    if (i % 17 == 0) set_mark(2);
    const RemodelResult result = remodel(mesh, designs.next(), {.strategy = Strategy::renew});
    ASSERT_FALSE(result.abandoned);
    for (auto& [age, then] : marks) {
      if (age > 0 && i % 4 != 0) continue;
      SCOPED_TRACE("step " + std::to_string(i) + ", mark " + std::to_string(age));
      const Transfer transfer(mesh, then.mark, {.outside = Outside::extrapolate});
      rows += transfer.vertices().rows.size();
      std::vector<double> values = then.values;
      transfer.ride(FieldPlace::vertices, 2, values);
      expect_kept(mesh, then, values);
      expect_linear(transfer, mesh, values);
      if (i % 20 == 0) {
        expect_transposed(transfer.vertices(), random);
        expect_transposed(transfer.triangles(), random);
        expect_same_between(then, mesh, values);
      }
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(rows, 1000U);
}

INSTANTIATE_TEST_SUITE_P(Of, Rides,
                         testing::Values(test::Family::airfoils, test::Family::flaps, test::Family::ducts),
                         [](const auto& given) { return test::name_of(given.param); });

TEST(Ride, OfValuesOnTrianglesKeepsThemAndIsExactOnLinearFields) {
  const auto seed = test::seed(232);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  test::Designs designs(test::Family::ducts, random);
  Mesh mesh = generate(designs.next(), {.gradation = 2.0}).mesh;
  std::size_t rows = 0;
  for (int i = 0; i < 20; ++i) {
    const FrozenMesh before = mesh.freeze();
    std::vector<double> values = state_of(mesh, FieldPlace::triangles, random);
    const std::vector<double> old = values;
    const Mark mark = mesh.mark();
    remodel(mesh, designs.next(), {.method = Method::general, .strategy = Strategy::chain});
    const Transfer transfer(mesh, mark);
    const ValueMap map = transfer.triangles();
    rows += map.rows.size();
    transfer.ride(FieldPlace::triangles, 2, values);
    const FrozenMesh after = mesh.freeze();
    for (std::size_t t = 0; t < after.triangles.size(); ++t) {
      const std::uint32_t id = after.triangle_ids[t];
      if (!std::binary_search(map.rows.begin(), map.rows.end(), id)) {
        ASSERT_EQ(values[2 * id], old[2 * id]);
        continue;
      }
      const auto& [a, b, c] = after.triangles[t];
      const Point centre = (1.0 / 3.0) * (after.points[a] + after.points[b] + after.points[c]);
      if (transfer.outside() > 0) continue;
      ASSERT_NEAR(values[2 * id], test::linear(centre), 1e-10);
    }
  }
  EXPECT_GT(rows, 100U);
}

TEST(Ride, AfterARegenerationIsFromTheOldMeshAsAWhole) {
  Mesh mesh = generate(test::catalogue_domain(0, 100), {.gradation = 2.0}).mesh;
  std::vector<double> values =
      values_by_id(mesh, FieldPlace::vertices, 1, [](Point p, auto) { return test::linear(p); });
  const Mark mark = mesh.mark();
  mesh.data().options.max_vertices = static_cast<std::uint32_t>(mesh.data().triangulation.vertex_count()) + 1;
  ASSERT_TRUE(remodel(mesh, test::catalogue_domain(1, 100), {.strategy = Strategy::chain}).regenerated);
  const Transfer transfer(mesh, mark, {.outside = Outside::extrapolate});
  const FrozenMesh frozen = mesh.freeze();
  EXPECT_GE(transfer.vertices().rows.size(), frozen.points.size());
  transfer.ride(FieldPlace::vertices, 1, values);
  for (std::size_t i = 0; i < frozen.points.size(); ++i)
    ASSERT_NEAR(values[frozen.vertex_ids[i]], test::linear(frozen.points[i]), 1e-9);
}

TEST(Ride, WithoutAnyChangeIsTheIdentity) {
  const Mesh mesh = generate(test::catalogue_domain(0, 60), {.gradation = 2.0}).mesh;
  const FrozenMesh frozen = mesh.freeze();
  FrozenMesh nameless = frozen;
  nameless.vertex_keys.clear();
  for (const FrozenMesh* after : {&frozen, static_cast<const FrozenMesh*>(&nameless)}) {
    const Transfer transfer(frozen, *after);
    EXPECT_TRUE(transfer.vertices().rows.empty());
    EXPECT_TRUE(transfer.triangles().rows.empty());
    std::vector<double> values(frozen.points.size());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sin(static_cast<double>(i));
    const std::vector<double> before = values;
    const Balance balance = transfer.remap(FieldPlace::vertices, 1, values);
    EXPECT_EQ(values, before);
    EXPECT_EQ(balance.area_gained, 0.0);
  }
}

TEST(Ride, BeyondTheOldDomainIsRefusedWhereThatIsAskedFor) {
  const FrozenMesh small = generate(test::with_holes({})).mesh.freeze();
  FrozenMesh large = small;
  large.vertex_keys.clear();
  for (Point& p : large.points) p = 2.0 * p;
  EXPECT_THROW(Transfer(small, large, {.outside = Outside::refuse}), Error);
  const Transfer transfer(small, large);
  EXPECT_GT(transfer.outside(), 0U);
  EXPECT_NEAR(transfer.farthest_outside(), std::sqrt(2.0), 1e-12);
  std::vector<double> values(small.points.size(), 1.0);
  values.pop_back();
  EXPECT_THROW(transfer.ride(FieldPlace::vertices, 1, values), Error);
}

}  // namespace
}  // namespace remodel
