// Remaps: conservative, of second order, within bounds.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "remodel/transfer.h"
#include "transfer/intersection.h"
#include "transfer/test_transfers.h"

namespace remodel {
namespace {

constexpr FieldPlace places[] = {FieldPlace::vertices, FieldPlace::triangles};

template <class Value>
Field field_on(const FrozenMesh& mesh, FieldPlace place, int components, Value value) {
  Field field{"f", place, components, {}};
  const std::size_t count = place == FieldPlace::vertices ? mesh.points.size() : mesh.triangles.size();
  for (std::size_t i = 0; i < count; ++i) {
    Point p = place == FieldPlace::vertices ? mesh.points[i] : Point{};
    if (place == FieldPlace::triangles)
      for (const std::uint32_t v : mesh.triangles[i]) p = p + (1.0 / 3.0) * mesh.points[v];
    for (int k = 0; k < components; ++k) field.values.push_back(value(p, k));
  }
  return field;
}

// Every triangle in four.
FrozenMesh refined(const FrozenMesh& mesh) {
  FrozenMesh fine;
  fine.points = mesh.points;
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [at, is_new] = middles.emplace(std::array{std::min(a, b), std::max(a, b)}, fine.points.size());
    if (is_new) fine.points.push_back(0.5 * (mesh.points[a] + mesh.points[b]));
    return at->second;
  };
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const std::array<std::uint32_t, 3>& piece :
         {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c}, std::array{ab, bc, ca}})
      fine.triangles.push_back(piece);
  }
  return fine;
}

// Two meshes of the unit square with a square hole that have nothing else in common.
std::pair<FrozenMesh, FrozenMesh> two_squares(std::size_t pieces) {
  const auto square = [&](std::size_t sides) {
    return Domain{{test::rectangle(LoopRole::outer, "outer", {0, 0}, {1, 1}, sides),
                   test::rectangle(LoopRole::hole, "hole", {0.3, 0.4}, {0.5, 0.6},
                                   std::max<std::size_t>(1, sides / 4))}};
  };
  FrozenMesh before = generate(square(pieces), {.gradation = 4.0}).mesh.freeze();
  FrozenMesh after = generate(square(pieces + 3), {.gradation = 4.0}).mesh.freeze();
  before.vertex_keys.clear();
  return {std::move(before), std::move(after)};
}

double smooth(Point p) {
  return std::sin(3.0 * p.x + 1.0) * std::cos(2.0 * p.y) + p.x * p.y;
}

double mean_error(const FrozenMesh& mesh, const Field& found, const Field& exact) {
  Field error = found;
  for (std::size_t i = 0; i < error.values.size(); ++i)
    error.values[i] = std::abs(found.values[i] - exact.values[i]);
  return integral(error, mesh)[0];
}

TEST(Intersection, OfTrianglesThatCoverOneAnotherAddsUp) {
  const auto seed = test::seed(241);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const auto corner = [&] { return Point{test::uniform(random, 0, 1), test::uniform(random, 0, 1)}; };
  for (int i = 0; i < 2000; ++i) {
    Corners a{corner(), corner(), corner()}, b{corner(), corner(), corner()};
    for (Corners* t : {&a, &b})
      if (area_of(*t) < 0.0) std::swap((*t)[0], (*t)[1]);
    // b in three pieces, one of whose corners is its centroid: edges and corners that coincide.
    const Point middle = centroid_of(b);
    double area = 0.0;
    Point moment;
    for (std::size_t k = 0; k < 3; ++k) {
      const Intersection piece = intersect(a, {b[k], b[(k + 1) % 3], middle});
      area += piece.area, moment = moment + piece.area * piece.centroid;
    }
    const Intersection whole = intersect(a, b), back = intersect(b, a);
    EXPECT_NEAR(whole.area, area, 1e-14);
    EXPECT_NEAR(whole.area, back.area, 1e-14);
    EXPECT_NEAR(whole.area * whole.centroid.x, moment.x, 1e-14);
    EXPECT_NEAR(whole.area * whole.centroid.y, moment.y, 1e-14);
    EXPECT_LE(whole.area, std::min(area_of(a), area_of(b)) + 1e-15);
    EXPECT_NEAR(intersect(a, a).area, area_of(a), 1e-15);
  }
}

