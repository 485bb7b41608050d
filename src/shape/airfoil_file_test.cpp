#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "remodel/airfoil.h"
#include "remodel/error.h"
#include "remodel/shape_files.h"
#include "support.h"

namespace remodel {
namespace {

// A cambered wedge in Selig order, nine points, a blunt trailing edge.
const std::vector<std::string> selig_lines = {"1.0 0.01",  "0.7 0.06",  "0.3 0.09",  "0.1 0.05", "0.0 0.0",
                                              "0.1 -0.02", "0.3 -0.03", "0.7 -0.01", "1.0 -0.01"};

std::string joined(const std::vector<std::string>& lines, const std::string& end = "\n") {
  std::string text;
  for (const std::string& line : lines) text += line + end;
  return text;
}

std::string with_line(std::size_t index, const std::string& line) {
  std::vector<std::string> lines = selig_lines;
  lines[index] = line;
  return "wedge\n" + joined(lines);
}

void expect_wedge(const AirfoilCoordinates& airfoil) {
  ASSERT_EQ(airfoil.upper.size(), 5u);
  ASSERT_EQ(airfoil.lower.size(), 5u);
  EXPECT_EQ(airfoil.upper.front(), (Point{0.0, 0.0}));
  EXPECT_EQ(airfoil.lower.front(), (Point{0.0, 0.0}));
  EXPECT_NEAR(airfoil.upper[2].x, 0.3, 1e-15);
  EXPECT_NEAR(airfoil.upper[2].y, 0.09, 1e-15);
  EXPECT_NEAR(airfoil.lower[2].y, -0.03, 1e-15);
  EXPECT_NEAR(airfoil.upper.back().x, 1.0, 1e-15);
  EXPECT_NEAR(airfoil.upper.back().y, 0.01, 1e-15);
  EXPECT_NEAR(airfoil.lower.back().y, -0.01, 1e-15);
}

// The one line of the Error that parsing throws.
std::string refusal(const std::string& text) {
  try {
    parse_airfoil(text, "wing.dat");
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::format);
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    EXPECT_TRUE(std::string(e.what()).starts_with("wing.dat")) << e.what();
    return e.what();
  }
  ADD_FAILURE() << "accepted:\n" << text.substr(0, 400);
  return {};
}

bool says(const std::string& message, const std::string& part) {
  return message.find(part) != std::string::npos;
}

class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& content) {
    static int count = 0;
    std::ostringstream name;
    name << "remodel-shape-test-" << ::testing::UnitTest::GetInstance()->random_seed() << "-"
         << static_cast<const void*>(this) << "-" << ++count << ".dat";
    path_ = std::filesystem::temp_directory_path() / name.str();
    std::ofstream(path_, std::ios::binary) << content;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

TEST(AirfoilFile, ReadsSeligOrderWithAndWithoutAName) {
  const AirfoilCoordinates named = parse_airfoil("  My wedge 12%\n" + joined(selig_lines), "wing.dat");
  EXPECT_EQ(named.name, "My wedge 12%");
  expect_wedge(named);
  const AirfoilCoordinates nameless = parse_airfoil(joined(selig_lines), "wing.dat");
  EXPECT_EQ(nameless.name, "");
  expect_wedge(nameless);
}

TEST(AirfoilFile, TakesANameThatBeginsWithDigits) {
  for (const std::string name : {"2412", "0012 64 a", "63-206", "23012 airfoil", "1 2 3"}) {
    const AirfoilCoordinates airfoil = parse_airfoil(name + "\n" + joined(selig_lines), "wing.dat");
    EXPECT_EQ(airfoil.name, name);
    expect_wedge(airfoil);
  }
}

TEST(AirfoilFile, ReadsLednicerOrder) {
  const std::string upper = "0 0\n0.1 0.05\n0.3 0.09\n0.7 0.06\n1.0 0.01\n";
  const std::string lower = "0 0\n0.1 -0.02\n0.3 -0.03\n0.7 -0.01\n1.0 -0.01\n";
  expect_wedge(parse_airfoil("wedge\n 5. 5.\n\n" + upper + "\n" + lower, "wing.dat"));
  expect_wedge(parse_airfoil("5 5\n" + upper + lower, "wing.dat"));
  expect_wedge(parse_airfoil("wedge\n5. 5.\n" + lower + upper, "wing.dat"));  // the lower surface first
}

TEST(AirfoilFile, ReadsSeligOrderWithTheLowerSurfaceFirst) {
  std::vector<std::string> lines = selig_lines;
  std::reverse(lines.begin(), lines.end());
  expect_wedge(parse_airfoil(joined(lines), "wing.dat"));
}

TEST(AirfoilFile, AcceptsEveryLineEndSeparatorAndComment) {
  const std::string text = joined(selig_lines);
  for (const std::string end :
       {"\r\n", "\r", "\n\n", "  \n", " # a remark\n", "\n! a remark\n\t% another\n"}) {
    expect_wedge(parse_airfoil("wedge\n" + joined(selig_lines, end), "wing.dat"));
  }
  for (const std::string separator : {"\t", ",", " , ", "   "}) {
    std::string changed;
    for (const char c : text) changed += c == ' ' ? separator : std::string(1, c);
    expect_wedge(parse_airfoil(changed, "wing.dat"));
  }
  expect_wedge(parse_airfoil("\xEF\xBB\xBF# made by hand\n\nG\xF6ttingen\n" + text.substr(0, text.size() - 1),
                             "wing.dat"));
}

TEST(AirfoilFile, AcceptsNumbersOfEveryStyle) {
  expect_wedge(
      parse_airfoil("wedge\n1. .01\n.7 6.D-2\n+0.3 9e-2\n1.0d-01 0.05E0\n0 -0.\n.1 -.02\n.3 -.03\n7E-1 -.01\n"
                    "1 -0.1E-1\n",
                    "wing.dat"));
}

// The wedge by the map p -> nose + size * turned(p).
std::string mapped_wedge(Point nose, double size, double degrees) {
  const double c = std::cos(degrees * std::numbers::pi / 180.0),
               d = std::sin(degrees * std::numbers::pi / 180.0);
  std::ostringstream text;
  text.precision(12);
  text << "mapped\n";
  for (const std::string& line : selig_lines) {
    std::istringstream numbers(line);
    double x = 0.0, y = 0.0;
    numbers >> x >> y;
    text << nose.x + size * (c * x - d * y) << " " << nose.y + size * (d * x + c * y) << "\n";
  }
  return text.str();
}

TEST(AirfoilFile, ScalesTheChordToOneAndMovesTheNoseToTheOriginAndSaysSo) {
  const AirfoilCoordinates airfoil = parse_airfoil(mapped_wedge({20.0, -7.0}, 250.0, 0.0), "wing.dat");
  EXPECT_NEAR(airfoil.upper[2].x, 0.3, 1e-8);
  EXPECT_NEAR(airfoil.upper[2].y, 0.09, 1e-8);
  EXPECT_NEAR(airfoil.upper.back().y + airfoil.lower.back().y, 0.0, 1e-15);
  EXPECT_NEAR(airfoil.frame.chord, 250.0, 1e-9);
  EXPECT_EQ(airfoil.frame.nose, (Point{20.0, -7.0}));
  ASSERT_EQ(airfoil.warnings.size(), 1u);
  EXPECT_EQ(airfoil.warnings[0],
            "wing.dat: its chord of 250 is scaled to 1 and its nose moved from 20,-7 to the origin");
}

TEST(AirfoilFile, TakesASeligFileOfWholeNumbersForNoLednicerFile) {
  const std::string text = "100 2\n70 6\n30 9\n0 0\n30 -3\n70 -1\n100 -2\n";
  EXPECT_EQ(parse_airfoil(text, "wing.dat").upper.size(), 4u);
}

TEST(AirfoilFile, PutsTheLeadingEdgeOnTheArcOfTheNoseWhateverTheNominalOne) {
  const std::string text =
      "1 0\n.6 .08\n.2 .07\n.01 .02\n-.0004 .006\n0 0\n.01 -.01\n.2 -.03\n.6 -.02\n1 0\n";
  const AirfoilCoordinates airfoil = parse_airfoil(text, "wing.dat");
  EXPECT_EQ(airfoil.upper.size() + airfoil.lower.size(), 12u);  // the nose, on no point, on both
  for (const std::vector<Point>* surface : {&airfoil.upper, &airfoil.lower}) {
    for (const Point p : *surface) {
      EXPECT_GE(p.x, -1e-5);
      EXPECT_LE(p.x, 1.0 + 1e-12);
    }
  }
  EXPECT_LT(fit_cst(airfoil, 2).max_error, 0.01);
}

TEST(AirfoilFile, TakesTheMiddleOfAFlatNose) {
  const std::string text = "1 0\n.5 .06\n.1 .05\n0 .01\n0 0\n0 -.01\n.1 -.05\n.5 -.06\n1 0\n";
  const AirfoilCoordinates airfoil = parse_airfoil(text, "wing.dat");
  EXPECT_EQ(airfoil.upper.size(), 5u);
  EXPECT_EQ(airfoil.lower.size(), 5u);
  EXPECT_EQ(airfoil.upper[1].y, -airfoil.lower[1].y);
}

TEST(AirfoilFile, DropsTheBaseOfABluntTrailingEdge) {
  const std::string text = "1 0\n1 .01\n" + joined({selig_lines.begin() + 1, selig_lines.end()}) + "1 0\n";
  expect_wedge(parse_airfoil(text, "wing.dat"));
}

TEST(AirfoilFile, ReadsATrailingEdgeThatIsCutAtAnAngle) {
  const AirfoilCoordinates airfoil = parse_airfoil(with_line(0, "1.004 0.01"), "wing.dat");
  EXPECT_GT(airfoil.upper.back().x, 1.0);
  EXPECT_LT(fit_cst(airfoil, 2).max_error, 0.02);
}

TEST(AirfoilFile, AcceptsTextBeforeAndAfterTheCoordinates) {
  const std::string rows = joined(selig_lines);
  for (const std::string header : {"made by hand\n", "61 points\n", "x y\n", "0.12 thick, 3 % camber\n",
                                   "-----\n\n", "Mach 0.6\nRe 3e6 at 2 degrees\n", "\"quoted\"\n"}) {
    const AirfoilCoordinates airfoil = parse_airfoil("wedge\n" + header + rows, "wing.dat");
    EXPECT_EQ(airfoil.name, "wedge");
    expect_wedge(airfoil);
  }
  for (const std::string footer :
       {"\x1a", "\nfrom the archive, 1987\n", "end\n", "2 digits are lost here\n\nJ. Doe\n",
        "***\n# a remark\n", "x/c and y/c\r\n\x1a\x1a"})
    expect_wedge(parse_airfoil("wedge\n" + rows + footer, "wing.dat"));
}

// A name and the grid's box; 999 999 between elements, of which one is read.
TEST(AirfoilFile, AcceptsFilesOfMses) {
  const std::string rows = joined(selig_lines), box = " -2.00  3.00  -2.50  3.50\n";
  const AirfoilCoordinates airfoil = parse_airfoil("wedge\n" + box + rows, "wing.dat");
  EXPECT_EQ(airfoil.name, "wedge");
  expect_wedge(airfoil);
  expect_wedge(parse_airfoil(box + rows, "wing.dat"));
  expect_wedge(parse_airfoil("wedge\n" + box + rows + "999. 999.\n", "wing.dat"));
  const std::string two = refusal("wedge\n" + box + rows + "999.0 999.0\n" + rows);
  EXPECT_TRUE(says(two, "found 2 elements, the second from line 13 on")) << two;
  for (const std::string wrong : {"3 -2 -2.5 3.5\n", "-2 3 3.5 -2.5\n", "-2 3 -2.5\n", "-2 nan -2.5 3.5\n"})
    EXPECT_TRUE(says(refusal("wedge\n" + wrong + rows), "wing.dat:2")) << wrong;
  EXPECT_TRUE(says(refusal("wedge\n" + rows + box), "wing.dat:11"));
}

// What may be a coordinate that was damaged is no text, and text between coordinates is not passed over.
TEST(AirfoilFile, TakesNoDamagedCoordinateForText) {
  for (const std::string wrong : {"1.0", "1.0 -0.0l", "1.0 -", "0x1 0", "1.0 0.0 0.0", "nan 0"}) {
    EXPECT_TRUE(says(refusal("wedge\n" + joined(selig_lines) + wrong + "\n"), "wing.dat:11")) << wrong;
    EXPECT_TRUE(says(refusal("wedge\n" + wrong + "\n" + joined(selig_lines)), "wing.dat:2")) << wrong;
  }
  EXPECT_TRUE(says(refusal(with_line(4, "lower surface follows")), "wing.dat:6"));
}

TEST(AirfoilFile, NamesLineAndFindingOfWhatIsNoCoordinate) {
  EXPECT_TRUE(says(refusal(with_line(3, "0.1 zero")), "wing.dat:5")) << refusal(with_line(3, "0.1 zero"));
  EXPECT_TRUE(says(refusal(with_line(3, "0.1 zero")), "\"zero\""));
  for (const std::string wrong : {"nan 0.05", "0.1 NaN", "0.1 inf", "-infinity 0", "1e300 0.05", "0.1 -1e999",
                                  "0.1", "0.1 0.05 0.0", "0.1 -", "0.1 0.05E-", "0.1 .", "0.1 --0.05",
                                  "0.1 +-0.05", "0x1 0.05", "0,1 0,05", "0.1 0.0.5", "name"}) {
    EXPECT_TRUE(says(refusal(with_line(3, wrong)), "wing.dat:5")) << wrong;
  }
}

TEST(AirfoilFile, RefusesFilesThatAreNoTextOrEmpty) {
  refusal("");
  refusal("\n\n \n");
  refusal("# only a remark\n");
  refusal("a name and nothing else\n");
  refusal(std::string("\0\0\0\0", 4));
  refusal(
      "\x7f"
      "ELF\x02\x01\x01 0 0\n" +
      joined(selig_lines));
  refusal("wedge\n" + joined(selig_lines) + std::string("\0\0", 2));
}

TEST(AirfoilFile, RefusesTooFewPoints) {
  refusal("1 0\n");
  refusal("1 0\n0 0\n1 0\n");
  refusal("1 0\n0 0\n.5 -.1\n1 0\n");
  EXPECT_NO_THROW(parse_airfoil("1 0\n.5 .1\n0 0\n.5 -.1\n1 0\n", "wing.dat"));
}

TEST(AirfoilFile, TakesAPointThatIsThereTwiceForOne) {
  for (std::size_t i = 0; i < selig_lines.size(); ++i) {
    std::vector<std::string> lines = selig_lines;
    lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(i), lines[i]);
    expect_wedge(parse_airfoil("wedge\n" + joined(lines), "wing.dat"));
  }
}

