// Gmsh's mesh format, versions 4.1, 4.0, 2.2 and their likes, ASCII and binary:
// https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format. Sections that say nothing about cells and
// boundary edges are skipped.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "io/assemble.h"
#include "io/foreign.h"
#include "io/formats.h"
#include "io/msh.h"
#include "io/msh_fields.h"
#include "io/msh_numbers.h"
#include "io/plane_vectors.h"
#include "io/scanner.h"
#include "io/steiner_note.h"
#include "remodel/error.h"

namespace remodel::io {

namespace {

using Nodes = std::array<std::uint32_t, 4>;  // of an element, ascending, no_node where it has less
constexpr std::uint32_t no_node = 0xffffffff;

struct HashOfNodes {
  std::size_t operator()(const Nodes& nodes) const {
    std::uint64_t hash = 0;
    for (const std::uint32_t node : nodes) hash = (hash ^ node) * 0x9e3779b97f4a7c15U;
    return static_cast<std::size_t>(hash ^ (hash >> 32));
  }
};

class MshReader {
 public:
  MshReader(std::string_view text, const std::string& file, const Warnings& warnings)
      : scan_(text, file),
        numbers_(scan_),
        fields_(scan_, numbers_, sections_in_plane(text)),
        file_(file),
        warnings_(warnings) {}

  FrozenMesh read() {
    read_format();
    while (!scan_.at_end()) read_section();
    if (!nodes_seen_) scan_.fail_found("", "$Nodes");
    if (!elements_seen_) scan_.fail_found("", "$Elements");
    say_what_is_left_out();
    mesh_.points = in_their_plane(coordinates_, used(), file_, warnings_);
    regions_.finish(mesh_);
    adopt_conventions(mesh_, file_);
    return std::move(mesh_);
  }

  // Which nodes a cell has; once all elements are read.
  const std::vector<bool>& used() {
    if (used_.empty()) used_ = used_points(mesh_, node_indices_.size());
    return used_;
  }

  // On all nodes. What is said of those that are not used is 0 where the file says nothing.
  std::vector<Field> read_fields() {
    fields_wanted_ = true;
    read();
    return fields_.take();
  }

 private:
  void say_what_is_left_out() const {
    const auto say = [&](const std::vector<std::string>& names, const char* what) {
      if (!names.empty()) warnings_.add(what + listed(names));
    };
    say(sections_left_out_, "sections without a place in a mesh are left out: ");
    std::vector<std::string> without_elements = other_names_;
    for (const auto& [group, name] : curve_names_)
      if (!groups_used_.contains({1, group}) && !second_groups_.contains({1, group}))
        without_elements.push_back(name);
    for (const auto& [group, name] : surface_names_)
      if (!groups_used_.contains({2, group}) && !second_groups_.contains({2, group}))
        without_elements.push_back(name);
    say(without_elements, "physical groups without lines and triangles are left out: ");
    std::vector<std::string> second;
    for (const auto& [dimension, group] : second_groups_)
      second.push_back(name_in(dimension == 1 ? curve_names_ : surface_names_, group, "", 0));
    say(second, "what is in several physical groups has the first one's name; left out there: ");
  }

  void expect(std::string_view expected) {
    if (const auto found = scan_.word(expected); found != expected) scan_.fail_found(found, expected);
  }

  void read_format() {
    expect("$MeshFormat");
    const std::string_view version = scan_.word("a version");
    if (version == "4.1" || version == "4" || version == "4.0") {
      version_4_ = true;
      early_4_ = version != "4.1";
    } else if (version != "2" && version != "2.0" && version != "2.1" && version != "2.2") {
      scan_.fail("version " + in_quotes(version) + " found, 4.1, 4.0 or 2.2 expected");
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
      version_4_ ? read_nodes_4() : read_nodes_22();
    } else if (name == "$Elements") {
      if (!nodes_seen_) scan_.fail_found(name, "$Nodes first");
      if (std::exchange(elements_seen_, true)) scan_.fail("a second $Elements found, one expected");
      version_4_ ? read_elements_4() : read_elements_22();
      number_quads();
    } else if (fields_wanted_ && (name == "$NodeData" || name == "$ElementData")) {
      if (!elements_seen_) scan_.fail_found(name, "$Elements first");
      name == "$NodeData" ? fields_.read(FieldPlace::vertices, binary_, node_indices_, used())
                          : fields_.read(FieldPlace::triangles, binary_, cell_indices_,
                                         std::vector<bool>(mesh_.cell_count(), true));
    } else {
      skip_section(name, end);
      return;
    }
    expect(end);
  }

