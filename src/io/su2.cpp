// The flow solver SU2's native mesh format: https://su2code.github.io/docs_v7/Mesh-File/

#include <algorithm>
#include <utility>

#include "io/assemble.h"
#include "io/foreign.h"
#include "io/formats.h"
#include "io/scanner.h"
#include "io/steiner_note.h"
#include "io/text_writer.h"
#include "io/vtkhdf.h"
#include "io/words.h"
#include "remodel/error.h"

namespace remodel::io {

namespace {

// Points may come after the cells that use them: the largest index waits for them, with its line.
struct LargestIndex {
  std::uint32_t value = 0;
  std::size_t line = 0;  // 0: no index yet
};

// Element types are VTK's cell types.
constexpr int su2_line = 3;
constexpr int su2_triangle = 5;
constexpr int su2_quadrilateral = 9;

void check_marker(const std::string& name, const std::string& file) {
  const auto bad = [](char c) { return static_cast<unsigned char>(c) <= ' ' || c == '%'; };
  if (name.empty() || std::any_of(name.begin(), name.end(), bad)) {
    throw Error(
        ErrorCode::argument, file,
        "boundary name " + in_quotes(name) + " found, SU2 expects one without '%' and control characters");
  }
}

class Su2Reader {
 public:
  Su2Reader(std::string_view text, const std::string& file, const Warnings& warnings)
      : scan_(text, file, '%'), file_(file), warnings_(warnings) {}

  FrozenMesh read() {
    while (!scan_.at_end()) read_section();
    if (!dimension_seen_) scan_.fail_found("", "NDIME= 2");
    if (!cells_seen_) scan_.fail_found("", "NELEM=");
    if (!points_seen_) scan_.fail_found("", "NPOIN=");
    if (!marker_count_seen_) scan_.fail_found("", "NMARK=");
    if (mesh_.boundaries.size() != marker_count_) {
      scan_.fail(std::to_string(mesh_.boundaries.size()) +
                 " markers found, NMARK= " + std::to_string(marker_count_) + " expected");
    }
    if (largest_.line != 0 && largest_.value >= mesh_.points.size()) {
      throw Error(ErrorCode::format, file_ + ":" + std::to_string(largest_.line),
                  "point " + std::to_string(largest_.value) +
                      " found, an index below NPOIN= " + std::to_string(mesh_.points.size()) + " expected");
    }
    if (!left_out_.empty())
      warnings_.add("sections without a place in a mesh are left out: " + listed(left_out_));
    adopt_conventions(mesh_, file_);
    return std::move(mesh_);
  }

  std::string take_boxes() { return std::move(boxes_); }

 private:
  void read_section() {
    const std::string_view keyword = scan_.keyword();
    if (keyword == "NDIME") {
      read_dimension();
    } else if (keyword == "NELEM") {
      read_cells();
    } else if (keyword == "NPOIN") {
      read_points();
    } else if (keyword == "NMARK") {
      expect_once(marker_count_seen_, "NMARK");
      marker_count_ = scan_.count("a number of markers");
      scan_.skip_line();
    } else if (keyword == "MARKER_TAG") {
      read_marker();
    } else if (keyword == "NZONE") {
      if (const auto zones = scan_.integer("NZONE= 1"); zones != 1) {
        scan_.fail_found("NZONE= " + std::to_string(zones), "NZONE= 1");
      }
    } else if (keyword.starts_with("FFD_")) {
      boxes_ += std::string(keyword) + "=" + without_notes(skip_section(keyword)) + "\n";
    } else {
      skip_section(keyword);
      if (keyword != "IZONE" && std::find(left_out_.begin(), left_out_.end(), keyword) == left_out_.end())
        left_out_.emplace_back(keyword);
    }
  }

  // Our own comments at the end of the file are no part of the last section.
  static std::string without_notes(std::string_view section) {
    return std::string(section.substr(0, section.find("\n% remodel: ")));
  }

  // Its data lines start with digits or signs. What follows the '=', without the blanks at its end.
  std::string_view skip_section(std::string_view keyword) {
    const auto is_letter = [](char c) { return (c >= 'A' && c <= 'Z') || c == '_'; };
    if (keyword.empty() || !is_letter(keyword.front())) scan_.fail_found(keyword, "a keyword and '='");
    const std::size_t begin = scan_.position();
    do scan_.skip_line();
    while (!scan_.at_end() && !is_letter(scan_.peek()));
    const std::string_view section = scan_.text_from(begin);
    return section.substr(0, section.find_last_not_of(" \t\r\n") + 1);
  }

  void expect_once(bool& seen, const char* keyword) {
    if (std::exchange(seen, true)) scan_.fail("a second " + std::string(keyword) + "= found, one expected");
  }

  void read_dimension() {
    expect_once(dimension_seen_, "NDIME");
    const auto dimension = scan_.integer("NDIME= 2");
    if (dimension != 2) scan_.fail_found("NDIME= " + std::to_string(dimension), "NDIME= 2");
  }

  std::uint32_t read_index() {
    const std::uint32_t index = scan_.index("the index of a point");
    if (largest_.line == 0 || index > largest_.value) largest_ = {index, scan_.line()};
    return index;
  }

  // A line of a cell ends with its own index, which is optional and says nothing.
  void read_cells() {
    expect_once(cells_seen_, "NELEM");
    const std::size_t count = scan_.count("a number of elements");
    scan_.skip_line();
    mesh_.triangles.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto type = scan_.integer("an element");
      if (type == su2_triangle)
        for (std::uint32_t& corner : mesh_.triangles.emplace_back()) corner = read_index();
      else if (type == su2_quadrilateral)
        for (std::uint32_t& corner : mesh_.quads.emplace_back()) corner = read_index();
      else
        scan_.fail("element of type " + std::to_string(type) +
                   " found, only triangles (type 5) and quadrilaterals (type 9) expected");
      scan_.skip_line();
    }
  }