TEST(AirfoilFile, TakesACountBeforeTheCoordinates) {
  expect_wedge(parse_airfoil("wedge\n129\n" + joined(selig_lines), "wing.dat"));
  EXPECT_TRUE(says(refusal("wedge\n" + joined(selig_lines) + "129\n"), "wing.dat:11"));
}

TEST(AirfoilFile, RefusesPointsOutOfOrder) {
  std::vector<std::string> lines = selig_lines;
  std::swap(lines[1], lines[2]);
  EXPECT_TRUE(says(refusal(joined(lines)), "grow")) << refusal(joined(lines));
  std::rotate(lines.begin(), lines.begin() + 4, lines.end());  // from the leading edge around
  refusal(joined(lines));
}

TEST(AirfoilFile, RefusesSurfacesThatCross) {
  EXPECT_TRUE(says(refusal(with_line(7, "0.7 0.08")), "crossed"));
  refusal("1 0\n.7 .1\n.3 -.1\n0 0\n.3 .1\n.7 -.1\n1 0\n");
}

TEST(AirfoilFile, RefusesFilesThatWereCutOff) {
  for (std::size_t count = 1; count < selig_lines.size(); ++count) {
    refusal("wedge\n" +
            joined({selig_lines.begin(), selig_lines.begin() + static_cast<std::ptrdiff_t>(count)}));
  }
}

