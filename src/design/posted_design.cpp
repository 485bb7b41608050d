#include "design/posted_design.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "base/checksum.h"
#include "base/json_bytes.h"
#include "design/finished_design.h"
#include "io/mesh_bytes.h"
#include "remodel/error.h"
#include "remodel/version.h"

namespace remodel {
namespace {

using Json = nlohmann::json;

const std::string other_process = "a design of another process";

Json to_json(const WorkerState& state) {
  return {{"design", state.design},
          {"row", state.row},
          {"checked", state.checked},
          {"full_adjustments", state.full_adjustments},
          {"evaluator", binary_json(state.evaluator)},
          {"mesh_design", state.mesh_design}};
}

WorkerState worker_state_from(const Json& json) {
  return {.design = json.at("design").get<std::vector<double>>(),
          .full_adjustments = json.at("full_adjustments").get<std::uint64_t>(),
          .row = json.at("row").get<RegenerationRule::Row>(),
          .checked = json.at("checked").get<bool>(),
          .evaluator = bytes_in(json.at("evaluator")),
          .mesh_design = json.at("mesh_design").get<std::vector<double>>()};
}

Json meshes_json(const std::vector<const Mesh*>& meshes) {
  Json json = Json::array();
  for (const Mesh* mesh : meshes) json.push_back(binary_json(io::mesh_to_bytes(*mesh)));
  return json;
}

std::vector<Mesh> meshes_from(const Json& json) {
  std::vector<Mesh> meshes;
  for (const Json& mesh : json) meshes.push_back(io::mesh_from_bytes(bytes_in(mesh), other_process));
  return meshes;
}

template <class Read>
auto understood(Read read) {
  try {
    return read();
  } catch (const Json::exception& problem) {
    throw Error(ErrorCode::format, other_process, problem.what());
  } catch (const std::invalid_argument& problem) {
    throw Error(ErrorCode::format, other_process, problem.what());
  }
}

}  // namespace

std::string encode(const PostedDesign& design, const std::vector<const Mesh*>& meshes) {
  const EvaluationRecord& record = design.record;
  return cbor_of(Json{{"run", design.run},
                      {"worker", design.worker},
                      {"token", design.token},
                      {"before", design.before},
                      {"state", to_json(design.state)},
                      {"meshes", meshes_json(meshes)},
                      {"design", design.proposal.design},
                      {"gradient", design.proposal.gradient},
                      {"from", design.proposal.from},
                      {"compare", design.tasks.compare ? Json(*design.tasks.compare) : Json()},
                      {"check", name_of(design.tasks.check)},
                      {"squared_displacement", design.squared_displacement},
                      {"evaluation", record.evaluation},
                      {"generation", record.generation},
                      {"sigma", record.sigma}});
}

PostedDesign decode_posted_design(const std::string& bytes) {
  return understood([&] {
    const Json json = Json::from_cbor(bytes);
    PostedDesign design{.run = json.at("run").get<std::string>(),
                        .worker = json.at("worker").get<std::uint64_t>(),
                        .token = json.at("token").get<std::uint64_t>(),
                        .before = json.at("before").get<std::uint64_t>(),
                        .state = worker_state_from(json.at("state")),
                        .meshes = meshes_from(json.at("meshes")),
                        .proposal = {.design = json.at("design").get<std::vector<double>>(),
                                     .gradient = json.at("gradient").get<bool>(),
                                     .from = json.at("from").get<std::vector<double>>()},
                        .tasks = {.check = checked_named(json.at("check").get<std::string>())},
                        .record = {},
                        .squared_displacement = json.at("squared_displacement").get<double>()};
    if (!json.at("compare").is_null()) design.tasks.compare = json.at("compare").get<std::vector<double>>();
    design.record.evaluation = json.at("evaluation").get<std::uint64_t>();
    design.record.generation = json.at("generation").get<std::uint64_t>();
    design.record.sigma = json.at("sigma").get<double>();
    design.record.coefficients = design.proposal.design;
    return design;
  });
}

std::string encode(const EvaluatedDesign& design, const Mesh& mesh) {
  Json json{{"stopped", static_cast<int>(design.stopped)}};
  if (design.stopped == Stopped::done) {
    json["finished"] = to_json(design.finished);
    json["state"] = to_json(design.state);
    json["meshes"] = meshes_json({&mesh});
  }
  return cbor_of(json);
}

EvaluatedDesign decode_evaluated_design(const std::string& bytes) {
  return understood([&] {
    const Json json = Json::from_cbor(bytes);
    EvaluatedDesign design{.stopped = static_cast<Stopped>(json.at("stopped").get<int>()),
                           .finished = {},
                           .state = {},
                           .meshes = {}};
    if (design.stopped != Stopped::done) return design;
    design.finished = finished_design_from(json.at("finished"));
    design.state = worker_state_from(json.at("state"));
    design.meshes = meshes_from(json.at("meshes"));
    return design;
  });
}

std::string identity_of(const DesignSpace& space, const Evaluator& evaluator) {
  Checksum sum;
  for (const std::string& text : {std::string(REMODEL_VERSION), space.description(), evaluator.description()})
    sum.add(text + "\n");
  return sum.text();
}

}  // namespace remodel
