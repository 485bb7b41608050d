#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "import/test_foreign.h"
#include "remodel/error.h"
#include "remodel/import.h"
#include "remodel/remodel.h"
#include "support.h"

namespace remodel {
namespace {

// An airfoil anywhere in a square, as a polygon with names.
struct Drawn {
  CstAirfoil airfoil = airfoil_catalogue()[0].airfoil();
  Point leading{2.0, 1.0};
  double chord = 1.5;
  double angle = 0.3;
  int points = 60;
  int base = 0;  // sides on a blunt trailing edge
  bool clockwise = true;
  std::size_t first = 7;
  std::vector<std::string> names{"wing"};  // of equal numbers of sides
};

Domain domain_of(const Drawn& drawn) {
  std::vector<Point> outline;
  for (int i = 0; i < drawn.points; ++i)
    outline.push_back(drawn.airfoil.at(static_cast<double>(i) / drawn.points));
  const Point lower = drawn.airfoil.at(1.0), upper = drawn.airfoil.at(0.0);
  for (int i = 0; i < drawn.base; ++i)
    outline.push_back(lower + (static_cast<double>(i) / drawn.base) * (upper - lower));
  for (Point& p : outline) {
    const Point along{drawn.chord * std::cos(drawn.angle), drawn.chord * std::sin(drawn.angle)};
    p = drawn.leading + p.x * along + p.y * Point{-along.y, along.x};
  }
  std::rotate(outline.begin(), outline.begin() + static_cast<std::ptrdiff_t>(drawn.first), outline.end());
  if (drawn.clockwise) std::reverse(outline.begin(), outline.end());
  outline.push_back(outline.front());
  Loop loop{.role = LoopRole::hole, .curves = {}};
  const std::size_t sides = (outline.size() - 1) / drawn.names.size();
  for (std::size_t k = 0; k < drawn.names.size(); ++k) {
    const auto begin = outline.begin() + static_cast<std::ptrdiff_t>(k * sides);
    const auto end =
        k + 1 == drawn.names.size() ? outline.end() : begin + static_cast<std::ptrdiff_t>(sides) + 1;
    loop.curves.push_back({.name = drawn.names[k],
                           .shape = Polyline{{begin, end}},
                           .parameters = Parameters::uniform(static_cast<std::size_t>(end - begin - 1))});
  }
  Domain domain{{loop, test::rectangle(LoopRole::outer, "outer", {-2, -2}, {6, 6}, 8)}};
  validate(domain);
  return domain;
}

TEST(AirfoilPlace, TheChordIsFoundWhereverTheAirfoilLies) {
  for (const double angle : {0.0, 0.3, -1.2, 2.9}) {
    for (const bool clockwise : {false, true}) {
      for (std::size_t airfoil = 0; airfoil < airfoil_catalogue().size(); ++airfoil) {
        SCOPED_TRACE(std::to_string(angle) + " " + std::to_string(airfoil));
        const Drawn drawn{
            .airfoil = airfoil_catalogue()[airfoil].airfoil(), .angle = angle, .clockwise = clockwise};
        const Domain domain = domain_of(drawn);
        const AirfoilPlace place = find_airfoil(domain, "wing", "mesh");
        const Point trailing = drawn.leading + drawn.chord * Point{std::cos(angle), std::sin(angle)};
        EXPECT_LT(distance(place.trailing, trailing), 1e-12);
        // The point farthest from the trailing edge: on thick noses a little beside x = 0.
        EXPECT_LT(distance(place.leading, drawn.leading), 0.01);
        EXPECT_EQ(place.base.size(), 0U);
        EXPECT_EQ(place.parameters.size(), 60U);
      }
    }
  }
}

// A symmetric section without a point on its nose: neither sheared nor turned, wherever it lies.
TEST(AirfoilPlace, ANoseBetweenTwoPointsIsFound) {
  const CstAirfoil section{.upper = {0.17, 0.16, 0.14, 0.15}, .lower = {-0.17, -0.16, -0.14, -0.15}};
  for (const double angle : {0.0, 0.4, -2.0})
    for (const bool clockwise : {false, true}) {
      SCOPED_TRACE(angle);
      Drawn drawn{.airfoil = section, .angle = angle, .points = 60, .clockwise = clockwise};
      Domain domain = domain_of(drawn);
      // Without the point at the nose there are two beside it, as far from the trailing edge.
      Polyline& outline = std::get<Polyline>(domain.loops[0].curves[0].shape);
      const auto at_nose = [&](Point p) { return distance(p, drawn.leading) < 1e-9; };
      ASSERT_EQ(std::erase_if(outline.points, at_nose), 1U);
      domain.loops[0].curves[0].parameters = Parameters::uniform(59);
      const AirfoilPlace place = find_airfoil(domain, "wing", "mesh");
      EXPECT_LT(distance(place.leading, drawn.leading), 1e-3 * drawn.chord);
      const Point chord = place.trailing - place.leading;
      EXPECT_NEAR(std::atan2(chord.y, chord.x), angle, 1e-9);
      ASSERT_EQ(place.parameters.size(), 59U);
      for (std::size_t i = 1; i < 59; ++i)
        EXPECT_NEAR(place.parameters[i] + place.parameters[59 - i], 1.0, 1e-9);
      const CstFit fit = fit_airfoil(domain, place, 3);
      EXPECT_LT(fit.max_error, 2e-3);
      for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(fit.airfoil.upper[i], -fit.airfoil.lower[i], 1e-6);
        EXPECT_NEAR(fit.airfoil.upper[i], section.upper[i], 0.01);
      }
      EXPECT_TRUE(one_to_one(domain, with_airfoil(domain, place, fit.airfoil)));
    }
}

// Symmetric sections have their leading edge where they are drawn: then the design is the one that was drawn.
TEST(AirfoilPlace, TheFitOfADrawnDesignIsTheDesign) {
  for (const bool clockwise : {false, true}) {
    Drawn drawn{.airfoil = {.upper = {0.17, 0.16, 0.14, 0.15}, .lower = {-0.17, -0.16, -0.14, -0.15}},
                .clockwise = clockwise};
    const Domain sharp = domain_of(drawn);
    const AirfoilPlace place = find_airfoil(sharp, "wing", "mesh");
    const CstFit fit = fit_airfoil(sharp, place, 3);
    EXPECT_LT(fit.max_error, 1e-12);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(fit.airfoil.upper[i], drawn.airfoil.upper[i], 1e-10);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(fit.airfoil.lower[i], drawn.airfoil.lower[i], 1e-10);
    EXPECT_EQ(fit.airfoil.te_upper, fit.airfoil.te_lower);

    drawn.airfoil.te_upper = 0.004;
    drawn.airfoil.te_lower = -0.004;
    drawn.base = 2;
    const Domain blunt = domain_of(drawn);
    const AirfoilPlace cut = find_airfoil(blunt, "wing", "mesh");
    EXPECT_EQ(cut.base.size(), 2U);
    EXPECT_EQ(cut.parameters.size(), 60U);
    const CstFit open = fit_airfoil(blunt, cut, 3);
    EXPECT_LT(open.max_error, 1e-12);
    EXPECT_NEAR(open.airfoil.te_upper, 0.004, 1e-12);
    EXPECT_NEAR(open.airfoil.te_lower, -0.004, 1e-12);
    EXPECT_NEAR(open.airfoil.upper[2], drawn.airfoil.upper[2], 1e-10);
  }
}

// The same airfoil in its own place: every vertex has its own again, whichever way the loop runs.
TEST(AirfoilPlace, AnAirfoilInItsOwnPlaceCorrespondsOneToOne) {
  for (const int base : {0, 1, 3}) {
    for (const bool clockwise : {false, true}) {
      for (const auto& names : {std::vector<std::string>{"wing"}, {"wing", "flap", "wing", "tip"}}) {
        SCOPED_TRACE(std::to_string(base) + " " + std::to_string(clockwise) + " " +
                     std::to_string(names.size()));
        Drawn drawn{.airfoil = {.upper = {0.17, 0.16, 0.14, 0.15}, .lower = {-0.17, -0.16, -0.14, -0.15}},
                    .base = base,
                    .clockwise = clockwise,
                    .names = names};
        if (base > 0) drawn.airfoil.te_upper = 0.004, drawn.airfoil.te_lower = -0.004;
        const Domain domain = domain_of(drawn);
        const AirfoilPlace place = find_airfoil(domain, "wing", "mesh");
        const Domain again = with_airfoil(domain, place, drawn.airfoil);
        ASSERT_NO_THROW(validate(again));
        const auto before = domain.stations(0), after = again.stations(0);
        ASSERT_EQ(before.size(), after.size());
        for (std::size_t i = 0; i < before.size(); ++i)
          EXPECT_LT(distance(domain.at(before[i]), again.at(after[i])), 1e-7) << i;
        EXPECT_TRUE(one_to_one(domain, again));
        EXPECT_EQ(again.loops[0].curves.size(), names.size());
      }
    }
  }
}

TEST(AirfoilPlace, TheNumberOfPointsCanBeAnother) {
  const Domain domain = domain_of({});
  const AirfoilPlace place = with_points(find_airfoil(domain, "wing", "mesh"), 80);
  const Domain next = with_airfoil(domain, place, airfoil_catalogue()[4].airfoil());
  EXPECT_NO_THROW(validate(next));
  EXPECT_EQ(next.stations(0).size(), 80U);
  EXPECT_THROW(with_points(place, 81), Error);
  EXPECT_THROW(with_points(place, 6), Error);
  EXPECT_THROW(with_points(find_airfoil(domain_of({.names = {"wing", "tail"}}), "wing", "mesh"), 80), Error);
}

TEST(AirfoilPlace, BoundariesThatAreNoBodyAreRefused) {
  const auto problem = [](const Domain& domain, const std::string& name) {
    try {
      find_airfoil(domain, name, "mesh.su2");
      return std::string("found");
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  const Domain domain = domain_of({});
  EXPECT_EQ(problem(domain, "wings"), "mesh.su2: no boundary 'wings' found, one of 'wing', 'outer' expected");
  EXPECT_EQ(problem(domain, "outer"),
            "mesh.su2: boundary 'outer' surrounds the mesh, the outline of a body in it expected");
  const Domain holes = test::with_holes({test::circle_hole(0.3, 0.3, 0.1), test::circle_hole(0.7, 0.7, 0.1)});
  EXPECT_EQ(problem(holes, "hole"), "mesh.su2: boundary 'hole' has 2 bodies, one expected");
}

TEST(AirfoilPlace, OfTwoSharpEdgesTheRearmostTrails) {
  Domain domain = domain_of({});
  domain.loops[0] = test::polygon(LoopRole::hole, "wing", {{1, 1}, {2, 0.9}, {3, 1}, {2, 1.1}}, 5);
  const AirfoilPlace place = find_airfoil(domain, "wing", "mesh");
  EXPECT_EQ(place.trailing, (Point{3, 1}));
  EXPECT_EQ(place.leading, (Point{1, 1}));
  EXPECT_EQ(place.parameters.size(), 20U);
}

// As in a file that names no boundary at all.
TEST(AirfoilPlace, ANameThatTheOuterBoundaryHasTooMeansTheBody) {
  Domain domain = domain_of({});
  for (Loop& loop : domain.loops) loop.curves.front().name = "boundary";
  EXPECT_EQ(find_airfoil(domain, "boundary", "mesh").loop, 0U);
}

// Bodies that are no airfoils have a place too: the rearmost point where there is no corner.
TEST(AirfoilPlace, ABodyWithoutACornerEndsAtItsLargestX) {
  const Domain domain = test::with_holes({test::circle_hole(0.5, 0.5, 0.2, 40)});
  const AirfoilPlace place = find_airfoil(domain, "hole", "mesh");
  EXPECT_LT(distance(place.trailing, {0.7, 0.5}), 1e-12);
  EXPECT_LT(distance(place.leading, {0.3, 0.5}), 1e-12);
  EXPECT_NO_THROW(validate(with_airfoil(domain, place, airfoil_catalogue()[0].airfoil())));
}

}  // namespace
}  // namespace remodel