TEST(AirfoilFile, RefusesCountsThatDoNotMatch) {
  const std::string upper = "0 0\n0.3 0.09\n1.0 0.01\n";
  const std::string lower = "0 0\n0.3 -0.03\n1.0 -0.01\n";
  EXPECT_NO_THROW(parse_airfoil("3. 3.\n" + upper + lower, "wing.dat"));
  for (const std::string counts : {"3. 4.", "61. 61.", "2. 3.", "4. 2.", "2. 4.", "6000000 3"}) {
    EXPECT_TRUE(says(refusal("wedge\n" + counts + "\n" + upper + lower), "wing.dat:")) << counts;
  }
  refusal("3. 3.\n");
}

TEST(AirfoilFile, RefusesFilesThatAreMissingDirectoriesOrHuge) {
  const auto code = [](const std::filesystem::path& file) {
    try {
      read_airfoil(file);
    } catch (const Error& e) {
      EXPECT_TRUE(says(e.what(), file.string())) << e.what();
      return e.code();
    }
    return ErrorCode::geometry;
  };
  EXPECT_EQ(code("no/such/file.dat"), ErrorCode::file);
  EXPECT_EQ(code(std::filesystem::temp_directory_path()), ErrorCode::file);
  const TemporaryFile huge(std::string((std::size_t{16} << 20) + 1, ' '));
  EXPECT_EQ(code(huge.path()), ErrorCode::format);
  if (!std::filesystem::exists("/dev/zero")) return;
  EXPECT_EQ(code("/dev/zero"), ErrorCode::file);
}

