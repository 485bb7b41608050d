// Compares a study with the paper's tables, row by row.

#include <cmath>

#include "study/study_report.h"

namespace remodel {

namespace {

double percent_above(double ours, double papers) {
  return 100.0 * (ours / papers - 1.0);
}

VerdictRow compare_with_paper(const StudyRow& row, const PaperRow& paper) {
  using enum StudyFigure;
  const auto papers = [&](StudyFigure figure) { return paper.figures[static_cast<std::size_t>(figure)]; };
  const StudyMean& preserved = row[preserved_percent];
  return {.at = row.at,
          .scenarios = row.scenarios,
          .generation_percent = percent_above(row[generated_triangles].mean, papers(generated_triangles)),
          .preserved_points = preserved.mean - papers(preserved_percent),
          .surplus_points = row[surplus_percent].mean - papers(surplus_percent),
          .triangles_percent = percent_above(row[triangles].mean, papers(triangles)),
          .speedup_ratio = row[speedup].mean / papers(speedup),
          .preserved_error = preserved.deviation / std::sqrt(static_cast<double>(preserved.count))};
}

}  // namespace

bool VerdictRow::generation_inside() const {
  return std::abs(generation_percent) <= verdict_generation_percent;
}
bool VerdictRow::preserved_inside() const {
  return std::abs(preserved_points) <= verdict_preserved_points;
}

std::vector<VerdictTable> judge_study(const StudyContents& study, const std::string& strategy) {
  std::vector<VerdictTable> tables;
  for (const StudyRow& row : study.rows) {
    const PaperRow* paper = row.strategy == strategy ? paper_row(row.at) : nullptr;
    if (paper == nullptr) continue;
    const VerdictRow verdict = compare_with_paper(row, *paper);
    if (std::isnan(verdict.generation_percent) || std::isnan(verdict.preserved_points) ||
        std::isnan(verdict.surplus_points))
      continue;
    if (tables.empty() || tables.back().table != paper->table || tables.back().airfoil != row.at.airfoil)
      tables.push_back({.table = paper->table, .airfoil = row.at.airfoil, .sigma = row.at.sigma, .rows = {}});
    tables.back().rows.push_back(verdict);
  }
  return tables;
}

VerdictShare verdict_share(const std::vector<VerdictTable>& tables) {
  VerdictShare share;
  for (const VerdictTable& table : tables) {
    for (const VerdictRow& row : table.rows) {
      if (!row.judged()) continue;
      ++share.rows;
      share.inside += row.inside();
      share.generation_inside += row.generation_inside();
      share.preserved_inside += row.preserved_inside();
    }
  }
  return share;
}

}  // namespace remodel
