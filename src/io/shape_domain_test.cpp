// Shapes of files as one domain.

#include "remodel/shape_domain.h"

#include <gtest/gtest.h>

#include <fstream>
#include <optional>

#include "io/test_meshes.h"

namespace remodel {
namespace {

using test::error_of;
using test::Scratch;

std::string write(const Scratch& scratch, const std::string& name, const std::string& text) {
  std::ofstream(scratch / name) << text;
  return (scratch / name).string();
}

// Rows of a section with its nose at `nose`.
std::string rows(double chord, Point nose) {
  const CstAirfoil section = named_airfoil("naca:2412", 5);
  std::string text;
  for (int i = 0; i <= 40; ++i) {
    const Point p = nose + chord * section.at(i / 40.0);
    text += std::to_string(p.x) + " " + std::to_string(p.y) + "\n";
  }
  return text;
}

std::string two_elements(const Scratch& scratch) {
  return write(scratch, "two.dat", "two\n" + rows(2.0, {0, 0}) + "999.0 999.0\n" + rows(0.6, {2.04, -0.06}));
}

void expect_refused(const std::vector<ShapeOfDomain>& shapes, const ShapeReading& reading,
                    const std::string& words) {
  const std::string message = error_of([&] { domain_of_shapes(shapes, {}, reading); });
  EXPECT_NE(message.find(words), std::string::npos) << message;
}

TEST(ShapeDomain, ElementsOfAFileKeepTheirPlaces) {
  const Scratch scratch;
  const ShapesDomain found = domain_of_shapes({{.shape = two_elements(scratch)}}, {.points = 60});
  ASSERT_EQ(found.domain.loops.size(), 3u);
  EXPECT_EQ(found.fits.size(), 2u);
  EXPECT_EQ(found.domain.loops[1].curves[0].name, "two_2");
  EXPECT_NEAR(found.domain.loops[1].placement.chord, 0.6, 1e-5);
  EXPECT_NEAR(found.domain.loops[1].placement.position.x, 2.04, 1e-5);
  EXPECT_NEAR(found.chord, 2.0, 1e-5);
  // The far field has 25 times the size of what it goes around.
  const Arc& farfield = std::get<Arc>(found.domain.loops[2].curves[0].shape);
  EXPECT_NEAR(farfield.radius, 25 * 2.64, 0.1);
  EXPECT_EQ(found.warnings.size(), 2u);
}

TEST(ShapeDomain, APointListIsMovedOnlyWhereItIsNotKept) {
  const Scratch scratch;
  const std::string file = write(scratch, "far.dat", "far\n" + rows(3.0, {5, 1}));
  ShapesDomain moved = domain_of_shapes({{.shape = file}}, {}, {.as_given = OutlineCurve::polyline});
  ShapesDomain kept =
      domain_of_shapes({{.shape = file}}, {}, {.as_given = OutlineCurve::polyline, .keep_coordinates = true});
  const auto least_x = [](const Domain& domain) {
    double least = 1e9;
    for (const Point p : domain.points(0)) least = std::min(least, p.x);
    return least;
  };
  EXPECT_NEAR(least_x(moved.domain), 0.0, 1e-6);
  EXPECT_NEAR(least_x(kept.domain), 5.0, 1e-5);
  EXPECT_FALSE(moved.outlines.at(0).kept);
  EXPECT_TRUE(kept.outlines.at(0).kept);
  EXPECT_EQ(moved.outlines[0].points, 40u);  // the last point is the first one again
}

TEST(ShapeDomain, AGraphStandsAlone) {
  const Scratch scratch;
  const std::string graph = write(scratch, "square.poly",
                                  "4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n"
                                  "4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n");
  const ShapesDomain found = domain_of_shapes({{.shape = graph}});
  EXPECT_TRUE(found.findings);
  EXPECT_FALSE(found.in_farfield);
  EXPECT_TRUE(is_whole_domain(graph));
  expect_refused({{.shape = graph}, {.shape = "naca:0012"}}, {}, "square.poly: holds a whole domain");
  expect_refused({{.shape = graph}}, {.keep_coordinates = true}, "keep_coordinates: given for");
}

TEST(ShapeDomain, WhatDoesNotGoTogetherIsRefused) {
  const Scratch scratch;
  expect_refused({}, {}, "shapes: found none");
  expect_refused({{.shape = "naca:0012"}}, {.as_given = OutlineCurve::spline},
                 "as_given: given for 'naca:0012'");
  expect_refused({{.shape = two_elements(scratch), .place = Placement{}}}, {}, "place: given for");
  expect_refused({{.shape = "naca:0012", .name = "a"}, {.shape = "naca:2412", .name = "a"}}, {},
                 "name: found 'a'");
}

TEST(ShapeDomain, SeveralElementsHaveMoreStationsAtTheirNoses) {
  const Scratch scratch;
  const auto largest_step_at_nose = [&](const std::optional<double>& share) {
    const ShapesDomain found =
        domain_of_shapes({{.shape = two_elements(scratch)}}, {.points = 60, .turning_share = share});
    const Parameters& stations = found.domain.loops[0].curves[0].parameters;
    return stations[30] - stations[29];
  };
  EXPECT_NEAR(largest_step_at_nose(0.0), 1.0 / 60, 1e-12);
  EXPECT_LT(largest_step_at_nose({}), 0.7 / 60);
  EXPECT_EQ(largest_step_at_nose({}), largest_step_at_nose(turning_share_of_elements));
}

TEST(ShapeDomain, TheNextDomainOfAMeshKeepsNamesAndStations) {
  const Scratch scratch;
  const Domain before =
      domain_of_shapes({{.shape = "naca:2412", .name = "main"},
                        {.shape = "naca:0012", .place = Placement{0.3, -20, {1.1, -0.1}}, .name = "flap"}},
                       {.points = 60, .turning_share = 0.5})
          .domain;
  Domain next = domain_of_shapes({{.shape = "naca:2412"},
                                  {.shape = "naca:0012", .place = Placement{0.3, -21, {1.1, -0.1}}}},
                                 discretisation_of(before))
                    .domain;
  EXPECT_EQ(next.loops[1].curves[0].name, "naca0012");
  take_names(next, before);
  EXPECT_EQ(next.loops[1].curves[0].name, "flap");
  for (Loop& loop : next.loops) EXPECT_TRUE(take_stations(loop, before));
  EXPECT_EQ(next.loops[1].curves[0].parameters, before.loops[1].curves[0].parameters);
}

}  // namespace
}  // namespace remodel
