#include "outputs.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "arguments.h"
#include "remodel/error.h"
#include "start_mesh.h"
#include "warnings.h"

namespace remodel::app {

void require_writable(const std::filesystem::path& given) {
  const WrittenPlace place = written_place(given);
  if (place.in_place) return;
  const std::filesystem::path directory =
      place.path.has_parent_path() ? place.path.parent_path() : std::filesystem::path(".");
  std::error_code ignored;
  if (!std::filesystem::is_directory(directory, ignored)) {
    throw Error(ErrorCode::file, given.string(), "directory '" + directory.string() + "' does not exist");
  }
  if (access(directory.c_str(), W_OK | X_OK) != 0) {
    throw Error(ErrorCode::file, given.string(),
                "directory '" + directory.string() + "' is not writable: " + std::strerror(errno));
  }
}

bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code none_there;
  if (std::filesystem::equivalent(a, b, none_there)) return true;
  const auto place = [&](const std::filesystem::path& file) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(file), none_there);
  };
  return place(a) == place(b) && !written_place(a).in_place;  // a device may be written to twice
}

void require_no_input(const std::string& file, const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs)
    if (is_same_file(file, input))
      throw Error(ErrorCode::argument, "-o",
                  "found '" + file + "', which is the input '" + input + "', expected another file");
}

void require_writable_directory(const std::filesystem::path& directory) {
  std::filesystem::path there = std::filesystem::absolute(directory);
  std::error_code ignored;
  while (!std::filesystem::exists(there, ignored) && there.has_relative_path()) there = there.parent_path();
  if (!std::filesystem::is_directory(there, ignored))
    throw Error(ErrorCode::file, there.string(), "is a file, expected a directory to write to");
  if (access(there.c_str(), W_OK | X_OK) != 0)
    throw Error(ErrorCode::file, directory.string(),
                "directory '" + there.string() + "' is not writable: " + std::strerror(errno));
}

void require_place_of_run(const std::filesystem::path& directory) {
  std::error_code ignored;
  if (std::filesystem::is_directory(directory, ignored)) return require_writable(directory / "new");
  if (!std::filesystem::exists(directory, ignored))
    require_writable(directory.has_filename() ? directory : directory.parent_path());
}

void require_writable_as(const std::string& file, std::initializer_list<const char*> extensions) {
  const std::string extension = std::filesystem::path(file).extension().string();
  if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end()) {
    std::string expected;
    for (const char* one : extensions) expected += (expected.empty() ? "" : " or ") + std::string(one);
    throw Error(ErrorCode::argument, file, "found extension '" + extension + "', expected " + expected);
  }
  require_writable(file);
}

namespace {

// What is missing in a file is said: whoever needs it there asks for it.
void say_left_out(const std::vector<std::string>& curves, const std::string& file, const std::string& why) {
  for (const std::string& name : curves) warn(file + ": inner curve '" + name + "' left out, " + why);
}

// .su2 and .foam have no place for regions; where curves divide them, these are spoken of.
void warn_of_regions(const FrozenMesh& mesh, const std::string& file) {
  if (mesh.region_names.size() > 1 && inner_curves(mesh).empty())
    warn(file + ": " + std::to_string(mesh.region_names.size()) +
         " regions left out, for which the format has no place");
}

}  // namespace

void warn_of_inner_curves(const FrozenMesh& mesh, const std::string& file, const std::string& remedy) {
  say_left_out(inner_curves(mesh), file, "which SU2 would take for a wall (" + remedy + ")");
}

void warn_of_names(const FrozenMesh& mesh, const std::string& file, MeshFormat format, InnerCurves inner) {
  const bool all = inner == InnerCurves::markers && format == MeshFormat::su2;
  const std::vector<std::string> left_out = all ? std::vector<std::string>() : inner_curves(mesh);
  for (const FrozenBoundary& boundary : mesh.boundaries)
    if (const std::string name = name_in(format, boundary.name);
        name != boundary.name && std::find(left_out.begin(), left_out.end(), boundary.name) == left_out.end())
      warn(file + ": boundary '" + boundary.name + "' is called '" + name +
           "' there: names of the format have no blanks");
}