TEST(Remap, IsOfSecondOrderAndConserves) {
  for (const FieldPlace place : places) {
    auto [before, after] = two_squares(6);
    std::vector<double> errors;
    for (int refinement = 0; refinement < 5; ++refinement) {
      Field field = field_on(before, place, 1, [](Point p, int) { return smooth(p); });
      const Field exact = field_on(after, place, 1, [](Point p, int) { return smooth(p); });
      const double integral_before = integral(field, before)[0];
      const Balance balance = Transfer(before, after).remap(place, 1, field.values);
      EXPECT_NEAR(integral(field, after)[0], integral_before, 1e-12 * integral_before);
      EXPECT_NEAR(balance.area_gained, 0.0, 1e-12);
      EXPECT_NEAR(balance.area_lost, 0.0, 1e-12);
      errors.push_back(mean_error(after, field, exact));
      before = refined(before), after = refined(after);
    }
    const auto intervals = static_cast<double>(errors.size() - 1);
    const double order = std::log2(errors.front() / errors.back()) / intervals;
    EXPECT_GE(order, 1.9) << testing::PrintToString(errors);
    RecordProperty("order", std::to_string(order));
  }
}

TEST(Remap, RefusesValuesOfAnotherCount) {
  const auto [before, after] = two_squares(6);
  const Transfer transfer(before, after);
  for (const FieldPlace place : places)
    for (const int components : {0, 1, 2, 5})
      for (const std::size_t count :
           {std::size_t{0}, std::size_t{7}, before.points.size() + before.triangles.size()}) {
        std::vector<double> values(count, 1.0);
        EXPECT_THROW(transfer.remap(place, components, values), Error);
        EXPECT_EQ(values.size(), count);
      }
}

TEST(Remap, IsExactOnLinearFields) {
  const auto [before, after] = two_squares(12);
  for (const FieldPlace place : places) {
    Field field = field_on(before, place, 1, [](Point p, int) { return test::linear(p); });
    const RemapOptions options{.limited = place == FieldPlace::vertices};
    Transfer(before, after).remap(place, 1, field.values, options);
    const Field exact = field_on(after, place, 1, [](Point p, int) { return test::linear(p); });
    for (std::size_t i = 0; i < field.values.size(); ++i)
      ASSERT_NEAR(field.values[i], exact.values[i], 1e-12);
  }
}

// A step function: the values after are within those before, near each vertex.
TEST(Remap, MakesNoNewExtremumAtAJump) {
  const auto [before, after] = two_squares(20);
  for (const FieldPlace place : places) {
    Field field =
        field_on(before, place, 1, [](Point p, int) { return p.x + 0.3 * p.y < 0.5 ? 1.0 : 1000.0; });
    const double integral_before = integral(field, before)[0];
    std::vector<double> free = field.values;
    const Transfer transfer(before, after);
    transfer.remap(place, 1, free, {.limited = false});
    EXPECT_TRUE(*std::min_element(free.begin(), free.end()) < 0.9 ||
                *std::max_element(free.begin(), free.end()) > 1000.1);
    const Balance balance = transfer.remap(place, 1, field.values);
    EXPECT_GT(balance.limited, 0U);
    EXPECT_GE(*std::min_element(field.values.begin(), field.values.end()), 1.0 - 1e-10);
    EXPECT_LE(*std::max_element(field.values.begin(), field.values.end()), 1000.0 + 1e-10);
    EXPECT_NEAR(integral(field, after)[0], integral_before, 1e-12 * integral_before);
  }
}

// Beside a jump, and beside a gas whose pressure has to be kept positive.
TEST(Remap, IsExactOnLinearComponentsWhateverTheOthersAre) {
  const auto [before, after] = two_squares(20);
  const auto value = [](Point p, int k) {
    const bool behind = p.x + 0.3 * p.y > 0.5;
    const double rho = behind ? 5.9 : 1.0, u = behind ? 100.0 : 1000.0;
    const double state[] = {test::linear(p), rho, rho * u, 0.0, 0.5 * rho * u * u + (behind ? 1e5 : 1e-3)};
    return state[k];
  };
  for (const FieldPlace place : places) {
    Field alone = field_on(before, place, 1, value), beside = field_on(before, place, 5, value);
    const Transfer transfer(before, after);
    transfer.remap(place, 1, alone.values);
    const Balance balance = transfer.remap(place, 5, beside.values, {.conserved = {{1, 2, 3, 4}}});
    EXPECT_GT(balance.limited, 0U);
    const Field exact = field_on(after, place, 1, value);
    // Limited slopes on triangles are not exact at the boundary.
    const double most = place == FieldPlace::vertices ? 1e-12 : 0.1;
    for (std::size_t i = 0; i < alone.values.size(); ++i) {
      ASSERT_EQ(beside.values[5 * i], alone.values[i]);
      ASSERT_NEAR(alone.values[i], exact.values[i], most);
    }
  }
}