TEST(AirfoilFile, ReadsWhatWasWritten) {
  const TemporaryFile file("wedge\r\n" + joined(selig_lines, "\r\n"));
  expect_wedge(read_airfoil(file.path()));
  EXPECT_EQ(load_airfoil(file.path().string(), 2), fit_cst(read_airfoil(file.path()), 2).airfoil);
}

// No input may do anything but parse or throw Error: one byte of a good file replaced, at every place.
TEST(AirfoilFile, SurvivesEveryOneByteChange) {
  const std::string good = "wedge\n" + joined(selig_lines);
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (const char c : {'\0', '9', '-', '.', 'e', ' ', '\n', '\xff'}) {
      std::string changed = good;
      changed[i] = c;
      try {
        const AirfoilCoordinates airfoil = parse_airfoil(changed, "wing.dat");
        ASSERT_GE(airfoil.upper.size(), 3u);
        for (const Point p : airfoil.upper) ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y)) << changed;
      } catch (const Error&) {
      }
    }
  }
}

TEST(AirfoilFile, ReadsTheStudysFiles) {
  REMODEL_SHARED_FILE(file, "airfoils/e376.dat");
  const AirfoilCoordinates airfoil = read_airfoil(file);
  EXPECT_EQ(airfoil.name, "EPPLER 376 AIRFOIL");
  EXPECT_EQ(airfoil.upper.size() + airfoil.lower.size(), 63u);  // 61 points, and the nose on both
}

}  // namespace
}  // namespace remodel
