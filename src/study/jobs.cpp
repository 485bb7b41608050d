// The three kinds of jobs. Each computes its rows from its StudyWork alone.

#include <algorithm>
#include <utility>

#include "optimise/comparison.h"
#include "optimise/mesh_chain.h"
#include "optimise/shape_search.h"
#include "optimise/stopwatch.h"
#include "optimise/summary.h"
#include "study/strategies.h"
#include "study/work.h"

namespace remodel {
namespace {

constexpr std::size_t max_refused = 10000;  // in a row: as in OptimiseOptions
constexpr std::size_t max_blocks = 100;

void ask(const StudyCancelQuestion& cancelled) {
  if (cancelled && cancelled()) throw StudyCancelled{};
}

bool is_compared(const StudyWork& work, std::uint64_t evaluation) {
  return work.compare_every != 0 && evaluation % work.compare_every == 0;
}

CstAirfoil design_at(const StudyWork& work, std::size_t index) {
  const std::span<const double> coefficients = work.path.coefficients(index);
  return with_coefficients(work.from, {coefficients.begin(), coefficients.end()});
}

OptimiseOptions mesh_options(const StudyWork& work) {
  return {.domain = {.points = work.pair.points}, .quality = {.gradation = work.pair.gradation}};
}

// Of the mean figures of some evaluations.
BlockRow block_of(std::uint64_t first, std::uint64_t last, const Summary& summary) {
  const OptimiseResult figures = summary.result();
  return {.first = first,
          .last = last,
          .triangles_mean = figures.triangles_mean,
          .preserved_percent = figures.preserved_percent,
          .lost_mean = figures.lost_mean,
          .full_adjustments = figures.full_adjustments,
          .remodel_ms_mean = figures.remodel_ms_mean,
          .surplus_percent = figures.surplus_percent};
}

ReplayRow replay_row(const OptimiseResult& figures, OptimiseStopped stopped, double seconds) {
  return {.evaluations = figures.evaluations,
          .full_adjustments = figures.full_adjustments,
          .triangles_mean = figures.triangles_mean,
          .preserved_percent = figures.preserved_percent,
          .lost_mean = figures.lost_mean,
          .generated_triangles_mean = figures.generated_triangles_mean,
          .surplus_percent = figures.surplus_percent,
          .remodel_ms_mean = figures.remodel_ms_mean,
          .generate_ms_mean = figures.generate_ms_mean,
          .speedup = figures.speedup,
          .min_angle_deg = figures.min_angle_deg,
          .invalid_meshes = figures.invalid_meshes,
          .recoveries = figures.recoveries,
          .refreshes = figures.refreshes,
          .gradation_bias = figures.gradation_bias,
          .gradation_deviation = figures.gradation_deviation,
          .generated_gradation_bias = figures.generated_gradation_bias,
          .generated_gradation_deviation = figures.generated_gradation_deviation,
          .seconds = seconds,
          .stopped = name_of(stopped),
          .detail = figures.detail};
}

class Replay {
 public:
  explicit Replay(const StudyWork& work) : work_(work), options_(mesh_options(work)) {
    options_.remodel.distance = work.distance;
    set_strategy(work.strategy, options_);
    block_size_ = (work.path.evaluations() + max_blocks - 1) / max_blocks;
  }
  ReplayRows run(const StudyCancelQuestion& cancelled);

 private:
  OptimiseStopped evaluate_all(const StudyCancelQuestion& cancelled);
  bool evaluate(MeshChain& chain, std::size_t index);
  const FreshRow* fresh_of(std::uint64_t evaluation) const;
  void add(const EvaluationRecord& record);
  void end_block(std::uint64_t last);

