// Writes the inputs that the fuzzers start from: one directory per target below the given one. The second
// argument is the adversarial corpus, whose domains are inputs too.

#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "remodel/generate.h"
#include "remodel/io.h"

using namespace remodel;

namespace {

std::string selig(const AirfoilCoordinates& coordinates) {
  std::string text = coordinates.name + "\n";
  const auto add = [&](Point p) {
    char line[64];
    std::snprintf(line, sizeof line, "%.6f %.6f\n", p.x, p.y);
    text += line;
  };
  for (auto p = coordinates.upper.rbegin(); p != coordinates.upper.rend(); p += 8) {
    add(*p);
    if (coordinates.upper.rend() - p <= 8) break;
  }
  for (std::size_t i = 0; i < coordinates.lower.size(); i += 8) add(coordinates.lower[i]);
  return text;
}

Domain square_with_arc() {
  const Polyline square{{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}}};
  return {{{LoopRole::outer, {{"wall", square, {0, 0.25, 0.5, 0.75}}}},
           {LoopRole::hole, {{"hole", Arc{{2, 2}, 1, 0, 6.283185307179586}, {0, 0.25, 0.5, 0.75}}}}}};
}

// A square around a square hole: quadrilaterals on two sides of it, triangles on the others, each a region.
FrozenMesh mixed_mesh() {
  FrozenMesh mesh;
  mesh.points = {{0, 0}, {3, 0}, {3, 3}, {0, 3}, {1, 1}, {2, 1}, {2, 2}, {1, 2}};
  mesh.triangles = {{2, 3, 6}, {3, 7, 6}, {3, 0, 7}, {0, 4, 7}};
  mesh.quads = {{0, 1, 5, 4}, {1, 2, 6, 5}};
  mesh.boundaries = {{"outer", {{0, 1}, {1, 2}, {2, 3}, {3, 0}}},
                     {"airfoil", {{4, 7}, {7, 6}, {6, 5}, {5, 4}}}};
  mesh.region_names = {"outside", "layer"};
  mesh.region = {0, 0, 0, 0, 1, 1};
  return mesh;
}

// Graphs with features beyond closed loops: cracks, joints, inner loops, single points, small angles,
// crossings and holes.
struct NamedGraph {
  const char* name;
  const char* poly;
};
constexpr NamedGraph graphs[] = {
    {"hole",
     "8 2 0 1\n1 0 0 1\n2 4 0 1\n3 4 4 1\n4 0 4 1\n5 1 1 2\n6 3 1 2\n7 3 3 2\n8 1 3 2\n"
     "8 1\n1 1 2 1\n2 2 3 1\n3 3 4 1\n4 4 1 1\n5 5 6 2\n6 6 7 2\n7 7 8 2\n8 8 5 2\n1\n1 2 2\n"},
    {"cracks",
     "# a crack, one from the side, a fan of small angles and a point\n"
     "11 2 0 0\n0 0 0\n1 4 0\n2 4 4\n3 0 4\n4 0.5 3\n5 1.5 3.25\n6 1 1\n7 3 1.2\n8 3 1.6\n9 2.5 2.5\n10 0 1\n"
     "9 1\n0 0 1 1\n1 1 2 1\n2 2 3 2\n3 3 10 3\n4 10 0 3\n5 4 5 7\n6 10 6 0\n7 6 7 0\n8 6 8 0\n0\n"},
    {"crossings",
     "12 2 0 0\n0 0 0\n1 4 0\n2 4 4\n3 0 4\n4 1 -1\n5 3 5\n6 -1 2.25\n7 5 2\n8 1 1\n9 3 1\n10 2 3\n11 2 -2\n"
     "10 0\n0 0 1\n1 1 2\n2 2 3\n3 3 0\n4 4 5\n5 6 7\n6 8 9\n7 9 10\n8 10 8\n9 11 10\n0\n"},
    {"inner_loop",
     "10 2 0 0\n0 0 0\n1 4 0\n2 4 4\n3 0 4\n4 1 1\n5 3 1\n6 3 3\n7 1 3\n8 2 2\n9 4 2\n"
     "11 1\n0 0 1 1\n1 1 9 1\n2 9 2 1\n3 2 3 1\n4 3 0 1\n5 4 5 5\n6 5 6 5\n7 6 7 6\n8 7 4 5\n9 8 6 0\n10 6 9 "
     "0\n0\n"},
    {"nested_holes",
     "12 2 0 0\n0 0 0\n1 8 0\n2 8 8\n3 0 8\n4 2 2\n5 6 2\n6 6 6\n7 2 6\n8 3 3\n9 5 3\n10 5 5\n11 3 5\n"
     "12 0\n0 0 1\n1 1 2\n2 2 3\n3 3 0\n4 4 5\n5 5 6\n6 6 7\n7 7 4\n8 8 9\n9 9 10\n10 10 11\n11 11 8\n1\n0 "
     "2.5 2.5\n"},
};