void MeshOutputs::add_options(CLI::App& app, Presence presence) {
  add_texts(app,
            {"-o,--output", "MESH", "",
             "Mesh file to write, format by extension: .vtkhdf (native), .su2, .msh, .vtu, .foam (OpenFOAM: "
             "the mesh of the case whose directory it lies in); may be repeated"},
            presence, files_);
  add_choice(app, {"--msh-version", "VERSION", "4.1", "Version of .msh files: 4.1 or 2.2"}, {"4.1", "2.2"},
             [this](std::size_t choice) {
               options_.msh_version = choice == 0 ? 41 : 22;
               msh_version_given_ = true;
             });
  add_flag(app, "--inner-markers",
           "Write curves inside the mesh as markers of .su2 files too, where SU2 takes them for walls",
           inner_markers_);
}

void MeshOutputs::require_possible() const {
  for (std::size_t i = 0; i < files_.size(); ++i) {
    mesh_format(files_[i]);
    require_writable(files_[i]);
    const auto same = [&](const std::string& other) { return is_same_file(other, files_[i]); };
    if (std::any_of(files_.begin(), files_.begin() + static_cast<std::ptrdiff_t>(i), same)) {
      throw Error(ErrorCode::argument, "-o", "found '" + files_[i] + "' twice, expected different files");
    }
  }
  if (msh_version_given_) require_format(MeshFormat::msh, "--msh-version", ".msh");
  if (inner_markers_) require_format(MeshFormat::su2, "--inner-markers", ".su2");
}

void MeshOutputs::require_format(MeshFormat format, const char* option, const char* extension) const {
  const auto has_format = [&](const std::string& file) { return mesh_format(file) == format; };
  if (std::none_of(files_.begin(), files_.end(), has_format))
    throw Error(ErrorCode::argument, option,
                std::string("given without a ") + extension + " file to write, expected one by -o");
}

template <class Freeze, class Write>
void MeshOutputs::write_each(std::span<const Field> fields, bool is_periodic, Freeze freeze,
                             Write write_file) const {
  const auto warn_of_losses = [&](const FrozenMesh& frozen, const std::string& file, MeshFormat format) {
    if (format == MeshFormat::foam)
      say_left_out(inner_curves(frozen), file, "as OpenFOAM has no patches inside a mesh");
    else if (!inner_markers_)
      warn_of_inner_curves(frozen, file, "--inner-markers writes it");
    warn_of_regions(frozen, file);
    warn_of_names(frozen, file, format, inner_markers_ ? InnerCurves::markers : InnerCurves::left_out);
  };
  for (const std::string& file : files_) {
    WriteOptions options = options_;
    if (inner_markers_) options.inner = InnerCurves::markers;
    const MeshFormat format = mesh_format(file);
    if (!options.su2_boxes.empty() && format != MeshFormat::su2 && format != MeshFormat::vtkhdf)
      warn(file + boxes_left_out);
    if (format != MeshFormat::su2 && format != MeshFormat::foam)
      options.fields = fields;
    else
      warn_of_losses(freeze(), file, format);
    if (is_periodic && format != MeshFormat::vtkhdf && format != MeshFormat::vtu)
      warn(file + ": left out that boundaries are periodic: `remodel flow --periodic` says it again");
    write_file(file, options);
  }
}

MeshOutputs MeshOutputs::with_boxes(const std::string& su2_boxes) const {
  MeshOutputs result = *this;
  result.options_.su2_boxes = su2_boxes;
  return result;
}

void MeshOutputs::write(const Mesh& mesh, std::span<const Field> fields) const {
  write_each(
      fields, !mesh.domain().periodic.empty(), [&] { return mesh.freeze(); },
      [&](const std::string& file, const WriteOptions& options) { write_mesh(mesh, file, options); });
}
void MeshOutputs::write(const FrozenMesh& mesh, std::span<const Field> fields) const {
  write_each(
      fields, !mesh.periodic.empty(), [&]() -> const FrozenMesh& { return mesh; },
      [&](const std::string& file, const WriteOptions& options) { write_mesh(mesh, file, options); });
}
void MeshOutputs::write(const LayeredMesh& mesh, LayerCells cells, std::span<const Field> fields) const {
  write_each(
      fields, !mesh.outer().domain().periodic.empty(), [&] { return mesh.freeze(cells); },
      [&](const std::string& file, const WriteOptions& options) { write_mesh(mesh, file, options, cells); });
}
void MeshOutputs::write(const Mesh& mesh) const {
  write(mesh, {});
}
void MeshOutputs::write(const FrozenMesh& mesh) const {
  write(mesh, {});
}

}  // namespace remodel::app
