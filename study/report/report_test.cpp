#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

#include "remodel/shape_files.h"
#include "study/report/names.h"
#include "study/report/summary.h"
#include "study/report/svg.h"
#include "study/study_report.h"

namespace remodel {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

StudyRow row_of(const StudyCase& at, double generated, double preserved, double surplus,
                const std::string& strategy = "chain") {
  StudyRow row;
  row.at = at;
  row.strategy = strategy;
  row.scenarios = 4;
  const auto set = [&](StudyFigure figure, double mean, double deviation) {
    row.figures[static_cast<std::size_t>(figure)] = {.mean = mean, .deviation = deviation, .count = 4};
  };
  set(StudyFigure::generated_triangles, generated, 1.0);
  set(StudyFigure::triangles, generated * (1.0 + surplus / 100.0), 1.0);
  set(StudyFigure::preserved_percent, preserved, 0.5);
  set(StudyFigure::surplus_percent, surplus, 1.0);
  set(StudyFigure::speedup, 20.0, 1.0);
  return row;
}

// A row that has exactly the paper's figures of a case.
StudyRow papers_own(const StudyCase& at) {
  const PaperRow& paper = *paper_row(at);
  return row_of(at, paper.figures[0], paper.figures[4], paper.figures[5]);
}

TEST(StudyMean, IsOverTheValuesThatAreThere) {
  const StudyMean none = study_mean({nan, nan});
  EXPECT_TRUE(std::isnan(none.mean));
  EXPECT_EQ(none.count, 0u);
  const StudyMean one = study_mean({nan, 3.0});
  EXPECT_EQ(one.mean, 3.0);
  EXPECT_TRUE(std::isnan(one.deviation));
  const StudyMean three = study_mean({1.0, 2.0, nan, 6.0});
  EXPECT_EQ(three.mean, 3.0);
  EXPECT_EQ(three.count, 3u);
  EXPECT_DOUBLE_EQ(three.deviation, std::sqrt(7.0));  // (4 + 1 + 9) / 2
}

TEST(PaperTables, HaveTwentySevenTablesOfTwentyFourRows) {
  EXPECT_EQ(paper_rows().size(), 27u * 24u);
  std::set<std::string> tables;
  std::set<StudyCase> cases;
  for (const PaperRow& row : paper_rows()) {
    tables.insert(row.table);
    cases.insert(row.at);
    EXPECT_EQ(report::catalogue_name(row.at.airfoil), row.at.airfoil);
    EXPECT_EQ(row.at.points, 50 * row.at.gradation);
    // The surplus is that of the mean counts, up to the paper's rounding.
    EXPECT_NEAR(100.0 * (row.figures[2] / row.figures[0] - 1.0), row.figures[5], 0.6) << row.table;
  }
  EXPECT_EQ(tables.size(), 27u);
  EXPECT_EQ(cases.size(), paper_rows().size());
}

TEST(PaperTables, AreFoundByTheNamesOfStudies) {
  const StudyCase at{"rae2822", 0.25, 200, 4.0, 1.0};
  ASSERT_NE(paper_row(at), nullptr);
  EXPECT_EQ(paper_row(at)->table, "A15");
  for (const char* name : {"airfoils/rae2822.dat", "/x/rae2822.json"}) {
    StudyCase file = at;
    file.airfoil = name;
    EXPECT_EQ(paper_row(file), paper_row(at)) << name;
  }
  for (const StudyCase& other :
       {StudyCase{"naca:4415", 0.25, 200, 4.0, 1.0}, StudyCase{"rae2822", 0.1, 200, 4.0, 1.0},
        StudyCase{"rae2822", 0.25, 200, 2.0, 1.0}, StudyCase{"", 0.25, 200, 4.0, 1.0}})
    EXPECT_EQ(paper_row(other), nullptr);
}

TEST(Verdict, OfThePapersOwnFiguresIsThatAllAreInside) {
  StudyContents study;
  for (const PaperRow& row : paper_rows()) study.rows.push_back(papers_own(row.at));
  const std::vector<VerdictTable> tables = judge_study(study);
  EXPECT_EQ(tables.size(), 27u);
  const VerdictShare share = verdict_share(tables);
  EXPECT_EQ(share.rows, 27u * 16u);  // I of 200, 300, 400 and 700
  EXPECT_EQ(share.inside, share.rows);
  for (const VerdictTable& table : tables)
    for (const VerdictRow& row : table.rows) EXPECT_EQ(row.generation_percent, 0.0);
}

TEST(Verdict, BoundsAreOnePointAndFivePercent) {
  const StudyCase at{"rae2822", 0.25, 200, 4.0, 1.0};
  const PaperRow& paper = *paper_row(at);
  const auto judged = [&](double count_factor, double points) {
    StudyContents study;
    study.rows = {row_of(at, paper.figures[0] * count_factor, paper.figures[4] + points, paper.figures[5])};
    return judge_study(study).at(0).rows.at(0);
  };
  EXPECT_TRUE(judged(1.049, 0.99).inside());
  EXPECT_TRUE(judged(0.951, -0.99).inside());
  EXPECT_FALSE(judged(1.051, 0.0).generation_inside());
  EXPECT_FALSE(judged(0.949, 0.0).generation_inside());
  EXPECT_FALSE(judged(1.0, 1.01).preserved_inside());
  EXPECT_FALSE(judged(1.0, -1.01).preserved_inside());
  const VerdictRow row = judged(1.02, 0.5);
  EXPECT_NEAR(row.generation_percent, 2.0, 1e-9);
  EXPECT_NEAR(row.preserved_points, 0.5, 1e-9);
  EXPECT_DOUBLE_EQ(row.preserved_error, 0.25);  // 0.5 / sqrt(4)
  EXPECT_DOUBLE_EQ(row.speedup_ratio, 20.0 / paper.figures[6]);
}

TEST(Verdict, IsOfOneStrategyAndLeavesOutWhatWasNotCompared) {
  const StudyCase at{"rae2822", 0.25, 200, 4.0, 1.0}, coarse{"rae2822", 0.25, 50, 1.0, 1.0};
  StudyContents study;
  study.rows = {row_of(coarse, 1.0, 1.0, 1.0), row_of(at, nan, 90.0, nan),
                row_of(at, 4650.0, 90.0, 20.0, "renew")};
  const std::vector<VerdictTable> tables = judge_study(study);
  ASSERT_EQ(tables.size(), 1u);
  EXPECT_EQ(tables[0].rows.size(), 1u);
  EXPECT_EQ(verdict_share(tables).rows, 0u);  // the coarse one is not judged
  EXPECT_EQ(judge_study(study, "renew").at(0).rows.size(), 1u);
  EXPECT_NE(report::verdict_sentence(study, verdict_share(tables)).find("no row"), std::string::npos);
}

TEST(Verdict, SaysWhereRunsAreShorterThanThePapers) {
  const VerdictShare share{.rows = 4, .inside = 3, .generation_inside = 4, .preserved_inside = 3};
  StudyContents study;
  study.evaluations = 9000;
  EXPECT_NE(report::verdict_sentence(study, share).find("3 of 4 (75 %)"), std::string::npos);
  EXPECT_EQ(report::verdict_sentence(study, share).find("evaluations"), std::string::npos);
  study.evaluations = 400;
  EXPECT_NE(report::verdict_sentence(study, share).find("have 400 evaluations"), std::string::npos);
}

TEST(Verdict, RemarksNameTheBoundAndTheScatter) {
  VerdictRow row;
  row.preserved_points = 1.4;
  row.preserved_error = 0.25;
  EXPECT_EQ(report::remark_on(row), "preservation (by less than two standard errors)");
  row.preserved_error = 0.1;
  EXPECT_EQ(report::remark_on(row), "preservation");
  row.preserved_error = nan;
  row.generation_percent = -6.0;
  EXPECT_EQ(report::remark_on(row), "generation count, preservation");
}

// Splits one line of CSV (RFC 4180) into its fields.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += line[++i];
    } else if (line[i] == '"') {
      quoted = !quoted;
    } else if (line[i] == ',' && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += line[i];
    }
  }
  return fields;
}

