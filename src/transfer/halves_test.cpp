// Meshes with quadrilaterals: values of their cells are carried like those of triangles.

#include "transfer/halves.h"

#include <gtest/gtest.h>

#include <numeric>

#include "remodel/error.h"
#include "remodel/predicates.h"

namespace remodel {
namespace {

// Rows of unit cells, quadrilaterals below and triangles above; `bend` moves the line between.
FrozenMesh strip(std::uint32_t cells, double bend) {
  FrozenMesh mesh;
  for (std::uint32_t j = 0; j < 3; ++j)
    for (std::uint32_t i = 0; i <= cells; ++i)
      mesh.points.push_back({static_cast<double>(i), j == 1 && i > 0 && i < cells ? 1.0 + bend : j});
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return j * (cells + 1) + i; };
  for (std::uint32_t i = 0; i < cells; ++i) {
    mesh.quads.push_back({at(i, 0), at(i + 1, 0), at(i + 1, 1), at(i, 1)});
    mesh.triangles.push_back({at(i, 1), at(i + 1, 1), at(i + 1, 2)});
    mesh.triangles.push_back({at(i, 1), at(i + 1, 2), at(i, 2)});
  }
  return mesh;
}

Field values_on(const FrozenMesh& mesh) {
  Field field{"f", FieldPlace::triangles, 1, std::vector<double>(mesh.cell_count())};
  std::iota(field.values.begin(), field.values.end(), 1.0);
  return field;
}

TEST(Quadrilaterals, KeepTheirValuesWhereNothingHasChanged) {
  const FrozenMesh mesh = strip(5, 0.1);
  const Transfer transfer(mesh, mesh);
  for (const bool conservative : {false, true}) {
    std::vector<double> values = values_on(mesh).values;
    conservative ? static_cast<void>(transfer.remap(FieldPlace::triangles, 1, values))
                 : transfer.ride(FieldPlace::triangles, 1, values);
    EXPECT_EQ(values, values_on(mesh).values);
  }
  EXPECT_TRUE(transfer.triangles().rows.empty());
}

TEST(Quadrilaterals, ConserveWhatTheirCellsHold) {
  const FrozenMesh before = strip(5, 0.0), after = strip(5, 0.25);
  const Transfer transfer(before, after);
  Field field = values_on(before);
  const double integral_before = integral(field, before)[0];
  double by_hand = 0.0;
  for (std::size_t i = 0; i < 10; ++i) by_hand += 0.5 * field.values[i];
  for (std::size_t i = 10; i < 15; ++i) by_hand += field.values[i];
  EXPECT_NEAR(integral_before, by_hand, 1e-12);
  transfer.remap(FieldPlace::triangles, 1, field.values);
  ASSERT_EQ(field.values.size(), after.cell_count());
  EXPECT_NEAR(integral(field, after)[0], integral_before, 1e-11);
}

TEST(Quadrilaterals, GiveTheirValuesToTrianglesThatTakeTheirPlaces) {
  FrozenMesh before = strip(4, 0.0), after = with_split_quads(before);
  Field field{"f", FieldPlace::triangles, 1, std::vector<double>(before.cell_count(), 3.0)};
  const Transfer transfer(before, after), back(after, before);
  std::vector<double> values = field.values;
  transfer.ride(FieldPlace::triangles, 1, values);
  EXPECT_EQ(values, std::vector<double>(after.cell_count(), 3.0));
  back.ride(FieldPlace::triangles, 1, values);
  for (const double value : values) EXPECT_NEAR(value, 3.0, 1e-14);
  EXPECT_THROW(transfer.ride(FieldPlace::triangles, 1, values = {1.0}), Error);
}

TEST(Quadrilaterals, WithPointsThatAreNotThereAreRefused) {
  FrozenMesh mesh = strip(2, 0.0);
  mesh.quads[1][2] = 99;
  EXPECT_THROW(Transfer(mesh, mesh), Error);
}

}  // namespace
}  // namespace remodel
