#include "remodel/field.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "remodel/error.h"

namespace remodel {
namespace {

FrozenMesh two_triangles() {
  FrozenMesh mesh;
  mesh.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

std::string error_of(const std::vector<Field>& fields) {
  try {
    require_fit(fields, two_triangles());
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(Fields, OfEveryPlaceAndNumberOfComponentsFit) {
  EXPECT_EQ(error_of({}), "");
  for (int components = 1; components <= 3; ++components) {
    const auto k = static_cast<std::size_t>(components);
    EXPECT_EQ(error_of({{"a", FieldPlace::vertices, components, std::vector<double>(4 * k)},
                        {"a", FieldPlace::triangles, components, std::vector<double>(2 * k)}}),
              "");
  }
}

TEST(Fields, WithAnotherNumberOfValuesAreRefusedInOneSentence) {
  EXPECT_EQ(error_of({{"mach", FieldPlace::vertices, 1, std::vector<double>(3)}}),
            "field 'mach': 3 values found, 4 expected: 1 for each of 4 vertices");
  EXPECT_EQ(error_of({{"v", FieldPlace::triangles, 2, std::vector<double>(2)}}),
            "field 'v': 2 values found, 4 expected: 2 for each of 2 triangles");
}

TEST(Fields, WithBadNamesComponentsOrValuesAreRefused) {
  const std::vector<double> four(4);
  for (const std::string name : {"", "a\nb", "a\x7f"}) {
    EXPECT_NE(error_of({{name, FieldPlace::vertices, 1, four}}), "") << name;
  }
  EXPECT_EQ(error_of({{"a", FieldPlace::vertices, 4, four}}),
            "field 'a': 4 components found, 1 to 3 expected");
  EXPECT_EQ(error_of({{"a", FieldPlace::vertices, 0, {}}}), "field 'a': 0 components found, 1 to 3 expected");
  EXPECT_EQ(error_of({{"a", FieldPlace::vertices, 1, four}, {"a", FieldPlace::vertices, 1, four}}),
            "field 'a': a second one on vertices found, each name once expected");
  EXPECT_EQ(error_of({{"a", FieldPlace::vertices, 1, {0, 1, std::numeric_limits<double>::infinity(), 3}}}),
            "field 'a': inf found at number 2 of the vertices, finite values expected");
}

TEST(Fields, AreFoundByNameOnVerticesFirst) {
  const std::vector<Field> fields = {{"a", FieldPlace::triangles, 1, {}}, {"a", FieldPlace::vertices, 1, {}}};
  EXPECT_EQ(find_field(fields, "a"), &fields[1]);
  EXPECT_EQ(find_field(std::span(fields).first(1), "a"), &fields[0]);
  EXPECT_EQ(find_field(fields, "b"), nullptr);
}

}  // namespace
}  // namespace remodel
