// Fields of OpenFOAM's time directories, in ASCII: dictionaries in which lists of values stand behind
// `nonuniform`.
// https://www.openfoam.com/documentation/user-guide/2-openfoam-cases/2.2-basic-inputoutput-file-format

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <system_error>

#include "io/foam_edges.h"
#include "io/scanner.h"
#include "io/text_writer.h"
#include "remodel/error.h"
#include "remodel/foam.h"
#include "remodel/io.h"

namespace remodel {

namespace {

namespace fs = std::filesystem;
using io::FoamPatch;

// Walks through a dictionary and takes its lists.
class FieldScanner {
 public:
  FieldScanner(std::string_view text, const std::string& source) : text_(text), source_(source) {}

  // Of a whole file: one that a solver was writing when it was ended has open braces, or no boundaryField.
  std::vector<FoamList> lists() {
    std::vector<FoamList> found;
    std::string_view last;
    bool boundary = false;
    for (std::string_view word = next(); !word.empty(); last = word, word = next()) {
      boundary = boundary || (open_.empty() && word == "boundaryField");
      if (word == "{")
        open_.push_back(last);
      else if (word == "}" && !open_.empty())
        open_.pop_back();
      else if (word == "nonuniform")
        found.push_back(list());
    }
    if (!open_.empty()) refuse_end("'}' of " + io::in_quotes(open_.back()));
    if (!boundary) refuse_end("boundaryField");
    return found;
  }
  bool begins_with(std::string_view word) { return next() == word; }
  // The value of an entry of the header.
  std::string header(std::string_view key) {
    for (std::string_view word = next(); !word.empty() && word != "}"; word = next())
      if (word == key) return std::string(next());
    return {};
  }

 private:
  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
    throw Error(ErrorCode::format, source_ + ":" + std::to_string(line),
                "found " + found + ", expected " + expected);
  }

  [[noreturn]] void refuse_end(const std::string& expected) const {
    refuse("the end of the file", expected + " before it: it is not whole");
  }

  void skip() {
    for (;;) {
      at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size());
      const std::string_view rest = text_.substr(at_);
      if (rest.starts_with("//"))
        at_ = std::min(text_.find('\n', at_), text_.size());
      else if (rest.starts_with("/*"))
        at_ = std::min(text_.find("*/", at_), text_.size() - 2) + 2;
      else
        return;
    }
  }
  std::string_view next() {
    constexpr std::string_view alone = "{}();";
    skip();
    if (at_ == text_.size()) return {};
    const std::size_t begin = at_;
    if (alone.find(text_[at_]) != std::string_view::npos)
      ++at_;
    else if (text_[at_] == '"')
      at_ = std::min(text_.find('"', at_ + 1), text_.size() - 1) + 1;
    else
      at_ = std::min(text_.find_first_of(" \t\r\n{}();\"", at_), text_.size());
    return text_.substr(begin, at_ - begin);
  }
  void expect(std::string_view word) {
    const std::string_view found = next();
    if (found != word) refuse(io::in_quotes(found), io::in_quotes(word));
  }
  double number() {
    const std::string_view word = next();
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
      refuse(io::in_quotes(word), "a finite number");
    return value;
  }

  // Behind `nonuniform`: List<scalar> 3(1 2 3), List<vector> 2((1 0 0) (0 1 0)), List<scalar> 4{1}, 0().
  FoamList list() {
    FoamList list;
    skip();
    list.begin = at_;
    if (open_.size() >= 2 && open_.front() == "boundaryField") list.patch = std::string(open_.back());
    std::string_view word = next();
    if (word.starts_with("List<")) {
      list.components = components(word);
      word = next();
    }
    std::size_t count = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), count);
    if (error != std::errc() || end != word.data() + word.size() || count > text_.size())
      refuse(io::in_quotes(word), "a number of values");
    const bool same = peek() == '{';
    expect(same ? "{" : "(");
    for (std::size_t i = 0; i < (same ? 1 : count); ++i) value(list);
    expect(same ? "}" : ")");
    if (same) {
      const std::vector<double> one = list.values;
      list.values.clear();
      for (std::size_t i = 0; i < count; ++i) list.values.insert(list.values.end(), one.begin(), one.end());
    }
    list.end = at_;
    return list;
  }
  int components(std::string_view word) const {
    if (word == "List<scalar>") return 1;
    if (word == "List<vector>") return 3;
    if (word == "List<symmTensor>") return 6;
    if (word == "List<tensor>") return 9;
    refuse(io::in_quotes(word), "List<scalar>, List<vector>, List<symmTensor> or List<tensor>");
  }
  void value(FoamList& list) {
    if (list.components == 1) return list.values.push_back(number());
    expect("(");
    for (int k = 0; k < list.components; ++k) list.values.push_back(number());
    expect(")");
  }
  char peek() {
    skip();
    return at_ < text_.size() ? text_[at_] : '\0';
  }

  std::string_view text_;
  const std::string& source_;
  std::size_t at_ = 0;
  std::vector<std::string_view> open_;  // names of the dictionaries around
};

