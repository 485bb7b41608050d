#include "step/strategy.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/renew_policy.h"
#include "remodel/error.h"
#include "step/coarsen.h"
#include "step/count_control.h"
#include "step/renew.h"

namespace remodel {

namespace {

constexpr std::array<StrategyInfo, 4> strategy_infos{{
    {Strategy::chain, "chain", "the paper's method to the letter, and all that imported meshes have"},
    {Strategy::renew, "renew", "length scales are renewed, what is too dense is coarsened"},
    {Strategy::morph, "morph", "renew, but the interior moves along with the boundary where it can"},
    {Strategy::reference, "reference",
     "every design's mesh is the morph of one reference mesh, as long as connectivity can be held"},
}};

// The vertices of the domain triangles that a step has made, for the next renewal.
void note_touched(MeshData& mesh) {
  const Triangulation& triangulation = mesh.triangulation;
  mesh.seen_vertices.clear(triangulation.vertex_slots());
  for (const TriangleId t : triangulation.touched()) {
    const Triangle& triangle = triangulation[t];
    if (!triangle.in_domain()) continue;
    for (const VertexId v : triangle.vertex)
      if (mesh.seen_vertices.insert(v)) mesh.renewal.pending_vertices.push_back(v.index);
  }
}

}  // namespace

std::span<const StrategyInfo> strategies() {
  return strategy_infos;
}

const char* name_of(Strategy strategy) {
  return strategy_infos[static_cast<std::size_t>(strategy)].name;
}

Strategy strategy_named(const std::string& name) {
  std::string expected;
  for (const StrategyInfo& info : strategy_infos) {
    if (info.name == name) return info.strategy;
    expected += (expected.empty() ? "" : ", ") + std::string(info.name);
  }
  throw Error(ErrorCode::argument, "strategy", "found '" + name + "', expected one of " + expected);
}

bool renews(const MeshData& mesh, const RemodelOptions& options) {
  return options.strategy != Strategy::chain && mesh.imported.empty();
}

double resolved_keep(const RemodelOptions& options, const QualityOptions& quality) {
  if (options.strategy == Strategy::chain) return 1.0;
  if (options.keep != 0.0) return options.keep;
  return RenewPolicy::keep(quality.gradation);
}

void calibrate(MeshData& mesh, int samples, StepObserver* observer) {
  mesh.renewal.count_factor = measured_count_factor(mesh, samples, observer);
}

std::size_t prepare_renewal(MeshData& mesh, StepObserver* observer) {
  RenewalState& renewal = mesh.renewal;
  if (renewal.count_factor == 0.0)
    renewal.count_factor = mesh.step == 0
                               ? triangles_per_size(mesh)
                               : measured_count_factor(mesh, RenewPolicy::samples_on_the_way, observer);
  if (renewal.count_factor == 0.0) return 0;  // no fresh mesh could be finished
  const double too_many = static_cast<double>(mesh.domain_triangles) - renewal.count_factor * size_of(mesh);
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

void note_changed(MeshData& mesh, const Correspondence& to) {
  std::vector<std::uint32_t>& pending = mesh.renewal.pending_loops;
  const std::vector<std::uint32_t> before = pending;
  pending.clear();
  for (std::uint32_t i = 0; i < to.loops.size(); ++i) {
    const LoopLinks& links = to.loops[i];
    const bool stays = links.from != no_link && mesh.domain.loops[links.from] == to.domain.loops[i];
    if (!stays || std::binary_search(before.begin(), before.end(), links.from)) pending.push_back(i);
  }
}

void renew_replaced(MeshData& mesh, std::span<const VertexId> moved, std::size_t budget) {
  List<VertexId> around =
      renew_length_scales(mesh, mesh.renewal.pending_loops, mesh.renewal.pending_vertices);
  around.insert(around.end(), moved.begin(), moved.end());
  coarsen_touched(mesh, around, budget);
}

bool refresh_is_due(const MeshData& mesh, std::uint32_t designs_a_step) {
  const RenewalState& renewal = mesh.renewal;
  constexpr std::uint32_t least = RenewPolicy::full_adjustments_before_sampling;
  const std::uint64_t wait = std::max<std::uint64_t>(
      RenewPolicy::designs_between_samplings(renewal.samplings) / designs_a_step, least);
  return renewal.full_adjustments >= least && renewal.count_factor != 0.0 &&
         mesh.step >= renewal.sampled_at + wait;
}

void discretisation_changed(MeshData& mesh, StepObserver* observer) {
  constexpr int samples = RenewPolicy::samples_of_another_discretisation;
  mesh.renewal.count_factor = measured_count_factor(mesh, samples, observer);
  mesh.renewal.until_shed = RenewPolicy::replacements_that_shed;
}

void count_imported(MeshData& mesh) {
  if (mesh.renewal.count_factor == 0.0) mesh.renewal.count_factor = triangles_per_size(mesh);
}

bool has_surplus(const MeshData& mesh, double tolerated) {
  const double factor = mesh.renewal.count_factor;
  const double most = (1.0 + tolerated) * factor * size_of(mesh);
  return factor != 0.0 && static_cast<double>(mesh.count_domain_triangles()) > most;
}

bool shed_surplus(MeshData& mesh) {
  if (!has_surplus(mesh, RenewPolicy::large_surplus)) return false;
  remove_dense(mesh, RenewPolicy::dense_below);
  return true;
}

void finish_replacement(MeshData& mesh, bool renewed) {
  RenewalState& renewal = mesh.renewal;
  renewal.full_adjustments = 0;
  if (renewed) {
    renewal.until_renewal = RenewPolicy::replacements_between_renewals;
    renewal.pending_vertices.clear();
    renewal.pending_loops.clear();
  } else {
    --renewal.until_renewal;
    note_touched(mesh);
  }
}

void replaced_by_chain(MeshData& mesh) {
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
  for (std::uint32_t n = 0; n < RenewPolicy::samples_per_sampling; ++n) {
    const double h_factor = RenewPolicy::sample_factor(mesh.step, n);
    GenerateResult sample = fresh_sample(mesh, h_factor, observer);
    if (sample.stopped == Stopped::interrupted) return std::nullopt;  // the next step looks again
    if (sample.stopped != Stopped::done) break;
    const double its_size = size_of(sample.mesh.data());
    const double its_factor = static_cast<double>(sample.mesh.triangle_count()) / its_size;
    per_size += its_factor * h_factor * h_factor;
    size += its_size;
    const double made = n + 1;
    factor = renewal.count_factor + RenewPolicy::sampling_weight * (per_size / made - renewal.count_factor);
    const double excess = std::abs(static_cast<double>(mesh.domain_triangles) / (factor * size / made) - 1.0);
    if (excess <= RenewPolicy::tolerated_excess) break;
    if (std::abs(its_factor / factor - 1.0) > 0.5 * excess) continue;
    note_sampling();
    sample.mesh.data().renewal.take_count_factor(renewal);
    return sample;
  }
  note_sampling();
  return std::nullopt;
}

}  // namespace remodel
