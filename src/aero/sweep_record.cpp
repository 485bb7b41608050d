#include "aero/sweep_record.h"

#include <cstdint>
#include <limits>
#include <utility>

#include "base/checked_json.h"
#include "base/json_bytes.h"
#include "remodel/error.h"

namespace remodel {
namespace {

constexpr int version = 2;

// What `read` makes of it; every way in which a file can be no sweep's is one kind of error.
template <class Read>
auto trusted(const std::string& source, Read read) {
  try {
    return read();
  } catch (const Json::exception& problem) {
    throw Error(ErrorCode::format, source, std::string("found no sweep of this version: ") + problem.what());
  } catch (const std::invalid_argument& problem) {
    throw Error(ErrorCode::format, source, std::string("found no sweep of this version: ") + problem.what());
  }
}

Json to_json(const SweepSection& section) {
  Json json{{"name", section.name}};
  if (section.problem.empty())
    json["airfoil"] = Json::parse(airfoil_to_json(section.airfoil));
  else
    json["problem"] = section.problem;
  return json;
}

SweepSection section_from(const Json& json, const std::string& source) {
  SweepSection section{.name = json.at("name").get<std::string>()};
  if (json.contains("problem"))
    section.problem = json.at("problem").get<std::string>();
  else
    section.airfoil = airfoil_from_json(json.at("airfoil").dump(), source);
  return section;
}

Json to_json(const std::vector<SweepRow>& rows) {
  Json json = Json::array();
  for (const SweepRow& row : rows)
    json.push_back({{"mach", row.mach}, {"reynolds", row.reynolds}, {"values", row.values}});
  return json;
}

std::vector<SweepRow> rows_from(const Json& json) {
  std::vector<SweepRow> rows;
  for (const Json& row : json)
    rows.push_back({.mach = row.at("mach").get<double>(),
                    .reynolds = row.at("reynolds").get<double>(),
                    .values = row.at("values").get<std::vector<double>>()});
  return rows;
}

template <class Enum>
Enum named(const std::string& name, std::initializer_list<Enum> values) {
  for (const Enum value : values)
    if (name == name_of(value)) return value;
  throw std::invalid_argument("found '" + name + "'");
}

// NaN is what a number is that there is none of: CBOR has it, texts of JSON have null.
double number_or_none(const Json& json) {
  return json.is_null() ? PolarPoint::none : json.get<double>();
}

Json to_json(const SweepFlow& flow) {
  const PolarPoint& p = flow.point;
  return Json::array({flow.section,
                      flow.mach,
                      flow.reynolds,
                      flow.asked,
                      flow.refused,
                      p.status ? name_of(*p.status) : "",
                      p.reason,
                      p.alpha_deg,
                      p.cl,
                      p.cd,
                      p.cm,
                      p.cd_pressure,
                      p.cd_friction,
                      p.y_plus_max,
                      p.newton_steps,
                      p.residual,
                      name_of(p.start),
                      p.seconds,
                      p.warnings,
                      flow.cp,
                      flow.cf,
                      flow.fields});
}

SweepFlow flow_from(const Json& json) {
  std::size_t next = 0;
  const auto take = [&]() -> const Json& { return json.at(next++); };
  SweepFlow flow;
  PolarPoint& p = flow.point;
  flow.section = take().get<std::size_t>();
  for (double* value : {&flow.mach, &flow.reynolds, &flow.asked}) *value = number_or_none(take());
  flow.refused = take().get<bool>();
  if (const auto status = take().get<std::string>(); !status.empty())
    p.status = named(status, {FlowStatus::converged, FlowStatus::step_limit, FlowStatus::stalled,
                              FlowStatus::memory, FlowStatus::interrupted});
  p.converged = p.status == FlowStatus::converged;
  p.reason = take().get<std::string>();
  for (double* value : {&p.alpha_deg, &p.cl, &p.cd, &p.cm, &p.cd_pressure, &p.cd_friction, &p.y_plus_max})
    *value = number_or_none(take());
  if (!p.converged) p.cl = PolarPoint::none;  // the lift that was asked for is in `asked`
  p.newton_steps = take().get<int>();
  p.residual = number_or_none(take());
  p.start = named(take().get<std::string>(), {FlowStart::cold, FlowStart::carried, FlowStart::refactored});
  p.seconds = number_or_none(take());
  p.warnings = take().get<std::vector<std::string>>();
  for (std::vector<double>* values : {&flow.cp, &flow.cf, &flow.fields})
    for (const Json& value : take()) values->push_back(number_or_none(value));
  return flow;
}

}  // namespace

Json to_json(const SweepProblem& problem) {
  Json sections = Json::array();
  for (const SweepSection& section : problem.sections) sections.push_back(to_json(section));
  Json json{{"version", version},
            {"model", name_of(problem.model)},
            {"over_lift", problem.over_lift},
            {"points", problem.domain.points},
            {"farfield_radius", problem.domain.farfield_radius},
            {"tolerance", problem.tolerance},
            {"max_steps", problem.max_steps},
            {"chain", problem.chain},
            {"order", name_of(problem.order)},
            {"seed", problem.seed},
            {"stations", problem.stations},
            {"fields", problem.fields}};
  if (problem.gradation) json["gradation"] = *problem.gradation;
  if (problem.transition) json["transition"] = *problem.transition;
  if (problem.layer)
    json["layer"] = {{"first_height", problem.layer->first_height},
                     {"growth", problem.layer->growth},
                     {"thickness", problem.layer->thickness}};
  if (!problem.field_points.empty()) {
    Json& points = json["field_points"] = Json::array();
    for (const Point p : problem.field_points) points.push_back({p.x, p.y});
  }
  json["rows"] = to_json(problem.rows);
  json["sections"] = std::move(sections);
  return json;
}

SweepProblem sweep_problem_from(const Json& json, const std::string& source) {
  return trusted(source, [&] {
    count_at(json, "version", version, version);
    SweepProblem problem;
    problem.model =
        named(json.at("model").get<std::string>(), {FlowModel::euler, FlowModel::laminar, FlowModel::sa});
    problem.over_lift = json.at("over_lift").get<bool>();
    problem.domain.points = static_cast<int>(count_at(json, "points", 8, 100000));
    problem.domain.farfield_radius = json.at("farfield_radius").get<double>();
    problem.tolerance = json.at("tolerance").get<double>();
    problem.max_steps = static_cast<int>(count_at(json, "max_steps", 1, 1000000));
    problem.chain = count_at(json, "chain", 1);
    problem.order = named(json.at("order").get<std::string>(),
                          {SweepOrder::nearest, SweepOrder::given, SweepOrder::random});
    problem.seed = json.at("seed").get<std::uint64_t>();
    problem.stations = count_at(json, "stations", 0, 100000);
    problem.fields = json.at("fields").get<bool>();
    if (json.contains("gradation")) problem.gradation = json.at("gradation").get<double>();
    if (json.contains("transition")) problem.transition = json.at("transition").get<std::array<double, 2>>();
    if (json.contains("layer")) {
      const Json& layer = json.at("layer");
      problem.layer = LayerOptions{.first_height = layer.at("first_height").get<double>(),
                                   .growth = layer.at("growth").get<double>(),
                                   .thickness = layer.at("thickness").get<double>()};
    }
    if (json.contains("field_points"))
      for (const Json& p : json.at("field_points"))
        problem.field_points.push_back({p.at(0).get<double>(), p.at(1).get<double>()});
    problem.rows = rows_from(json.at("rows"));
    for (const Json& section : json.at("sections")) problem.sections.push_back(section_from(section, source));
    return problem;
  });
}

Json to_json(const std::vector<SweepPlan>& plans) {
  Json json = Json::array();
  for (const SweepPlan& plan : plans) json.push_back({{"rows", to_json(plan.rows)}, {"chains", plan.chains}});
  return json;
}

std::vector<SweepPlan> sweep_plans_from(const Json& json, const SweepProblem& problem,
                                        const std::string& source) {
  return trusted(source, [&] {
    std::vector<SweepPlan> plans;
    for (const Json& plan : json) {
      plans.push_back({.rows = rows_from(plan.at("rows")),
                       .chains = plan.at("chains").get<std::vector<std::vector<std::size_t>>>()});
      for (const std::vector<std::size_t>& chain : plans.back().chains)
        for (const std::size_t section : chain)
          if (section >= problem.sections.size())
            throw std::invalid_argument("found section " + std::to_string(section) + " of " +
                                        std::to_string(problem.sections.size()));
    }
    return plans;
  });
}

std::string encode(const ChainWork& work) {
  return cbor_of(
      Json{{"sweep", to_json(work.problem)}, {"sections", work.sections}, {"directory", work.directory}});
}

ChainWork decode_chain_work(const std::string& bytes) {
  const std::string source = "work of a sweep";
  return trusted(source, [&] {
    const Json json = Json::from_cbor(bytes);
    ChainWork work{.problem = sweep_problem_from(json.at("sweep"), source),
                   .sections = json.at("sections").get<std::vector<std::size_t>>(),
                   .directory = json.at("directory").get<std::string>()};
    if (work.sections.size() != work.problem.sections.size())
      throw std::invalid_argument("found numbers of other sections");
    return work;
  });
}

std::string encode(const ChainResult& result) {
  Json flows = Json::array();
  for (const SweepFlow& flow : result.flows) flows.push_back(to_json(flow));
  return cbor_of(
      Json{{"version", version}, {"mesh_seconds", result.mesh_seconds}, {"flows", std::move(flows)}});
}

ChainResult decode_chain_result(const std::string& bytes, const std::string& source) {
  return trusted(source, [&] {
    const Json json = Json::from_cbor(bytes);
    count_at(json, "version", version, version);
    ChainResult result{.flows = {}, .mesh_seconds = json.at("mesh_seconds").get<double>()};
    for (const Json& flow : json.at("flows")) result.flows.push_back(flow_from(flow));
    return result;
  });
}

}  // namespace remodel