// Only fields in cells can be carried to other cells.
bool is_cell_field(const std::string& type) {
  return type == "volScalarField" || type == "volVectorField" || type == "volSymmTensorField" ||
         type == "volTensorField";
}

// Of the field that a file holds; empty for files that are none of OpenFOAM's.
std::string class_of(const std::string& text, const std::string& source) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw Error(ErrorCode::format, source, "found an empty file, expected a field");
  std::string type = FieldScanner(text, source).header("class");
  if (type.empty() && FieldScanner(text, source).begins_with("FoamFile"))
    throw Error(
        ErrorCode::format, source,
        "found a header without a class, expected 'class volScalarField;' or another: the file is not "
        "whole");
  return type;
}

std::string list_text(const FoamList& list) {
  constexpr std::string_view types[] = {"", "scalar", "", "vector", "", "", "symmTensor", "", "", "tensor"};
  const auto width = static_cast<std::size_t>(list.components);
  io::TextWriter out;
  out << "List<" << types[width] << ">\n" << list.values.size() / width << "\n(\n";
  for (std::size_t i = 0; i < list.values.size(); i += width) {
    if (width > 1) out << '(';
    for (std::size_t k = 0; k < width; ++k) {
      if (k != 0) out << ' ';
      out << list.values[i + k];
    }
    out << (width > 1 ? ")\n" : "\n");
  }
  out << ")\n";
  return out.take();
}

// For each face of a patch after, the nearest one before.
std::vector<std::size_t> nearest_faces(const FrozenMesh& before, const FoamPatch& from,
                                       const FrozenMesh& after, const FoamPatch& to) {
  const auto middle = [](const FrozenMesh& mesh, const io::FoamEdge& edge) {
    return 0.5 * mesh.points[edge.a] + 0.5 * mesh.points[edge.b];
  };
  std::vector<Point> middles;
  for (const io::FoamEdge& edge : from.edges) middles.push_back(middle(before, edge));
  std::vector<std::size_t> nearest;
  for (const io::FoamEdge& edge : to.edges) {
    const Point place = middle(after, edge);
    double least = std::numeric_limits<double>::infinity();
    std::size_t best = 0;
    for (std::size_t i = 0; i < middles.size(); ++i) {
      const double dx = middles[i].x - place.x, dy = middles[i].y - place.y, squared = dx * dx + dy * dy;
      if (squared < least) best = i, least = squared;
    }
    nearest.push_back(best);
  }
  return nearest;
}

const FoamPatch* patch_named(const std::vector<FoamPatch>& patches, const std::string& name) {
  const auto found = std::find_if(patches.begin(), patches.end(),
                                  [&](const FoamPatch& patch) { return patch.name == name; });
  return found == patches.end() ? nullptr : &*found;
}

void require_size(const FoamList& list, const FrozenMesh& mesh, const std::vector<FoamPatch>& patches,
                  const std::string& source) {
  const FoamPatch* patch = list.patch.empty() ? nullptr : patch_named(patches, list.patch);
  if (!list.patch.empty() && patch == nullptr) {
    if (list.values.empty()) return;
    throw Error(ErrorCode::format, source,
                "found values of the patch " + io::in_quotes(list.patch) + ", which the mesh does not have");
  }
  const std::size_t found = list.values.size() / static_cast<std::size_t>(list.components),
                    expected = patch ? patch->edges.size() : mesh.cell_count();
  if (found != expected)
    throw Error(ErrorCode::format, source,
                "found " + std::to_string(found) + " values of " +
                    (patch ? "the patch " + io::in_quotes(patch->name) : std::string("cells")) +
                    ", expected one for each of " + std::to_string(expected));
}

