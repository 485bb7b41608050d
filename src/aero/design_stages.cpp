#include "aero/design_stages.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "design/checkpoint.h"
#include "design/design_loop.h"
#include "remodel/directory_lock.h"
#include "remodel/io.h"

namespace remodel {
namespace {

using StageJson = nlohmann::ordered_json;
namespace fs = std::filesystem;

// Coarse meshes only lead to the next one: their last steps would be lost in the difference between the two.
constexpr double promise_on_coarse_meshes = 1e-3;

DesignProblem on_coarse_mesh(const DesignProblem& problem, int points) {
  DesignProblem coarse = problem;
  coarse.coarse_points.clear();
  coarse.verify.clear();
  if (problem.gradation) coarse.gradation = *problem.gradation * points / problem.domain.points;
  coarse.domain.points = points;
  coarse.least_promise = std::max(problem.least_promise, promise_on_coarse_meshes);
  if (problem.text.empty()) return coarse;
  StageJson text = StageJson::parse(problem.text);
  text["mesh"]["points"] = points;
  if (coarse.gradation) text["mesh"]["gradation"] = *coarse.gradation;
  coarse.text = text.dump();
  return coarse;
}

DesignStage stage_of(const DesignProblem& problem, const DesignResult& result) {
  return {.points = problem.domain.points,
          .triangles = result.search.triangles_mean,
          .evaluations = static_cast<std::size_t>(result.search.evaluations),
          .start_objective = result.start_objective,
          .objective =
              std::isfinite(result.search.objective) ? std::optional(result.search.objective) : std::nullopt,
          .seconds = result.search.seconds,
          .stopped = result.stopped};
}

// What the next mesh begins with: the best design, or the least violated one that has a flow.
void begin_next(const fs::path& directory, DesignProblem& next) {
  const DesignRun run = read_design_run(directory);
  next.start.reset();
  if (run.has_flow) next.first_design = run.best_design();
}

// Of an earlier run with the same directory: its first design is another one, and nothing goes on from it.
void remove_later_stages(const fs::path& directory) {
  remove_stages(directory, 2);
  std::error_code ignored;
  for (const char* file : {"checkpoint.json", "stages.json", "fresh.json", "history.sqlite"})
    fs::remove(directory / file, ignored);
}

}  // namespace

fs::path stage_directory(const fs::path& directory, std::size_t stage) {
  return directory / ("stage-" + std::to_string(stage));
}

void remove_stages(const fs::path& directory, std::size_t first) {
  std::error_code ignored;
  for (std::size_t stage = first; fs::exists(stage_directory(directory, stage) / "history.sqlite", ignored);
       ++stage)
    fs::remove_all(stage_directory(directory, stage), ignored);
}

std::string stages_json(const std::vector<DesignStage>& stages) {
  StageJson list = StageJson::array();
  const auto number = [](const std::optional<double>& value) {
    return value ? StageJson(*value) : StageJson();
  };
  for (const DesignStage& stage : stages)
    list.push_back({{"points", stage.points},
                    {"triangles", stage.triangles},
                    {"evaluations", stage.evaluations},
                    {"start_objective", number(stage.start_objective)},
                    {"objective", number(stage.objective)},
                    {"seconds", stage.seconds},
                    {"stopped", stage.stopped}});
  return list.dump();
}

DesignResult search_coarse_to_fine(const DesignProblem& problem, const DesignRunOptions& options,
                                   const SearchMesh& search, OptimiseObserver* observer) {
  std::optional<DirectoryLock> lock(std::in_place, options.directory);
  if (!options.resume && !options.overwrite) require_no_other_run(options.directory);
  std::vector<DesignStage> stages;
  DesignProblem next = problem;
  std::string carried;
  const auto is_begun = [&](const fs::path& directory) {
    return options.resume && has_checkpoint(directory);
  };
  for (std::size_t i = 0; i < problem.coarse_points.size(); ++i) {
    DesignProblem coarse = on_coarse_mesh(next, problem.coarse_points[i]);
    DesignRunOptions own = options;
    own.directory = stage_directory(options.directory, i + 1);
    own.resume = i == 0 ? options.resume : is_begun(own.directory);
    // The next mesh has begun with this one's best design, however many designs are asked for now.
    const bool is_last = i + 1 == problem.coarse_points.size();
    if (own.resume && is_begun(is_last ? options.directory : stage_directory(options.directory, i + 2)))
      coarse.evaluations = read_design_run(own.directory).rows.size();
    AtFirstDesign watched(observer, [&] {
      if (i == 0 && options.overwrite) remove_later_stages(options.directory);
    });
    SearchOnMesh on_mesh = search(coarse, own, carried, &watched);
    stages.push_back(stage_of(coarse, on_mesh.result));
    const std::string& stopped = on_mesh.result.stopped;
    if ((stopped != "done" && stopped != "evaluations") || on_mesh.result.search.evaluations == 0) {
      on_mesh.result.stages = std::move(stages);
      std::string& detail = on_mesh.result.detail;
      detail += (detail.empty() ? "" : "; ") +
                ("ended on the mesh of " + std::to_string(coarse.domain.points)) + " points, in " +
                own.directory.string();
      return std::move(on_mesh.result);
    }
    begin_next(own.directory, next);
    carried = std::move(on_mesh.designer);
  }
  lock.reset();
  next.coarse_points.clear();
  DesignRunOptions own = options;
  own.resume = is_begun(options.directory);
  SearchOnMesh finest = search(next, own, carried, observer);
  stages.push_back(stage_of(next, finest.result));
  finest.result.stages = std::move(stages);
  write_text_atomically(options.directory / "stages.json", stages_json(finest.result.stages) + "\n");
  return std::move(finest.result);
}

}  // namespace remodel
