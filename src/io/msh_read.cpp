// Gmsh's mesh format, versions 4.1, 2.2 and their likes, ASCII and binary:
// https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format. Sections that say nothing about triangles and
// boundary edges are skipped.

#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

#include "io/assemble.h"
#include "io/formats.h"
#include "io/msh.h"
#include "io/msh_numbers.h"
#include "io/scanner.h"
#include "remodel/error.h"

namespace remodel::io {

namespace {

class MshReader {
 public:
  MshReader(std::string_view text, const std::string& file)
      : scan_(text, file), numbers_(scan_), file_(file) {}

  FrozenMesh read() {
    read_format();
    while (!scan_.at_end()) read_section();
    if (!nodes_seen_) scan_.fail_found("", "$Nodes");
    if (!elements_seen_) scan_.fail_found("", "$Elements");
    adopt_conventions(mesh_, file_);
    return std::move(mesh_);
  }

 private:
  void expect(std::string_view expected) {
    if (const auto found = scan_.word(expected); found != expected) scan_.fail_found(found, expected);
  }

  void read_format() {
    expect("$MeshFormat");
    const std::string_view version = scan_.word("a version");
    if (version == "4.1") {
      version_4_ = true;
    } else if (version != "2" && version != "2.0" && version != "2.1" && version != "2.2") {
      scan_.fail("version " + in_quotes(version) + " found, 4.1 or 2.2 expected");
    }
    const auto type = scan_.integer("a file type");
    if (type != 0 && type != 1) {
      scan_.fail("file type " + std::to_string(type) + " found, 0 (ASCII) or 1 (binary) expected");
    }
    if (type == 1) {
      const auto size = scan_.integer("the size of a number");
      if (size != 8) scan_.fail("numbers of " + std::to_string(size) + " bytes found, 8 expected");
      binary_ = true;
      numbers_.begin_binary();
      const auto one = numbers_.integer("the number 1");
      if (one == 0x01000000) scan_.fail("big-endian numbers found, little-endian ones expected");
      if (one != 1) scan_.fail("no binary number 1 found, one expected in a binary file");
    } else {
      scan_.skip_line();
    }
    expect("$EndMeshFormat");
  }

  void read_section() {
    const std::string_view name = scan_.word("a section");
    if (name.size() < 2 || name[0] != '$') scan_.fail_found(name, "a section, '$Nodes' say,");
    const std::string end = "$End" + std::string(name.substr(1));
    if (name == "$PhysicalNames") {
      read_physical_names();
    } else if (name == "$Entities" && version_4_) {
      read_entities();
    } else if (name == "$Nodes") {
      if (std::exchange(nodes_seen_, true)) scan_.fail("a second $Nodes found, one expected");
      version_4_ ? read_nodes_41() : read_nodes_22();
    } else if (name == "$Elements") {
      if (!nodes_seen_) scan_.fail_found(name, "$Nodes first");
      if (std::exchange(elements_seen_, true)) scan_.fail("a second $Elements found, one expected");
      version_4_ ? read_elements_41() : read_elements_22();
    } else if (binary_) {
      return scan_.skip_past(end);
    } else {
      while (scan_.word(end) != end) {
      }
      return;
    }
    expect(end);
  }

  void read_physical_names() {
    for (auto left = scan_.count("a number of physical names"); left > 0; --left) {
      const auto dimension = scan_.integer("a dimension");
      const auto tag = scan_.integer("a physical tag");
      std::string_view name = scan_.rest_of_line();
      if (name.size() < 3 || name.front() != '"' || name.back() != '"') {
        scan_.fail_found(name, "a physical name in quotes");
      }
      if (dimension != 1) continue;
      const std::string text(name.substr(1, name.size() - 2));
      for (const auto& [other, known] : curve_names_) {
        if (known == text)
          scan_.fail("a second physical curve " + in_quotes(text) + " found, each name once expected");
      }
      curve_names_[tag] = text;
    }
  }

  // Only needed for the physical groups of the curves.
  void read_entities() {
    if (binary_) return read_binary_entities();
    const std::size_t points = scan_.count("a number of points");
    const std::size_t curves = scan_.count("a number of curves");
    const std::size_t surfaces = scan_.count("a number of surfaces");
    const std::size_t volumes = scan_.count("a number of volumes");
    scan_.skip_line();
    for (std::size_t i = 0; i < points; ++i) scan_.integer("a point"), scan_.skip_line();
    for (std::size_t i = 0; i < curves; ++i) {
      const auto tag = scan_.integer("a curve");
      for (int k = 0; k < 6; ++k) scan_.real("a bounding box");
      if (scan_.count("a number of physical tags") > 0) {
        curve_groups_[tag] = std::abs(scan_.integer("a physical tag"));
      }
      scan_.skip_line();
    }
    for (std::size_t i = 0; i < surfaces; ++i) scan_.integer("a surface"), scan_.skip_line();
    for (std::size_t i = 0; i < volumes; ++i) scan_.integer("a volume"), scan_.skip_line();
  }

