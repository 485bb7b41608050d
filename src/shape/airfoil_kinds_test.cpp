// Coordinate files as other programs write them.

#include <gtest/gtest.h>

#include <functional>
#include <sstream>

#include "remodel/airfoil.h"
#include "remodel/error.h"

namespace remodel {
namespace {

const std::vector<Point> upper{{0.0, 0.0}, {0.1, 0.05}, {0.3, 0.09}, {0.7, 0.06}, {1.0, 0.0}};
const std::vector<Point> lower{{0.0, 0.0}, {0.1, -0.02}, {0.3, -0.03}, {0.7, -0.01}, {1.0, 0.0}};

using Format = std::function<std::string(Point)>;
std::string number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}
std::string plain(Point p) {
  return number(p.x) + " " + number(p.y);
}

std::string rows(const std::vector<Point>& points, const Format& format = plain) {
  std::string text;
  for (const Point p : points) text += format(p) + "\n";
  return text;
}

std::vector<Point> selig() {
  std::vector<Point> points(upper.rbegin(), upper.rend());
  points.insert(points.end(), lower.begin() + 1, lower.end());
  return points;
}

void expect_wedge(const AirfoilCoordinates& airfoil) {
  ASSERT_EQ(airfoil.upper.size(), upper.size());
  ASSERT_EQ(airfoil.lower.size(), lower.size());
  for (std::size_t i = 0; i < upper.size(); ++i) {
    EXPECT_LT(squared_distance(airfoil.upper[i], upper[i]), 1e-24) << i;
    EXPECT_LT(squared_distance(airfoil.lower[i], lower[i]), 1e-24) << i;
  }
}

std::string refusal(const std::string& text) {
  try {
    parse_airfoil(text, "file.txt");
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::format);
    return e.what();
  }
  ADD_FAILURE() << "accepted: " << text.substr(0, 200);
  return {};
}

bool says(const std::string& message, const std::string& part) {
  return message.find(part) != std::string::npos;
}

std::string with_commas(std::string text) {
  for (char& c : text)
    if (c == '.') c = ',';
  return text;
}

TEST(AirfoilKinds, ReadsSemicolonsAndDecimalCommas) {
  const auto semicolon = [](Point p) { return number(p.x) + ";" + number(p.y); };
  expect_wedge(parse_airfoil("x;y\n" + rows(selig(), semicolon), "file.txt"));
  expect_wedge(parse_airfoil("x;y\n" + with_commas(rows(selig(), semicolon)), "file.txt"));
  expect_wedge(parse_airfoil("wedge\r\n" + with_commas(rows(selig())), "file.txt"));
  expect_wedge(parse_airfoil(
      "wedge\n" +
          with_commas(rows(selig(), [](Point p) { return " " + number(p.x) + "\t" + number(p.y) + " ;"; })),
      "file.txt"));
}

TEST(AirfoilKinds, TakesThePlaneOfThreeColumnsAndSaysSo) {
  const auto check = [](const Format& format, const std::string& left_out) {
    const AirfoilCoordinates airfoil = parse_airfoil("wedge\n" + rows(selig(), format), "file.txt");
    expect_wedge(airfoil);
    ASSERT_EQ(airfoil.warnings.size(), 1u);
    EXPECT_TRUE(says(airfoil.warnings[0], "the " + left_out)) << airfoil.warnings[0];
  };
  check([](Point p) { return plain(p) + " 0.25"; }, "third");
  check([](Point p) { return number(p.x) + " 0 " + number(p.y); }, "second");
  check([](Point p) { return "2.5, " + number(p.x) + ", " + number(p.y); }, "first");
  int i = 0;
  check([&i](Point p) { return std::to_string(++i) + " " + plain(p); }, "first");
  EXPECT_TRUE(says(refusal(rows(selig(), [](Point p) { return plain(p) + " " + number(p.x * p.y); })),
                   "three columns, none of which"));
}

TEST(AirfoilKinds, ReadsFilesOfOpenFast) {
  const std::string head =
      "        10   NumCoords         ! The number of coordinates in the airfoil shape file (including an "
      "extra "
      "coordinate for airfoil reference).\n"
      "! ......... x-y coordinates are next if NumCoords > 0 .............\n"
      "! x-y coordinate of airfoil reference\n!  x/c        y/c\n0.25       0\n"
      "! coordinates of airfoil shape\n!  x/c        y/c\n";
  expect_wedge(parse_airfoil(head + rows(selig()), "file.txt"));
  EXPECT_TRUE(says(refusal(head + rows(selig()) + "1 0\n"), "NumCoords"));
  EXPECT_TRUE(says(refusal("! ------------ AirfoilInfo v1.01.x Input File ----\n\"DEFAULT\" InterpOrd\n"
                           "@\"coords.txt\" NumCoords\n-180 0 0.02 0\n"),
                   "AirfoilInfo file of OpenFAST"));
}

