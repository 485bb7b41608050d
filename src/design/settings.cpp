#include "design/settings.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/checksum.h"
#include "design/living_mesh.h"
#include "design/workers.h"
#include "remodel/error.h"
#include "remodel/mesh_state.h"
#include "remodel/version.h"
#include "step/strategy.h"

namespace remodel {
namespace {

constexpr std::size_t most_workers = 1000;

// All that a run depends on of its start mesh.
std::string identity_of(const Mesh& mesh) {
  const MeshState state = mesh.state();
  Checksum sum;
  for (const double value : state.coordinates) sum.add(value);
  for (const double value : state.length_scales) sum.add(value);
  for (const std::uint32_t value : state.triangle_vertices) sum.add(std::uint64_t{value});
  sum.add(domain_to_json(state.domain));
  return sum.text();
}

// Which of two settings differ, for the error message.
std::string differences(const std::string& a, const std::string& b) {
  const auto first = nlohmann::json::parse(a, nullptr, false), second = nlohmann::json::parse(b);
  if (!first.is_object()) return "all";
  std::string names;
  const auto add = [&](const std::string& key) { names += (names.empty() ? "" : ", ") + key; };
  for (const auto& [key, value] : second.items())
    if (!first.contains(key) || first[key] != value) add(key);
  for (const auto& [key, value] : first.items())
    if (!second.contains(key)) add(key);
  return names;
}

// A part of a run says what it is.
void add_description(nlohmann::ordered_json& json, const std::string& description, const char* part) {
  const auto object = nlohmann::ordered_json::parse(description, nullptr, false);
  if (!object.is_object())
    throw Error(ErrorCode::argument, part, "expected a description that is a JSON object");
  json.update(object);
}

}  // namespace

void require_good(const OptimiseOptions& options) {
  const auto require = [](bool good, const char* option, const char* expected) {
    if (!good) throw Error(ErrorCode::argument, option, expected);
  };
  require(options.evaluations >= 1, "evaluations", "expected at least 1");
  require(options.max_refused >= 1, "max_refused", "expected at least 1");
  require(options.tolerance >= 0.0 && std::isfinite(options.tolerance), "tolerance", "expected at least 0");
  require(options.constraint_tolerance >= 0.0 && std::isfinite(options.constraint_tolerance),
          "constraint_tolerance", "expected at least 0");
  require(options.workers <= most_workers, "workers", "expected 0 to 1000");
  require(options.threads <= most_workers, "threads", "expected 0 to 1000");
  require(!options.fail_at_limits || options.compare_every == 0, "compare every",
          "expected 0 where designs fail at limits of meshes");
  require(options.strategy != MeshStrategy::regenerate || !options.start, "strategy",
          "expected another than regenerate with a start mesh, which it would replace");
  require(!options.directory.empty(), "directory", "expected the run's directory");
}

std::string settings_of(const DesignSpace& space, const Designer& designer, const Evaluator& evaluator,
                        const OptimiseOptions& options) {
  const QualityOptions quality = quality_of(options);
  const RemodelOptions step = step_options(options);
  using OrderedJson = nlohmann::ordered_json;
  OrderedJson json = {{"version", REMODEL_VERSION}};
  add_description(json, space.description(), "design space");
  add_description(json, designer.description(), "designer");
  add_description(json, evaluator.description(), "evaluator");
  json.update(OrderedJson{{"min_angle_deg", quality.min_angle_deg},
                          {"max_gradation", quality.max_gradation},
                          {"gradation", quality.gradation},
                          {"resolution", quality.resolution},
                          {"max_vertices", quality.max_vertices},
                          {"min_edge", quality.min_edge},
                          {"distance", step.distance},
                          {"method", name_of(step.method)},
                          {"strategy", name_of(options.strategy)},
                          {"workers", worker_count(options, designer.population())},
                          {"keep", resolved_keep(step, quality)},
                          {"compare_every", options.compare_every},
                          {"full_check_every", options.full_check_every}});
  if (options.constraint_tolerance != 0.0) json["constraint_tolerance"] = options.constraint_tolerance;
  if (!options.first_design.empty()) json["first_design"] = options.first_design;
  if (options.start) {
    json["refine_angle_deg"] = quality.refine_angle_deg;
    json["start_mesh"] = identity_of(options.start->mesh);
  }
  return json.dump();
}

void require_settings(const std::string& found, const std::string& expected,
                      const std::filesystem::path& directory) {
  if (found != expected)
    throw Error(
        ErrorCode::argument, directory.string(),
        "expected the options of the run to be resumed, found others: " + differences(found, expected));
}

}  // namespace remodel
