#include "remodel/draw.h"

#include <cairo.h>
#include <gtest/gtest.h>

#include <memory>

#include "draw/clip.h"
#include "draw/color_scale.h"
#include "io/test_meshes.h"
#include "remodel/io.h"

namespace remodel {
namespace {

using draw_detail::Box;
using test::error_of;
using test::Scratch;

int png_number(const std::string& png, std::size_t at) {
  int value = 0;
  for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | static_cast<unsigned char>(png[i]);
  return value;
}

std::string drawn(const FrozenMesh& mesh, const std::string& name, const DrawOptions& options = {}) {
  const Scratch scratch;
  draw(mesh, scratch / name, options);
  return read_text(scratch / name);
}

TEST(Draw, MakesAPngOfTheAskedWidthAndTheWindowsProportions) {
  const std::string png = drawn(test::square_ring(), "a.png", {.window = {{0, 0, 2, 1}}, .width = 800});
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_EQ(png_number(png, 16), 800);
  EXPECT_EQ(png_number(png, 20), 400 + 42);
}

TEST(Draw, MakesAnSvg) {
  const std::string svg = drawn(test::square_ring(), "a.svg");
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
}

TEST(Draw, TheSameMeshGivesTheSameBytes) {
  for (const char* name : {"a.png", "a.svg"}) {
    EXPECT_EQ(drawn(test::full_square_ring(), name), drawn(test::full_square_ring(), name)) << name;
  }
}

TEST(Draw, DrawsOnlyWhatMeetsTheWindow) {
  const FrozenMesh mesh = test::graded_ring(200, 60);
  const auto all = drawn(mesh, "a.svg").size();
  const auto few = drawn(mesh, "a.svg", {.window = {{0.95, -0.05, 1.1, 0.05}}}).size();
  EXPECT_LT(few, all / 4);
}

TEST(Draw, AWindowOfABillionthIsNoTroubleAndNeitherIsAnEmptyOne) {
  const FrozenMesh mesh = test::graded_ring(50, 20);
  for (const char* name : {"a.png", "a.svg"}) {
    EXPECT_NE(drawn(mesh, name, {.window = {{1.2, 0.3, 1.2 + 1e-9, 0.3 + 1e-9}}}), "");
    EXPECT_NE(drawn(mesh, name, {.window = {{100, 100, 101, 101}}}), "");
  }
}

// 0xRRGGBB of each pixel, row by row.
std::vector<std::uint32_t> pixels_of(const FrozenMesh& mesh, const DrawOptions& options, int& width) {
  const Scratch scratch;
  draw(mesh, scratch / "a.png", options);
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> image(
      cairo_image_surface_create_from_png((scratch / "a.png").c_str()), cairo_surface_destroy);
  width = cairo_image_surface_get_width(image.get());
  std::vector<std::uint32_t> pixels;
  for (int y = 0; y < cairo_image_surface_get_height(image.get()); ++y) {
    const auto* row = reinterpret_cast<const std::uint32_t*>(cairo_image_surface_get_data(image.get()) +
                                                             y * cairo_image_surface_get_stride(image.get()));
    for (int x = 0; x < width; ++x) pixels.push_back(row[x] & 0xffffff);
  }
  return pixels;
}

TEST(Draw, ColoursTheDomainWithoutGapsAndLeavesTheHoleWhite) {
  int width = 0;
  const auto pixels = pixels_of(test::square_ring(), {.window = {{0, 0, 3, 3}}, .width = 300}, width);
  ASSERT_EQ(width, 300);
  for (int y = 2; y < 298; ++y) {
    for (int x = 2; x < 298; ++x) {
      // Outlines are a few pixels wide; the hole is from 1 to 2 chords, its upper left corner a little
      // higher.
      const bool inside = x > 104 && x < 196 && y > 104 && y < 196;
      const bool outside = x < 96 || x > 204 || y < 88 || y > 204;
      const auto color = pixels[static_cast<std::size_t>(y * width + x)];
      if (inside) {
        ASSERT_EQ(color, 0xffffffU) << x << ' ' << y;
      }
      if (outside) {
        ASSERT_LT(color >> 16, 0xf8U) << x << ' ' << y;
      }
    }
  }
}

TEST(Draw, EachColouringIsAnotherPicture) {
  const FrozenMesh mesh = test::full_square_ring();
  const auto quality = drawn(mesh, "a.png");
  const auto length = drawn(mesh, "a.png", {.color = DrawColor::length_scale});
  const auto age = drawn(mesh, "a.png", {.color = DrawColor::age});
  EXPECT_NE(quality, length);
  EXPECT_NE(quality, age);
  EXPECT_NE(length, age);
  FrozenMesh with_errors = mesh;
  with_errors.gradation_error.assign(mesh.triangles.size(), -0.2);
  const auto gradation = drawn(with_errors, "a.png", {.color = DrawColor::gradation});
  for (const auto* other : {&quality, &length, &age}) EXPECT_NE(gradation, *other);
}

TEST(Draw, RefusesOtherExtensionsEmptyWindowsAndMissingData) {
  const FrozenMesh mesh = test::square_ring();
  EXPECT_EQ(error_of([&] { draw(mesh, "a.jpg"); }), "a.jpg: extension '.jpg' found, .svg or .png expected");
  EXPECT_EQ(error_of([&] {
              draw(mesh, "a.png", {.window = {{1, 0, 1, 2}}});
            }),
            "window: 1,0,1,2 found, x0,y0,x1,y1 with x0 < x1 and y0 < y1 expected");
  EXPECT_NE(error_of([&] { draw(mesh, "a.png", {.window = {{0, 0, std::nan(""), 2}}}); }), "");
  EXPECT_EQ(error_of([&] { draw(mesh, "a.png", {.color = DrawColor::age}); }),
            "color age: a mesh without birth steps found, one with them expected");
  EXPECT_EQ(error_of([&] { draw(mesh, "a.png", {.color = DrawColor::length_scale}); }),
            "color length-scale: a mesh without length scales found, one with them expected");
  EXPECT_EQ(error_of([&] { draw(mesh, "a.png", {.color = DrawColor::gradation}); }),
            "color gradation: a mesh without gradation errors found, one with them expected");
  EXPECT_EQ(error_of([&] { draw(mesh, "a.png", {.width = 0}); }),
            "width: 0 found, 100 to 8000 pixels expected");
  EXPECT_EQ(error_of([&] { draw({}, "a.png"); }), "draw: an empty mesh found, one with points expected");
}

TEST(ColorScale, MinimumAnglesRunFromTwentyToSixtyDegrees) {
  FrozenMesh mesh;
  mesh.points = {{0, 0}, {1, 0}, {0.5, std::sqrt(0.75)}, {1, 0.1}, {1, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  const auto scale = draw_detail::color_scale(mesh, {0, 1, 2}, DrawColor::quality);
  EXPECT_NEAR(scale.positions[0], 1.0, 1e-12);
  EXPECT_EQ(scale.positions[1], 0.0);
  EXPECT_NEAR(scale.positions[2], 25.0 / 40.0, 1e-12);
}

TEST(ColorScale, TheNewestTrianglesAreBrightest) {
  const auto scale = draw_detail::color_scale(test::full_square_ring(), {0, 7}, DrawColor::age);
  EXPECT_EQ(scale.positions, (std::vector<double>{0.0, 1.0}));
  EXPECT_EQ(scale.low, "9");
  EXPECT_EQ(scale.high, "0");
}

TEST(ColorScale, QuadrilateralsHaveTheirSmallestCorner) {
  FrozenMesh mesh = test::mixed_ring();
  const auto scale = draw_detail::color_scale(mesh, {4, 5}, DrawColor::quality);
  EXPECT_NEAR(scale.positions.at(0), (45.0 - 20.0) / 40.0, 1e-12);  // between the squares' sides and diagonals
  mesh.birth = {0, 1, 2, 3};
  EXPECT_EQ(draw_detail::color_scale(mesh, {3, 4}, DrawColor::age).positions, (std::vector<double>{1, 0}));
  mesh.fate = {Fate::kept, Fate::kept, Fate::kept, Fate::kept, Fate::moved, Fate::made};
  EXPECT_EQ(draw_detail::color_scale(mesh, {4, 5}, DrawColor::fate).positions, (std::vector<double>{0.5, 1}));
  EXPECT_EQ(draw_detail::color_scale(mesh, {3, 5}, DrawColor::region).positions, (std::vector<double>{0, 1}));
}

TEST(ColorScale, FatesHaveAColourEach) {
  FrozenMesh mesh = test::full_square_ring();
  mesh.fate.assign(mesh.triangles.size(), Fate::kept);
  mesh.fate[1] = Fate::moved;
  mesh.fate[2] = Fate::made;
  const auto scale = draw_detail::color_scale(mesh, {0, 1, 2}, DrawColor::fate);
  EXPECT_EQ(scale.positions, (std::vector<double>{0.0, 0.5, 1.0}));
  EXPECT_EQ(scale.legend_steps, 3);
  mesh.fate.clear();
  EXPECT_EQ(error_of([&] { draw(mesh, "a.png", {.color = DrawColor::fate}); }),
            "color fate: a mesh without fates found, one with them expected");
}

TEST(ColorScale, RegionsHaveAColourEach) {
  FrozenMesh mesh = test::full_square_ring();
  EXPECT_EQ(error_of([&] { draw(mesh, "a.png", {.color = DrawColor::region}); }),
            "color region: a mesh of one region found, one with several expected");
  mesh.region_names = {"water", "oil", "sand"};
  mesh.region.assign(mesh.triangles.size(), 0);
  mesh.region[1] = 2;
  const auto scale = draw_detail::color_scale(mesh, {0, 1}, DrawColor::region);
  EXPECT_EQ(scale.positions, (std::vector<double>{0.0, 1.0}));
  EXPECT_EQ(scale.legend_steps, 3);
  EXPECT_EQ(scale.title, "Regions water, oil, sand:");
}

TEST(ColorScale, GradationErrorsRunFromHalfToTwiceAndDivergeAtZero) {
  FrozenMesh mesh = test::full_square_ring();
  mesh.gradation_error.assign(mesh.triangles.size(), 0.0);
  mesh.gradation_error[0] = -std::log(2.0);
  mesh.gradation_error[1] = 0.5 * std::log(2.0);
  mesh.gradation_error[3] = 2.0;
  const auto scale = draw_detail::color_scale(mesh, {0, 1, 2, 3}, DrawColor::gradation);
  EXPECT_EQ(scale.positions, (std::vector<double>{0.0, 0.75, 0.5, 1.0}));
  EXPECT_EQ(scale.map, draw_detail::ColorMap::diverging);
  const auto blue = draw_detail::color_at(scale.map, 0.0), grey = draw_detail::color_at(scale.map, 0.5),
             red = draw_detail::color_at(scale.map, 1.0);
  EXPECT_GT(blue.blue, blue.red);
  EXPECT_GT(red.red, red.blue);
  EXPECT_EQ(grey.red, grey.blue);
}

TEST(Clip, KeepsWhatIsInsideAndCutsWhatIsNot) {
  const Box box{{0, 0}, {1, 1}};
  EXPECT_EQ(draw_detail::clip_polygon({{0.1, 0.1}, {0.9, 0.1}, {0.5, 0.9}}, box).size(), 3U);
  EXPECT_EQ(draw_detail::clip_polygon({{-9, -9}, {9, -9}, {0, 9}}, box).size(), 4U);
  EXPECT_TRUE(draw_detail::clip_polygon({{2, 2}, {3, 2}, {2, 3}}, box).empty());
  const auto part = draw_detail::clip_segment({-1, 0.5}, {3, 0.5}, box);
  ASSERT_TRUE(part);
  EXPECT_EQ(part->first, (Point{0, 0.5}));
  EXPECT_EQ(part->second, (Point{1, 0.5}));
  EXPECT_FALSE(draw_detail::clip_segment({-1, 2}, {3, 2}, box));
  EXPECT_FALSE(draw_detail::clip_segment({-1, 0.5}, {0.5, 2.5}, box));
}

}  // namespace
}  // namespace remodel
