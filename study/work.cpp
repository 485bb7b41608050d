#include "study/work.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "remodel/error.h"
#include "remodel/version.h"

namespace remodel {
namespace {

using Cbor = nlohmann::json;

template <typename Row>
Cbor cbor_of(const Row& row) {
  Cbor result = Cbor::array();
  for_each_figure(Row::figures(), row, [&](const auto&, const auto& value) { result.push_back(value); });
  return result;
}

template <typename Row>
Row row_of(const Cbor& json) {
  Row row;
  std::size_t index = 0;
  for_each_figure(Row::figures(), row, [&](const auto&, auto& value) { json.at(index++).get_to(value); });
  return row;
}

template <typename Row>
Cbor cbor_of(const std::vector<Row>& rows) {
  Cbor result = Cbor::array();
  for (const Row& row : rows) result.push_back(cbor_of(row));
  return result;
}

template <typename Row>
std::vector<Row> rows_of(const Cbor& json) {
  std::vector<Row> result;
  for (const Cbor& row : json) result.push_back(row_of<Row>(row));
  return result;
}

Cbor cbor_of(const StudyPath& path) {
  return {{"dimension", path.dimension}, {"values", path.values}};
}

StudyPath path_of(const Cbor& json) {
  StudyPath path;
  json.at("dimension").get_to(path.dimension);
  json.at("values").get_to(path.values);
  if (path.values.size() % (path.dimension + 2) != 0) throw std::invalid_argument("a path of another size");
  return path;
}

std::string bytes_of(const Cbor& json) {
  std::string bytes;
  Cbor::to_cbor(json, bytes);
  return bytes;
}

// Calls read(json) with the decoded bytes; its exceptions become Error (format).
template <typename Read>
auto parse(const std::string& bytes, const char* content, Read read) {
  try {
    const Cbor json = Cbor::from_cbor(bytes);
    if (json.at("version") != REMODEL_VERSION) throw std::invalid_argument("of another version");
    return read(json);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& problem) {
    throw Error(ErrorCode::format, content,
                std::string("expected those of version ") + REMODEL_VERSION + ": " + problem.what());
  }
}

}  // namespace

std::string encode(const StudyWork& work) {
  return bytes_of({{"version", REMODEL_VERSION},
                   {"kind", static_cast<int>(work.kind)},
                   {"from", airfoil_to_json(work.from)},
                   {"to", airfoil_to_json(work.to)},
                   {"evaluations", work.evaluations},
                   {"compare_every", work.compare_every},
                   {"check_every", work.check_every},
                   {"validate_every", work.validate_every},
                   {"sigma", work.sigma},
                   {"seed", work.seed},
                   {"all_points", work.points},
                   {"points", work.pair.points},
                   {"gradation", work.pair.gradation},
                   {"path", cbor_of(work.path)},
                   {"distance", work.distance},
                   {"strategy", work.strategy},
                   {"fresh", cbor_of(work.fresh)}});
}

StudyWork decode_work(const std::string& bytes) {
  return parse(bytes, "a study's job", [](const Cbor& json) {
    StudyWork work;
    work.kind = static_cast<JobKind>(json.at("kind").get<int>());
    work.from = airfoil_from_json(json.at("from").get<std::string>(), "a study's job");
    work.to = airfoil_from_json(json.at("to").get<std::string>(), "a study's job");
    json.at("evaluations").get_to(work.evaluations);
    json.at("compare_every").get_to(work.compare_every);
    json.at("check_every").get_to(work.check_every);
    json.at("validate_every").get_to(work.validate_every);
    json.at("sigma").get_to(work.sigma);
    json.at("seed").get_to(work.seed);
    json.at("all_points").get_to(work.points);
    json.at("points").get_to(work.pair.points);
    json.at("gradation").get_to(work.pair.gradation);
    work.path = path_of(json.at("path"));
    json.at("distance").get_to(work.distance);
    json.at("strategy").get_to(work.strategy);
    work.fresh = rows_of<FreshRow>(json.at("fresh"));
    return work;
  });
}

std::string encode(const StudyRows& rows) {
  Cbor json = {{"version", REMODEL_VERSION}, {"kind", rows.index()}};
  if (const auto* path = std::get_if<PathRows>(&rows)) {
    json["row"] = cbor_of(*path);
    json["path"] = cbor_of(path->path);
  } else if (const auto* fresh = std::get_if<FreshRows>(&rows)) {
    json["rows"] = cbor_of(*fresh);
  } else {
    const auto& replay = std::get<ReplayRows>(rows);
    json["row"] = cbor_of(replay.replay);
    json["blocks"] = cbor_of(replay.blocks);
    json["comparisons"] = cbor_of(replay.comparisons);
  }
  return bytes_of(json);
}

StudyRows decode_rows(const std::string& bytes) {
  return parse(bytes, "a study's rows", [](const Cbor& json) -> StudyRows {
    switch (static_cast<JobKind>(json.at("kind").get<int>())) {
      case JobKind::path: {
        PathRows rows = row_of<PathRows>(json.at("row"));
        rows.path = path_of(json.at("path"));
        return rows;
      }
      case JobKind::fresh:
        return rows_of<FreshRow>(json.at("rows"));
      case JobKind::replay:
        return ReplayRows{.replay = row_of<ReplayRow>(json.at("row")),
                          .blocks = rows_of<BlockRow>(json.at("blocks")),
                          .comparisons = rows_of<ComparisonRow>(json.at("comparisons"))};
    }
    throw std::invalid_argument("rows of an unknown kind");
  });
}

std::optional<std::string> run_study_job(const std::string& bytes, const std::function<bool()>& cancelled) {
  const StudyWork work = decode_work(bytes);
  try {
    switch (work.kind) {
      case JobKind::path:
        return encode(compute_path(work, cancelled));
      case JobKind::fresh:
        return encode(compute_fresh(work, cancelled));
      case JobKind::replay:
        return encode(compute_replay(work, cancelled));
    }
  } catch (const StudyCancelled&) {
    return std::nullopt;
  }
  throw Error(ErrorCode::format, "a study's job", "is of an unknown kind");
}

}  // namespace remodel