  const StudyWork& work_;
  OptimiseOptions options_;
  std::size_t block_size_ = 0;
  Summary summary_, block_;
  ReplayRows rows_;
};

ReplayRows Replay::run(const StudyCancelQuestion& cancelled) {
  const ThreadStopwatch watch;
  const OptimiseStopped stopped = evaluate_all(cancelled);
  rows_.replay = replay_row(summary_.result(), stopped, watch.seconds());
  return std::move(rows_);
}

OptimiseStopped Replay::evaluate_all(const StudyCancelQuestion& cancelled) {
  std::optional<Mesh> first = first_mesh(work_.from, options_);
  if (!first) return OptimiseStopped::mesh_limit;
  MeshChain chain(options_, std::move(*first));
  for (std::size_t index = 0; index < work_.path.evaluations(); ++index) {
    ask(cancelled);
    if (!evaluate(chain, index)) {
      end_block(index);
      return OptimiseStopped::mesh_limit;
    }
  }
  end_block(work_.path.evaluations());
  return work_.path.evaluations() < work_.evaluations ? OptimiseStopped::infeasible : OptimiseStopped::done;
}

// False where a limit kept the mesh, or the one to compare with, from being finished.
bool Replay::evaluate(MeshChain& chain, std::size_t index) {
  EvaluationRecord record;
  record.evaluation = index + 1;
  record.sigma = work_.path.sigma(index);
  record.objective = work_.path.objective(index);
  const bool compared = is_compared(work_, record.evaluation);
  const FreshRow* fresh = compared ? fresh_of(record.evaluation) : nullptr;
  if (compared && !fresh) return false;
  const auto due = [&](std::uint64_t every) { return record.evaluation % every == 0; };
  // At the first step too, as optimise() does: so the smallest of all angles is known.
  const bool whole = index == 0 || due(work_.check_every);
  const StepTasks tasks{.check = due(work_.validate_every) ? Checked::full
                                 : whole                   ? Checked::quick
                                                           : Checked::changes};
  if (chain.step(design_at(work_, index), tasks, record) != Stopped::done) return false;
  if (fresh) {
    const GradationError error = chain.mesh().gradation_error();
    add_comparison({.triangles = fresh->triangles,
                    .error = {fresh->gradation_bias, fresh->gradation_deviation},
                    .seconds = fresh->seconds},
                   error, record);
    rows_.comparisons.push_back({record.evaluation, record.triangles, error.deviation});
  }
  add(record);
  return true;
}

const FreshRow* Replay::fresh_of(std::uint64_t evaluation) const {
  const auto place =
      std::lower_bound(work_.fresh.begin(), work_.fresh.end(), evaluation,
                       [](const FreshRow& row, std::uint64_t wanted) { return row.evaluation < wanted; });
  return place != work_.fresh.end() && place->evaluation == evaluation ? &*place : nullptr;
}

void Replay::add(const EvaluationRecord& record) {
  summary_.add(record);
  block_.add(record);
  if (record.evaluation % block_size_ == 0) end_block(record.evaluation);
}

void Replay::end_block(std::uint64_t last) {
  if (block_.evaluations() == 0) return;
  rows_.blocks.push_back(block_of(last + 1 - block_.evaluations(), last, block_));
  block_ = Summary();
}

}  // namespace

PathRows compute_path(const StudyWork& work, const StudyCancelQuestion& cancelled) {
  const ThreadStopwatch watch;
  std::vector<Feasibility> of_pairs;
  for (const int points : work.points)
    of_pairs.emplace_back(work.from, AirfoilDomainOptions{.points = points});
  ShapeSearch search(work.from, initial_distribution(work.from, work.sigma, work.seed),
                     [&](const CstAirfoil& design) {
                       return std::all_of(of_pairs.begin(), of_pairs.end(),
                                          [&](const Feasibility& feasible) { return feasible(design); });
                     });
  const InterpolationObjective target(work.to);
  PathRows rows;
  rows.path.dimension = coefficients_of(work.from).size();
  CstAirfoil best = work.from;
  for (; rows.evaluations < work.evaluations; ++rows.evaluations) {
    ask(cancelled);
    const std::optional<Sample> sample = search.next(max_refused);
    rows.infeasible_samples += sample ? sample->refused : max_refused;
    if (!sample) break;
    const double objective = target.mean_square(sample->design);
    std::vector<double>& values = rows.path.values;
    values.push_back(search.cmaes().sigma());
    values.push_back(objective);
    values.insert(values.end(), sample->coefficients.begin(), sample->coefficients.end());
    search.tell(*sample, objective);
    if (rows.evaluations != 0 && objective >= rows.objective) continue;
    rows.objective = objective;
    best = sample->design;
  }
  if (rows.evaluations > 0) rows.max_error = target.max_error(best);
  rows.best = airfoil_to_json(best);
  rows.seconds = watch.seconds();
  return rows;
}

FreshRows compute_fresh(const StudyWork& work, const StudyCancelQuestion& cancelled) {
  const OptimiseOptions options = mesh_options(work);
  const DesignDomains domain_of(options);
  FreshRows rows;
  for (std::size_t index = 0; index < work.path.evaluations(); ++index) {
    const std::uint64_t evaluation = index + 1;
    if (!is_compared(work, evaluation)) continue;
    ask(cancelled);
    const FreshMesh fresh =
        fresh_mesh(domain_of, options.quality,
                   compared_design(domain_of, design_at(work, index), evaluation, work.path.sigma(index)));
    if (fresh.stopped != Stopped::done) break;
    rows.push_back({evaluation, fresh.triangles, fresh.seconds, fresh.error.bias, fresh.error.deviation});
  }
  return rows;
}

ReplayRows compute_replay(const StudyWork& work, const StudyCancelQuestion& cancelled) {
  return Replay(work).run(cancelled);
}

}  // namespace remodel
