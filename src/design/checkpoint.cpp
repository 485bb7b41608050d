#include "design/checkpoint.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/checked_json.h"
#include "base/checksum.h"
#include "design/finished_design.h"
#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr int checkpoint_version = 4;

constexpr std::string_view mesh_extension = ".vtkhdf", state_extension = ".state";

// File number i, from 0, of one of the two sets.
std::string file_name(char set, std::size_t i, std::string_view extension) {
  return std::string("checkpoint-") + set + (i == 0 ? "" : "-" + std::to_string(i + 1)) +
         std::string(extension);
}

fs::path file_of(const fs::path& directory) {
  return directory / "checkpoint.json";
}

std::string checksum(std::string_view bytes) {
  Checksum sum;
  sum.add(bytes);
  return sum.text();
}

struct StoredFile {
  std::string file;  // empty: none
  std::string checksum;
};

struct Stored {
  Checkpoint checkpoint;  // without the evaluators' states
  std::vector<StoredFile> meshes;
  std::vector<StoredFile> states;  // of each worker's evaluator
};

void require(bool good, const char* problem) {
  if (!good) throw std::invalid_argument(problem);
}

Json to_json(const WorkersState& state) {
  Json workers = Json::array();
  for (const WorkerState& worker : state.workers) {
    workers.push_back({{"design", worker.design},
                       {"evaluated", worker.evaluated},
                       {"full_adjustments", worker.full_adjustments},
                       {"row", worker.row},
                       {"checked", worker.checked}});
    if (!worker.mesh_design.empty()) workers.back()["mesh_design"] = worker.mesh_design;
  }
  return {{"last", state.last}, {"each", std::move(workers)}};
}

WorkersState workers_from(const Json& json) {
  WorkersState state;
  state.last = count_at(json, "last");
  for (const Json& each : json.at("each")) {
    WorkerState& worker = state.workers.emplace_back();
    each.at("design").get_to(worker.design);
    worker.evaluated = count_at(each, "evaluated");
    worker.full_adjustments = count_at(each, "full_adjustments");
    worker.row = count_at(each, "row");
    each.at("checked").get_to(worker.checked);
    if (each.contains("mesh_design")) each.at("mesh_design").get_to(worker.mesh_design);
  }
  require(state.last < state.workers.size(), "it names a worker that there is not");
  return state;
}

Json to_json(const StoredFile& stored) {
  return {{"file", stored.file}, {"checksum", stored.checksum}};
}

std::vector<StoredFile> files_from(const Json& json) {
  std::vector<StoredFile> files;
  for (const Json& each : json) {
    StoredFile& stored = files.emplace_back();
    each.at("file").get_to(stored.file);
    each.at("checksum").get_to(stored.checksum);
    require(stored.file.empty() || is_checkpoint_file(stored.file),
            "it names a file that is none of a checkpoint");
  }
  return files;
}

