#include "optimise/comparison.h"

#include "optimise/portable_math.h"
#include "optimise/stopwatch.h"
#include "remodel/generate.h"

namespace remodel {

FreshMesh fresh_mesh(const DesignDomains& domain_of, const QualityOptions& quality,
                     const CstAirfoil& design) {
  const ThreadStopwatch watch;
  const GenerateResult generated = generate(domain_of(design), quality);
  const double seconds = watch.seconds();
  return {.stopped = generated.stopped,
          .triangles = generated.mesh.triangle_count(),
          .error = generated.mesh.gradation_error(),
          .seconds = seconds};
}

// Where the optimiser has converged, designs hardly differ any more, and neither would the meshes that they
// are compared with: one mesh with many or few triangles, by chance, would decide the mean of hundreds.
CstAirfoil compared_design(const DesignDomains& domain_of, const CstAirfoil& design, std::uint64_t evaluation,
                           double sigma) {
  constexpr double converged = 0.003,
                   jitter = 0.001;  // standard deviation of samples; of coefficients, relative
  if (sigma >= converged) return design;
  portable::Generator random(evaluation);
  CstAirfoil jittered = design;
  for (auto* surface : {&jittered.upper, &jittered.lower})
    for (double& coefficient : *surface) coefficient *= 1.0 + jitter * random.normal();
  return domain_of.feasible(jittered) ? jittered : design;
}

void add_comparison(const FreshMesh& fresh, const GradationError& remodelled, EvaluationRecord& record) {
  record.generate_seconds = fresh.seconds;
  record.generated_triangles = fresh.triangles;
  record.gradation_bias = remodelled.bias;
  record.gradation_deviation = remodelled.deviation;
  record.generated_gradation_bias = fresh.error.bias;
  record.generated_gradation_deviation = fresh.error.deviation;
}

}  // namespace remodel
