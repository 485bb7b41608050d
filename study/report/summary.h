#pragma once

// A study and its verdict in words, as the page, the Markdown report and the program print them.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "study/study_report.h"

namespace remodel::report {

struct Range {
  double low, high;
};
// The minimum and maximum of each figure over a table's rows.
struct VerdictSummary {
  Range generation, triangles, preserved, surplus, speedup;
  VerdictShare share;
};
VerdictSummary summarise(const VerdictTable& table);  // the table has at least one row

// One sentence; a second one follows if the study's scenarios are shorter than the paper's.
std::string verdict_sentence(const StudyContents& study, const VerdictShare& share);
// A remark on a row: the bound that it breaks, and whether the scatter of the scenarios is as large.
std::string remark_on(const VerdictRow& row);

// The run's options and machine as labels and values, in the order of display.
std::vector<std::pair<std::string, std::string>> summary_lines(const StudyContents& study);

// Escapes JSON text for a script element.
std::string for_script(std::string_view json);

}  // namespace remodel::report