  void read_binary_entities() {
    numbers_.begin_binary();
    std::size_t counts[4];  // points, curves, surfaces, volumes
    for (std::size_t& count : counts) count = numbers_.count("a number of entities");
    for (int dimension = 0; dimension < 4; ++dimension)
      for (std::size_t i = 0; i < counts[dimension]; ++i) read_binary_entity(dimension);
  }

  // Tag, place (a point's) or bounding box, physical groups, and the entities that bound it.
  void read_binary_entity(int dimension) {
    const auto tag = numbers_.integer("an entity");
    for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) numbers_.real("a bounding box");
    const std::size_t groups = numbers_.count("a number of physical tags");
    for (std::size_t k = 0; k < groups; ++k) {
      const auto group = numbers_.integer("a physical tag");
      if (dimension == 1) curve_groups_.try_emplace(tag, std::abs(group));
    }
    if (dimension == 0) return;
    for (auto left = numbers_.count("a number of bounding entities"); left > 0; --left)
      numbers_.integer("a bounding entity");
  }

  void add_node_tag() {
    const auto tag = version_4_ ? numbers_.tag("the tag of a node") : numbers_.integer("the tag of a node");
    const auto index = static_cast<std::uint32_t>(node_indices_.size());
    if (!node_indices_.emplace(tag, index).second) {
      scan_.fail("node " + std::to_string(tag) + " found a second time, each tag once expected");
    }
  }

  void add_point() {
    const double x = numbers_.coordinate();
    const double y = numbers_.coordinate();
    const double z = numbers_.coordinate();
    if (mesh_.points.empty()) plane_z_ = z;
    // A program that turned the mesh into the plane leaves rounding errors behind, no more.
    constexpr double rounding = 1e-9;
    if (std::abs(z - plane_z_) > rounding * (1.0 + std::abs(x) + std::abs(y))) {
      scan_.fail("z = " + std::to_string(z) + " found, a mesh in a plane z = " + std::to_string(plane_z_) +
                 " expected");
    }
    mesh_.points.push_back({x, y});
  }

  void read_nodes_41() {
    if (binary_) numbers_.begin_binary();
    const std::size_t blocks = numbers_.count("a number of blocks");
    const std::size_t count = numbers_.count("a number of nodes");
    skip_tag_range();
    reserve_nodes(count);
    for (std::size_t block = 0; block < blocks; ++block) {
      const auto dimension = numbers_.integer("the dimension of an entity");
      numbers_.integer("the tag of an entity");
      const bool parametric = numbers_.integer("0 or 1 for parametric") != 0;
      const std::size_t nodes = numbers_.count("a number of nodes in the block");
      for (std::size_t i = 0; i < nodes; ++i) add_node_tag();
      for (std::size_t i = 0; i < nodes; ++i) {
        add_point();
        for (auto k = parametric ? dimension : 0; k > 0; --k) numbers_.real("a parameter");
      }
    }
    expect_total(mesh_.points.size(), count, "nodes");
  }

  // The smallest and the largest tag.
  void skip_tag_range() {
    if (!binary_) return scan_.skip_line();
    numbers_.tag("the smallest tag");
    numbers_.tag("the largest tag");
  }

  void read_nodes_22() {
    const std::size_t count = scan_.count("a number of nodes");
    if (binary_) numbers_.begin_binary();
    reserve_nodes(count);
    for (std::size_t i = 0; i < count; ++i) {
      add_node_tag();
      add_point();
    }
  }

  void reserve_nodes(std::size_t count) {
    mesh_.points.reserve(count);
    node_indices_.reserve(count);
  }

  void expect_total(std::size_t found, std::size_t expected, const char* what) {
    if (found == expected) return;
    scan_.fail(std::to_string(found) + " " + what + " found, " + std::to_string(expected) +
               " expected by the section's header");
  }

  std::uint32_t read_node() {
    const auto tag = version_4_ ? numbers_.tag("the tag of a node") : numbers_.integer("the tag of a node");
    const auto found = node_indices_.find(tag);
    if (found == node_indices_.end()) {
      scan_.fail("node " + std::to_string(tag) + " found, the tag of one of the " +
                 std::to_string(mesh_.points.size()) + " nodes expected");
    }
    return found->second;
  }

