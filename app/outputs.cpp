#include "outputs.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "arguments.h"
#include "remodel/error.h"

namespace remodel::app {

void require_writable(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    throw Error(ErrorCode::file, file.string(), "is a directory, expected a file to write");
  }
  const std::filesystem::path directory = file.has_parent_path() ? file.parent_path() : ".";
  if (!std::filesystem::is_directory(directory, ignored)) {
    throw Error(ErrorCode::file, file.string(), "directory '" + directory.string() + "' does not exist");
  }
  if (access(directory.c_str(), W_OK | X_OK) != 0) {
    throw Error(ErrorCode::file, file.string(),
                "directory '" + directory.string() + "' is not writable: " + std::strerror(errno));
  }
}

void MeshOutputs::add_options(CLI::App& app, Presence presence) {
  add_texts(app,
            {"-o,--output", "MESH", "",
             "Mesh file to write, format by extension: .vtkhdf (native), .su2, .msh, .vtu; may be repeated"},
            presence, files_);
  add_choice(app, {"--msh-version", "VERSION", "4.1", "Version of .msh files: 4.1 or 2.2"}, {"4.1", "2.2"},
             [this](std::size_t choice) { options_.msh_version = choice == 0 ? 41 : 22; });
}

void MeshOutputs::require_possible() const {
  for (std::size_t i = 0; i < files_.size(); ++i) {
    mesh_format(files_[i]);
    require_writable(files_[i]);
    if (std::find(files_.begin(), files_.begin() + static_cast<std::ptrdiff_t>(i), files_[i]) !=
        files_.begin() + static_cast<std::ptrdiff_t>(i)) {
      throw Error(ErrorCode::argument, "-o", "found '" + files_[i] + "' twice, expected different files");
    }
  }
}

void MeshOutputs::write(const Mesh& mesh) const {
  for (const std::string& file : files_) write_mesh(mesh, file, options_);
}

void MeshOutputs::write(const FrozenMesh& mesh) const {
  for (const std::string& file : files_) write_mesh(mesh, file, options_);
}

}  // namespace remodel::app
