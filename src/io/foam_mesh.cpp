// OpenFOAM's polyMesh: https://www.openfoam.com/documentation/user-guide/4-mesh-generation-and-conversion

#include <algorithm>
#include <system_error>

#include "io/foam_edges.h"
#include "io/scanner.h"
#include "io/text_writer.h"
#include "io/words.h"
#include "remodel/error.h"
#include "remodel/foam.h"
#include "remodel/io.h"

namespace remodel {

namespace {

namespace fs = std::filesystem;
using io::FoamEdge;
using io::FoamPatch;
using io::TextWriter;

// A face between two cells.
struct InnerFace {
  std::uint32_t owner, neighbour;
  FoamEdge edge;  // of the owner
};

// Faces in OpenFOAM's order: by owner, the lower cell, then by neighbour.
std::vector<InnerFace> inner_faces(const std::vector<FoamEdge>& edges) {
  std::vector<InnerFace> faces;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    if (edges[i].ends() != edges[i + 1].ends()) continue;
    const bool first = edges[i].cell < edges[i + 1].cell;
    const FoamEdge &owner = edges[first ? i : i + 1], &other = edges[first ? i + 1 : i];
    faces.push_back({owner.cell, other.cell, owner});
    ++i;
  }
  std::sort(faces.begin(), faces.end(), [](const InnerFace& a, const InnerFace& b) {
    return std::pair(a.owner, a.neighbour) < std::pair(b.owner, b.neighbour);
  });
  return faces;
}

TextWriter begin_file(const char* type, const char* object, const std::string& note = {}) {
  TextWriter out;
  out << "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       " << type << ";\n";
  if (!note.empty()) out << "    note        \"" << note << "\";\n";
  out << "    location    \"constant/polyMesh\";\n    object      " << object << ";\n}\n\n";
  return out;
}

std::string points_text(const FrozenMesh& mesh) {
  TextWriter out = begin_file("vectorField", "points");
  out << 2 * mesh.points.size() << "\n(\n";
  for (const int z : {0, 1})
    for (const Point p : mesh.points) out << '(' << p.x << ' ' << p.y << ' ' << z << ")\n";
  out << ")\n";
  return out.take();
}

// Normals point out of owners.
std::string faces_text(const FrozenMesh& mesh, const std::vector<InnerFace>& inner,
                       const std::vector<FoamPatch>& patches) {
  const auto above = static_cast<std::uint32_t>(mesh.points.size());
  std::size_t count = inner.size() + 2 * mesh.cell_count();
  for (const FoamPatch& patch : patches) count += patch.edges.size();
  TextWriter out = begin_file("faceList", "faces");
  const auto upright = [&](const FoamEdge& edge) {
    out << "4(" << edge.a << ' ' << edge.b << ' ' << edge.b + above << ' ' << edge.a + above << ")\n";
  };
  out << count << "\n(\n";
  for (const InnerFace& face : inner) upright(face.edge);
  for (const FoamPatch& patch : patches)
    for (const FoamEdge& edge : patch.edges) upright(edge);
  for (std::size_t i = 0; i < mesh.cell_count(); ++i) {
    const auto corners = mesh.cell(i);
    out << corners.size() << '(' << corners[0];
    for (std::size_t k = corners.size() - 1; k > 0; --k) out << ' ' << corners[k];
    out << ")\n";
  }
  for (std::size_t i = 0; i < mesh.cell_count(); ++i) {
    const auto corners = mesh.cell(i);
    out << corners.size() << '(' << corners[0] + above;
    for (const std::uint32_t corner : corners.subspan(1)) out << ' ' << corner + above;
    out << ")\n";
  }
  out << ")\n";
  return out.take();
}

std::string owners_text(const FrozenMesh& mesh, const std::vector<InnerFace>& inner,
                        const std::vector<FoamPatch>& patches, const std::string& note) {
  std::vector<std::uint32_t> owners;
  for (const InnerFace& face : inner) owners.push_back(face.owner);
  for (const FoamPatch& patch : patches)
    for (const FoamEdge& edge : patch.edges) owners.push_back(edge.cell);
  for (const int side : {0, 1}) {
    static_cast<void>(side);
    for (std::uint32_t t = 0; t < mesh.cell_count(); ++t) owners.push_back(t);
  }
  TextWriter out = begin_file("labelList", "owner", note);
  out << owners.size() << "\n(\n";
  for (const std::uint32_t owner : owners) out << owner << '\n';
  out << ")\n";
  return out.take();
}

std::string neighbours_text(const std::vector<InnerFace>& inner, const std::string& note) {
  TextWriter out = begin_file("labelList", "neighbour", note);
  out << inner.size() << "\n(\n";
  for (const InnerFace& face : inner) out << face.neighbour << '\n';
  out << ")\n";
  return out.take();
}

std::string boundary_text(const FrozenMesh& mesh, std::size_t inner, const std::vector<FoamPatch>& patches) {
  TextWriter out = begin_file("polyBoundaryMesh", "boundary");
  std::size_t start = inner;
  const auto entry = [&](const std::string& name, std::string_view type, std::size_t faces) {
    out << "    " << name << "\n    {\n        type            " << type << ";\n        nFaces          "
        << faces << ";\n        startFace       " << start << ";\n    }\n";
    start += faces;
  };
  out << patches.size() + 2 << "\n(\n";
  for (const FoamPatch& patch : patches) {
    const bool open = patch.name == "farfield" || patch.name == "inlet" || patch.name == "outlet";
    entry(patch.name, open ? "patch" : "wall", patch.edges.size());
  }
  entry("front", "empty", mesh.cell_count());
  entry("back", "empty", mesh.cell_count());
  out << ")\n";
  return out.take();
}

void require_names(const FrozenMesh& mesh, const std::vector<FoamPatch>& patches, const std::string& file) {
  std::vector<FrozenBoundary> written;  // those with cells on both sides are no patches
  for (const FrozenBoundary& boundary : mesh.boundaries)
    if (std::ranges::find(patches, io::as_word(boundary.name), &FoamPatch::name) != patches.end())
      written.push_back({boundary.name, {}});
  io::require_different_words(written, file);
  for (const FoamPatch& patch : patches) {
    const auto bad = [](char c) {
      return static_cast<unsigned char>(c) <= ' ' ||
             std::string_view("\"'/;{}()$").find(c) != std::string_view::npos;
    };
    if (patch.name.empty() || patch.name == "front" || patch.name == "back" ||
        std::any_of(patch.name.begin(), patch.name.end(), bad))
      throw Error(ErrorCode::argument, file,
                  "boundary name " + io::in_quotes(patch.name) +
                      " found, OpenFOAM expects a word, which is not 'front' or 'back'");
  }
}

}  // namespace

