// Writes the inputs that the fuzzers start from: one directory a target below the given one. The second
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
  for (const char* target : {"airfoil_text", "airfoil_json", "domain_json", "import", "su2", "msh", "vtu", "vtkhdf",
                             "vtkhdf_values", "mesh_state", "kernel", "remodel"})
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
  for (unsigned i = 0; i < 8; ++i) {
    std::string bytes;
    for (unsigned k = 0; k < 120; ++k) bytes += static_cast<char>((i * 97 + k * k * 31 + k * 7) % 251);
    for (const char* target : {"kernel", "remodel", "mesh_state", "vtkhdf_values"})
      write_text_atomically(root / target / ("walk" + std::to_string(i)), bytes);
  }
  return 0;
}
