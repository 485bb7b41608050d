// Gmsh's mesh format, versions 4.1 and 2.2, ASCII: https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format

#include <algorithm>

#include "io/formats.h"
#include "io/msh.h"
#include "io/scanner.h"
#include "io/text_writer.h"
#include "remodel/error.h"

namespace remodel::io {

namespace {

// Boundary k is curve and physical group k + 1; the domain is surface 1 and the physical group after the
// boundaries'. Nodes and elements are numbered from 1 in our order, boundary edges first.
class MshWriter {
 public:
  MshWriter(const FrozenMesh& mesh, const std::string& file)
      : mesh_(mesh), file_(file), domain_tag_(mesh.boundaries.size() + 1) {
    for (const auto& boundary : mesh.boundaries) edge_count_ += boundary.edges.size();
  }

  std::string version_41() {
    out_ << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
    physical_names();
    entities();
    nodes_41();
    elements_41();
    return out_.take();
  }

  std::string version_22() {
    out_ << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    physical_names();
    nodes_22();
    elements_22();
    return out_.take();
  }

 private:
  void physical_names() {
    out_ << "$PhysicalNames\n" << mesh_.boundaries.size() + 1 << '\n';
    for (std::size_t k = 0; k < mesh_.boundaries.size(); ++k) {
      const std::string& name = mesh_.boundaries[k].name;
      const auto bad = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '"'; };
      if (name.empty() || std::any_of(name.begin(), name.end(), bad)) {
        throw Error(ErrorCode::argument, file_,
                    "boundary name " + in_quotes(name) + " found, Gmsh expects one line without quotes");
      }
      out_ << "1 " << k + 1 << " \"" << name << "\"\n";
    }
    out_ << "2 " << domain_tag_ << " \"" << domain_name << "\"\n$EndPhysicalNames\n";
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
    out_ << "$Entities\n0 " << mesh_.boundaries.size() << " 1 0\n";
    for (std::size_t k = 0; k < mesh_.boundaries.size(); ++k) {
      out_ << k + 1 << ' ';
      bounding_box();
      out_ << " 1 " << k + 1 << " 0\n";
    }
    out_ << "1 ";
    bounding_box();
    out_ << " 1 " << domain_tag_ << ' ' << mesh_.boundaries.size();
    for (std::size_t k = 0; k < mesh_.boundaries.size(); ++k) out_ << ' ' << k + 1;
    out_ << "\n$EndEntities\n";
  }

  void nodes_41() {
    const std::size_t count = mesh_.points.size();
    out_ << "$Nodes\n1 " << count << " 1 " << count << "\n2 1 0 " << count << '\n';
    for (std::size_t i = 1; i <= count; ++i) out_ << i << '\n';
    for (const Point p : mesh_.points) out_ << p.x << ' ' << p.y << " 0\n";
    out_ << "$EndNodes\n";
  }

  void elements_41() {
    const std::size_t count = edge_count_ + mesh_.triangles.size();
    out_ << "$Elements\n" << mesh_.boundaries.size() + 1 << ' ' << count << " 1 " << count << '\n';
    std::size_t tag = 0;
    for (std::size_t k = 0; k < mesh_.boundaries.size(); ++k) {
      const auto& edges = mesh_.boundaries[k].edges;
      out_ << "1 " << k + 1 << ' ' << msh_line << ' ' << edges.size() << '\n';
      for (const auto& [a, b] : edges) out_ << ++tag << ' ' << a + 1 << ' ' << b + 1 << '\n';
    }
    out_ << "2 1 " << msh_triangle << ' ' << mesh_.triangles.size() << '\n';
    for (const auto& [a, b, c] : mesh_.triangles) {
      out_ << ++tag << ' ' << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
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
    out_ << "$Elements\n" << edge_count_ + mesh_.triangles.size() << '\n';
    std::size_t tag = 0;
    for (std::size_t k = 0; k < mesh_.boundaries.size(); ++k) {
      for (const auto& [a, b] : mesh_.boundaries[k].edges) {
        out_ << ++tag << ' ' << msh_line << " 2 " << k + 1 << ' ' << k + 1 << ' ' << a + 1 << ' ' << b + 1
             << '\n';
      }
    }
    for (const auto& [a, b, c] : mesh_.triangles) {
      out_ << ++tag << ' ' << msh_triangle << " 2 " << domain_tag_ << " 1 " << a + 1 << ' ' << b + 1 << ' '
           << c + 1 << '\n';
    }
    out_ << "$EndElements\n";
  }

  const FrozenMesh& mesh_;
  std::string file_;
  std::size_t domain_tag_;
  std::size_t edge_count_ = 0;
  TextWriter out_;
};

}  // namespace

std::string msh_text(const FrozenMesh& mesh, int version, const std::string& file) {
  if (version == 41) return MshWriter(mesh, file).version_41();
  if (version == 22) return MshWriter(mesh, file).version_22();
  throw Error(ErrorCode::argument, "msh version", std::to_string(version) + " found, 41 or 22 expected");
}

}  // namespace remodel::io
