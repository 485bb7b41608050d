#pragma once

// The -o files of a subcommand: refused before the work where that is possible, written after it.

#include <filesystem>
#include <string>
#include <vector>

#include "arguments.h"
#include "remodel/frozen_mesh.h"
#include "remodel/io.h"
#include "remodel/mesh.h"

namespace remodel::app {

class MeshOutputs {
 public:
  // -o (repeatable) and --msh-version.
  void add_options(CLI::App& app, Presence presence);
  // Throws Error for an unknown extension, a file named twice, and what require_writable() refuses.
  void require_possible() const;
  void write(const Mesh& mesh) const;
  void write(const FrozenMesh& mesh) const;
  const std::vector<std::string>& files() const { return files_; }

 private:
  std::vector<std::string> files_;
  WriteOptions options_;
};

// Throws Error (file) where file is a directory, or its directory is missing or not writable.
void require_writable(const std::filesystem::path& file);

}  // namespace remodel::app
