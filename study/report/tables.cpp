// Writes the tables of a study and its verdict as CSV and as Markdown.

#include <cmath>

#include "study/report/names.h"
#include "study/report/summary.h"
#include "study/study_report.h"

namespace remodel {

namespace {

using report::exact;
using report::fixed;
using report::short_number;
using report::with_sign;

// Quotes a field as RFC 4180 asks: if it has a separator, a quote or a line end; quotes inside are doubled.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string csv_case(const StudyCase& at) {
  return csv_field(at.airfoil) + ',' + short_number(at.sigma) + ',' + std::to_string(at.points) + ',' +
         short_number(at.gradation) + ',' + short_number(at.distance);
}

// A paragraph in lines of at most 118 characters.
std::string in_lines(const std::string& paragraph) {
  constexpr std::size_t most = 118;
  std::string lines = paragraph + '\n';
  for (std::size_t begin = 0; lines.size() - begin > most + 1;) {
    const std::size_t end = lines.rfind(' ', begin + most);
    if (end == std::string::npos || end <= begin) break;
    lines[end] = '\n';
    begin = end + 1;
  }
  return lines;
}

// Escapes arbitrary text for a Markdown cell or heading.
std::string markdown_text(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\n' || c == '\r') {
      result += ' ';
    } else {
      if (std::string_view("\\`*_{}[]<>#|~&").find(c) != std::string_view::npos) result += '\\';
      result += c;
    }
  }
  return result;
}

std::string heading_of(const StudyCase& at, const PaperRow* paper) {
  return (paper ? "Table " + paper->table + ": " : "") + markdown_text(report::title_of(at.airfoil)) +
         ", σ = " + short_number(at.sigma);
}

constexpr std::array<int, paper_figure_count> table_decimals = {0, 2, 0, 3, 2, 2, 1};

// "mean (the paper's)", the latter where there is one.
std::string markdown_cell(const StudyRow& row, const PaperRow* paper, std::size_t figure) {
  const std::string ours = fixed(row.figures[figure].mean, table_decimals[figure]);
  return paper ? ours + " (" + fixed(paper->figures[figure], table_decimals[figure]) + ")" : ours;
}

std::string markdown_row(const StudyRow& row) {
  const PaperRow* paper = paper_row(row.at);
  std::string line = "| " + std::to_string(row.at.points) + " | " + short_number(row.at.gradation) + " | " +
                     short_number(row.at.distance) + " | " + markdown_text(row.strategy) + " | " +
                     std::to_string(row.scenarios) + " |";
  for (std::size_t figure = 0; figure < paper_figure_count; ++figure)
    line += ' ' + markdown_cell(row, paper, figure) + " |";
  return line + '\n';
}

std::string verdict_line(const VerdictTable& table) {
  const report::VerdictSummary s = report::summarise(table);
  return "| " + table.table + " | " + markdown_text(report::title_of(table.airfoil)) + " | " +
         short_number(table.sigma) + " | " + std::to_string(table.rows.size()) + " | " +
         with_sign(s.generation.low, 1) + " to " + with_sign(s.generation.high, 1) + " | " +
         with_sign(s.triangles.low, 1) + " to " + with_sign(s.triangles.high, 1) + " | " +
         with_sign(s.preserved.low, 2) + " to " + with_sign(s.preserved.high, 2) + " | " +
         with_sign(s.surplus.low, 1) + " to " + with_sign(s.surplus.high, 1) + " | " +
         fixed(s.speedup.low, 2) + " to " + fixed(s.speedup.high, 2) + " | " +
         std::to_string(s.share.inside) + " of " + std::to_string(s.share.rows) + " |\n";
}

std::string outside_line(const VerdictTable& table, const VerdictRow& row) {
  return "| " + table.table + " | " + std::to_string(row.at.points) + " | " + short_number(row.at.distance) +
         " | " + std::to_string(row.scenarios) + " | " + with_sign(row.generation_percent, 1) + " | " +
         with_sign(row.preserved_points, 2) + " | " + fixed(row.preserved_error, 2) + " | " +
         with_sign(row.surplus_points, 1) + " | " + report::remark_on(row) + " |\n";
}

std::string outside_rows(const std::vector<VerdictTable>& tables) {
  std::string lines;
  for (const VerdictTable& table : tables)
    for (const VerdictRow& row : table.rows)
      if (row.judged() && !row.inside()) lines += outside_line(table, row);
  if (lines.empty()) return "No row with I of at least 200 is outside.\n";
  return "| table | I | D | scenarios | generation % | preservation points | its standard error | surplus "
         "points | outside |\n"
         "|---|---:|---:|---:|---:|---:|---:|---:|---|\n" +
         lines;
}