TEST(StudyCsv, ReadsBackToTheSameNumbersAndNames) {
  StudyContents study;
  study.rows = {row_of({"a \"b\", c", 0.1, 200, 4.0, 0.5}, 1.0 / 3.0, 91.7 + 1e-13, nan),
                row_of({"rae2822", 0.25, 200, 4.0, 1.0}, 4650.0, 91.0, 20.0)};
  std::istringstream text(study_csv(study));
  std::string header, first, second, rest;
  ASSERT_TRUE(std::getline(text, header) && std::getline(text, first) && std::getline(text, second));
  EXPECT_FALSE(std::getline(text, rest));
  const std::vector<std::string> names = fields_of(header), ours = fields_of(first),
                                 known = fields_of(second);
  ASSERT_EQ(ours.size(), names.size());
  ASSERT_EQ(known.size(), names.size());
  const auto at = [&](const std::vector<std::string>& fields, const std::string& name) {
    return fields.at(static_cast<std::size_t>(std::ranges::find(names, name) - names.begin()));
  };
  EXPECT_EQ(at(ours, "airfoil"), "a \"b\", c");
  EXPECT_EQ(std::stod(at(ours, "sigma")), 0.1);
  EXPECT_EQ(std::stod(at(ours, "generation_triangles")), 1.0 / 3.0);
  EXPECT_EQ(std::stod(at(ours, "preservation_percent")), 91.7 + 1e-13);
  EXPECT_EQ(at(ours, "surplus_percent"), "");
  EXPECT_EQ(at(ours, "paper_table"), "");
  EXPECT_EQ(at(known, "paper_table"), "A15");
}

