// The flow solver SU2's native mesh format: https://su2code.github.io/docs_v7/Mesh-File/

#include <algorithm>
#include <utility>

#include "io/assemble.h"
#include "io/formats.h"
#include "io/scanner.h"
#include "io/steiner_note.h"
#include "io/text_writer.h"
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

void check_marker(const std::string& name, const std::string& file) {
  const auto bad = [](char c) { return static_cast<unsigned char>(c) <= ' ' || c == '%'; };
  if (name.empty() || std::any_of(name.begin(), name.end(), bad)) {
    throw Error(ErrorCode::argument, file,
                "boundary name " + in_quotes(name) + " found, SU2 expects one without blanks and '%'");
  }
}

class Su2Reader {
 public:
  Su2Reader(std::string_view text, const std::string& file) : scan_(text, file, '%'), file_(file) {}

  FrozenMesh read() {
    while (!scan_.at_end()) read_section();
    if (!dimension_seen_) scan_.fail_found("", "NDIME= 2");
    if (!triangles_seen_) scan_.fail_found("", "NELEM=");
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
    adopt_conventions(mesh_, file_);
    return std::move(mesh_);
  }

 private:
  void read_section() {
    const std::string_view keyword = scan_.keyword();
    if (keyword == "NDIME") {
      read_dimension();
    } else if (keyword == "NELEM") {
      read_triangles();
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
    } else {
      skip_section(keyword);
    }
  }

  // Free-form deformation boxes and the like: their data lines start with digits.
  void skip_section(std::string_view keyword) {
    const auto is_letter = [](char c) { return (c >= 'A' && c <= 'Z') || c == '_'; };
    if (keyword.empty() || !is_letter(keyword.front())) scan_.fail_found(keyword, "a keyword and '='");
    do scan_.skip_line();
    while (!scan_.at_end() && !is_letter(scan_.peek()));
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
  void read_triangles() {
    expect_once(triangles_seen_, "NELEM");
    const std::size_t count = scan_.count("a number of elements");
    scan_.skip_line();
    mesh_.triangles.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto type = scan_.integer("an element");
      if (type != su2_triangle) {
        scan_.fail("element of type " + std::to_string(type) + " found, only triangles (type 5) expected");
      }
      auto& [a, b, c] = mesh_.triangles.emplace_back();
      a = read_index();
      b = read_index();
      c = read_index();
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
  FrozenMesh mesh_;
  LargestIndex largest_;
  BoundaryNames names_;
  bool dimension_seen_ = false;
  bool triangles_seen_ = false;
  bool points_seen_ = false;
  bool marker_count_seen_ = false;
  std::size_t marker_count_ = 0;
};

}  // namespace

std::string su2_text(const FrozenMesh& whole, const std::string& file, InnerCurves inner) {
  const FrozenMesh mesh = inner == InnerCurves::left_out ? without_inner_edges(whole) : whole;
  TextWriter out;
  out << "NDIME= 2\nNELEM= " << mesh.triangles.size() << '\n';
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    out << su2_triangle << ' ' << a << ' ' << b << ' ' << c << ' ' << i << '\n';
  }
  out << "NPOIN= " << mesh.points.size() << '\n';
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    out << mesh.points[i].x << ' ' << mesh.points[i].y << ' ' << i << '\n';
  }
  out << "NMARK= " << mesh.boundaries.size() << '\n';
  for (const auto& boundary : mesh.boundaries) {
    check_marker(boundary.name, file);
    out << "MARKER_TAG= " << boundary.name << "\nMARKER_ELEMS= " << boundary.edges.size() << '\n';
    for (const auto& [from, to] : boundary.edges) out << su2_line << ' ' << from << ' ' << to << '\n';
  }
  out << steiner_note(mesh, "% ");
  return out.take();
}

FrozenMesh parse_su2(std::string_view text, const std::string& file) {
  FrozenMesh mesh = Su2Reader(text, file).read();
  take_steiner_notes(text, mesh);
  return mesh;
}

}  // namespace remodel::io
