#include "design/comparison.h"

#include "base/stopwatch.h"
#include "design/portable_math.h"
#include "remodel/generate.h"

namespace remodel {

FreshMesh fresh_mesh(const DesignSpace& space, const QualityOptions& quality,
                     std::span<const double> design) {
  const ThreadStopwatch watch;
  const GenerateResult generated = generate(space.domain(design), quality);
  const double seconds = watch.seconds();
  return {.stopped = generated.stopped,
          .triangles = generated.mesh.triangle_count(),
          .error = generated.mesh.gradation_error(),
          .seconds = seconds};
}

// Where the optimiser has converged, designs hardly differ any more, and neither would the meshes that they
// are compared with: one mesh with many or few triangles, by chance, would decide the mean of hundreds.
std::vector<double> compared_design(const DesignSpace& space, std::span<const double> design,
                                    std::uint64_t evaluation, double step_size) {
  constexpr double converged = 0.003,
                   jitter = 0.001;  // standard deviation of samples; of coefficients, relative
  std::vector<double> same(design.begin(), design.end());
  if (step_size >= converged || step_size == 0.0) return same;
  portable::Generator random(evaluation);
  std::vector<double> jittered = same;
  for (double& coefficient : jittered) coefficient *= 1.0 + jitter * random.normal();
  return space.feasible(jittered) ? jittered : same;
}

void add_comparison(const FreshMesh& fresh, const GradationError& remodelled, MeshStep& record) {
  record.generate_seconds = fresh.seconds;
  record.generated_triangles = fresh.triangles;
  record.gradation_bias = remodelled.bias;
  record.gradation_deviation = remodelled.deviation;
  record.generated_gradation_bias = fresh.error.bias;
  record.generated_gradation_deviation = fresh.error.deviation;
}

}  // namespace remodel