  // The nodes of an element. A line belongs to its physical group or, without one, to its curve.
  void add_element(std::int64_t type, std::int64_t group, std::int64_t curve) {
    if (type == msh_triangle) {
      auto& [a, b, c] = mesh_.triangles.emplace_back();
      a = read_node();
      b = read_node();
      c = read_node();
    } else if (type == msh_line) {
      auto& [a, b] = boundary_of(group, curve).edges.emplace_back();
      a = read_node();
      b = read_node();
    } else if (type == msh_point) {
      read_node();
    } else {
      scan_.fail("element of type " + std::to_string(type) +
                 " found, only triangles (type 2) and lines (type 1) expected");
    }
  }

  FrozenBoundary& boundary_of(std::int64_t group, std::int64_t curve) {
    const auto [entry, added] = boundaries_.try_emplace({group, curve}, 0);
    if (added) {
      const auto known = curve_names_.find(group);
      const std::string name = known != curve_names_.end() ? known->second
                               : group != 0                ? "physical_" + std::to_string(group)
                                                           : "curve_" + std::to_string(curve);
      entry->second = static_cast<std::size_t>(&boundary_named(mesh_, name) - mesh_.boundaries.data());
    }
    return mesh_.boundaries[entry->second];
  }

  void read_elements_41() {
    if (binary_) numbers_.begin_binary();
    const std::size_t blocks = numbers_.count("a number of blocks");
    const std::size_t count = numbers_.count("a number of elements");
    skip_tag_range();
    std::size_t total = 0;
    for (std::size_t block = 0; block < blocks; ++block) {
      numbers_.integer("the dimension of an entity");
      const auto entity = numbers_.integer("the tag of an entity");
      const auto type = numbers_.integer("the type of an element");
      const std::size_t elements = numbers_.count("a number of elements in the block");
      const auto found = curve_groups_.find(entity);
      const std::int64_t group = found != curve_groups_.end() ? found->second : 0;
      for (std::size_t i = 0; i < elements; ++i) {
        numbers_.tag("the tag of an element");
        add_element(type, group, entity);
      }
      total += elements;
    }
    expect_total(total, count, "elements");
  }

  void read_elements_22() {
    const std::size_t count = scan_.count("a number of elements");
    if (binary_) return read_binary_elements_22(count);
    for (std::size_t i = 0; i < count; ++i) {
      scan_.integer("the number of an element");
      const auto type = scan_.integer("the type of an element");
      add_element_22(type, scan_.count("a number of tags"));
    }
  }

  // Blocks of elements of one type, each with a header that says how many tags they have.
  void read_binary_elements_22(std::size_t count) {
    numbers_.begin_binary();
    for (std::size_t i = 0; i < count;) {
      const auto type = numbers_.integer("the type of an element");
      const auto elements = numbers_.integer("a number of elements in the block");
      const auto tags = numbers_.integer("a number of tags");
      if (elements <= 0 || static_cast<std::uint64_t>(elements) > count - i || tags < 0 || tags > 1000)
        scan_.fail("a block of " + std::to_string(elements) + " elements with " + std::to_string(tags) +
                   " tags found, 1 to " + std::to_string(count - i) + " elements expected");
      for (auto left = elements; left > 0; --left, ++i) {
        numbers_.integer("the number of an element");
        add_element_22(type, static_cast<std::size_t>(tags));
      }
    }
  }

  // The first tag is the physical group, the second one the entity.
  void add_element_22(std::int64_t type, std::size_t tags) {
    std::int64_t values[2] = {0, 0};
    for (std::size_t k = 0; k < tags; ++k) {
      const auto value = numbers_.integer("a tag");
      if (k < 2) values[k] = value;
    }
    add_element(type, std::abs(values[0]), values[1]);
  }

  Scanner scan_;
  MshNumbers numbers_;
  std::string file_;
  FrozenMesh mesh_;
  bool version_4_ = false;
  bool binary_ = false;
  bool nodes_seen_ = false;
  bool elements_seen_ = false;
  double plane_z_ = 0.0;
  std::unordered_map<std::int64_t, std::uint32_t> node_indices_;
  std::map<std::int64_t, std::string> curve_names_;    // by physical tag
  std::map<std::int64_t, std::int64_t> curve_groups_;  // physical tag by curve
  std::map<std::pair<std::int64_t, std::int64_t>, std::size_t> boundaries_;
};

}  // namespace

FrozenMesh parse_msh(std::string_view text, const std::string& file) {
  return MshReader(text, file).read();
}

}  // namespace remodel::io
