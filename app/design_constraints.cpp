#include "design_constraints.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "number_text.h"
#include "remodel/evaluation.h"

namespace remodel::app {

namespace {

// The functions that an entry takes.
std::size_t functions_of(const Json& entry, bool symmetric) {
  const std::string kind = entry.at("kind");
  const std::size_t surfaces = symmetric ? 1 : 2;
  if (kind == "thickness") return entry.at("x").size();
  if (kind == "contains") return surfaces * containment_stations;
  return kind == "leading_edge_radius" ? surfaces : 1;
}

// The evaluator's order: constraints of sections, gaps, those of flows.
int place_of(const std::string& kind) {
  const auto is_one_of = [&](std::initializer_list<const char*> kinds) {
    return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
  };
  return is_one_of({"lift", "moment", "drag", "suction"}) ? 2 : kind == "gap" ? 1 : 0;
}

}  // namespace

std::vector<std::string> constraint_names(const Json& problem) {
  std::vector<std::string> names;
  const Json entries = problem.value("constraints", Json::array());
  const bool symmetric = problem.value("symmetric", false);
  for (int place = 0; place < 3; ++place)
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const std::string kind = entries[i].at("kind");
      if (place_of(kind) != place) continue;
      const bool is_only = std::count_if(entries.begin(), entries.end(),
                                         [&](const Json& other) { return other.at("kind") == kind; }) == 1;
      names.insert(names.end(), functions_of(entries[i], symmetric),
                   is_only ? kind : kind + " (constraint " + std::to_string(i + 1) + ")");
    }
  return names;
}

double constraint_tolerance_of(const Json& problem) {
  return problem.value("constraint_tolerance", default_constraint_tolerance);
}

Json violations(const Json& problem, const std::vector<double>& constraints) {
  const std::vector<std::string> names = constraint_names(problem);
  const double tolerance = constraint_tolerance_of(problem);
  Json result = Json::object();
  for (std::size_t i = 0; i < std::min(names.size(), constraints.size()); ++i) {
    const double before = result.value(names[i], 0.0);
    result[names[i]] = std::max(before, constraints[i] > tolerance ? constraints[i] : 0.0);
  }
  return result;
}

std::optional<std::size_t> least_violated(const std::vector<EvaluationRecord>& rows) {
  std::optional<std::size_t> least;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!std::isfinite(rows[i].objective)) continue;
    if (!least || violation_of(rows[i].constraints) < violation_of(rows[*least].constraints)) least = i;
  }
  return least;
}

std::string why_no_design(const Json& problem, const std::vector<EvaluationRecord>& rows) {
  const std::optional<std::size_t> least = least_violated(rows);
  if (!least) return "no flow was found for any design";
  const Json by = violations(problem, rows[*least].constraints);
  const auto worst = std::max_element(by.begin(), by.end());
  return "no design is within all constraints: the least violated one, design " +
         std::to_string(rows[*least].evaluation) + ", violates '" + worst.key() + "' most, by " +
         short_text(worst->get<double>());
}

}  // namespace remodel::app
