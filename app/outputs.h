#pragma once

// The output files (-o) of a subcommand: checked before the work as far as possible, written after it.

#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "arguments.h"
#include "remodel/field.h"
#include "remodel/frozen_mesh.h"
#include "remodel/io.h"
#include "remodel/layers.h"
#include "remodel/mesh.h"

namespace remodel::app {

class MeshOutputs {
 public:
  // -o (repeatable), --msh-version and --inner-markers.
  void add_options(CLI::App& app, Presence presence);
  // Throws Error for an unknown extension, a file named twice, what require_writable() refuses, and options of
  // formats that no file has.
  void require_possible() const;
  void write(const Mesh& mesh) const;
  void write(const FrozenMesh& mesh) const;
  // With fields, of which .su2 files have none.
  void write(const Mesh& mesh, std::span<const Field> fields) const;
  void write(const FrozenMesh& mesh, std::span<const Field> fields) const;
  void write(const LayeredMesh& mesh, LayerCells cells, std::span<const Field> fields = {}) const;
  // Writes SU2's FFD boxes too (ReadNotes::su2_boxes), and warns of files that have no place for them.
  MeshOutputs with_boxes(const std::string& su2_boxes) const;
  const std::vector<std::string>& files() const { return files_; }

 private:
  // freeze() gives the frozen view, write(file, options) writes a file.
  template <class Freeze, class Write>
  void write_each(std::span<const Field> fields, bool is_periodic, Freeze freeze, Write write) const;

  void require_format(MeshFormat format, const char* option, const char* extension) const;

  std::vector<std::string> files_;
  bool inner_markers_ = false;
  bool msh_version_given_ = false;
  WriteOptions options_;
};

// Says on standard error which curves inside the mesh a .su2 file leaves out, and how to have them there.
void warn_of_inner_curves(const FrozenMesh& mesh, const std::string& file, const std::string& remedy);
// Says which boundaries have another name there, as the format knows no blanks in names. inner: whether curves
// inside the mesh are written.
void warn_of_names(const FrozenMesh& mesh, const std::string& file, MeshFormat format, InnerCurves inner);
// Throws Error (file) if the file is a directory, or its directory is missing or not writable.
void require_writable(const std::filesystem::path& file);
// Throws Error (file) where a directory with files of a run cannot be made, or written to.
void require_place_of_run(const std::filesystem::path& directory);
// require_writable(), and throws Error (argument) if the file has none of the extensions (".png").
void require_writable_as(const std::string& file, std::initializer_list<const char*> extensions);
// Whether both names lead to one file, by links too; one that there is not yet counts by its name.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);
// Throws Error (argument) where the file is one of those that are read, and would be lost.
void require_no_input(const std::string& file, const std::vector<std::string>& inputs);
// Throws Error (file) if there is no such directory and none can be made, or it is not writable.
void require_writable_directory(const std::filesystem::path& directory);

}  // namespace remodel::app
