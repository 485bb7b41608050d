#include "study/report/summary.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "study/report/names.h"

namespace remodel::report {

namespace {

using SummaryJson = nlohmann::ordered_json;

constexpr std::uint64_t papers_evaluations = 9000;

template <typename Member>
Range range_of(const VerdictTable& table, Member member) {
  const auto [low, high] = std::ranges::minmax_element(table.rows, {}, member);
  return {(*low).*member, (*high).*member};
}

std::string percent_of(std::size_t part, std::size_t whole) {
  return fixed(100.0 * static_cast<double>(part) / static_cast<double>(whole), 0) + " %";
}

std::string dump(const SummaryJson& value) {
  if (value.is_number_float()) return short_number(value.get<double>());
  return value.is_string() ? value.get<std::string>()
                           : value.dump(-1, ' ', false, SummaryJson::error_handler_t::replace);
}

// A value of the options or of the machine: lists with commas, pairs as I/G.
std::string words_of(const SummaryJson& value) {
  if (value.is_object() && value.contains("points") && value.contains("gradation"))
    return dump(value["points"]) + "/" + dump(value["gradation"]);
  if (!value.is_array()) return dump(value);
  std::string text;
  for (const SummaryJson& item : value) text += (text.empty() ? "" : ", ") + words_of(item);
  return text;
}

std::string label_of(const std::string& key) {
  if (key == "pairs") return "I/G";
  if (key == "sigmas") return "σ";
  if (key == "distances") return "D";
  if (key == "memory_gb") return "memory, GB";
  std::string label = key;
  std::ranges::replace(label, '_', ' ');
  return label;
}

}  // namespace

VerdictSummary summarise(const VerdictTable& table) {
  return {.generation = range_of(table, &VerdictRow::generation_percent),
          .triangles = range_of(table, &VerdictRow::triangles_percent),
          .preserved = range_of(table, &VerdictRow::preserved_points),
          .surplus = range_of(table, &VerdictRow::surplus_points),
          .speedup = range_of(table, &VerdictRow::speedup_ratio),
          .share = verdict_share({table})};
}

std::string verdict_sentence(const StudyContents& study, const VerdictShare& share) {
  if (share.rows == 0) return "The study holds no row of the paper's tables with I of at least 200 by chain.";
  const std::string of = " of " + std::to_string(share.rows);
  std::string text =
      "Of the rows with I of at least 200, " + std::to_string(share.inside) + of + " (" +
      percent_of(share.inside, share.rows) + ") are within " + fixed(verdict_preserved_points, 1) +
      " percentage points of the paper's preservation and within " + fixed(verdict_generation_percent, 0) +
      " % of its triangle counts of generation. For preservation alone these are " +
      std::to_string(share.preserved_inside) + of + ", for counts alone " +
      std::to_string(share.generation_inside) + of + ".";
  if (study.evaluations < papers_evaluations)
    text +=
        " The scenarios have " + std::to_string(study.evaluations) + " evaluations, the paper's about " +
        std::to_string(papers_evaluations) +
        ". Shorter runs have fewer of the late, small steps in which all boundary vertices move in place. "
        "They preserve less.";
  return text;
}

std::string remark_on(const VerdictRow& row) {
  std::string remark;
  if (!row.generation_inside()) remark = "generation count";
  if (!row.preserved_inside()) {
    remark += remark.empty() ? "preservation" : ", preservation";
    if (std::abs(row.preserved_points) - verdict_preserved_points <= 2.0 * row.preserved_error)
      remark += " (by less than two standard errors)";
  }
  return remark;
}

std::vector<std::pair<std::string, std::string>> summary_lines(const StudyContents& study) {
  std::vector<std::pair<std::string, std::string>> lines;
  lines.emplace_back("made by", "remodel " + study.version + ", " + study.created);
  const SummaryJson options = SummaryJson::parse(study.options, nullptr, false);
  if (options.is_object())
    for (const auto& [key, value] : options.items()) lines.emplace_back(label_of(key), words_of(value));
  const SummaryJson machine = SummaryJson::parse(study.machine, nullptr, false);
  if (machine.is_object())
    for (const auto& [key, value] : machine.items())
      lines.emplace_back("machine, " + label_of(key), words_of(value));
  lines.emplace_back("cost", fixed(study.seconds / 3600.0, 2) + " core hours");
  std::string state = std::to_string(study.scenarios) + " of " + std::to_string(study.expected_scenarios) +
                      " scenarios searched, " + std::to_string(study.replays) + " of " +
                      std::to_string(study.expected_replays) + " replays";
  lines.emplace_back("state", (study.finished() ? "finished: " : "not finished: ") + state);
  for (const StudyGap& gap : study.gaps)
    lines.emplace_back("missing", title_of(gap.airfoil) + ", σ = " + short_number(gap.sigma) + ": " +
                                      std::to_string(gap.expected - gap.replays) + " of " +
                                      std::to_string(gap.expected) + " replays");
  return lines;
}

}  // namespace remodel::report
