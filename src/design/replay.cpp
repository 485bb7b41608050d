#include "remodel/replay.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

#include "base/checked_json.h"
#include "design/airfoil_space.h"
#include "design/design_search.h"
#include "design/hub.h"
#include "design/living_mesh.h"
#include "design/run_space.h"
#include "remodel/domain.h"
#include "remodel/error.h"
#include "remodel/io.h"
#include "remodel/optimise.h"
#include "remodel/version.h"

namespace remodel {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

template <typename Enum>
Enum named(const Json& name, std::initializer_list<Enum> all) {
  for (const Enum value : all)
    if (name == name_of(value)) return value;
  throw Error(ErrorCode::format, "options", "found " + name.dump() + ", expected another name");
}

void require_this_version(const Json& json, const fs::path& directory) {
  const std::string version = json.at("version");
  if (version != REMODEL_VERSION)
    throw Error(
        ErrorCode::argument, directory.string(),
        "found a run of version " + version + ", expected one of version " + std::string(REMODEL_VERSION));
}

// What a run's meshes depend on beside the designs and the first of them.
OptimiseOptions options_of(const Json& json) {
  OptimiseOptions options;
  options.remodel = {
      .distance = number_at(json, "distance", 0.0, std::numeric_limits<double>::max()),
      .method = named(json.at("method"), {Method::automatic, Method::specialised, Method::general}),
      .keep = number_at(json, "keep", 0.0, 1e6)};
  options.strategy = mesh_strategy(json.at("strategy"));
  options.workers = count_at(json, "workers", 1, 1000);
  return options;
}

void require_same_mesh(const EvaluationRecord& record, const Mesh& mesh, const fs::path& history) {
  if (mesh.triangle_count() == record.triangles) return;
  throw Error(ErrorCode::format, history.string(),
              "evaluation " + std::to_string(record.evaluation) + ": found " +
                  std::to_string(record.triangles) + " triangles, expected " +
                  std::to_string(mesh.triangle_count()) + " after the designs before it");
}

void require_worker(std::uint64_t worker, std::uint64_t workers) {
  if (worker >= 1 && worker <= workers) return;
  throw Error(ErrorCode::argument, "worker",
              "found " + std::to_string(worker) + ", expected 1 to " + std::to_string(workers));
}

// The run's options, read by `read`.
template <class Read>
auto read_options(const fs::path& file, const History& history, Read read) {
  try {
    const auto run = history.run();
    return read(run, Json::parse(run.at("options")));
  } catch (const Error&) {
    throw;
  } catch (const std::exception& problem) {
    throw Error(ErrorCode::format, file.string(),
                std::string("expected the options of a run: ") + problem.what());
  }
}

// The hub of a run follows the mean of its designer's distribution: the designer is asked once more, and told
// what the history says.
class FollowedHub {
 public:
  FollowedHub(const OptimiseOptions& options, const DesignSpace& space, CmaesDesigner designer,
              const Mesh& mesh)
      : space_(space), designer_(std::move(designer)), hub_(options, space, designer_.population(), mesh) {}

  FollowedHub(const FollowedHub&) = delete;
  FollowedHub& operator=(const FollowedHub&) = delete;

  const Hub& hub() const { return hub_; }

  // Before the row's design is tried.
  void follow(const EvaluationRecord& record) {
    if ((record.evaluation - 1) % designer_.population() != 0) return;
    if (const auto mean = feasible_centre(designer_, feasible_)) hub_.follow(*mean, generation_);
    generation_ = {};
  }

  // After it; `history` is named where the designer proposes another design.
  void tell(const EvaluationRecord& record, const fs::path& history) {
    const auto sample = next_sample(designer_, feasible_, OptimiseOptions{}.max_refused);
    if (!sample || sample->proposal.design != record.coefficients)
      throw Error(ErrorCode::format, history.string(),
                  "evaluation " + std::to_string(record.evaluation) +
                      ": expected the design that the run's seed leads to, found another");
    designer_.tell(sample->proposal, {.objective = record.objective, .constraints = record.constraints});
    ++generation_.evaluated;
    generation_.full_adjustments += record.full_adjustment ? 1 : 0;
  }

