#pragma once

// What page, Markdown and program say of a study and its verdict, in words.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "remodel/study_report.h"

namespace remodel::report {

struct Range {
  double low, high;
};
// Least and largest of a table's rows.
struct VerdictSummary {
  Range generation, triangles, preserved, surplus, speedup;
  VerdictShare share;
};
VerdictSummary summarise(const VerdictTable& table);  // of at least one row

// One sentence, and where the study's scenarios are shorter than the paper's a second one that says so.
std::string verdict_sentence(const StudyContents& study, const VerdictShare& share);
// Which bound a row breaks, and whether the scatter of the scenarios is as large.
std::string remark_on(const VerdictRow& row);

// What was run: label and value, in the order to be shown.
std::vector<std::pair<std::string, std::string>> summary_lines(const StudyContents& study);

// JSON text as it may stand in a script element.
std::string for_script(std::string_view json);

}  // namespace remodel::report
