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