  void skip_section(std::string_view name, const std::string& end) {
    const bool is_field = name == "$NodeData" || name == "$ElementData" || name == "$Comments";
    if (!is_field &&
        std::find(sections_left_out_.begin(), sections_left_out_.end(), name) == sections_left_out_.end())
      sections_left_out_.emplace_back(name);
    if (binary_) {
      scan_.skip_past(end);
    } else {
      while (scan_.word(end) != end) {
      }
    }
  }

  void read_physical_names() {
    for (auto left = scan_.count("a number of physical names"); left > 0; --left) {
      const auto dimension = scan_.integer("a dimension");
      const auto tag = scan_.integer("a physical tag");
      std::string_view name = scan_.rest_of_line();
      if (name.size() < 3 || name.front() != '"' || name.back() != '"') {
        scan_.fail_found(name, "a physical name in quotes");
      }
      const std::string text(name.substr(1, name.size() - 2));
      if (dimension == 2) surface_names_[tag] = text;
      if (dimension == 0 || dimension == 3) other_names_.push_back(text);
      if (dimension != 1) continue;
      if (!known_curves_.insert(text).second)
        scan_.fail("a second physical curve " + in_quotes(text) + " found, each name once expected");
      curve_names_[tag] = text;
    }
  }

  // Only needed for the physical groups of curves and surfaces.
  void read_entities() {
    if (binary_) return read_binary_entities();
    const std::size_t points = scan_.count("a number of points");
    const std::size_t curves = scan_.count("a number of curves");
    const std::size_t surfaces = scan_.count("a number of surfaces");
    const std::size_t volumes = scan_.count("a number of volumes");
    scan_.skip_line();
    for (std::size_t i = 0; i < points; ++i) scan_.integer("a point"), scan_.skip_line();
    for (std::size_t i = 0; i < curves; ++i) read_entity("a curve", 1, curve_groups_);
    for (std::size_t i = 0; i < surfaces; ++i) read_entity("a surface", 2, surface_groups_);
    for (std::size_t i = 0; i < volumes; ++i) scan_.integer("a volume"), scan_.skip_line();
  }

  // The first physical group counts.
  void read_entity(const char* what, int dimension, std::map<std::int64_t, std::int64_t>& groups) {
    const auto tag = scan_.integer(what);
    for (int k = 0; k < 6; ++k) scan_.real("a bounding box");
    for (auto left = scan_.count("a number of physical tags"); left > 0; --left)
      add_group(dimension, tag, scan_.integer("a physical tag"), groups);
    scan_.skip_line();
  }

  void add_group(int dimension, std::int64_t entity, std::int64_t group,
                 std::map<std::int64_t, std::int64_t>& groups) {
    const auto [entry, is_first] = groups.try_emplace(entity, std::abs(group));
    if (!is_first && entry->second != std::abs(group)) second_groups_.insert({dimension, std::abs(group)});
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
    for (int k = 0; k < (dimension == 0 && !early_4_ ? 3 : 6); ++k) numbers_.real("a bounding box");
    const std::size_t groups = numbers_.count("a number of physical tags");
    for (std::size_t k = 0; k < groups; ++k) {
      const auto group = numbers_.integer("a physical tag");
      if (dimension == 1) add_group(1, tag, group, curve_groups_);
      if (dimension == 2) add_group(2, tag, group, surface_groups_);
    }
    if (dimension == 0) return;
    for (auto left = numbers_.count("a number of bounding entities"); left > 0; --left)
      numbers_.integer("a bounding entity");
  }

  // The tag of a node or an element: 64 bits from version 4.1 on.
  std::int64_t tag_of(const char* what) {
    return version_4_ && !early_4_ ? numbers_.tag(what) : numbers_.integer(what);
  }

  void add_node_tag() {
    const auto tag = tag_of("the tag of a node");
    const auto index = static_cast<std::uint32_t>(node_indices_.size());
    if (!node_indices_.emplace(tag, index).second) {
      scan_.fail("node " + std::to_string(tag) + " found a second time, each tag once expected");
    }
  }

  void add_point() {
    for (int axis = 0; axis < 3; ++axis) coordinates_.push_back(numbers_.coordinate());
  }

  // A block's entity: version 4.0 has its tag first.
  struct Entity {
    std::int64_t dimension, tag;
  };
  Entity read_block_entity() {
    const auto first = numbers_.integer("the entity of a block");
    const auto second = numbers_.integer("the entity of a block");
    return early_4_ ? Entity{second, first} : Entity{first, second};
  }

