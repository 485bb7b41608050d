// Writes the page: a template into which style, scripts and the study as JSON are inserted. The page's script
// makes tables and charts from the JSON.

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "remodel/error.h"
#include "study/report/embedded.h"
#include "study/report/names.h"
#include "study/report/summary.h"
#include "study/report/svg.h"
#include "study/study_report.h"

namespace remodel {

namespace {

using PageJson = nlohmann::ordered_json;

// Numbers have seven digits, which is more than a chart can show and halves the page. NaN becomes null.
PageJson page_number(double value) {
  if (!std::isfinite(value)) return nullptr;
  char digits[40];
  std::snprintf(digits, sizeof digits, "%.7g", value);
  return std::strtod(digits, nullptr);
}

PageJson row_json(const StudyRow& row) {
  PageJson means = PageJson::array(), deviations = PageJson::array();
  for (const StudyMean& figure : row.figures) {
    means.push_back(page_number(figure.mean));
    deviations.push_back(page_number(figure.deviation));
  }
  return {{"airfoil", row.at.airfoil},
          {"sigma", row.at.sigma},
          {"I", row.at.points},
          {"G", row.at.gradation},
          {"D", row.at.distance},
          {"strategy", row.strategy},
          {"scenarios", row.scenarios},
          {"means", means},
          {"deviations", deviations},
          {"min_angle", page_number(row.min_angle_deg)},
          {"invalid", row.invalid_meshes},
          {"recoveries", row.recoveries},
          {"refreshes", row.refreshes}};
}

// The paper's row beside each case that the study holds.
PageJson paper_json(const StudyContents& study) {
  PageJson rows = PageJson::array();
  const StudyCase* before = nullptr;
  for (const StudyRow& row : study.rows) {
    if (before != nullptr && *before == row.at) continue;
    before = &row.at;
    const PaperRow* paper = paper_row(row.at);
    if (paper == nullptr) continue;
    rows.push_back({{"table", paper->table},
                    {"airfoil", row.at.airfoil},
                    {"sigma", row.at.sigma},
                    {"I", row.at.points},
                    {"G", row.at.gradation},
                    {"D", row.at.distance},
                    {"means", paper->figures},
                    {"lost", page_number(report::papers_lost(*paper))}});
  }
  return rows;
}

PageJson range_json(const report::Range& range) {
  return {page_number(range.low), page_number(range.high)};
}

PageJson verdict_json(const StudyContents& study) {
  const std::vector<VerdictTable> tables = judge_study(study);
  PageJson lines = PageJson::array(), outside = PageJson::array();
  for (const VerdictTable& table : tables) {
    const report::VerdictSummary s = report::summarise(table);
    lines.push_back({{"table", table.table},
                     {"title", report::title_of(table.airfoil)},
                     {"sigma", table.sigma},
                     {"rows", table.rows.size()},
                     {"generation", range_json(s.generation)},
                     {"remodelling", range_json(s.triangles)},
                     {"preservation", range_json(s.preserved)},
                     {"surplus", range_json(s.surplus)},
                     {"speedup", range_json(s.speedup)},
                     {"judged", s.share.rows},
                     {"inside", s.share.inside}});
    for (const VerdictRow& row : table.rows) {
      if (!row.judged() || row.inside()) continue;
      outside.push_back({{"table", table.table},
                         {"I", row.at.points},
                         {"D", row.at.distance},
                         {"scenarios", row.scenarios},
                         {"generation", page_number(row.generation_percent)},
                         {"preservation", page_number(row.preserved_points)},
                         {"error", page_number(row.preserved_error)},
                         {"surplus", page_number(row.surplus_points)},
                         {"remark", report::remark_on(row)}});
    }
  }
  return {{"sentence", report::verdict_sentence(study, verdict_share(tables))},
          {"lines", lines},
          {"outside", outside}};
}

// The page has blocks only for the D nearest to 1: the others look alike, and a row has a hundred blocks.
bool drawn_over_run(const StudyContents& study, const StudyRow& row) {
  double nearest = HUGE_VAL;
  for (const StudyRow& other : study.rows)
    if (other.at.airfoil == row.at.airfoil && other.at.sigma == row.at.sigma)
      nearest = std::min(nearest, std::abs(std::log2(other.at.distance)));
  return std::abs(std::log2(row.at.distance)) == nearest;
}

PageJson blocks_json(const StudyContents& study) {
  std::vector<bool> wanted;
  for (const StudyRow& row : study.rows) wanted.push_back(drawn_over_run(study, row));
  PageJson blocks = PageJson::array();
  for (const StudyBlock& block : study.blocks) {
    if (!wanted[block.row]) continue;
    blocks.push_back({block.row, block.first, block.last, page_number(block.triangles.mean),
                      page_number(block.preserved_percent.mean), page_number(block.surplus_percent.mean)});
  }
  return blocks;
}

PageJson pictures_json(const std::vector<StudySvg>& figures) {
  PageJson list = PageJson::array();
  for (const StudySvg& figure : figures)
    list.push_back({{"name", figure.name}, {"title", figure.title}, {"svg", figure.text}});
  return list;
}

PageJson data_of(const StudyContents& study, const std::vector<StudySvg>& mesh_figures) {
  PageJson rows = PageJson::array(), airfoils = PageJson::array(), summary = PageJson::array();
  for (const StudyRow& row : study.rows) rows.push_back(row_json(row));
  for (const StudyOutline& airfoil : study.airfoils)
    airfoils.push_back({{"name", airfoil.name}, {"title", airfoil.title}});
  for (const auto& [label, value] : report::summary_lines(study)) summary.push_back({label, value});
  PageJson keys = PageJson::array();
  for (std::size_t i = 0; i < study_figure_count; ++i) keys.push_back(key_of(static_cast<StudyFigure>(i)));
  return {{"summary", summary},
          {"finished", study.finished()},
          {"evaluations", study.evaluations},
          {"figures", keys},
          {"airfoils", airfoils},
          {"rows", rows},
          {"paper", paper_json(study)},
          {"verdict", verdict_json(study)},
          {"blocks", blocks_json(study)},
          {"meshes", pictures_json(mesh_figures)},
          {"outlines", pictures_json(study_airfoil_figures(study))}};
}

}  // namespace

namespace report {

// JSON has "<" in strings only, where it can be written as an escape: so no text of the data can end the
// script element that contains it.
std::string for_script(std::string_view json) {
  std::string text;
  for (const char c : json) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

// The page redistributes scripts of other projects, so it contains their licences.
std::string licences() {
  std::string text;
  for (const auto& [name, licence] :
       {std::pair("Vega", embedded_vega_licence()), std::pair("Vega-Lite", embedded_vega_lite_licence()),
        std::pair("Vega-Embed", embedded_vega_embed_licence())})
    text += std::string(name) + "\n\n" + escaped(licence) + "\n";
  return text;
}

}  // namespace report

std::string study_page(const StudyContents& study, const std::vector<StudySvg>& mesh_figures) {
  using namespace report;
  if (embedded_vega().empty() || embedded_vega_lite().empty() || embedded_vega_embed().empty())
    throw Error(
        ErrorCode::file, "page",
        "found no scripts of the page in this program, expected it built after scripts/install-dependencies");
  const std::string data =
      for_script(data_of(study, mesh_figures).dump(-1, ' ', false, PageJson::error_handler_t::replace));
  const std::string licence_texts = licences();
  const std::array<std::pair<std::string_view, std::string_view>, 7> parts = {
      {{"/*style*/", embedded_style()},
       {"/*licences*/", licence_texts},
       {"/*vega*/", embedded_vega()},
       {"/*vega-lite*/", embedded_vega_lite()},
       {"/*vega-embed*/", embedded_vega_embed()},
       {"/*data*/", data},
       {"/*script*/", embedded_script()}}};
  // Marks are looked for in the template only, in its order, because inserted text may contain them too.
  std::string page;
  std::string_view rest = embedded_page();
  for (const auto& [mark, text] : parts) {
    const std::size_t at = rest.find(mark);
    page.append(rest.substr(0, at)).append(text);
    rest.remove_prefix(at + mark.size());
  }
  return page.append(rest);
}

}  // namespace remodel