FoamField parsed(std::string name, std::string text, const std::string& source, const FrozenMesh& mesh,
                 const std::vector<FoamPatch>& patches) {
  if (FieldScanner(text, source).header("format") == "binary")
    throw Error(ErrorCode::format, source, "found the format binary, expected ascii");
  FoamField field{std::move(name), std::move(text), {}};
  field.lists = FieldScanner(field.text, source).lists();
  for (const FoamList& list : field.lists) require_size(list, mesh, patches, source);
  return field;
}

std::vector<FoamPatch> patches_of(const FrozenMesh& mesh) {
  return io::foam_patches(mesh, io::edges_of_cells(mesh));
}

}  // namespace

FoamField parse_foam_field(std::string name, std::string text, const std::string& source,
                           const FrozenMesh& mesh) {
  return parsed(std::move(name), std::move(text), source, mesh, patches_of(mesh));
}

FoamTime read_foam_time(const fs::path& directory, const FrozenMesh& mesh) {
  std::error_code problem;
  std::vector<fs::path> files;
  for (fs::directory_iterator file(directory, problem), end; file != end && !problem; file.increment(problem))
    if (file->is_regular_file()) files.push_back(file->path());
  if (problem)
    throw Error(ErrorCode::file, directory.string(), "cannot be read as a directory: " + problem.message());
  std::sort(files.begin(), files.end());
  const std::vector<FoamPatch> patches = patches_of(mesh);
  FoamTime time;
  for (const fs::path& file : files) {
    if (file.extension() == ".gz")
      throw Error(ErrorCode::format, file.string(), "found a compressed file, expected writeCompression off");
    std::string text = read_text(file), name = file.filename().string();
    const std::string source = file.string();
    const std::string type = class_of(text, source);
    if (is_cell_field(type))
      time.fields.push_back(parsed(std::move(name), std::move(text), source, mesh, patches));
    else
      time.left_out.push_back(std::move(name));
  }
  if (time.fields.empty())
    throw Error(ErrorCode::format, directory.string(), "found no fields in cells, expected some");
  return time;
}

std::string foam_text(const FoamField& field) {
  std::string text;
  std::size_t done = 0;
  for (const FoamList& list : field.lists) {
    text.append(field.text, done, list.begin - done);
    text += list_text(list);
    done = list.end;
  }
  return text.append(field.text, done);
}

void write_foam_time(const FoamTime& time, const fs::path& directory) {
  std::error_code problem;
  fs::create_directories(directory, problem);
  if (problem)
    throw Error(ErrorCode::file, directory.string(), "cannot make the directory: " + problem.message());
  for (const FoamField& field : time.fields) write_text_atomically(directory / field.name, foam_text(field));
}

void carry_foam_time(FoamTime& time, const FrozenMesh& before, const FrozenMesh& after,
                     const std::function<void(int components, std::vector<double>& values)>& cells) {
  const std::vector<FoamPatch> old_patches = patches_of(before), new_patches = patches_of(after);
  std::vector<std::vector<std::size_t>> nearest;
  for (const FoamPatch& patch : new_patches) {
    const FoamPatch* from = patch_named(old_patches, patch.name);
    nearest.push_back(from ? nearest_faces(before, *from, after, patch) : std::vector<std::size_t>());
  }
  for (FoamField& field : time.fields)
    for (FoamList& list : field.lists) {
      if (list.patch.empty()) {
        cells(list.components, list.values);
        continue;
      }
      const FoamPatch* patch = patch_named(new_patches, list.patch);
      if (patch == nullptr) continue;
      const auto width = static_cast<std::size_t>(list.components);
      const std::vector<double> old = std::move(list.values);
      list.values.clear();
      for (const std::size_t face : nearest[static_cast<std::size_t>(patch - new_patches.data())])
        list.values.insert(list.values.end(), old.begin() + static_cast<std::ptrdiff_t>(face * width),
                           old.begin() + static_cast<std::ptrdiff_t>((face + 1) * width));
    }
}

fs::path latest_foam_time(const fs::path& case_directory) {
  fs::path latest;
  double latest_time = 0.0;
  std::error_code problem;
  for (fs::directory_iterator file(case_directory, problem), end; file != end && !problem;
       file.increment(problem)) {
    const std::string name = file->path().filename().string();
    double time = 0.0;
    const auto [stop, error] = std::from_chars(name.data(), name.data() + name.size(), time);
    if (error != std::errc() || stop != name.data() + name.size() || !(time > latest_time)) continue;
    if (file->is_directory()) latest = file->path(), latest_time = time;
  }
  return latest;
}

}  // namespace remodel
