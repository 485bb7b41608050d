#include "remodel/generate.h"

#include <cmath>

#include "generate/discretise.h"
#include "generate/recovery_error.h"
#include "generate/refine.h"
#include "mesh/option_ranges.h"
#include "mesh/small_angles.h"
#include "remodel/error.h"

namespace remodel {

namespace {

void validate(const QualityOptions& options) {
  if (const auto found = out_of_range(options))
    throw Error(ErrorCode::argument, found->option, found->problem);
}

// About how many triangles there will be. Around a boundary whose n vertices are a length scale h apart,
// scales grow by distance / G: the integral of 1 / scale^2 over the plane is about n G, and a triangle has
// about a fifth of a squared scale. For small G the grading is too steep for that, hence the constant. A
// guess too low costs copies, one too high address space.
std::size_t expected_triangles(const MeshData& mesh) {
  const double per_vertex = 20.0 + 5.0 * std::min(mesh.options.gradation, 1e3);
  const double guess = static_cast<double>(mesh.boundary.size()) * per_vertex;
  return static_cast<std::size_t>(std::min(guess, 2.0 * mesh.options.max_vertices));
}

}  // namespace

GenerateResult generate(const Domain& domain, const QualityOptions& options, StepObserver* observer) {
  validate(options);
  validate(domain);
  GenerateResult result;
  MeshData& mesh = result.mesh.data();
  mesh.domain = domain;
  mesh.options = options;
  try {
    discretise(mesh);
    mesh.triangulation.reserve(expected_triangles(mesh));
    const Arena::Scope scope(mesh.arena);
    Refiner refiner(mesh, observer);
    for (std::uint32_t i = 0; i < mesh.triangulation.triangle_slots(); ++i) refiner.consider(TriangleId{i});
    result.stopped = refiner.run();
    require_points_in_domain(mesh);  // a split of a curved boundary may have passed one
    result.small_angles = refiner.small_angles();
  } catch (const RecoveryError& error) {
    throw Error(ErrorCode::geometry, nameless_domain, error.what());
  }
  mesh.stopped = result.stopped;
  mesh.domain_triangles = mesh.count_domain_triangles();
  result.exempt_triangles = count_exempt(mesh);
  return result;
}

}  // namespace remodel
