// The paper's tables, from study/data/paper_tables.csv, which is part of the program.

#include <charconv>
#include <map>
#include <utility>

#include "remodel/error.h"
#include "study/report/embedded.h"
#include "study/report/names.h"
#include "study/study_report.h"

namespace remodel {

namespace {

std::string_view take_field(std::string_view& text, char end) {
  const std::size_t at = text.find(end);
  const std::string_view part = text.substr(0, at);
  text.remove_prefix(at == std::string_view::npos ? text.size() : at + 1);
  return part;
}

double take_number(std::string_view& line) {
  const std::string_view field = take_field(line, ',');
  double number = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), number);
  if (error != std::errc() || end != field.data() + field.size())
    throw Error(ErrorCode::format, "paper_tables.csv",
                "found '" + std::string(field) + "', expected a number");
  return number;
}

std::vector<PaperRow> parse_paper_tables(std::string_view text) {
  std::vector<PaperRow> rows;
  bool header = true;
  while (!text.empty()) {
    std::string_view line = take_field(text, '\n');
    if (line.empty() || line.front() == '#') continue;
    if (std::exchange(header, false)) continue;
    PaperRow row;
    row.table = take_field(line, ',');
    row.at.airfoil = take_field(line, ',');
    row.at.sigma = take_number(line);
    row.at.points = static_cast<int>(take_number(line));
    row.at.gradation = take_number(line);
    row.at.distance = take_number(line);
    for (double& figure : row.figures) figure = take_number(line);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

const std::vector<PaperRow>& paper_rows() {
  static const std::vector<PaperRow> rows = parse_paper_tables(report::embedded_paper_tables());
  return rows;
}

const PaperRow* paper_row(const StudyCase& at) {
  static const std::map<StudyCase, const PaperRow*> rows = [] {
    std::map<StudyCase, const PaperRow*> result;
    for (const PaperRow& row : paper_rows()) result[row.at] = &row;
    return result;
  }();
  StudyCase known = at;
  known.airfoil = report::catalogue_name(at.airfoil);
  const auto found = rows.find(known);
  return found == rows.end() ? nullptr : found->second;
}

}  // namespace remodel