double pressure(const double* state) {
  return 0.4 * (state[3] - 0.5 * (state[1] * state[1] + state[2] * state[2]) / state[0]);
}

// Across a strong shock energy is mostly kinetic on one side: each component within its bounds is not enough.
TEST(Remap, KeepsDensityAndPressurePositiveAtAShock) {
  const auto [before, after] = two_squares(20);
  for (const FieldPlace place : places) {
    Field field = field_on(before, place, 1, [](Point, int) { return 0.0; });
    const std::size_t count = field.values.size();
    const Field side = field_on(before, place, 1, [](Point p, int) { return p.x < 0.5 ? 0.0 : 1.0; });
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) {
      const bool behind = side.values[i] > 0.5;
      const double rho = behind ? 5.9 : 1.0, u = behind ? 100.0 : 1000.0, p = behind ? 1e5 : 1e-3;
      values.insert(values.end(), {rho, rho * u, 0.0, p / 0.4 + 0.5 * rho * u * u});
    }
    const Balance balance = Transfer(before, after).remap(place, 4, values, {.conserved = {{0, 1, 2, 3}}});
    for (std::size_t i = 0; 4 * i < values.size(); ++i) {
      ASSERT_GT(values[4 * i], 0.0);
      ASSERT_GT(pressure(&values[4 * i]), 0.0);
    }
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(balance.after[k], balance.before[k] + balance.gained[k] - balance.lost[k],
                  1e-12 * std::abs(balance.before[3]));
  }
}

class RemapsOf : public testing::TestWithParam<test::Family> {};

// Living meshes with moving boundaries: the balance adds up, and what lies apart from changes keeps its bits.
TEST_P(RemapsOf, LivingMeshesBalanceWithTheSweptArea) {
  const auto seed = test::seed(242);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  test::Designs designs(GetParam(), random);
  Mesh mesh = generate(designs.next(), {.gradation = 2.0}).mesh;
  std::size_t kept = 0, changed = 0;
  for (int i = 0; i < 60; ++i) {
    const FrozenMesh before = mesh.freeze();
    const Mark mark = mesh.mark();
    std::vector<std::vector<double>> states;
    for (const FieldPlace place : places)
      states.push_back(test::values_by_id(mesh, place, 2,
                                          [&](Point, std::size_t) { return test::uniform(random, 1, 2); }));
    remodel(mesh, designs.next(), {.strategy = Strategy::renew});
    const FrozenMesh after = mesh.freeze();
    const Transfer transfer(mesh, mark);
    const auto whole = [&](const std::vector<double>& values, const FrozenMesh& frozen, FieldPlace place) {
      Field field{"f", place, 2, {}};
      for (const std::uint32_t id : place == FieldPlace::vertices ? frozen.vertex_ids : frozen.triangle_ids)
        field.values.insert(field.values.end(), {values[2 * id], values[2 * id + 1]});
      return integral(field, frozen);
    };
    for (const FieldPlace place : places) {
      std::vector<double>& values = states[place == FieldPlace::vertices ? 0 : 1];
      const std::vector<double> old = values;
      const std::vector<double> integral_before = whole(values, before, place);
      const Balance balance = transfer.remap(place, 2, values);
      const std::vector<double> integral_after = whole(values, after, place);
      for (std::size_t k = 0; k < 2; ++k) {
        const double swept = balance.gained[k] - balance.lost[k];
        EXPECT_NEAR(integral_after[k], integral_before[k] + swept, 1e-12 * integral_before[k])
            << "step " << i;
        EXPECT_NEAR(balance.after[k], balance.before[k] + swept, 1e-12 * integral_before[k]);
      }
      for (const std::uint32_t id : place == FieldPlace::vertices ? after.vertex_ids : after.triangle_ids) {
        ASSERT_GE(values[2 * id], 1.0 - 1e-12);
        ASSERT_LE(values[2 * id], 2.0 + 1e-12);
      }
      for (std::size_t k = 0; k < std::min(old.size(), values.size()); ++k)
        (old[k] == values[k] ? kept : changed) += 1;
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(kept, changed);
  EXPECT_GT(changed, 1000U);
}

INSTANTIATE_TEST_SUITE_P(Of, RemapsOf,
                         testing::Values(test::Family::airfoils, test::Family::flaps, test::Family::ducts),
                         [](const auto& given) { return test::name_of(given.param); });

}  // namespace
}  // namespace remodel
