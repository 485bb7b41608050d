#include "aero/posted_point.h"

#include <nlohmann/json.hpp>

#include "base/json_bytes.h"
#include "io/mesh_bytes.h"
#include "remodel/error.h"

namespace remodel {
namespace {

using PointJson = nlohmann::json;

const std::string point_source = "a point of another process";

template <class Read>
auto point_read(Read read) {
  try {
    return read();
  } catch (const PointJson::exception& problem) {
    throw Error(ErrorCode::format, point_source, problem.what());
  }
}

}  // namespace

std::string encode(const PostedPoint& point, const Mesh& mesh) {
  PointJson json{{"run", point.run},          {"point", point.point},   {"token", point.token},
                 {"before", point.before},    {"design", point.design}, {"from", point.from},
                 {"gradient", point.gradient}};
  if (point.target) {
    PointJson& target = json["target"] = PointJson::array();
    for (const auto& [parameter, pressure] : *point.target) target.push_back({parameter, pressure});
  }
  json["mesh"] = binary_json(io::mesh_to_bytes(mesh));
  return cbor_of(json);
}

PostedPoint decode_posted_point(const std::string& bytes) {
  return point_read([&] {
    const PointJson json = PointJson::from_cbor(bytes);
    PostedPoint point{.run = json.at("run").get<std::string>(),
                      .point = json.at("point").get<std::uint64_t>(),
                      .token = json.at("token").get<std::uint64_t>(),
                      .before = json.at("before").get<std::uint64_t>(),
                      .design = json.at("design").get<std::vector<double>>(),
                      .from = json.at("from").get<std::vector<double>>(),
                      .gradient = json.at("gradient").get<bool>(),
                      .target = {},
                      .mesh = io::mesh_from_bytes(bytes_in(json.at("mesh")), point_source)};
    if (!json.contains("target")) return point;
    point.target.emplace();
    for (const PointJson& station : json.at("target"))
      (*point.target)[station.at(0).get<double>()] = station.at(1).get<double>();
    return point;
  });
}

std::string encode(const EvaluatedPoint& evaluated) {
  if (!evaluated.problem.empty()) return cbor_of(PointJson{{"problem", evaluated.problem}});
  const FlowResult& flow = evaluated.point.flow;
  PointJson json{{"cl", flow.cl},
                 {"cd", flow.cd},
                 {"cm", flow.cm},
                 {"alpha_deg", flow.alpha_deg},
                 {"seconds", flow.seconds},
                 {"factorisations", flow.factorisations},
                 {"gradient_seconds", evaluated.point.gradient_seconds},
                 {"of_outlets", evaluated.point.of_outlets}};
  if (flow.friction) json["friction"] = {flow.friction->cd_pressure, flow.friction->cd_friction};
  PointJson& slopes = json["slopes"] = PointJson::array();
  for (const auto& [function, slope] : evaluated.point.slopes)
    slopes.push_back({function, slope.value, slope.by});
  return cbor_of(json);
}

EvaluatedPoint decode_evaluated_point(const std::string& bytes) {
  return point_read([&] {
    const PointJson json = PointJson::from_cbor(bytes);
    EvaluatedPoint evaluated;
    if (json.contains("problem")) {
      evaluated.problem = json.at("problem").get<std::string>();
      return evaluated;
    }
    FlowResult& flow = evaluated.point.flow;
    flow.cl = json.at("cl").get<double>(), flow.cd = json.at("cd").get<double>();
    flow.cm = json.at("cm").get<double>(), flow.alpha_deg = json.at("alpha_deg").get<double>();
    flow.seconds = json.at("seconds").get<double>();
    flow.factorisations = json.at("factorisations").get<int>();
    evaluated.point.gradient_seconds = json.at("gradient_seconds").get<double>();
    for (const PointJson& number : json.at("of_outlets"))
      evaluated.point.of_outlets.push_back({number.at(0).get<std::string>(), number.at(1).get<double>()});
    if (json.contains("friction")) {
      flow.friction.emplace();
      flow.friction->cd_pressure = json.at("friction").at(0).get<double>();
      flow.friction->cd_friction = json.at("friction").at(1).get<double>();
    }
    for (const PointJson& slope : json.at("slopes"))
      evaluated.point.slopes[slope.at(0).get<std::size_t>()] = {slope.at(1).get<double>(),
                                                                slope.at(2).get<std::vector<double>>()};
    return evaluated;
  });
}

}  // namespace remodel
