#include "optimise/checkpoint.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

#include "optimise/checksum.h"
#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr std::array<const char*, 2> mesh_names = {"checkpoint-a.vtkhdf", "checkpoint-b.vtkhdf"};

fs::path file_of(const fs::path& directory) {
  return directory / "checkpoint.json";
}

std::string checksum(std::string_view bytes) {
  Checksum sum;
  sum.add(bytes);
  return sum.text();
}

struct Stored {
  Checkpoint checkpoint;
  std::string mesh;  // file name
  std::string mesh_checksum;
};

Stored parse(const std::string& text) {
  Json content = Json::parse(text);
  const auto require = [](bool good, const char* problem) {
    if (!good) throw std::invalid_argument(problem);
  };
  const std::string expected = content.at("checksum").get<std::string>();
  content.erase("checksum");
  require(checksum(content.dump()) == expected, "its checksum is another");
  require(content.at("format") == "remodel-checkpoint" && content.at("version") == 2,
          "it is of another version");
  Stored stored;
  content.at("settings").get_to(stored.checkpoint.settings);
  content.at("evaluation").get_to(stored.checkpoint.evaluation);
  content.at("refused").get_to(stored.checkpoint.refused);
  content.at("finished").get_to(stored.checkpoint.finished);
  content.at("seconds").get_to(stored.checkpoint.seconds);
  content.at("cmaes").get_to(stored.checkpoint.cmaes);
  content.at("history_checksum").get_to(stored.checkpoint.history_checksum);
  content.at("mesh").get_to(stored.mesh);
  content.at("mesh_checksum").get_to(stored.mesh_checksum);
  require(std::find(mesh_names.begin(), mesh_names.end(), stored.mesh) != mesh_names.end(),
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

// The mesh file that the present checkpoint, if there is one, does not name.
std::string free_mesh_name(const fs::path& directory) {
  if (!has_checkpoint(directory)) return mesh_names[0];
  return read_stored(directory).mesh == mesh_names[0] ? mesh_names[1] : mesh_names[0];
}

}  // namespace

bool has_checkpoint(const fs::path& directory) {
  return fs::exists(file_of(directory));
}

void write_checkpoint(const fs::path& directory, const Checkpoint& checkpoint, const Mesh& mesh) {
  const std::string mesh_name = free_mesh_name(directory);
  write_mesh(mesh, directory / mesh_name);
  Json content = {{"format", "remodel-checkpoint"},
                  {"version", 2},
                  {"settings", checkpoint.settings},
                  {"evaluation", checkpoint.evaluation},
                  {"refused", checkpoint.refused},
                  {"finished", checkpoint.finished},
                  {"seconds", checkpoint.seconds},
                  {"cmaes", checkpoint.cmaes},
                  {"history_checksum", checkpoint.history_checksum},
                  {"mesh", mesh_name},
                  {"mesh_checksum", checksum(read_text(directory / mesh_name))}};
  content["checksum"] = checksum(content.dump());
  write_text_atomically(file_of(directory), content.dump());
}

Checkpoint read_checkpoint(const fs::path& directory) {
  return read_stored(directory).checkpoint;
}

Mesh read_checkpoint_mesh(const fs::path& directory) {
  const Stored stored = read_stored(directory);
  const fs::path file = directory / stored.mesh;
  if (checksum(read_text(file)) != stored.mesh_checksum)
    throw Error(ErrorCode::format, file.string(),
                "expected the mesh of checkpoint.json: its checksum is another");
  return read_mesh(file);
}

}  // namespace remodel