  // A node's tag and its place: side by side in version 4.0, all tags of a block first in 4.1.
  void read_nodes_4() {
    if (binary_) numbers_.begin_binary();
    const std::size_t blocks = numbers_.count("a number of blocks");
    const std::size_t count = numbers_.count("a number of nodes");
    skip_tag_range();
    reserve_nodes(count);
    for (std::size_t block = 0; block < blocks; ++block) {
      const auto dimension = read_block_entity().dimension;
      const bool parametric = numbers_.integer("0 or 1 for parametric") != 0;
      const std::size_t nodes = numbers_.count("a number of nodes in the block");
      for (std::size_t i = 0; i < nodes && !early_4_; ++i) add_node_tag();
      for (std::size_t i = 0; i < nodes; ++i) {
        if (early_4_) add_node_tag();
        add_point();
        for (auto k = parametric ? dimension : 0; k > 0; --k) numbers_.real("a parameter");
      }
    }
    expect_total(node_indices_.size(), count, "nodes");
  }

  // The smallest and the largest tag, from version 4.1 on.
  void skip_tag_range() {
    if (early_4_) return;
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
    coordinates_.reserve(3 * count);
    node_indices_.reserve(count);
  }

  void expect_total(std::size_t found, std::size_t expected, const char* what) {
    if (found == expected) return;
    scan_.fail(std::to_string(found) + " " + what + " found, " + std::to_string(expected) +
               " expected by the section's header");
  }

  std::uint32_t read_node() {
    const auto tag = tag_of("the tag of a node");
    const auto found = node_indices_.find(tag);
    if (found == node_indices_.end()) {
      scan_.fail("node " + std::to_string(tag) + " found, the tag of one of the " +
                 std::to_string(node_indices_.size()) + " nodes expected");
    }
    return found->second;
  }

  // The nodes of an element, after its tag. A line belongs to its physical group or, without one, to its
  // curve.
  void add_element(std::int64_t type, std::int64_t group, std::int64_t entity) {
    if (type == msh_triangle) {
      const std::uint32_t a = read_node(), b = read_node(), c = read_node();
      if (is_listed_again(2, group, {a, b, c, no_node})) return;
      if (fields_wanted_) cell_indices_[element_tag_] = static_cast<std::uint32_t>(mesh_.triangles.size());
      add_region(RegionNames::Cell::triangle, group);
      mesh_.triangles.push_back({a, b, c});
    } else if (type == msh_quadrilateral) {
      const std::uint32_t a = read_node(), b = read_node(), c = read_node(), d = read_node();
      if (is_listed_again(2, group, {a, b, c, d})) return;
      if (fields_wanted_) quad_tags_.push_back(element_tag_);
      add_region(RegionNames::Cell::quadrilateral, group);
      mesh_.quads.push_back({a, b, c, d});
    } else if (type == msh_line) {
      const std::uint32_t a = read_node(), b = read_node();
      if (is_listed_again(1, group, {a, b, no_node, no_node})) return;
      groups_used_.insert({1, group});
      boundary_of(group, entity).edges.push_back({a, b});
    } else if (type == msh_point) {
      read_node();
    } else {
      const bool second = std::ranges::find(msh_second_order, type) != std::end(msh_second_order);
      scan_.fail("element of type " + std::to_string(type) +
                 " found, only triangles (type 2), quadrilaterals (type 3) and lines (type 1) expected" +
                 std::string(advice_on(second ? CellKind::second_order : CellKind::other)));
    }
  }

  // They come after the triangles, wherever the file has them.
  void number_quads() {
    for (std::size_t i = 0; i < quad_tags_.size(); ++i)
      cell_indices_[quad_tags_[i]] = static_cast<std::uint32_t>(mesh_.triangles.size() + i);
  }

  // Version 2 lists what is in several physical groups once for each.
  bool is_listed_again(int dimension, std::int64_t group, Nodes nodes) {
    if (version_4_) return false;
    std::sort(nodes.begin(), nodes.end());
    const auto [entry, is_new] = group_of_.try_emplace(nodes, group);
    if (is_new || entry->second == group) return false;
    second_groups_.insert({dimension, group});
    if (dimension == 2) warnings_.count_repeated_triangle();
    return true;
  }

  static std::string name_in(const std::map<std::int64_t, std::string>& names, std::int64_t group,
                             const char* kind, std::int64_t entity) {
    if (const auto known = names.find(group); known != names.end()) return known->second;
    return group != 0 ? "physical_" + std::to_string(group) : kind + std::to_string(entity);
  }

  // The region of the cell that begins, by its physical group: surfaces alone are pieces of a drawing.
  void add_region(RegionNames::Cell cell, std::int64_t group) {
    groups_used_.insert({2, group});
    auto& name = region_of_[group];
    if (name.empty()) name = group == 0 ? domain_name : name_in(surface_names_, group, "", 0);
    regions_.add(mesh_, cell, name);
  }

