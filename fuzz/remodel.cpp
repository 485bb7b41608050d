// Sequences of designs on a living mesh, with a check after each; a refused design leaves the mesh unchanged.

#include "remodel/remodel.h"
#include "fuzz.h"
#include "mesh/mesh_data.h"
#include "remodel/generate.h"

using namespace remodel;

namespace {

class Designs {
 public:
  Designs(fuzz::Bytes bytes) : bytes_(bytes) {
    const auto& catalogue = airfoil_catalogue();
    airfoil_ = catalogue[bytes_.below(static_cast<unsigned>(catalogue.size()))].airfoil();
    options_ = {.points = 8 + 2 * static_cast<int>(bytes_.below(9)),
                .farfield_radius = 1.6 + 0.05 * bytes_.below(32),
                .farfield_points = 8 + static_cast<int>(bytes_.below(8))};
  }

  void run() {
    const double gradation = 0.5 + 0.5 * bytes_.below(32);
    GenerateResult generated = generate(domain(), {.gradation = gradation, .max_vertices = 1500});
    require_valid(generated.mesh, generated.stopped, generated.exempt_triangles);
    if (generated.stopped != Stopped::done) return;
    Mesh mesh = std::move(generated.mesh);
    for (int steps = 0; steps < 8 && !bytes_.empty(); ++steps) step(mesh);
  }

 private:
  Domain domain() const { return airfoil_domain(airfoil_, options_); }

  void change() {
    const unsigned what = bytes_.next();
    auto& side = what & 1U ? airfoil_.upper : airfoil_.lower;
    const double amount = (static_cast<int>(bytes_.next()) - 128) / 128.0;
    if (what % 16 == 15)
      options_.points = 8 + 2 * static_cast<int>(bytes_.below(9));
    else if (what % 16 == 14)
      options_.farfield_radius = 1.6 + 0.05 * bytes_.below(32);
    else if (what % 16 == 13)
      airfoil_ =
          airfoil_catalogue()[bytes_.below(static_cast<unsigned>(airfoil_catalogue().size()))].airfoil();
    else if (what & 2U)
      side[bytes_.below(static_cast<unsigned>(side.size()))] += amount;
    else
      for (double& value : side) value *= 1.0 + 0.25 * amount;
  }

  void step(Mesh& mesh) {
    for (unsigned changes = 1 + bytes_.below(3); changes > 0; --changes) change();
    const RemodelOptions options{.distance = 0.5 * bytes_.below(10),
                                 .method = bytes_.below(4) == 0 ? Method::general : Method::automatic};
    const MeshState before = mesh.state();
    try {
      const RemodelResult result = remodel::remodel(mesh, domain(), options);
      require_valid(mesh, result.stopped, 0);
      fuzz::require(result.triangles == mesh.triangle_count() && result.preserved <= result.triangles_before,
                    "the counts are wrong");
    } catch (const Error&) {
      ++fuzz::refusals;
      fuzz::require(mesh.state() == before, "a refused design has changed the mesh");
    }
  }

  static void require_valid(const Mesh& mesh, Stopped stopped, std::size_t exempt) {
    fuzz::require_empty(mesh.data().triangulation.check_topology());
    fuzz::require_empty(check_boundary(mesh.data()));
    if (stopped == Stopped::done && exempt == 0) fuzz::require_empty(mesh.quick_check());
  }

  fuzz::Bytes bytes_;
  CstAirfoil airfoil_;
  AirfoilDomainOptions options_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    Designs(fuzz::Bytes(data, size)).run();
  } catch (const Error&) {
    ++fuzz::refusals;  // the first design cannot be meshed
  }
  return 0;
}