void write_corpus_domains(const std::filesystem::path& corpus, const std::filesystem::path& directory) {
  for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
    if (entry.path().extension() != ".json") continue;
    const auto designs = nlohmann::json::parse(read_text(entry.path())).at("designs");
    for (std::size_t i = 0; i < designs.size(); ++i)
      if (designs[i].contains("domain"))
        write_text_atomically(directory / (entry.path().stem().string() + std::to_string(i)),
                              designs[i]["domain"].dump());
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::filesystem::path root = argv[1];
  for (const char* target : {"airfoil_text", "airfoil_json", "domain_json", "poly", "import", "su2", "msh",
                             "vtu", "vtkhdf", "vtkhdf_values", "mesh_state", "kernel", "remodel"})
    std::filesystem::create_directories(root / target);

  for (const char* digits : {"0012", "4415", "23012"})
    write_text_atomically(root / "airfoil_text" / (std::string("naca") + digits),
                          selig(naca_airfoil(digits)));
  for (const CatalogueEntry& entry : airfoil_catalogue()) {
    const CstAirfoil airfoil = entry.airfoil();
    write_text_atomically(root / "airfoil_json" / std::string(entry.name), airfoil_to_json(airfoil));
    write_text_atomically(
        root / "domain_json" / std::string(entry.name),
        domain_to_json(airfoil_domain(airfoil, {.points = 8, .farfield_radius = 2, .farfield_points = 8})));
  }
  write_text_atomically(root / "domain_json" / "square", domain_to_json(square_with_arc()));
  write_corpus_domains(argv[2], root / "domain_json");
  for (const NamedGraph& graph : graphs) {
    write_text_atomically(root / "poly" / graph.name, graph.poly);
    write_text_atomically(root / "domain_json" / (std::string("graph_") + graph.name),
                          domain_to_json(planar_domain(parse_poly(graph.poly, graph.name), graph.name)));
  }

  const Mesh mesh = generate(square_with_arc(), {.min_angle_deg = 20, .gradation = 8}).mesh;
  write_mesh(mesh, root / "import" / "square.su2");
  const Domain section = airfoil_domain(airfoil_catalogue()[0].airfoil(),
                                        {.points = 8, .farfield_radius = 2, .farfield_points = 8});
  write_mesh(generate(section, {.min_angle_deg = 20, .gradation = 1}).mesh, root / "import" / "airfoil.su2");
  for (const char* extension : {"su2", "msh", "vtu", "vtkhdf"}) {
    const auto file = root / extension / (std::string("mesh.") + extension);
    write_mesh(mesh, file);
  }
  write_mesh(mesh.freeze(), root / "vtkhdf" / "frozen.vtkhdf");
  write_mesh(mesh.freeze(), root / "msh" / "mesh22.msh", {.msh_version = 22});
  FrozenMesh parts = mesh.freeze();
  parts.region_names = {"one", "two"};
  for (std::uint32_t i = 0; i < parts.triangles.size(); ++i) parts.region.push_back(i % 5 % 2);
  for (const char* extension : {"msh", "vtu", "vtkhdf"})
    write_mesh(parts, root / extension / (std::string("regions.") + extension));
  const FrozenMesh mixed = mixed_mesh();
  const Field speed{"speed", FieldPlace::triangles, 1, {1, 2, 3, 4, 5, 6}};
  write_mesh(mixed, root / "import" / "mixed.su2");
  write_mesh(mixed, root / "su2" / "mixed.su2");
  write_mesh(mixed, root / "msh" / "mixed22.msh", {.msh_version = 22});
  for (const char* extension : {"msh", "vtu", "vtkhdf"})
    write_mesh(mixed, root / extension / (std::string("mixed.") + extension), {.fields = {&speed, 1}});
  for (unsigned i = 0; i < 8; ++i) {
    std::string bytes;
    for (unsigned k = 0; k < 120; ++k) bytes += static_cast<char>((i * 97 + k * k * 31 + k * 7) % 251);
    for (const char* target : {"kernel", "remodel", "mesh_state", "vtkhdf_values"})
      write_text_atomically(root / target / ("walk" + std::to_string(i)), bytes);
  }
  return 0;
}