std::vector<FoamPatch> io::foam_patches(const FrozenMesh& mesh, const std::vector<FoamEdge>& edges) {
  const auto range = [&](const FoamEdge& like) {
    return std::equal_range(edges.begin(), edges.end(), like,
                            [](const FoamEdge& a, const FoamEdge& b) { return a.ends() < b.ends(); });
  };
  std::vector<FoamPatch> patches;
  std::vector<bool> named(edges.size());
  for (const FrozenBoundary& boundary : mesh.boundaries) {
    FoamPatch patch{as_word(boundary.name), {}};
    for (const auto& [a, b] : boundary.edges) {
      const auto [first, last] = range({a, b, 0});
      if (last - first != 1) continue;
      named[static_cast<std::size_t>(first - edges.begin())] = true;
      patch.edges.push_back(*first);
    }
    if (!patch.edges.empty()) patches.push_back(std::move(patch));
  }
  FoamPatch rest{"unnamed", {}};
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i + 1 < edges.size() && edges[i].ends() == edges[i + 1].ends())
      ++i;
    else if (!named[i])
      rest.edges.push_back(edges[i]);
  }
  if (!rest.edges.empty()) patches.push_back(std::move(rest));
  return patches;
}

void write_foam_mesh(const FrozenMesh& mesh, const fs::path& file) {
  const std::vector<FoamEdge> edges = io::edges_of_cells(mesh);
  const std::vector<FoamPatch> patches = io::foam_patches(mesh, edges);
  require_names(mesh, patches, file.string());
  const std::vector<InnerFace> inner = inner_faces(edges);
  std::size_t faces = inner.size() + 2 * mesh.cell_count();
  for (const FoamPatch& patch : patches) faces += patch.edges.size();
  const std::string note =
      "nPoints: " + std::to_string(2 * mesh.points.size()) + " nCells: " + std::to_string(mesh.cell_count()) +
      " nFaces: " + std::to_string(faces) + " nInternalFaces: " + std::to_string(inner.size());
  const fs::path constant = file.parent_path() / "constant", place = constant / "polyMesh",
                 fresh = constant / ".polyMesh.remodel";
  const auto require = [&](const std::error_code& problem, const char* what) {
    if (problem) throw Error(ErrorCode::file, place.string(), std::string(what) + problem.message());
  };
  std::error_code problem;
  if (fs::is_symlink(place, problem))
    throw Error(ErrorCode::file, place.string(), "is a link, expected a directory to replace or none");
  fs::remove_all(fresh, problem);
  fs::create_directories(fresh, problem);
  require(problem, "cannot make the directory: ");
  write_text_atomically(fresh / "points", points_text(mesh));
  write_text_atomically(fresh / "faces", faces_text(mesh, inner, patches));
  write_text_atomically(fresh / "owner", owners_text(mesh, inner, patches, note));
  write_text_atomically(fresh / "neighbour", neighbours_text(inner, note));
  write_text_atomically(fresh / "boundary", boundary_text(mesh, inner.size(), patches));
  fs::remove_all(place, problem);
  require(problem, "cannot be replaced: ");
  fs::rename(fresh, place, problem);
  require(problem, "cannot be replaced: ");
  write_text_atomically(file, "");
}

}  // namespace remodel
