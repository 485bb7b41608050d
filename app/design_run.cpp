#include "design_run.h"

#include <stdexcept>

#include "remodel/error.h"

namespace remodel::app {

double DesignRun::sum(const char* output) const {
  double total = 0.0;
  for (const EvaluationRecord& row : rows)
    if (const auto found = row.outputs.find(output); found != row.outputs.end()) total += found->second;
  return total;
}

bool holds_design_run(const std::filesystem::path& directory) {
  const auto run = History::open(directory / "history.sqlite").run();
  const auto options = run.find("options");
  return options != run.end() && Json::accept(options->second) &&
         Json::parse(options->second).contains("problem");
}

DesignRun read_design_run(const std::filesystem::path& directory) {
  const std::filesystem::path file = directory / "history.sqlite";
  const History history = History::open(file);
  DesignRun run;
  try {
    run.options = Json::parse(history.run().at("options"));
    const Json& space = run.options.at("space");
    run.start = airfoil_from_json(space.at("from").dump(), file.string());
    run.space.half = run.options.at("half");
    run.space.domain.points = space.at("points");
    run.space.domain.farfield_radius = space.at("farfield_radius");
    run.space.domain.farfield_points = space.at("farfield_points");
    const Json& problem = run.options.at("problem");
    run.space.symmetric = problem.value("symmetric", false);
    for (const Json& entry : problem.at("flow")) {
      FlowConditions& at = run.conditions.emplace_back();
      at.mach = entry.at("mach"), at.alpha_deg = entry.value("alpha_deg", 0.0);
      if (entry.contains("cl")) at.cl = entry.at("cl").get<double>();
    }
  } catch (const std::out_of_range&) {
    throw Error(ErrorCode::format, file.string(), "found no run of `remodel design`");
  } catch (const Json::exception&) {
    throw Error(ErrorCode::format, file.string(), "found no run of `remodel design`");
  }
  run.rows = history.records();
  if (run.rows.empty())
    throw Error(ErrorCode::format, file.string(), "found no design, expected one or more");
  const std::size_t numbers = run.section_space().start().size();
  for (const EvaluationRecord& row : run.rows)
    if (row.coefficients.size() != numbers)
      throw Error(ErrorCode::format, file.string(),
                  "evaluation " + std::to_string(row.evaluation) + ": found a design of " +
                      std::to_string(row.coefficients.size()) + " numbers, expected " +
                      std::to_string(numbers));
  for (std::size_t i = 1; i < run.rows.size(); ++i)
    if (run.rows[i].best_objective < run.rows[run.best].best_objective) run.best = i;
  return run;
}

}  // namespace remodel::app