  FrozenBoundary& boundary_of(std::int64_t group, std::int64_t curve) {
    const auto [entry, added] = boundaries_.try_emplace({group, curve}, 0);
    if (added) {
      const std::string name = name_in(curve_names_, group, "curve_", curve);
      entry->second = names_.add(mesh_, name).first;
    }
    return mesh_.boundaries[entry->second];
  }

  void read_elements_4() {
    if (binary_) numbers_.begin_binary();
    const std::size_t blocks = numbers_.count("a number of blocks");
    const std::size_t count = numbers_.count("a number of elements");
    skip_tag_range();
    std::size_t total = 0;
    for (std::size_t block = 0; block < blocks; ++block) {
      const auto entity = read_block_entity().tag;
      const auto type = numbers_.integer("the type of an element");
      const std::size_t elements = numbers_.count("a number of elements in the block");
      const bool flat = type == msh_triangle || type == msh_quadrilateral;
      const auto& groups = flat ? surface_groups_ : curve_groups_;
      const auto found = groups.find(entity);
      const std::int64_t group = found != groups.end() ? found->second : 0;
      for (std::size_t i = 0; i < elements; ++i) {
        element_tag_ = tag_of("the tag of an element");
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
      element_tag_ = scan_.integer("the number of an element");
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
        element_tag_ = numbers_.integer("the number of an element");
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
  MshFields fields_;
  std::string file_;
  Warnings warnings_;
  FrozenMesh mesh_;
  bool version_4_ = false;
  bool early_4_ = false;  // 4.0
  bool binary_ = false;
  bool nodes_seen_ = false;
  bool elements_seen_ = false;
  std::vector<double> coordinates_;  // of the nodes
  std::vector<bool> used_;           // likewise, see used()
  std::vector<std::string> sections_left_out_;
  std::vector<std::string> other_names_;                  // of physical points and volumes
  std::set<std::pair<int, std::int64_t>> groups_used_;    // by dimension and physical tag
  std::set<std::pair<int, std::int64_t>> second_groups_;  // that elements would have besides their first
  std::unordered_map<Nodes, std::int64_t, HashOfNodes> group_of_;  // of version 2's elements
  bool fields_wanted_ = false;
  std::int64_t element_tag_ = 0;  // of the element that is being read
  std::unordered_map<std::int64_t, std::uint32_t> node_indices_;
  std::unordered_map<std::int64_t, std::uint32_t> cell_indices_;  // where fields are wanted
  std::vector<std::int64_t> quad_tags_;                           // likewise
  std::map<std::int64_t, std::string> curve_names_;               // by physical tag
  std::set<std::string> known_curves_;
  std::map<std::int64_t, std::string> surface_names_;
  std::map<std::int64_t, std::int64_t> curve_groups_;  // physical tag by curve
  std::map<std::int64_t, std::int64_t> surface_groups_;
  std::map<std::int64_t, std::string> region_of_;  // by physical tag
  RegionNames regions_;
  BoundaryNames names_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::size_t> boundaries_;
};

void take_keys(std::string_view text, const std::string& file, FrozenMesh& mesh) {
  if (text.find(vertex_keys_name) == std::string_view::npos) return;
  const std::vector<Field> fields = MshReader(text, file, Warnings(nullptr, file)).read_fields();
  const Field* keys = find_field(fields, std::string(vertex_keys_name));
  if (keys == nullptr || keys->values.size() != mesh.points.size()) return;
  for (const double key : keys->values) mesh.vertex_keys.push_back(key_of_real(key));
  take_generation_note(text, mesh);
}

}  // namespace

FrozenMesh parse_msh(std::string_view text, const std::string& file, ReadNotes* notes) {
  const Warnings warnings(notes, file);
  MshReader reader(text, file, warnings);
  FrozenMesh mesh = reader.read();
  take_steiner_notes(text, mesh);
  take_keys(text, file, mesh);
  warnings.note_unused_points(reader.used(), keep_used_points(mesh, reader.used()));
  return mesh;
}

std::vector<Field> parse_msh_fields(std::string_view text, const std::string& file) {
  MshReader reader(text, file, Warnings(nullptr, file));
  std::vector<Field> fields = reader.read_fields();
  keep_used_points(fields, reader.used());
  std::erase_if(fields, [](const Field& field) {
    return field.name == vertex_keys_name && field.place == FieldPlace::vertices;
  });
  return fields;
}

}  // namespace remodel::io