 private:
  const DesignSpace& space_;
  Feasible feasible_ = [this](std::span<const double> design) { return space_.feasible(design); };
  CmaesDesigner designer_;
  Hub hub_;
  Hub::Generation generation_;
};

// designer: of a run by CMA-ES, without which a hub cannot be followed.
void replay_run(const fs::path& directory, const DesignSpace& space, std::optional<CmaesDesigner> designer,
                std::uint64_t worker, const ReplayVisit& visit) {
  const fs::path file = directory / "history.sqlite";
  const History history = History::open(file);
  OptimiseOptions options = read_options(file, history, [&](const auto&, const Json& json) {
    require_this_version(json, directory);
    return options_of(json);
  });
  require_worker(worker, options.workers);
  const bool by_hub = options.strategy == MeshStrategy::hub;
  if (by_hub && !designer)
    throw Error(ErrorCode::argument, directory.string(),
                "found a run by hub in a design space of its own, expected one of airfoils");
  const std::vector<double> start = space.start();
  const std::size_t population =
      designer ? designer->population() : interpolation_designer(start, 1.0, 1).population();

  Mesh first = read_outer_mesh(directory / "first.vtkhdf");
  options.quality = first.options();
  std::unique_ptr<FollowedHub> followed;
  std::unique_ptr<LivingMesh> living;
  if (by_hub) {
    followed = std::make_unique<FollowedHub>(options, space, std::move(*designer), first);
    living = std::make_unique<TrialMesh>(options, space, followed->hub(), std::move(first), start);
  } else {
    living = std::make_unique<LivingMesh>(options, space, std::move(first), start,
                                          std::min<std::size_t>(options.workers, population));
  }
  history.each([&](const EvaluationRecord& record) {
    if (record.coefficients.size() != start.size())
      throw Error(ErrorCode::format, file.string(), "expected the coefficients of the start's degree");
    if (followed) followed->follow(record);
    if (record.worker == worker) {
      MeshStep step;
      // What the criterion of `regenerate` chose lies in the history.
      const bool generate = options.strategy == MeshStrategy::regenerate && record.refreshed;
      // A mesh that failed a check was generated afresh: it is validated as the run did.
      const bool may_have_met_limit = !std::isfinite(record.objective);
      std::optional<Mesh> before;
      std::vector<double> of_before = living->design();
      if (may_have_met_limit) before = living->mesh();
      const Stopped stopped =
          living->step(record.coefficients, {.check = record.checked, .generate = generate}, step);
      if (before && stopped != Stopped::done)
        living->take_back(*std::move(before), std::move(of_before), step);
      require_same_mesh(record, living->mesh(), file);
      visit(record, living->mesh());
    }
    if (followed) followed->tell(record, file);
  });
}

// The space of a run of optimise() between airfoils.
std::unique_ptr<RunSpace> run_space(const std::map<std::string, std::string>& run, const Json& options,
                                    const fs::path& directory) {
  const CstAirfoil from = airfoil_from_json(run.at("from"), (directory / "history.sqlite").string());
  const std::optional<RunLayers> layers = RunSpace::layers_in(run.at("options"));
  if (options.contains("start_mesh")) {
    const fs::path first = directory / "first.vtkhdf";
    const Domain domain = layers ? read_layered_mesh(first).domain() : read_mesh(first).domain();
    const AirfoilPlace place = place_from_json(run.at("place"));
    if (place.loop >= domain.loops.size())
      throw std::invalid_argument("place: found loop " + std::to_string(place.loop) + " of " +
                                  std::to_string(domain.loops.size()));
    return std::make_unique<RunSpace>(std::make_unique<AirfoilSpace>(from, domain, place), layers);
  }
  const AirfoilDomainOptions alone{
      .points = static_cast<int>(count_at(options, "points", 8, 100000)),
      .farfield_radius = number_at(options, "farfield_radius", 1.0, 1e6),
      .farfield_points = static_cast<int>(count_at(options, "farfield_points", 8, 100000))};
  return std::make_unique<RunSpace>(std::make_unique<AirfoilSpace>(from, alone), layers);
}

}  // namespace

void replay(const fs::path& directory, std::uint64_t worker, const ReplayVisit& visit) {
  const fs::path file = directory / "history.sqlite";
  struct Searched {
    std::unique_ptr<RunSpace> space;
    double sigma;
    std::uint64_t seed;
  };
  const Searched run = read_options(file, History::open(file), [&](const auto& facts, const Json& json) {
    require_this_version(json, directory);
    return Searched{run_space(facts, json, directory), number_at(json, "sigma", 0.0, 1e100),
                    count_at(json, "seed", 0, UINT64_MAX)};
  });
  const DesignSpace& space = run.space->space();
  replay_run(directory, space, interpolation_designer(space.start(), run.sigma, run.seed), worker, visit);
}

std::unique_ptr<DesignSpace> replayed_space(const fs::path& directory) {
  const fs::path file = directory / "history.sqlite";
  return read_options(file, History::open(file), [&](const auto& facts, const Json& json) {
    require_this_version(json, directory);
    return run_space(facts, json, directory)->release();
  });
}

void replay(const fs::path& directory, const DesignSpace& space, std::uint64_t worker,
            const ReplayVisit& visit) {
  replay_run(directory, space, std::nullopt, worker, visit);
}

}  // namespace remodel
