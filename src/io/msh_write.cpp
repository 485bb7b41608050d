// Gmsh's mesh format, versions 4.1 and 2.2, ASCII: https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format

#include <algorithm>

#include "io/assemble.h"
#include "io/formats.h"
#include "io/msh.h"
#include "io/plane_vectors.h"
#include "io/scanner.h"
#include "io/steiner_note.h"
#include "io/text_writer.h"
#include "remodel/error.h"

namespace remodel::io {

namespace {

// Boundary k is curve and physical group k + 1; region k is surface k + 1, and the physical groups of regions
// come after the boundaries'. A mesh without regions has one, "domain". Nodes and elements are numbered from
// 1 in our order, boundary edges first; a block of version 4.1 is a run of triangles or quadrilaterals of one
// region.
class MshWriter {
 public:
  MshWriter(const FrozenMesh& mesh, const std::string& file, std::span<const Field> fields)
      : mesh_(mesh), file_(file), fields_(fields), regions_(mesh.region_names) {
    if (mesh.region.empty()) regions_ = {std::string(domain_name)};
    for (const auto& boundary : mesh.boundaries) edge_count_ += boundary.edges.size();
  }

  std::string version_41() {
    out_ << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
    physical_names();
    entities();
    nodes_41();
    elements_41();
    keys();
    for (const Field& field : fields_) data(field);
    comments();
    return out_.take();
  }

  std::string version_22() {
    out_ << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    physical_names();
    nodes_22();
    elements_22();
    keys();
    for (const Field& field : fields_) data(field);
    comments();
    return out_.take();
  }

 private:
  void keys() {
    if (mesh_.vertex_keys.empty()) return;
    Field field{std::string(vertex_keys_name), FieldPlace::vertices, 1, {}};
    for (const std::uint64_t key : mesh_.vertex_keys) {
      const std::optional<double> real = real_of_key(key);
      if (!real) return;
      field.values.push_back(*real);
    }
    data(field);
  }

  void comments() {
    const std::string note = steiner_note(mesh_, "") + generation_note(mesh_) + plane_note(in_plane_);
    if (!note.empty()) out_ << "$Comments\n" << note << "$EndComments\n";
  }

  void physical_names() {
    out_ << "$PhysicalNames\n" << mesh_.boundaries.size() + regions_.size() << '\n';
    for (std::size_t k = 0; k < mesh_.boundaries.size(); ++k) {
      physical_name(1, k + 1, "boundary", mesh_.boundaries[k].name);
    }
    for (std::size_t k = 0; k < regions_.size(); ++k) physical_name(2, group_of(k), "region", regions_[k]);
    out_ << "$EndPhysicalNames\n";
  }

  void physical_name(int dimension, std::size_t group, const char* what, const std::string& name) {
    const auto bad = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '"'; };
    if (name.empty() || std::any_of(name.begin(), name.end(), bad)) {
      throw Error(
          ErrorCode::argument, file_,
          std::string(what) + " name " + in_quotes(name) + " found, Gmsh expects one line without quotes");
    }
    out_ << dimension << ' ' << group << " \"" << name << "\"\n";
  }

  std::size_t group_of(std::size_t region) const { return mesh_.boundaries.size() + 1 + region; }
  std::size_t end_of_run(std::size_t begin) const {
    std::size_t end = begin + 1;
    while (end < mesh_.cell_count() && type_of(end) == type_of(begin) && region_of(end) == region_of(begin))
      ++end;
    return end;
  }
  std::size_t region_of(std::size_t cell) const { return mesh_.region.empty() ? 0 : mesh_.region[cell]; }
  int type_of(std::size_t cell) const {
    return mesh_.cell(cell).size() == 3 ? msh_triangle : msh_quadrilateral;
  }
  void nodes_of(std::size_t cell) {
    for (const std::uint32_t node : mesh_.cell(cell)) out_ << ' ' << node + 1;
    out_ << '\n';
  }

