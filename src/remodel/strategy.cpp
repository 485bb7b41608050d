#include "remodel/strategy.h"

#include <algorithm>
#include <cmath>

#include "remodel/coarsen.h"
#include "remodel/count_control.h"
#include "remodel/renew.h"

namespace remodel {

namespace {

constexpr int samples_on_the_way = 5;  // for a mesh of unknown history: K within about 2 %
constexpr double tolerated_excess = 0.02;
constexpr int refresh_attempts = 5;

double size_of(MeshData& mesh) {
  return mesh.renewal.interior_size + boundary_size(mesh);
}

double triangles_per_size(MeshData& mesh) {
  return static_cast<double>(mesh.domain_triangles) / size_of(mesh);
}

double excess(MeshData& mesh) {
  return triangles_per_size(mesh) / mesh.renewal.count_factor - 1.0;
}

}  // namespace

const char* name_of(Strategy strategy) {
  return strategy == Strategy::chain ? "chain" : "renew";
}

bool renews(const MeshData& mesh, const RemodelOptions& options) {
  return options.strategy == Strategy::renew && mesh.imported.empty();
}

double resolved_keep(const RemodelOptions& options, const QualityOptions& quality) {
  if (options.strategy == Strategy::chain) return 1.0;
  if (options.keep != 0.0) return options.keep;
  return quality.gradation <= 2.0 ? 1.1 : 1.25;
}

void calibrate(MeshData& mesh, int samples, StepObserver* observer) {
  mesh.renewal.interior_size = interior_size(mesh);
  mesh.renewal.count_factor = measured_count_factor(mesh, samples, observer);
}

std::size_t prepare_renewal(MeshData& mesh, StepObserver* observer) {
  RenewalState& renewal = mesh.renewal;
  if (renewal.interior_size < 0.0) renewal.interior_size = interior_size(mesh);
  if (renewal.count_factor == 0.0)
    renewal.count_factor =
        mesh.step == 0 ? triangles_per_size(mesh) : measured_count_factor(mesh, samples_on_the_way, observer);
  const double too_many = static_cast<double>(mesh.domain_triangles) - renewal.count_factor * size_of(mesh);
  return static_cast<std::size_t>(std::max(0.0, 0.5 * too_many));
}

void renew_replaced(MeshData& mesh, std::span<const std::size_t> loops, std::size_t budget) {
  renew_length_scales(mesh, loops);
  coarsen_touched(mesh, budget);
}

void finish_renewal(MeshData& mesh) {
  mesh.renewal.interior_size = corrected_interior_size(mesh, mesh.renewal.interior_size);
  mesh.renewal.full_adjustments = 0;
}

// Counts are chaotic: bounds that differ by a tenth of a percent give other meshes.
std::optional<GenerateResult> nearer_to_fresh(MeshData& mesh, StepObserver* observer) {
  double least = std::abs(excess(mesh));
  std::optional<GenerateResult> nearest;
  if (least <= tolerated_excess) return nearest;
  for (int i = 0; i < refresh_attempts; ++i) {
    QualityOptions options = mesh.options;
    options.max_gradation *= 1.0 - 0.001 * i;
    GenerateResult fresh = generate(mesh.domain, options, observer);
    if (fresh.stopped != Stopped::done) break;
    MeshData& data = fresh.mesh.data();
    data.options = mesh.options;
    data.renewal = {.count_factor = mesh.renewal.count_factor, .interior_size = interior_size(data)};
    const double found = std::abs(excess(data));
    if (found < least) {
      least = found;
      nearest = std::move(fresh);
    }
    if (least <= tolerated_excess) break;
  }
  return nearest;
}

}  // namespace remodel
