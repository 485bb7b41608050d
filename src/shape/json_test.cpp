#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include "remodel/domain.h"
#include "remodel/error.h"
#include "remodel/shape_files.h"
#include "support.h"

namespace remodel {
namespace {

const std::string good_airfoil = R"({"degree": 2, "upper": [0.1, 0.2, 0.3], "lower": [-0.1, 0, 0.3]})";

template <typename Read>
std::string refusal(Read read, const std::string& text) {
  try {
    read(text, "design.json");
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::format);
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    EXPECT_TRUE(std::string(e.what()).starts_with("design.json")) << e.what();
    return e.what();
  }
  ADD_FAILURE() << "accepted " << text.substr(0, 200);
  return {};
}
std::string airfoil_refusal(const std::string& text) {
  return refusal(airfoil_from_json, text);
}
std::string domain_refusal(const std::string& text) {
  return refusal(
      [](const std::string& json, const std::string& source) { return domain_from_json(json, source); },
      text);
}

bool says(const std::string& message, const std::string& part) {
  return message.find(part) != std::string::npos;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

TEST(AirfoilJson, RoundTripsToTheLastBit) {
  const auto seed = test::seed(5);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, 0.3);
  for (int k = 0; k < 500; ++k) {
    CstAirfoil airfoil{
        .upper = {}, .lower = {}, .e1 = 0.5 + 0.001 * k, .e2 = 1.0, .te_upper = normal(random)};
    for (int i = 0; i < 6; ++i) {
      airfoil.upper.push_back(normal(random) * std::pow(10.0, -std::abs(normal(random) * 20.0)));
      airfoil.lower.push_back(i == 0 ? -0.0 : normal(random));
    }
    const CstAirfoil back = airfoil_from_json(airfoil_to_json(airfoil), "memory");
    ASSERT_EQ(back, airfoil) << "seed " << seed;
    ASSERT_TRUE(std::signbit(back.lower[0]));
  }
}

TEST(AirfoilJson, TakesDefaultsAndWhatAFitReports) {
  const CstAirfoil airfoil = airfoil_from_json(good_airfoil, "memory");
  EXPECT_EQ(airfoil, (CstAirfoil{.upper = {0.1, 0.2, 0.3}, .lower = {-0.1, 0.0, 0.3}}));
  const std::string reported =
      replaced(good_airfoil, "{", R"({"name": "x", "max_error": 1e-3, "rms_error": 1e-4,
      "thickness": {"value": 0.1, "at": 0.3}, "camber": {"value": 0, "at": 0}, )");
  EXPECT_EQ(airfoil_from_json(reported, "memory"), airfoil);
}

TEST(AirfoilJson, RefusesWhatIsNoAirfoilAndNamesTheKey) {
  for (const std::string text :
       {"", "{", "[]", "null", "3", "\"x\"", "{}", "{\"degree\": 2}", "not json", "\xff\xfe"}) {
    airfoil_refusal(text);
  }
  EXPECT_TRUE(says(airfoil_refusal(replaced(good_airfoil, "0.2", "\"0.2\"")), "upper[1]"));
  EXPECT_TRUE(says(airfoil_refusal(replaced(good_airfoil, "0.2", "null")), "upper[1]"));
  airfoil_refusal(replaced(good_airfoil, "0.2", "NaN"));
  airfoil_refusal(replaced(good_airfoil, "0.2", "1e999"));
  EXPECT_TRUE(says(airfoil_refusal(replaced(good_airfoil, "0.2, ", "")), "upper"));
  EXPECT_TRUE(says(airfoil_refusal(replaced(good_airfoil, "[-0.1, 0, 0.3]", "0.1")), "lower"));
  for (const std::string degree : {"3", "2.5", "0", "-2", "\"2\"", "1e9", "true"}) {
    airfoil_refusal(replaced(good_airfoil, "2,", degree + ","));
  }
  EXPECT_TRUE(says(airfoil_refusal(replaced(good_airfoil, "{", "{\"colour\": 1, ")), "\"colour\""));
  EXPECT_TRUE(says(airfoil_refusal(replaced(good_airfoil, "{", "{\"degree\": 2, ")), "twice"));
  for (const std::string wrong : {"0", "-1", "1e9", "\"a\""}) {
    EXPECT_TRUE(says(airfoil_refusal(replaced(good_airfoil, "{", "{\"e1\": " + wrong + ", ")), "e1"))
        << wrong;
  }
}

TEST(AirfoilJson, RefusesToWriteWhatIsNotFinite) {
  CstAirfoil airfoil{.upper = {0.1, std::numeric_limits<double>::quiet_NaN()}, .lower = {0.1, 0.1}};
  EXPECT_THROW(airfoil_to_json(airfoil), Error);
}

Domain domain_of_every_shape() {
  CstAirfoil open{.upper = {0.17, 0.1}, .lower = {-0.1, -0.2}, .te_upper = 0.01, .te_lower = -0.02};
  Domain domain = airfoil_domain(open, {.points = 20, .farfield_points = 30});
  const Polyline triangle{.points = {{3.0, 0.1}, {4.0, 1.0 / 3.0}, {3.5, 2.0}, {3.0, 0.1}}};
  domain.loops.push_back(
      {.role = LoopRole::hole,
       .curves = {
           {.name = "a \"quoted\" name\n", .shape = triangle, .parameters = {0.0, 1.0 / 3.0, 2.0 / 3.0}}}});
  return domain;
}

TEST(DomainJson, RoundTripsToTheLastBit) {
  const Domain domain = domain_of_every_shape();
  EXPECT_EQ(domain_from_json(domain_to_json(domain), "memory"), domain);
  EXPECT_EQ(domain_from_json(domain_to_json({}), "memory"), Domain{});
}

TEST(DomainJson, RefusesWhatIsNoDomainAndNamesTheKey) {
  const std::string good = domain_to_json(domain_of_every_shape());
  for (const std::string text : {"", "{}", "[]", "{\"loops\": 3}", "{\"loops\": [3]}", "{\"loops\": [{}]}"}) {
    domain_refusal(text);
  }
  EXPECT_TRUE(says(domain_refusal(replaced(good, "\"outer\"", "\"inner\"")), "loops[1].role"));
  EXPECT_TRUE(says(domain_refusal(replaced(good, "\"kind\":\"arc\"", "\"kind\":\"circle\"")),
                   "loops[1].curves[0].shape"));
  EXPECT_TRUE(says(domain_refusal(replaced(good, "\"radius\":25.0", "\"radius\":\"25\"")), "radius"));
  EXPECT_TRUE(says(domain_refusal(replaced(good, "\"radius\":25.0", "\"radios\":25.0")), "radius"));
  EXPECT_TRUE(says(domain_refusal(replaced(good, "\"centre\":[0.5,0.0]", "\"centre\":[0.5]")), "centre"));
  EXPECT_TRUE(says(domain_refusal(replaced(good, "\"name\":\"farfield\"", "\"name\":null")),
                   "loops[1].curves[0].name"));
  EXPECT_TRUE(
      says(domain_refusal(replaced(good, "\"parameters\":[0.0", "\"parameters\":[null")), "parameters[0]"));
  domain_refusal(replaced(good, "{\"loops\"", "{\"version\":1,\"loops\""));
  domain_refusal(good.substr(0, good.size() / 2));
}

TEST(DomainJson, SurvivesDeepNestingAndHugeTexts) {
  domain_refusal(std::string(1000000, '['));
  domain_refusal("{\"loops\":" + std::string(100000, '[') + std::string(100000, ']') + "}");
  domain_refusal(std::string((std::size_t{16} << 20) + 1, ' '));
}

TEST(LoadAirfoil, TellsFilesSectionsAndNamesApart) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("remodel-" + std::to_string(std::random_device{}()) + ".json");
  const CstAirfoil design{.upper = {0.1, 0.2, 0.3}, .lower = {-0.1, 0.0, 0.05}};
  std::ofstream(file) << airfoil_to_json(design);
  EXPECT_EQ(load_airfoil(file.string(), 5), design);
  std::filesystem::remove(file);
  EXPECT_EQ(load_airfoil("naca:2412", 6), fit_cst(naca_airfoil("2412"), 6).airfoil);
  EXPECT_EQ(load_airfoil("rae2822", 6).degree(), 6);
}

TEST(LoadAirfoil, SaysWhatItKnowsWhereTheNameIsUnknown) {
  const auto refused = [](const std::string& shape) -> std::pair<ErrorCode, std::string> {
    try {
      load_airfoil(shape, 5);
    } catch (const Error& e) {
      return {e.code(), e.what()};
    }
    ADD_FAILURE() << shape;
    return {};
  };
  for (const std::string shape : {"", "no-such-airfoil", "NACA0012"}) {
    EXPECT_EQ(refused(shape).first, ErrorCode::argument);
    EXPECT_TRUE(says(refused(shape).second, "rae2822")) << refused(shape).second;
  }
  EXPECT_EQ(refused("naca:12").first, ErrorCode::argument);
  EXPECT_EQ(refused("no-such-file.dat").first, ErrorCode::file);
  EXPECT_EQ(refused("no/such.json").first, ErrorCode::file);
  EXPECT_EQ(refused(".").first, ErrorCode::file);
}

}  // namespace
}  // namespace remodel