  void bounding_box() {
    Point low = mesh_.points.empty() ? Point{} : mesh_.points.front();
    Point high = low;
    for (const Point p : mesh_.points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    out_ << low.x << ' ' << low.y << " 0 " << high.x << ' ' << high.y << " 0";
  }

  void entities() {
    out_ << "$Entities\n0 " << mesh_.boundaries.size() << ' ' << regions_.size() << " 0\n";
    for (std::size_t k = 0; k < mesh_.boundaries.size(); ++k) {
      out_ << k + 1 << ' ';
      bounding_box();
      out_ << " 1 " << k + 1 << " 0\n";
    }
    for (std::size_t region = 0; region < regions_.size(); ++region) {
      out_ << region + 1 << ' ';
      bounding_box();
      const std::size_t curves = regions_.size() == 1 ? mesh_.boundaries.size() : 0;  // which is not known
      out_ << " 1 " << group_of(region) << ' ' << curves;
      for (std::size_t k = 0; k < curves; ++k) out_ << ' ' << k + 1;
      out_ << '\n';
    }
    out_ << "$EndEntities\n";
  }

  void nodes_41() {
    const std::size_t count = mesh_.points.size();
    out_ << "$Nodes\n1 " << count << " 1 " << count << "\n2 1 0 " << count << '\n';
    for (std::size_t i = 1; i <= count; ++i) out_ << i << '\n';
    for (const Point p : mesh_.points) out_ << p.x << ' ' << p.y << " 0\n";
    out_ << "$EndNodes\n";
  }

  void elements_41() {
    const std::size_t count = edge_count_ + mesh_.cell_count();
    std::size_t runs = 0;
    for (std::size_t begin = 0; begin < mesh_.cell_count(); begin = end_of_run(begin)) ++runs;
    out_ << "$Elements\n" << mesh_.boundaries.size() + runs << ' ' << count << " 1 " << count << '\n';
    std::size_t tag = 0;
    for (std::size_t k = 0; k < mesh_.boundaries.size(); ++k) {
      const auto& edges = mesh_.boundaries[k].edges;
      out_ << "1 " << k + 1 << ' ' << msh_line << ' ' << edges.size() << '\n';
      for (const auto& [a, b] : edges) out_ << ++tag << ' ' << a + 1 << ' ' << b + 1 << '\n';
    }
    for (std::size_t begin = 0; begin < mesh_.cell_count(); begin = end_of_run(begin)) {
      const std::size_t end = end_of_run(begin);
      out_ << "2 " << region_of(begin) + 1 << ' ' << type_of(begin) << ' ' << end - begin << '\n';
      for (std::size_t i = begin; i < end; ++i) {
        out_ << ++tag;
        nodes_of(i);
      }
    }
    out_ << "$EndElements\n";
  }

  void nodes_22() {
    out_ << "$Nodes\n" << mesh_.points.size() << '\n';
    for (std::size_t i = 0; i < mesh_.points.size(); ++i) {
      out_ << i + 1 << ' ' << mesh_.points[i].x << ' ' << mesh_.points[i].y << " 0\n";
    }
    out_ << "$EndNodes\n";
  }

  // tag, type, two tags: physical group and entity, nodes
  void elements_22() {
    out_ << "$Elements\n" << edge_count_ + mesh_.cell_count() << '\n';
    std::size_t tag = 0;
    for (std::size_t k = 0; k < mesh_.boundaries.size(); ++k) {
      for (const auto& [a, b] : mesh_.boundaries[k].edges) {
        out_ << ++tag << ' ' << msh_line << " 2 " << k + 1 << ' ' << k + 1 << ' ' << a + 1 << ' ' << b + 1
             << '\n';
      }
    }
    for (std::size_t i = 0; i < mesh_.cell_count(); ++i) {
      out_ << ++tag << ' ' << type_of(i) << " 2 " << group_of(region_of(i)) << ' ' << region_of(i) + 1;
      nodes_of(i);
    }
    out_ << "$EndElements\n";
  }

  // A view of Gmsh's: time 0, time step 0. Gmsh expects one, three or nine components, and meshio values of
  // all elements: a boundary edge has that of its cell.
  void data(const Field& field) {
    ++sections_;
    if (field.components == 2) in_plane_.push_back(sections_);
    if (field.name.find('"') != std::string::npos) {
      throw Error(ErrorCode::argument, file_,
                  "field " + in_quotes(field.name) + " found, Gmsh expects a name without quotes");
    }
    const bool on_vertices = field.place == FieldPlace::vertices;
    const auto components = static_cast<std::size_t>(field.components);
    std::vector<std::size_t> order;  // of the values, by the numbers of nodes or elements
    if (!on_vertices) order = cells_at_boundaries(mesh_);
    for (std::size_t i = 0; i < field.values.size() / components; ++i) order.push_back(i);
    out_ << (on_vertices ? "$NodeData" : "$ElementData") << "\n1\n\"" << field.name << "\"\n1\n0\n3\n0\n"
         << (components == 2 ? 3 : components) << '\n'
         << order.size() << '\n';
    for (std::size_t i = 0; i < order.size(); ++i) {
      out_ << i + 1;
      for (std::size_t k = 0; k < components; ++k) out_ << ' ' << field.values[order[i] * components + k];
      out_ << (components == 2 ? " 0\n" : "\n");
    }
    out_ << (on_vertices ? "$EndNodeData\n" : "$EndElementData\n");
  }

  const FrozenMesh& mesh_;
  std::string file_;
  std::span<const Field> fields_;
  std::vector<std::string> regions_;
  std::size_t edge_count_ = 0;
  std::size_t sections_ = 0;           // of data, written so far
  std::vector<std::size_t> in_plane_;  // those of them that a third component was added to
  TextWriter out_;
};

}  // namespace

std::string msh_text(const FrozenMesh& mesh, int version, const std::string& file,
                     std::span<const Field> fields) {
  require_fit(fields, mesh);
  if (version == 41) return MshWriter(mesh, file, fields).version_41();
  if (version == 22) return MshWriter(mesh, file, fields).version_22();
  throw Error(ErrorCode::argument, "msh version", std::to_string(version) + " found, 41 or 22 expected");
}

}  // namespace remodel::io
