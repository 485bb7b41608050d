#include "optimise/checkpoint.h"

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string_view>

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

// FNV-1a, 64 bits (G. Fowler, L. C. Noll, K.-P. Vo).
std::string checksum(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

// The content of checkpoint.json, its checksum verified and taken out.
Json read_content(const fs::path& directory) {
  const fs::path file = file_of(directory);
  Json content;
  try {
    content = Json::parse(read_text(file));
    const std::string expected = content.at("checksum").get<std::string>();
    content.erase("checksum");
    if (checksum(content.dump()) != expected) throw std::invalid_argument("its checksum is another");
    if (content.at("format") != "remodel-checkpoint" || content.at("version") != 1)
      throw std::invalid_argument("it is of another version");
  } catch (const Error&) {
    throw;
  } catch (const std::exception& problem) {
    throw Error(ErrorCode::format, file.string(),
                std::string("expected a run's checkpoint: ") + problem.what());
  }
  return content;
}

// The mesh file that the present checkpoint, if there is one, does not name.
std::string free_mesh_name(const fs::path& directory) {
  if (!has_checkpoint(directory)) return mesh_names[0];
  return read_content(directory).value("mesh", "") == mesh_names[0] ? mesh_names[1] : mesh_names[0];
}

}  // namespace

bool has_checkpoint(const fs::path& directory) {
  return fs::exists(file_of(directory));
}

void write_checkpoint(const fs::path& directory, const Checkpoint& checkpoint, const Mesh& mesh) {
  const std::string mesh_name = free_mesh_name(directory);
  write_mesh(mesh, directory / mesh_name);
  Json content = {{"format", "remodel-checkpoint"},
                  {"version", 1},
                  {"settings", checkpoint.settings},
                  {"evaluation", checkpoint.evaluation},
                  {"refused", checkpoint.refused},
                  {"finished", checkpoint.finished},
                  {"seconds", checkpoint.seconds},
                  {"cmaes", checkpoint.cmaes},
                  {"mesh", mesh_name},
                  {"mesh_checksum", checksum(read_text(directory / mesh_name))}};
  content["checksum"] = checksum(content.dump());
  write_text_atomically(file_of(directory), content.dump());
}

Checkpoint read_checkpoint(const fs::path& directory) {
  const Json content = read_content(directory);
  Checkpoint checkpoint;
  content.at("settings").get_to(checkpoint.settings);
  content.at("evaluation").get_to(checkpoint.evaluation);
  content.at("refused").get_to(checkpoint.refused);
  content.at("finished").get_to(checkpoint.finished);
  content.at("seconds").get_to(checkpoint.seconds);
  content.at("cmaes").get_to(checkpoint.cmaes);
  return checkpoint;
}

Mesh read_checkpoint_mesh(const fs::path& directory) {
  const Json content = read_content(directory);
  const fs::path file = directory / content.at("mesh").get<std::string>();
  if (checksum(read_text(file)) != content.at("mesh_checksum"))
    throw Error(ErrorCode::format, file.string(),
                "expected the mesh of checkpoint.json: its checksum is another");
  return read_mesh(file);
}

void remove_checkpoint(const fs::path& directory) {
  fs::remove(file_of(directory));
  for (const char* name : mesh_names) fs::remove(directory / name);
}

}  // namespace remodel
