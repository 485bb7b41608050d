#include "remodel/strategy.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "remodel/coarsen.h"
#include "remodel/count_control.h"
#include "remodel/renew.h"

namespace remodel {

namespace {

constexpr int samples_on_the_way = 5;  // for a mesh of unknown history: K within about 2 %
constexpr std::uint32_t full_adjustments_before_refresh = 25;
constexpr std::uint64_t designs_before_sampling = 1000;  // four times as many with each one
constexpr double tolerated_excess = 0.02;
constexpr std::uint32_t samples_at_refresh = 2;  // at most
constexpr double unknown_size = -1.0;
constexpr double weight_of_refresh = 1.0 / 3.0;  // of a refresh's samples in K

// Whether it is cheaper to follow S from replacement to replacement, if all are like the one that the journal
// has, than to sum it up anew when the next renewal asks for it.
bool is_worth_following(const MeshData& mesh) {
  const Triangulation& triangulation = mesh.triangulation;
  const std::size_t changed = triangulation.earlier().size() + triangulation.touched().size();
  return changed * (mesh.renewal.until_renewal + 1) < triangulation.triangle_slots();
}

// The vertices of the domain triangles that a step has made, for the next renewal.
void note_touched(MeshData& mesh) {
  const Triangulation& triangulation = mesh.triangulation;
  mesh.vertex_marks.clear(triangulation.vertex_slots());
  for (const TriangleId t : triangulation.touched()) {
    const Triangle& triangle = triangulation[t];
    if (!triangle.alive() || triangle.region != Region::domain) continue;
    for (const VertexId v : triangle.vertex)
      if (mesh.vertex_marks.visit(v.index)) mesh.renewal.pending_vertices.push_back(v.index);
  }
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
  return quality.gradation <= 1.0 ? 1.1 : quality.gradation <= 2.0 ? 1.2 : 1.25;
}

void calibrate(MeshData& mesh, int samples, StepObserver* observer) {
  mesh.renewal.interior_size = interior_size(mesh);
  mesh.renewal.count_factor = measured_count_factor(mesh, samples, observer);
}

std::size_t prepare_renewal(MeshData& mesh, StepObserver* observer) {
  RenewalState& renewal = mesh.renewal;
  know_interior_size(mesh);
  if (renewal.count_factor == 0.0)
    renewal.count_factor =
        mesh.step == 0 ? triangles_per_size(mesh) : measured_count_factor(mesh, samples_on_the_way, observer);
  if (renewal.count_factor == 0.0) return 0;  // no fresh mesh could be finished
  const double too_many =
      static_cast<double>(mesh.domain_triangles) - renewal.count_factor * total_size(mesh);
  return static_cast<std::size_t>(std::max(0.0, 0.5 * too_many));
}

bool renewal_is_due(const MeshData& mesh) {
  return mesh.renewal.until_renewal == 0;
}

void note_moved(MeshData& mesh, std::span<const std::size_t> loops) {
  std::vector<std::uint32_t>& pending = mesh.renewal.pending_loops;
  if (std::includes(pending.begin(), pending.end(), loops.begin(), loops.end())) return;
  for (const std::size_t loop : loops) {
    const auto place = std::lower_bound(pending.begin(), pending.end(), loop);
    if (place == pending.end() || *place != loop) pending.insert(place, static_cast<std::uint32_t>(loop));
  }
}

void note_all_moved(MeshData& mesh) {
  mesh.renewal.pending_loops.resize(mesh.domain.loops.size());
  std::iota(mesh.renewal.pending_loops.begin(), mesh.renewal.pending_loops.end(), 0U);
}

RenewedSize renew_replaced(MeshData& mesh, std::span<const VertexId> moved, std::size_t budget) {
  Renewed renewed = renew_length_scales(mesh, mesh.renewal.pending_loops, mesh.renewal.pending_vertices);
  List<VertexId>& around = renewed.risen;
  around.insert(around.end(), moved.begin(), moved.end());
  coarsen_touched(mesh, around, budget);
  return renewed.size;
}

// Samples cost many steps, and most say that the mesh is as it should be: the more of them, the longer the
// wait.
bool refresh_is_due(const MeshData& mesh, std::uint32_t full_adjustments, std::uint32_t designs_a_step) {
  const RenewalState& renewal = mesh.renewal;
  const std::uint64_t designs = designs_before_sampling << std::min(2 * renewal.samplings, 40U);
  const std::uint64_t wait =
      std::max<std::uint64_t>(designs / designs_a_step, full_adjustments_before_refresh);
  return full_adjustments >= full_adjustments_before_refresh && renewal.count_factor != 0.0 &&
         mesh.step >= renewal.sampled_at + wait;
}

void finish_replacement(MeshData& mesh, const std::optional<RenewedSize>& renewed) {
  RenewalState& renewal = mesh.renewal;
  renewal.full_adjustments = 0;
  if (renewed) {
    renewal.until_renewal = RenewalState::replacements_between_renewals;
    renewal.pending_vertices.clear();
    renewal.pending_loops.clear();
  } else {
    --renewal.until_renewal;
    note_touched(mesh);
  }
  const bool known = renewal.interior_size >= 0.0;
  renewal.interior_size = known && (renewed || is_worth_following(mesh))
                              ? corrected_interior_size(mesh, renewal.interior_size, renewed)
                              : unknown_size;
}

void forget_size(MeshData& mesh) {
  mesh.renewal.interior_size = unknown_size;
  mesh.renewal.until_renewal = 0;
  mesh.renewal.full_adjustments = 0;
}

// Counts are chaotic: the same design with bounds that differ by a fraction of a percent is another sample.
// So the mesh is not compared with the samples' counts, but with what K makes of their size. That of the mesh
// itself, whose length scales differ from a fresh mesh's within the tolerance of renewal, may be 2 % off.
// The first sample that halves the excess is taken.
std::optional<GenerateResult> nearer_to_fresh(MeshData& mesh, StepObserver* observer) {
  RenewalState& renewal = mesh.renewal;
  double factor = renewal.count_factor;
  const auto note_sampling = [&] {
    renewal.count_factor = factor;
    renewal.sampled_at = mesh.step;
    ++renewal.samplings;
  };
  double per_size = 0.0, size = 0.0;  // sums
  for (std::uint32_t n = 0; n < samples_at_refresh; ++n) {
    const double h_factor = 1.0 - 0.0001 * static_cast<double>((mesh.step + 17 * n) % 51);
    GenerateResult sample = fresh_sample(mesh, h_factor, observer);
    if (sample.stopped == Stopped::interrupted) return std::nullopt;  // the next step looks again
    if (sample.stopped != Stopped::done) break;
    const double its_size = total_size(sample.mesh.data());
    const double its_factor = static_cast<double>(sample.mesh.triangle_count()) / its_size;
    per_size += its_factor * h_factor * h_factor;
    size += its_size;
    const double made = n + 1;
    factor = renewal.count_factor + weight_of_refresh * (per_size / made - renewal.count_factor);
    const double excess = std::abs(static_cast<double>(mesh.domain_triangles) / (factor * size / made) - 1.0);
    if (excess <= tolerated_excess) break;
    if (std::abs(its_factor / factor - 1.0) > 0.5 * excess) continue;
    note_sampling();
    sample.mesh.data().renewal.take_count_factor(renewal);
    return sample;
  }
  note_sampling();
  return std::nullopt;
}

}  // namespace remodel
