#include "remodel/replay.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "design/design_search.h"
#include "remodel/design_space.h"
#include "remodel/domain.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/io.h"
#include "remodel/optimise.h"
#include "remodel/remodel.h"
#include "remodel/version.h"

namespace remodel {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// What a mesh depends on beside the designs.
struct RunSettings {
  RemodelOptions remodel;
  std::uint64_t workers = 1;
};

template <typename Enum>
Enum named(const Json& name, std::initializer_list<Enum> all) {
  for (const Enum value : all)
    if (name == name_of(value)) return value;
  throw Error(ErrorCode::format, "options", "found " + name.dump() + ", expected another name");
}

void require_replayable(const Json& json, const fs::path& directory) {
  const auto refuse = [&](const std::string& found, const std::string& expected) {
    throw Error(ErrorCode::argument, directory.string(), "found " + found + ", expected " + expected);
  };
  const std::string version = json.at("version");
  if (version != REMODEL_VERSION)
    refuse("a run of version " + version, std::string("one of version ") + REMODEL_VERSION);
  if (json.contains("start_mesh")) refuse("a run that began with a mesh", "one that began with an airfoil");
  const std::string strategy = json.at("strategy");
  for (const MeshStrategy no_chain : {MeshStrategy::hub, MeshStrategy::regenerate})
    if (strategy == name_of(no_chain)) refuse("a run by " + strategy, "one by renew, chain or pool");
}

RunSettings settings_of(const Json& json) {
  const std::uint64_t workers = json.at("workers");
  return {.remodel = {.distance = json.at("distance"),
                      .method =
                          named(json.at("method"), {Method::automatic, Method::specialised, Method::general}),
                      .strategy = info_of(mesh_strategy(json.at("strategy"))).step,
                      .keep = json.at("keep")},
          .workers = workers};
}

void require_same_mesh(const EvaluationRecord& record, const Mesh& mesh, const fs::path& history) {
  if (mesh.triangle_count() == record.triangles) return;
  throw Error(ErrorCode::format, history.string(),
              "evaluation " + std::to_string(record.evaluation) + ": found " +
                  std::to_string(record.triangles) + " triangles, expected " +
                  std::to_string(mesh.triangle_count()) + " after the designs before it");
}

// Where the run had to help itself by generation, so does the replay.
void advance(Mesh& mesh, const Domain& domain, const RemodelOptions& options, bool regenerated) {
  const QualityOptions quality = mesh.options();
  const RemodelResult result = remodel(mesh, domain, options);
  if (regenerated && !result.regenerated) mesh = generate(domain, quality).mesh;
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

}  // namespace

void replay(const fs::path& directory, std::uint64_t worker,
            const std::function<void(const EvaluationRecord&, const Mesh&)>& visit) {
  const fs::path file = directory / "history.sqlite";
  const AirfoilSpace space = read_options(file, History::open(file), [&](const auto& run, const Json& json) {
    require_replayable(json, directory);
    const AirfoilDomainOptions domain = {.points = json.at("points"),
                                         .farfield_radius = json.at("farfield_radius"),
                                         .farfield_points = json.at("farfield_points")};
    return AirfoilSpace(airfoil_from_json(run.at("from"), file.string()), domain);
  });
  replay(directory, space, worker, visit);
}

void replay(const fs::path& directory, const DesignSpace& space, std::uint64_t worker,
            const std::function<void(const EvaluationRecord&, const Mesh&)>& visit) {
  const fs::path file = directory / "history.sqlite";
  const History history = History::open(file);
  RunSettings settings = read_options(file, history, [&](const auto&, const Json& json) {
    require_replayable(json, directory);
    return settings_of(json);
  });
  require_worker(worker, settings.workers);
  const std::vector<double> start = space.start();
  const std::size_t population = interpolation_designer(start, 1.0, 1).population();
  settings.remodel.designs_a_step = static_cast<std::uint32_t>(std::min(settings.workers, population));

  Mesh mesh = read_mesh(directory / "first.vtkhdf");
  history.each([&](const EvaluationRecord& record) {
    if (record.worker != worker) return;
    if (record.coefficients.size() != start.size())
      throw Error(ErrorCode::format, file.string(), "expected the coefficients of the start's degree");
    advance(mesh, space.domain(record.coefficients), settings.remodel, record.regenerated);
    require_same_mesh(record, mesh, file);
    visit(record, mesh);
  });
}

}  // namespace remodel