TEST(AirfoilKinds, ReadsFilesOfOpenVsp) {
  const std::string head = "WEDGE GEOM AIRFOIL FILE\nWedge\n";
  expect_wedge(parse_airfoil(head + "0\tSym Flag (0 - No, 1 - Yes)\n5\tNum Pnts Upper\n5\tNum Pnts Lower\n" +
                                 rows(upper) + "\n" + rows(lower),
                             "wedge.af"));
  const AirfoilCoordinates symmetric = parse_airfoil(
      head + "1\tSym Flag (0 - No, 1 - Yes)\n5\tNum Pnts Upper\n5\tNum Pnts Lower\n" + rows(upper),
      "wedge.af");
  EXPECT_EQ(symmetric.lower[2].y, -symmetric.upper[2].y);
  EXPECT_TRUE(says(refusal("# BEZIER AIRFOIL\n# wedge\n0 0\n0 .1\n1 .1\n1 0\n"), "control points"));
}

TEST(AirfoilKinds, ReadsTwoSurfacesWithoutTheirCounts) {
  expect_wedge(parse_airfoil("wedge\n\n" + rows(upper) + "\n" + rows(lower), "file.txt"));
  expect_wedge(parse_airfoil("wedge\n\n" + rows(lower) + "\n\n" + rows(upper), "file.txt"));
}

TEST(AirfoilKinds, PassesOverDatesAndAddressesBehindTheCoordinates) {
  for (const std::string footer :
       {"\n26/10/2001 http://www.example.org/forum?t=1\n", "\nhttp://example.org/main.htm\n25/09/2007",
        "\n9%_1.4%_CM0=0.015 http://example.org\n28/12/2005    1.000733  -->1.0\n",
        "\n(15%)\n Posted by: J. D.\n",
        "\n*modification 0.999975->1.000000    0.002500 / 1.000025\n\n===========\n"})
    expect_wedge(parse_airfoil("wedge\n" + rows(selig()) + footer, "file.txt"));
}

// Blocks that are outlines each, set apart by 999, by a name or by an empty line; what is none is no element.
TEST(AirfoilKinds, TellsTheElementsOfAFileApart) {
  std::vector<Point> flap = selig();
  for (Point& p : flap) p = Point{1.02, -0.03} + 0.3 * p;
  for (const std::string between :
       {"999. 999.\n", " 999.0  999.0\n\n", "\n", "FLAP\n", "\n# flap\nFlap 2\n"}) {
    const std::string text = "MAIN\n" + rows(selig()) + between + rows(flap);
    const AirfoilOutlines file = parse_outlines(text, "file.txt");
    ASSERT_EQ(file.elements.size(), 2u) << between;
    EXPECT_EQ(file.elements[0].points, selig());
    for (std::size_t i = 0; i < flap.size(); ++i)
      EXPECT_LT(squared_distance(file.elements[1].points[i], flap[i]), 1e-12) << between << i;
    EXPECT_TRUE(says(refusal(text), "found 2 elements"));
  }
  EXPECT_EQ(parse_outlines("wedge\n" + rows(selig()) + "999. 999.\n", "file.txt").elements.size(), 1u);
  EXPECT_TRUE(says(refusal("wedge\n" + rows(upper) + "lower surface\n" + rows(lower)), "\"lower surface\""));
}

TEST(AirfoilKinds, NamesFilesOfOtherKinds) {
  EXPECT_TRUE(says(refusal("<?xml version=\"1.0\"?>\n<svg/>\n"), "XML, SVG or HTML"));
  EXPECT_TRUE(says(refusal("%PDF-1.4\n"), "PDF"));
  EXPECT_TRUE(says(refusal("  0\nSECTION\n  2\nHEADER\n"), "DXF"));
  EXPECT_TRUE(says(refusal("ISO-10303-21;\nHEADER;\n"), "STEP"));
  EXPECT_TRUE(says(refusal("{\"degree\": 5}\n"), "JSON"));
  EXPECT_TRUE(
      says(refusal(" XFOIL  Version 6.99\n Calculated polar for: NACA 0012\n 0.0 0.0 0.005\n"), "polar"));
  EXPECT_TRUE(
      says(refusal("0.0 0.0 0.005 0.1\n1.0 0.11 0.006 0.1\n2.0 0.2 0.006 0.1\n"), "rows of 4 numbers"));
}

TEST(AirfoilKinds, RefusesAnOutlineThatWasCutOff) {
  EXPECT_TRUE(says(refusal("wedge\n" + rows(upper)), "cut off"));
}

}  // namespace
}  // namespace remodel