std::string verdict_section(const StudyContents& study) {
  const std::vector<VerdictTable> tables = judge_study(study);
  std::string text = "## Verdict\n\n";
  if (tables.empty()) return text + "The study holds no row of the paper's tables by `chain`.\n";
  text += in_lines(report::verdict_sentence(study, verdict_share(tables))) + '\n' +
          in_lines(
              "The table has ours by `chain` beside the paper's, from the least to the largest difference "
              "of a table's rows. Triangles of generation and of remodelling are in per cent, preservation "
              "and surplus in percentage points. The speed-up is a ratio. Both times are of one machine "
              "each; the paper does not name its own.") +
          "\n| table | airfoil | σ | rows | generation % | remodelling % | preservation points | surplus "
          "points | "
          "speed-up ratio | inside, I ≥ 200 |\n|---|---|---:|---:|---|---|---|---|---|---|\n";
  for (const VerdictTable& table : tables) text += verdict_line(table);
  return text + "\n### Rows outside\n\n" + outside_rows(tables);
}

}  // namespace

std::string study_csv(const StudyContents& study) {
  std::string text = "airfoil,sigma,I,G,D,strategy,scenarios,evaluations";
  for (std::size_t i = 0; i < study_figure_count; ++i) {
    const std::string key(key_of(static_cast<StudyFigure>(i)));
    text += ',' + key + ',' + key + "_deviation";
  }
  text += ",min_angle_deg,invalid_meshes,recoveries,refreshes,paper_table";
  for (std::size_t i = 0; i < paper_figure_count; ++i)
    text += ",paper_" + std::string(key_of(static_cast<StudyFigure>(i)));
  text += '\n';
  for (const StudyRow& row : study.rows) {
    text += csv_case(row.at) + ',' + csv_field(row.strategy) + ',' + std::to_string(row.scenarios) + ',' +
            std::to_string(row.evaluations);
    for (const StudyMean& figure : row.figures)
      text += ',' + exact(figure.mean) + ',' + exact(figure.deviation);
    text += ',' + exact(row.min_angle_deg) + ',' + std::to_string(row.invalid_meshes) + ',' +
            std::to_string(row.recoveries) + ',' + std::to_string(row.refreshes);
    const PaperRow* paper = paper_row(row.at);
    text += ',' + (paper ? paper->table : "");
    for (std::size_t i = 0; i < paper_figure_count; ++i)
      text += ',' + (paper ? short_number(paper->figures[i]) : "");
    text += '\n';
  }
  return text;
}

std::string study_blocks_csv(const StudyContents& study) {
  std::string text =
      "airfoil,sigma,I,G,D,strategy,first,last,remodelling_triangles,preservation_percent,surplus_percent\n";
  for (const StudyBlock& block : study.blocks) {
    const StudyRow& row = study.rows[block.row];
    text += csv_case(row.at) + ',' + csv_field(row.strategy) + ',' + std::to_string(block.first) + ',' +
            std::to_string(block.last) + ',' + exact(block.triangles.mean) + ',' +
            exact(block.preserved_percent.mean) + ',' + exact(block.surplus_percent.mean) + '\n';
  }
  return text;
}

std::string verdict_csv(const std::vector<VerdictTable>& tables) {
  std::string text =
      "table,airfoil,sigma,I,G,D,scenarios,generation_percent,remodelling_percent,preservation_points,"
      "preservation_standard_error,surplus_points,speedup_ratio,judged,inside\n";
  for (const VerdictTable& table : tables)
    for (const VerdictRow& row : table.rows)
      text += table.table + ',' + csv_case(row.at) + ',' + std::to_string(row.scenarios) + ',' +
              exact(row.generation_percent) + ',' + exact(row.triangles_percent) + ',' +
              exact(row.preserved_points) + ',' + exact(row.preserved_error) + ',' +
              exact(row.surplus_points) + ',' + exact(row.speedup_ratio) + ',' +
              (row.judged() ? "1," : "0,") + (row.inside() ? "1\n" : "0\n");
  return text;
}

std::string verdict_markdown(const StudyContents& study) {
  std::string text = "# Study\n\n";
  for (const auto& [label, value] : report::summary_lines(study))
    text += "- " + label + ": " + markdown_text(value) + '\n';
  return text + '\n' + verdict_section(study);
}

std::string study_markdown(const StudyContents& study) {
  std::string text = verdict_markdown(study) +
                     "\n## Tables\n\nMeans over the scenarios, the paper's in parentheses. Times are in "
                     "milliseconds of the thread's processor time.\n";
  const StudyRow* before = nullptr;
  for (const StudyRow& row : study.rows) {
    if (before == nullptr || before->at.airfoil != row.at.airfoil || before->at.sigma != row.at.sigma) {
      text +=
          "\n### " + heading_of(row.at, paper_row(row.at)) +
          "\n\n| I | G | D | strategy | scenarios | generation triangles | ms | remodelling triangles | ms | "
          "preservation % | surplus % | speed-up "
          "|\n|---:|---:|---:|---|---:|---:|---:|---:|---:|---:|---:|---:|\n";
    }
    text += markdown_row(row);
    before = &row;
  }
  return text;
}

}  // namespace remodel