TEST(Escaping, NoTextEndsTheElementItStandsIn) {
  EXPECT_EQ(report::for_script("[\"</script><!--\"]"), "[\"\\u003c/script>\\u003c!--\"]");
  EXPECT_EQ(report::escaped("<a b='c' d=\"e\">&\x01"), "&lt;a b=&#39;c&#39; d=&quot;e&quot;&gt;&amp;");
  EXPECT_EQ(report::file_name_of("../x y.dat"), ".._x_y.dat");
}

TEST(Names, KeepThePapersOrder) {
  EXPECT_TRUE(report::before_by_name("goe459", "naca2412"));
  EXPECT_TRUE(report::before_by_name("rae2822", "e376"));
  EXPECT_TRUE(report::before_by_name("goe702", "another"));
  EXPECT_FALSE(report::before_by_name("another", "goe702"));
  EXPECT_EQ(report::title_of("x/e376.dat"), "Eppler 376");
  EXPECT_EQ(report::title_of("naca:0012"), "NACA 0012");
  EXPECT_EQ(report::title_of("mine"), "mine");
}

TEST(StudyCharts, SayInEachPanelWhatTheStudyHolds) {
  StudyContents study;
  study.airfoils = {{"rae2822", "RAE 2822", {}}};
  for (const PaperRow& row : paper_rows())
    if (row.at.airfoil == "rae2822" && row.at.distance <= 1.0) study.rows.push_back(papers_own(row.at));
  const std::vector<StudySvg> charts = study_charts(study);
  ASSERT_EQ(charts.size(), 4u);
  EXPECT_EQ(charts[0].name, "rae2822-chain-preservation");
  const auto count = [](const std::string& text, const std::string& what) {
    std::size_t found = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
    return found;
  };
  // Three sigmas, two D, ours and the paper's; six points each.
  EXPECT_EQ(count(charts[0].text, "<polyline"), 3u * 2u * 2u);
  EXPECT_EQ(count(charts[0].text, "<circle"), 3u * 2u * 2u * 6u);
}

TEST(StudyCharts, StandWithoutAComparison) {
  StudyContents study;
  study.airfoils = {{"mine", "mine", {}}};
  study.rows = {row_of({"mine", 0.1, 50, 1.0, 1.0}, nan, 91.0, nan)};
  for (const StudySvg& chart : study_charts(study)) {
    EXPECT_EQ(chart.text.find("nan"), std::string::npos) << chart.name;
    EXPECT_EQ(chart.text.find("inf"), std::string::npos) << chart.name;
  }
}

TEST(StudyAirfoilFigures, GiveThicknessAndCamber) {
  StudyContents study;
  study.airfoils = {{"naca2412", "NACA 2412", load_airfoil("naca2412", 5)}, {"broken", "broken", {}}};
  const std::vector<StudySvg> figures = study_airfoil_figures(study);
  ASSERT_EQ(figures.size(), 1u);
  EXPECT_NE(figures[0].title.find("thickness 11.9 % at"), std::string::npos) << figures[0].title;
  EXPECT_NE(figures[0].title.find("camber 1.9 % at"), std::string::npos) << figures[0].title;
}

TEST(StudyMeshFigures, AreTheSameEveryTime) {
  StudyContents study;
  const CstAirfoil from = load_airfoil("naca0012", 5), to = load_airfoil("rae2822", 5);
  study.pictured = {.airfoil = "rae2822", .sigma = 0.25, .seed = 1, .designs = {}};
  for (int i = 0; i <= 20; ++i) study.pictured.designs.push_back(i % 2 == 0 ? from : to);
  const MeshFigureOptions small{.points = 50, .evaluations = 20};
  const std::vector<StudySvg> once = study_mesh_figures(study, small),
                              again = study_mesh_figures(study, small);
  ASSERT_EQ(once.size(), 4u);
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(once[i].text, again[i].text);
  study.pictured.designs.clear();
  EXPECT_TRUE(study_mesh_figures(study, small).empty());
}

}  // namespace
}  // namespace remodel
