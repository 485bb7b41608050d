#include "remodel/plot.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/test_meshes.h"
#include "remodel/io.h"

namespace remodel {
namespace {

using test::error_of;
using test::Scratch;

std::string drawn(const Plot& plot, const std::string& name) {
  const Scratch scratch;
  draw_plot(plot, scratch / name);
  return read_text(scratch / name);
}

Plot wave() {
  Plot plot{.x = {"x"}, .y = {"Cp"}, .caption = "a wave"};
  PlotCurve curve{"wave", {}};
  for (int i = 0; i <= 50; ++i) curve.points.push_back({0.02 * i, std::sin(0.2 * i) + 1.5});
  plot.curves.push_back(curve);
  return plot;
}

TEST(Plots, AreTheSameBytesEachTimeAndEverythingChangesThem) {
  Plot reversed = wave(), logarithmic = wave(), other = wave(), caption = wave();
  reversed.y.reversed = true;
  logarithmic.y.logarithmic = true;
  other.curves[0].points[7].y = 3.0;
  caption.caption = "another";
  for (const char* name : {"a.svg", "a.png"}) {
    EXPECT_EQ(drawn(wave(), name), drawn(wave(), name));
    for (const Plot& plot : {reversed, logarithmic, other, caption})
      EXPECT_NE(drawn(wave(), name), drawn(plot, name));
  }
  EXPECT_NE(drawn(wave(), "a.svg").find("</svg>"), std::string::npos);
}

TEST(Plots, OfOnePointOrOneValueAreNoTrouble) {
  Plot plot = wave();
  plot.curves = {{"", {{1.0, 1.0}}}};
  EXPECT_NE(drawn(plot, "a.png"), "");
  plot.y.logarithmic = true;
  EXPECT_NE(drawn(plot, "a.png"), "");
}

// Lines of an SVG: the grid's, the frame and the curves.
std::size_t lines_of(const Plot& plot) {
  const std::string text = drawn(plot, "a.svg");
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find("stroke-width", at)) != text.npos; ++at) ++count;
  return count;
}

TEST(Plots, HaveTicksOnALogarithmicAxisWithinADecade) {
  Plot plot{.x = {"design"}, .y = {.label = "objective"}};
  plot.curves = {{"", {{1.0, 0.046}, {2.0, 0.03}, {3.0, 0.018}}}};
  const std::size_t linear = lines_of(plot);
  plot.y.logarithmic = true;  // neither 0.1 nor 0.01 is on it
  EXPECT_GE(lines_of(plot) + 2, linear);
}

TEST(Plots, HaveTicksAtWholeNumbersAloneWhereThingsAreCounted) {
  for (const std::size_t designs : {1, 2, 3}) {
    Plot plot{.x = {.label = "design", .whole = true}, .y = {"objective"}};
    plot.curves = {{"", {}}};
    for (std::size_t i = 1; i <= designs; ++i) plot.curves[0].points.push_back({static_cast<double>(i), 1.0});
    Plot broken = plot;
    broken.x.whole = false;
    EXPECT_LT(lines_of(plot), lines_of(broken)) << designs;
  }
}

TEST(Plots, MarkTheFewPointsOfACurve) {
  Plot plot = wave();
  plot.curves.push_back({"another", {{0.5, 1.0}}});
  Plot without = plot;
  without.curves.back().points[0] = {0.5, 1.1};
  EXPECT_NE(drawn(plot, "a.png"), drawn(without, "a.png"));
}

TEST(Plots, RefuseInOneSentenceWhatTheyCannotShow) {
  Plot plot = wave();
  EXPECT_EQ(error_of([&] { draw_plot(plot, "a.pdf"); }),
            "a.pdf: extension '.pdf' found, .svg or .png expected");
  plot.width = 100;
  EXPECT_EQ(error_of([&] { draw_plot(plot, "a.svg"); }), "width: 100 found, 200 to 8000 pixels expected");
  plot = wave();
  plot.y.logarithmic = true;
  plot.curves[0].points[3].y = 0.0;
  EXPECT_EQ(error_of([&] { draw_plot(plot, "a.svg"); }), "plot: 0 found, a finite value above 0 expected");
  plot.curves.clear();
  EXPECT_EQ(error_of([&] { draw_plot(plot, "a.svg"); }), "plot: no points found, a curve expected");
}

}  // namespace
}  // namespace remodel