Stored parse(const std::string& text) {
  Json content = Json::parse(text);
  const std::string expected = content.at("checksum").get<std::string>();
  content.erase("checksum");
  require(checksum(content.dump()) == expected, "its checksum is another");
  require(content.at("format") == "remodel-checkpoint" && content.at("version") == checkpoint_version,
          "it is of another version");
  Stored stored;
  content.at("settings").get_to(stored.checkpoint.settings);
  stored.checkpoint.evaluation = count_at(content, "evaluation");
  stored.checkpoint.refused = count_at(content, "refused");
  content.at("finished").get_to(stored.checkpoint.finished);
  stored.checkpoint.seconds = number_at(content, "seconds", 0.0, most_seconds);
  content.at("designer").get_to(stored.checkpoint.designer);
  content.at("history_checksum").get_to(stored.checkpoint.history_checksum);
  stored.checkpoint.workers = workers_from(content.at("workers"));
  if (content.contains("ahead"))
    for (const Json& each : content.at("ahead"))
      stored.checkpoint.ahead.push_back(finished_design_from(each));
  stored.meshes = files_from(content.at("meshes"));
  stored.states = files_from(content.at("states"));
  require(!stored.meshes.empty() && std::all_of(stored.meshes.begin(), stored.meshes.end(),
                                                [](const StoredFile& mesh) { return !mesh.file.empty(); }),
          "it names no mesh of a checkpoint");
  require(stored.states.size() == stored.checkpoint.workers.workers.size(),
          "it has not one evaluator's state a worker");
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

// These write files of a set and return what the checkpoint says of them.
Json write_meshes(const fs::path& directory, char set, std::span<const Mesh* const> meshes) {
  std::map<const Mesh*, Json> written;
  Json list = Json::array();
  for (const Mesh* mesh : meshes) {
    if (!written.contains(mesh)) {
      const std::string name = file_name(set, written.size(), mesh_extension);
      write_mesh(*mesh, directory / name);
      written[mesh] = to_json(StoredFile{name, checksum(read_text(directory / name))});
    }
    list.push_back(written[mesh]);
  }
  return list;
}

Json write_states(const fs::path& directory, char set, const std::vector<WorkerState>& workers) {
  Json list = Json::array();
  for (const WorkerState& worker : workers) {
    StoredFile stored;
    if (!worker.evaluator.empty()) {
      stored = {file_name(set, list.size(), state_extension), checksum(worker.evaluator)};
      write_text_atomically(directory / stored.file, worker.evaluator);
    }
    list.push_back(to_json(stored));
  }
  return list;
}

// The bytes of a file that the checkpoint names.
std::string read_stored_file(const fs::path& directory, const StoredFile& stored) {
  const fs::path file = directory / stored.file;
  std::string bytes = read_text(file);
  if (checksum(bytes) != stored.checksum)
    throw Error(ErrorCode::format, file.string(),
                "expected the file of checkpoint.json: its checksum is another");
  return bytes;
}

}  // namespace

bool is_checkpoint_file(std::string_view name) {
  const std::string_view extension = name.ends_with(mesh_extension) ? mesh_extension : state_extension;
  if (!name.ends_with(extension) || !(name.starts_with("checkpoint-a") || name.starts_with("checkpoint-b")))
    return false;
  const std::string_view number = name.substr(12, name.size() - 12 - extension.size());
  if (number.empty()) return true;
  return number.size() > 1 && number[0] == '-' &&
         number.find_first_not_of("0123456789", 1) == std::string_view::npos;
}

bool has_checkpoint(const fs::path& directory) {
  return fs::exists(file_of(directory));
}

void write_checkpoint(const fs::path& directory, const Checkpoint& checkpoint,
                      std::span<const Mesh* const> meshes) {
  const char set = free_set(directory);
  Json content = {{"format", "remodel-checkpoint"},
                  {"version", checkpoint_version},
                  {"settings", checkpoint.settings},
                  {"evaluation", checkpoint.evaluation},
                  {"refused", checkpoint.refused},
                  {"finished", checkpoint.finished},
                  {"seconds", checkpoint.seconds},
                  {"designer", checkpoint.designer},
                  {"workers", to_json(checkpoint.workers)},
                  {"history_checksum", checkpoint.history_checksum},
                  {"meshes", write_meshes(directory, set, meshes)},
                  {"states", write_states(directory, set, checkpoint.workers.workers)}};
  for (const FinishedDesign& design : checkpoint.ahead) content["ahead"].push_back(to_json(design));
  content["checksum"] = checksum(content.dump());
  write_text_atomically(file_of(directory), content.dump());
}

Checkpoint read_checkpoint(const fs::path& directory) {
  Stored stored = read_stored(directory);
  for (std::size_t i = 0; i < stored.states.size(); ++i)
    if (!stored.states[i].file.empty())
      stored.checkpoint.workers.workers[i].evaluator = read_stored_file(directory, stored.states[i]);
  return std::move(stored.checkpoint);
}

std::vector<Mesh> read_checkpoint_meshes(const fs::path& directory) {
  std::vector<Mesh> meshes;
  for (const StoredFile& stored : read_stored(directory).meshes) {
    read_stored_file(directory, stored);  // refuses damaged ones
    meshes.push_back(read_mesh(directory / stored.file));
  }
  return meshes;
}

}  // namespace remodel
