#include "draw/field_painter.h"

#include <gtest/gtest.h>

#include <memory>

#include "draw/color_scale.h"
#include "io/test_meshes.h"
#include "remodel/draw.h"
#include "remodel/io.h"

namespace remodel {
namespace {

using draw_detail::ValuedPoint;
using test::error_of;
using test::Scratch;

// A rectangle of 2 by 1, of coarse triangles, and the field x on it.
FrozenMesh rectangle() {
  FrozenMesh mesh;
  mesh.points = {{0, 0}, {2, 0}, {2, 1}, {0, 1}, {0.7, 0.4}};
  mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  mesh.boundaries = {{"wall", {{0, 1}, {1, 2}, {2, 3}, {3, 0}}}};
  return mesh;
}
Field field_x(const FrozenMesh& mesh) {
  Field field{"x", FieldPlace::vertices, 1, {}};
  for (const Point p : mesh.points) field.values.push_back(p.x);
  return field;
}

std::string drawn(const FrozenMesh& mesh, const std::string& name, const DrawOptions& options) {
  const Scratch scratch;
  draw(mesh, scratch / name, options);
  return read_text(scratch / name);
}

double area_of(const std::vector<ValuedPoint>& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    twice += cross(polygon[i].point, polygon[(i + 1) % polygon.size()].point);
  return 0.5 * twice;
}

TEST(FieldPicture, BandsOfATriangleAddUpToItAndHoldTheirValuesAlone) {
  const std::vector<ValuedPoint> triangle = {{{0, 0}, -0.3}, {{1, 0.1}, 1.7}, {{0.2, 0.9}, 0.4}};
  double sum = 0.0;
  for (int band = -10; band < 20; ++band) {
    const double low = 0.1 * band, high = 0.1 * (band + 1);
    const auto part = draw_detail::between_values(triangle, low, high);
    for (const auto& corner : part) {
      EXPECT_GE(corner.value, low - 1e-15);
      EXPECT_LE(corner.value, high + 1e-15);
    }
    sum += area_of(part);
  }
  EXPECT_NEAR(sum, area_of(triangle), 1e-15);
  EXPECT_TRUE(draw_detail::between_values(triangle, 2.0, 3.0).empty());
}

TEST(FieldPicture, TicksAreRoundNumbersInsideTheRange) {
  EXPECT_EQ(draw_detail::ticks_within(0.0, 1.0).size(), 11U);
  for (const auto& [low, high] : {std::pair{-0.37, 1.49}, {0.499, 0.501}, {-3e5, 2e7}, {1e-9, 7e-9}}) {
    const auto ticks = draw_detail::ticks_within(low, high);
    EXPECT_GE(ticks.size(), 4U) << low;
    EXPECT_LE(ticks.size(), 11U) << low;
    EXPECT_GE(ticks.front(), low - 1e-8 * (high - low));
    EXPECT_LE(ticks.back(), high + 1e-8 * (high - low));
  }
}

TEST(FieldPicture, ColoursFollowALinearFieldWithoutGapsWhateverTheTriangles) {
  const Scratch scratch;
  const FrozenMesh mesh = rectangle();
  draw(mesh, scratch / "a.png", {.window = {{0, 0, 2, 1}}, .field = DrawField{field_x(mesh)}, .width = 400});
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> image(
      cairo_image_surface_create_from_png((scratch / "a.png").c_str()), cairo_surface_destroy);
  ASSERT_EQ(cairo_image_surface_get_width(image.get()), 400);
  const auto* bytes = cairo_image_surface_get_data(image.get());
  const int stride = cairo_image_surface_get_stride(image.get());
  for (int y = 5; y < 195; ++y) {
    const auto* row = reinterpret_cast<const std::uint32_t*>(bytes + y * stride);
    for (int x = 5; x < 395; ++x) {
      const auto color = draw_detail::color_at(draw_detail::ColorMap::sequential, (x + 0.5) / 400.0);
      ASSERT_NEAR((row[x] >> 16 & 0xff) / 255.0, color.red, 0.03) << x << ' ' << y;
      ASSERT_NEAR((row[x] >> 8 & 0xff) / 255.0, color.green, 0.03) << x << ' ' << y;
      ASSERT_NEAR((row[x] & 0xff) / 255.0, color.blue, 0.03) << x << ' ' << y;
    }
  }
}

TEST(FieldPicture, TheSameFieldGivesTheSameBytesAndOptionsChangeThem) {
  const FrozenMesh mesh = rectangle();
  for (const char* name : {"a.png", "a.svg"}) {
    const DrawOptions plain{.field = DrawField{field_x(mesh)}};
    DrawOptions lines = plain, range = plain, label = plain;
    lines.field->iso_lines = 5;
    range.field->range = {{0.0, 1.0}};
    label.field->label = "abscissa";
    const std::string picture = drawn(mesh, name, plain);
    EXPECT_EQ(picture, drawn(mesh, name, plain));
    for (const DrawOptions& other : {lines, range, label}) EXPECT_NE(picture, drawn(mesh, name, other));
  }
}

TEST(FieldPicture, ConstantFieldsFieldsOnTrianglesAndVectorsAreDrawn) {
  const FrozenMesh mesh = rectangle();
  const Field constant{"c", FieldPlace::vertices, 1, std::vector<double>(5, 0.5)};
  const Field cells{"t", FieldPlace::triangles, 1, {1, 2, 3, 4}};
  const Field vectors{"v", FieldPlace::vertices, 2, std::vector<double>(10, -1.0)};
  for (const Field& field : {constant, cells, vectors})
    EXPECT_NE(drawn(mesh, "a.svg", {.field = DrawField{field}}), "") << field.name;
}

TEST(FieldPicture, QuadrilateralsAreDrawnAsTwoTriangles) {
  const FrozenMesh mixed = test::mixed_ring(), split = with_split_quads(mixed);
  const Field field = field_x(mixed);
  for (const int lines : {0, 5}) {
    const DrawOptions options{.field = DrawField{.field = field, .iso_lines = lines}, .caption = "x"};
    EXPECT_EQ(drawn(mixed, "a.svg", options), drawn(split, "a.svg", options));
  }
  const Field on_cells{"c", FieldPlace::triangles, 1, {1, 2, 3, 4, 5, 6}};
  EXPECT_NE(drawn(mixed, "a.svg", {.field = DrawField{.field = on_cells}}).find("</svg>"), std::string::npos);
}

TEST(FieldPicture, RefusesInOneSentenceWhatItCannotDraw) {
  const FrozenMesh mesh = rectangle();
  const auto refusal = [&](const DrawField& field) {
    return error_of([&] { draw(mesh, "a.png", {.field = field}); });
  };
  const Field cells{"t", FieldPlace::triangles, 1, {1, 2, 3, 4}};
  EXPECT_EQ(refusal({.field = cells, .iso_lines = 3}),
            "iso-lines: a field on triangles found, 't', one on vertices expected");
  EXPECT_EQ(refusal({.field = field_x(mesh), .iso_lines = 201}), "iso-lines: 201 found, 0 to 200 expected");
  EXPECT_EQ(refusal({.field = field_x(mesh), .range = {{2.0, 1.0}}}),
            "range: 2:1 found, two numbers A:B with A < B expected");
  EXPECT_EQ(refusal({.field = {"t", FieldPlace::triangles, 1, {1, 2}}}),
            "field 't': 2 values found, 4 expected: 1 for each of 4 triangles");
}

}  // namespace
}  // namespace remodel