  void read_points() {
    expect_once(points_seen_, "NPOIN");
    const std::size_t count = scan_.count("a number of points");
    scan_.skip_line();  // a second number repeats the first, without halo points
    mesh_.points.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      auto& [x, y] = mesh_.points.emplace_back();
      x = scan_.coordinate();
      y = scan_.coordinate();
      scan_.skip_line();
    }
  }

  void read_marker() {
    const std::string name(scan_.rest_of_line());
    if (name.empty()) scan_.fail("MARKER_TAG= without a name found");
    if (!names_.add(mesh_, name).second)
      scan_.fail("a second marker " + in_quotes(name) + " found, each name once expected");
    if (const auto next = scan_.keyword(); next != "MARKER_ELEMS") scan_.fail_found(next, "MARKER_ELEMS=");
    const std::size_t count = scan_.count("a number of marker elements");
    scan_.skip_line();
    auto& edges = mesh_.boundaries.back().edges;
    edges.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto type = scan_.integer("a marker element");
      if (type != su2_line) {
        scan_.fail("marker element of type " + std::to_string(type) + " found, only lines (type 3) expected");
      }
      auto& [from, to] = edges.emplace_back();
      from = read_index();
      to = read_index();
      scan_.skip_line();
    }
  }

  Scanner scan_;
  std::string file_;
  Warnings warnings_;
  FrozenMesh mesh_;
  std::vector<std::string> left_out_;
  std::string boxes_;
  LargestIndex largest_;
  BoundaryNames names_;
  bool dimension_seen_ = false;
  bool cells_seen_ = false;
  bool points_seen_ = false;
  bool marker_count_seen_ = false;
  std::size_t marker_count_ = 0;
};

// Surface points are known by numbers, which points have no more where some are left out.
std::string boxes_of_used(std::string boxes, const ReadNotes& notes, const Warnings& warnings) {
  std::size_t surface_points = 0;
  if (notes.unused_points == 0) return boxes;
  boxes = without_surface_points(boxes, surface_points);
  if (surface_points > 0)
    warnings.add("with them " + std::to_string(surface_points) +
                 " surface points of FFD boxes, which SU2_DEF with DV_KIND= FFD_SETTING finds anew");
  return boxes;
}

}  // namespace

std::string su2_text(const FrozenMesh& whole, const std::string& file, InnerCurves inner,
                     const std::string& boxes) {
  const FrozenMesh mesh = inner == InnerCurves::left_out ? without_inner_edges(whole) : whole;
  TextWriter out;
  out << "NDIME= 2\nNELEM= " << mesh.cell_count() << '\n';
  for (std::size_t i = 0; i < mesh.cell_count(); ++i) {
    out << (mesh.cell(i).size() == 3 ? su2_triangle : su2_quadrilateral);
    for (const std::uint32_t corner : mesh.cell(i)) out << ' ' << corner;
    out << ' ' << i << '\n';
  }
  out << "NPOIN= " << mesh.points.size() << '\n';
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    out << mesh.points[i].x << ' ' << mesh.points[i].y << ' ' << i << '\n';
  }
  require_different_words(mesh.boundaries, file);
  out << "NMARK= " << mesh.boundaries.size() << '\n';
  for (const auto& boundary : mesh.boundaries) {
    const std::string name = as_word(boundary.name);
    check_marker(name, file);
    out << "MARKER_TAG= " << name << "\nMARKER_ELEMS= " << boundary.edges.size() << '\n';
    for (const auto& [from, to] : boundary.edges) out << su2_line << ' ' << from << ' ' << to << '\n';
  }
  out << boxes << steiner_note(mesh, "% ");
  return out.take();
}

FrozenMesh parse_su2(std::string_view text, const std::string& file, ReadNotes* notes) {
  const Warnings warnings(notes, file);
  Su2Reader reader(text, file, warnings);
  FrozenMesh mesh = reader.read();
  take_steiner_notes(text, mesh);
  const std::vector<bool> used = used_points(mesh, mesh.points.size());
  warnings.note_unused_points(used, keep_used_points(mesh, used));
  if (notes != nullptr) notes->su2_boxes = boxes_of_used(reader.take_boxes(), *notes, warnings);
  return mesh;
}

}  // namespace remodel::io

namespace remodel {

std::string read_su2_boxes(const std::filesystem::path& file) {
  const KeptPipes once;
  switch (io::format_to_read(file)) {
    case MeshFormat::su2: {
      ReadNotes notes;
      read_frozen_mesh(file, &notes);
      return notes.su2_boxes;
    }
    case MeshFormat::vtkhdf:
      return io::read_vtkhdf_boxes(file);
    default:
      return {};
  }
}

// https://su2code.github.io/docs_v7/Mesh-File/ has the layout: the lines of points follow their number.
std::string without_surface_points(const std::string& boxes, std::size_t& surface_points) {
  constexpr std::string_view keyword = "FFD_SURFACE_POINTS";
  std::string result;
  bool among_points = false;
  for (std::size_t begin = 0; begin < boxes.size();) {
    const std::size_t end = std::min(boxes.find('\n', begin), boxes.size() - 1) + 1;
    const std::string_view line = std::string_view(boxes).substr(begin, end - begin);
    begin = end;
    const bool has_keyword = line.find('=') != line.npos;
    among_points = has_keyword ? line.starts_with(keyword) : among_points;
    if (has_keyword && among_points)
      result += std::string(keyword) + "= 0\n";
    else if (among_points)
      surface_points += line.find_first_not_of(" \t\r\n") != line.npos ? 1 : 0;
    else
      result += line;
  }
  return result;
}

}  // namespace remodel
