#include "study/options.h"
#include "remodel/shape_files.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "design/airfoil_space.h"
#include "remodel/error.h"
#include "study/plan.h"
#include "study/strategies.h"

namespace remodel {
namespace {

using Json = nlohmann::ordered_json;

void require(bool good, const char* option, const std::string& expected) {
  if (!good) throw Error(ErrorCode::argument, option, "expected " + expected);
}

template <typename Value>
void require_list(const std::vector<Value>& list, const char* option) {
  require(!list.empty() && list.size() <= longest_list, option,
          "1 to " + std::to_string(longest_list) + " of them, found " + std::to_string(list.size()));
  for (std::size_t i = 0; i < list.size(); ++i)
    require(std::find(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(i), list[i]) ==
                list.begin() + static_cast<std::ptrdiff_t>(i),
            option, "different ones, found one twice");
}

void require_airfoils(const StudyOptions& options) {
  std::vector<std::string> names;
  for (const StudyAirfoil& airfoil : options.airfoils) {
    names.push_back(airfoil.name);
    try {
      require_same_family(study_start().design, airfoil.design);
    } catch (const Error& error) {
      throw Error(error.code(), "airfoils", airfoil.name + ": " + error.what());
    }
  }
  require_list(names, "airfoils");
}

std::vector<std::string> names_of(const std::vector<StudyAirfoil>& airfoils) {
  std::vector<std::string> names;
  for (const StudyAirfoil& airfoil : airfoils) names.push_back(airfoil.name);
  return names;
}

// Appends the elements of `wanted` that the list does not have yet.
template <typename Value>
void add_new(std::vector<Value>& list, const std::vector<Value>& wanted) {
  for (const Value& value : wanted)
    if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
}

}  // namespace

StudyAirfoil study_start() {
  static const StudyAirfoil start{"naca:0012", load_airfoil("naca:0012", 5)};
  return start;
}

StudyOptions full_study() {
  StudyOptions options;
  for (const CatalogueEntry& entry : airfoil_catalogue())
    if (entry.name != "naca0012") options.airfoils.push_back({std::string(entry.name), entry.airfoil()});
  options.scenarios = 30;
  return options;
}

void require_good(const StudyOptions& options) {
  require_airfoils(options);
  require_list(options.sigmas, "sigmas");
  require_list(options.pairs, "pairs");
  require_list(options.distances, "distances");
  require_list(options.strategies, "strategies");
  for (const double sigma : options.sigmas)
    require(sigma > 0.0 && std::isfinite(sigma), "sigmas", "more than 0");
  for (const StudyPair& pair : options.pairs) {
    require(pair.points >= 8 && pair.points <= 100000 && pair.points % 2 == 0, "pairs",
            "an even number of points from 8 to 100000");
    require(pair.gradation > 0.0 && std::isfinite(pair.gradation), "pairs", "a gradation above 0");
  }
  for (const double distance : options.distances)
    require(distance >= 0.0 && std::isfinite(distance), "distances", "at least 0");
  OptimiseOptions ignored;
  for (const std::string& strategy : options.strategies) set_strategy(strategy, ignored);
  require(options.scenarios >= 1 && options.scenarios <= most_scenarios, "scenarios",
          "1 to " + std::to_string(most_scenarios));
  require(options.evaluations >= 1, "evaluations", "at least 1");
}

std::string study_options_to_json(const StudyOptions& options) {
  Json pairs = Json::array();
  for (const StudyPair& pair : options.pairs)
    pairs.push_back({{"points", pair.points}, {"gradation", pair.gradation}});
  return Json{{"airfoils", names_of(options.airfoils)},
              {"sigmas", options.sigmas},
              {"pairs", pairs},
              {"distances", options.distances},
              {"scenarios", options.scenarios},
              {"evaluations", options.evaluations},
              {"compare_every", options.compare_every},
              {"check_every", options.check_every},
              {"validate_every", options.validate_every},
              {"strategies", options.strategies},
              {"seed", options.seed}}
      .dump();
}

StudyOptions study_options_from_json(const std::string& text, const std::string& source) {
  try {
    const Json json = Json::parse(text);
    StudyOptions options;
    for (const Json& name : json.at("airfoils")) options.airfoils.push_back({name.get<std::string>(), {}});
    json.at("sigmas").get_to(options.sigmas);
    options.pairs.clear();
    for (const Json& pair : json.at("pairs"))
      options.pairs.push_back({pair.at("points").get<int>(), pair.at("gradation").get<double>()});
    json.at("distances").get_to(options.distances);
    json.at("scenarios").get_to(options.scenarios);
    json.at("evaluations").get_to(options.evaluations);
    json.at("compare_every").get_to(options.compare_every);
    options.check_every = json.value("check_every", options.check_every);
    options.validate_every = json.value("validate_every", options.validate_every);
    json.at("strategies").get_to(options.strategies);
    json.at("seed").get_to(options.seed);
    return options;
  } catch (const nlohmann::json::exception& problem) {
    throw Error(ErrorCode::format, source, std::string("expected a study's options: ") + problem.what());
  }
}

StudyOptions grown(const StudyOptions& study, const StudyOptions& wanted, const std::string& where) {
  std::string differences;
  const auto require_same = [&](bool same, const char* name) {
    if (!same) differences += (differences.empty() ? "" : ", ") + std::string(name);
  };
  require_same(study.pairs == wanted.pairs, "pairs");
  require_same(study.evaluations == wanted.evaluations, "evaluations");
  require_same(study.compare_every == wanted.compare_every, "compare_every");
  require_same(study.check_every == wanted.check_every, "check_every");
  require_same(study.validate_every == wanted.validate_every, "validate_every");
  require_same(study.seed == wanted.seed, "seed");
  for (const StudyAirfoil& airfoil : wanted.airfoils)
    for (const StudyAirfoil& known : study.airfoils)
      require_same(airfoil.name != known.name || airfoil.design == known.design,
                   ("the design of " + airfoil.name).c_str());
  if (!differences.empty())
    throw Error(ErrorCode::argument, where,
                "expected the options of the study to be resumed, found others: " + differences);
  StudyOptions result = study;
  add_new(result.airfoils, wanted.airfoils);
  add_new(result.sigmas, wanted.sigmas);
  add_new(result.distances, wanted.distances);
  add_new(result.strategies, wanted.strategies);
  result.scenarios = std::max(study.scenarios, wanted.scenarios);
  return result;
}

}  // namespace remodel
