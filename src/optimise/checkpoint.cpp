#include "optimise/checkpoint.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "optimise/checksum.h"
#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr int version = 3;

// Mesh number i, from 0, of one of the two sets.
std::string mesh_name(char set, std::size_t i) {
  return std::string("checkpoint-") + set + (i == 0 ? "" : "-" + std::to_string(i + 1)) + ".vtkhdf";
}

fs::path file_of(const fs::path& directory) {
  return directory / "checkpoint.json";
}

std::string checksum(std::string_view bytes) {
  Checksum sum;
  sum.add(bytes);
  return sum.text();
}

struct StoredMesh {
  std::string file;
  std::string checksum;
};

struct Stored {
  Checkpoint checkpoint;
  std::vector<StoredMesh> meshes;
};

void require(bool good, const char* problem) {
  if (!good) throw std::invalid_argument(problem);
}

Json to_json(const WorkersState& state) {
  Json workers = Json::array();
  for (const WorkerState& worker : state.workers)
    workers.push_back({{"coefficients", worker.coefficients},
                       {"evaluated", worker.evaluated},
                       {"full_adjustments", worker.full_adjustments},
                       {"row", worker.row},
                       {"checked", worker.checked}});
  return {{"last", state.last}, {"each", std::move(workers)}};
}

WorkersState workers_from(const Json& json) {
  WorkersState state;
  json.at("last").get_to(state.last);
  for (const Json& each : json.at("each")) {
    WorkerState& worker = state.workers.emplace_back();
    each.at("coefficients").get_to(worker.coefficients);
    each.at("evaluated").get_to(worker.evaluated);
    each.at("full_adjustments").get_to(worker.full_adjustments);
    each.at("row").get_to(worker.row);
    each.at("checked").get_to(worker.checked);
  }
  require(state.last < state.workers.size(), "it names a worker that there is not");
  return state;
}

Stored parse(const std::string& text) {
  Json content = Json::parse(text);
  const std::string expected = content.at("checksum").get<std::string>();
  content.erase("checksum");
  require(checksum(content.dump()) == expected, "its checksum is another");
  require(content.at("format") == "remodel-checkpoint" && content.at("version") == version,
          "it is of another version");
  Stored stored;
  content.at("settings").get_to(stored.checkpoint.settings);
  content.at("evaluation").get_to(stored.checkpoint.evaluation);
  content.at("refused").get_to(stored.checkpoint.refused);
  content.at("finished").get_to(stored.checkpoint.finished);
  content.at("seconds").get_to(stored.checkpoint.seconds);
  content.at("cmaes").get_to(stored.checkpoint.cmaes);
  content.at("history_checksum").get_to(stored.checkpoint.history_checksum);
  stored.checkpoint.workers = workers_from(content.at("workers"));
  for (const Json& mesh : content.at("meshes"))
    stored.meshes.push_back({mesh.at("file").get<std::string>(), mesh.at("checksum").get<std::string>()});
  require(!stored.meshes.empty() &&
              std::all_of(stored.meshes.begin(), stored.meshes.end(),
                          [](const StoredMesh& mesh) { return is_checkpoint_mesh(mesh.file); }),
          "it names no mesh of a checkpoint");
  return stored;
}

Stored read_stored(const fs::path& directory) {
  const fs::path file = file_of(directory);
  const std::string text = read_text(file);
  try {
    return parse(text);
  } catch (const std::exception& problem) {
    throw Error(ErrorCode::format, file.string(),
                std::string("expected a run's checkpoint: ") + problem.what());
  }
}

// The set that the present checkpoint, if there is one, does not name.
char free_set(const fs::path& directory) {
  if (!has_checkpoint(directory)) return 'a';
  return read_stored(directory).meshes.front().file.starts_with("checkpoint-a") ? 'b' : 'a';
}

// Writes the meshes and returns what the checkpoint says of them.
Json write_meshes(const fs::path& directory, std::span<const Mesh* const> meshes) {
  const char set = free_set(directory);
  std::map<const Mesh*, Json> written;
  Json list = Json::array();
  for (const Mesh* mesh : meshes) {
    if (!written.contains(mesh)) {
      const std::string name = mesh_name(set, written.size());
      write_mesh(*mesh, directory / name);
      written[mesh] = {{"file", name}, {"checksum", checksum(read_text(directory / name))}};
    }
    list.push_back(written[mesh]);
  }
  return list;
}

}  // namespace

bool is_checkpoint_mesh(std::string_view name) {
  const bool framed =
      name.ends_with(".vtkhdf") && (name.starts_with("checkpoint-a") || name.starts_with("checkpoint-b"));
  if (!framed) return false;
  const std::string_view number = name.substr(12, name.size() - 12 - 7);
  if (number.empty()) return true;
  return number.size() > 1 && number[0] == '-' &&
         number.find_first_not_of("0123456789", 1) == std::string_view::npos;
}

bool has_checkpoint(const fs::path& directory) {
  return fs::exists(file_of(directory));
}

void write_checkpoint(const fs::path& directory, const Checkpoint& checkpoint,
                      std::span<const Mesh* const> meshes) {
  Json content = {{"format", "remodel-checkpoint"},
                  {"version", version},
                  {"settings", checkpoint.settings},
                  {"evaluation", checkpoint.evaluation},
                  {"refused", checkpoint.refused},
                  {"finished", checkpoint.finished},
                  {"seconds", checkpoint.seconds},
                  {"cmaes", checkpoint.cmaes},
                  {"workers", to_json(checkpoint.workers)},
                  {"history_checksum", checkpoint.history_checksum},
                  {"meshes", write_meshes(directory, meshes)}};
  content["checksum"] = checksum(content.dump());
  write_text_atomically(file_of(directory), content.dump());
}

Checkpoint read_checkpoint(const fs::path& directory) {
  return read_stored(directory).checkpoint;
}

std::vector<Mesh> read_checkpoint_meshes(const fs::path& directory) {
  std::vector<Mesh> meshes;
  for (const StoredMesh& stored : read_stored(directory).meshes) {
    const fs::path file = directory / stored.file;
    if (checksum(read_text(file)) != stored.checksum)
      throw Error(ErrorCode::format, file.string(),
                  "expected the mesh of checkpoint.json: its checksum is another");
    meshes.push_back(read_mesh(file));
  }
  return meshes;
}

}  // namespace remodel
