#include "remodel/flow_plots.h"

#include <gtest/gtest.h>

#include "remodel/error.h"

namespace remodel {
namespace {

FrozenMesh six_points() {
  FrozenMesh mesh;
  for (int i = 0; i < 6; ++i) mesh.points.push_back({100.0 + i, 0.0});
  return mesh;
}

TEST(CpPlot, EveryCurveHasAName) {
  FrozenMesh mesh = six_points();
  // Edges of a file come in any order; those of the wall are two pieces.
  mesh.boundaries = {{"floor", {{1, 2}, {0, 1}, {2, 3}}}, {"roof", {{5, 4}}}, {"farfield", {{3, 4}}}};
  const std::vector<double> cp = {0, 1, 2, 3, 4, 5};
  const Plot plot = cp_plot(mesh, {"farfield"}, cp, duct_caption(0.3), "--cp-plot");
  ASSERT_EQ(plot.curves.size(), 2U);
  EXPECT_EQ(plot.curves[0].name, "floor");
  EXPECT_EQ(plot.curves[0].points, (std::vector<Point>{{100, 0}, {101, 1}, {102, 2}, {103, 3}}));
  EXPECT_EQ(plot.curves[1].name, "roof");
  mesh.boundaries[0].edges = {{1, 0}, {0, 1}, {2, 3}, {3, 2}};  // two bodies of one name
  const Plot two = cp_plot(mesh, {"farfield"}, cp, "", "--cp-plot");
  ASSERT_EQ(two.curves.size(), 3U);
  EXPECT_EQ(two.curves[0].name, "floor 1");
  EXPECT_EQ(two.curves[0].points, (std::vector<Point>{{101, 1}, {100, 0}, {101, 1}}));
  EXPECT_EQ(two.curves[1].name, "floor 2");
}

TEST(CpPlot, SaysWhatItShows) {
  FrozenMesh mesh = six_points();
  mesh.boundaries = {{"floor", {{0, 1}}}};
  const std::vector<double> cp(6, 0.0);
  EXPECT_EQ(cp_plot(mesh, {"farfield"}, cp, duct_caption(0.3), "--cp-plot").x.label, "x");
  EXPECT_EQ(duct_caption(0.3), "M 0.3");
  mesh.boundaries.clear();
  EXPECT_THROW(cp_plot(mesh, {"farfield"}, cp, "", "--cp-plot"), Error);
}

}  // namespace
}  // namespace remodel
