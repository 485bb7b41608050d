// The three kinds of jobs. The rows of a job depend on its StudyWork alone.

#include <algorithm>
#include <utility>

#include "base/stopwatch.h"
#include "design/airfoil_space.h"
#include "design/comparison.h"
#include "design/design_search.h"
#include "design/interpolation.h"
#include "design/living_mesh.h"
#include "design/summary.h"
#include "study/strategies.h"
#include "study/work.h"

namespace remodel {
namespace {

constexpr std::size_t max_refused = 10000;  // consecutive refused samples, as in OptimiseOptions
constexpr std::size_t max_blocks = 100;

void ask(const StudyCancelQuestion& cancelled) {
  if (cancelled && cancelled()) throw StudyCancelled{};
}

bool is_compared(const StudyWork& work, std::uint64_t evaluation) {
  return work.compare_every != 0 && evaluation % work.compare_every == 0;
}

OptimiseOptions mesh_options(const StudyWork& work) {
  return {.domain = {.points = work.pair.points}, .quality = {.gradation = work.pair.gradation}};
}

// The row of the evaluations first to last, from their mean figures.
BlockRow block_of(std::uint64_t first, std::uint64_t last, const Summary& summary) {
  BlockRow row;
  copy_figures(BlockRow::figures(), row, optimise_figures, summary.result());
  row.first = first;
  row.last = last;
  return row;
}

ReplayRow replay_row(const OptimiseResult& result, OptimiseStopped stopped, double seconds) {
  ReplayRow row;
  copy_figures(ReplayRow::figures(), row, optimise_figures, result);
  row.seconds = seconds;
  row.stopped = name_of(stopped);
  return row;
}

class Replay {
 public:
  explicit Replay(const StudyWork& work)
      : work_(work), options_(mesh_options(work)), space_(work.from, options_.domain) {
    options_.remodel.distance = work.distance;
    set_strategy(work.strategy, options_);
    block_size_ = (work.path.evaluations() + max_blocks - 1) / max_blocks;
  }
  ReplayRows run(const StudyCancelQuestion& cancelled);

 private:
  OptimiseStopped evaluate_all(const StudyCancelQuestion& cancelled);
  bool evaluate(LivingMesh& living, std::size_t index);
  const FreshRow* fresh_of(std::uint64_t evaluation) const;
  void add(const EvaluationRecord& record);
  void end_block(std::uint64_t last);

  const StudyWork& work_;
  OptimiseOptions options_;
  AirfoilSpace space_;
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
  GenerateResult first = first_mesh(space_, options_);
  if (first.stopped != Stopped::done) return OptimiseStopped::mesh_limit;
  LivingMesh living(options_, space_, std::move(first.mesh), space_.start());
  for (std::size_t index = 0; index < work_.path.evaluations(); ++index) {
    ask(cancelled);
    if (!evaluate(living, index)) {
      end_block(index);
      return OptimiseStopped::mesh_limit;
    }
  }
  end_block(work_.path.evaluations());
  return work_.path.evaluations() < work_.evaluations ? OptimiseStopped::infeasible : OptimiseStopped::done;
}

// Returns false if a limit ended the mesh, or the fresh mesh to compare with, before it was finished.
bool Replay::evaluate(LivingMesh& living, std::size_t index) {
  EvaluationRecord record;
  record.evaluation = index + 1;
  record.sigma = work_.path.sigma(index);
  record.objective = work_.path.objective(index);
  const bool compared = is_compared(work_, record.evaluation);
  const FreshRow* fresh = compared ? fresh_of(record.evaluation) : nullptr;
  if (compared && !fresh) return false;
  const auto due = [&](std::uint64_t every) { return record.evaluation % every == 0; };
  // The first step is checked as a whole too, as in optimise(), so that the smallest of all angles is known.
  const bool whole = index == 0 || due(work_.check_every);
  const StepTasks tasks{.check = due(work_.validate_every) ? Checked::full
                                 : whole                   ? Checked::quick
                                                           : Checked::changes};
  if (living.step(work_.path.coefficients(index), tasks, record) != Stopped::done) return false;
  if (fresh) {
    const GradationError error = living.mesh().gradation_error();
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
  const auto feasible = [&](std::span<const double> design) {
    const CstAirfoil airfoil = with_coefficients(work.from, design);
    return std::all_of(of_pairs.begin(), of_pairs.end(),
                       [&](const Feasibility& good) { return good(airfoil); });
  };
  CmaesDesigner designer = interpolation_designer(coefficients_of(work.from), work.sigma, work.seed);
  const InterpolationObjective target(work.to);
  PathRows rows;
  rows.path.dimension = coefficients_of(work.from).size();
  CstAirfoil best = work.from;
  for (; rows.evaluations < work.evaluations; ++rows.evaluations) {
    ask(cancelled);
    const std::optional<Sample> sample = next_sample(designer, feasible, max_refused);
    rows.infeasible_samples += sample ? sample->refused : max_refused;
    if (!sample) break;
    const std::vector<double>& coefficients = sample->proposal.design;
    const CstAirfoil design = with_coefficients(work.from, coefficients);
    const double objective = target.mean_square(design);
    std::vector<double>& values = rows.path.values;
    values.push_back(designer.step_size());
    values.push_back(objective);
    values.insert(values.end(), coefficients.begin(), coefficients.end());
    designer.tell(sample->proposal, {.objective = objective});
    if (rows.evaluations != 0 && objective >= rows.objective) continue;
    rows.objective = objective;
    best = design;
  }
  if (rows.evaluations > 0) rows.max_error = target.max_error(best);
  rows.best = airfoil_to_json(best);
  rows.seconds = watch.seconds();
  return rows;
}

FreshRows compute_fresh(const StudyWork& work, const StudyCancelQuestion& cancelled) {
  const OptimiseOptions options = mesh_options(work);
  const AirfoilSpace space(work.from, options.domain);
  FreshRows rows;
  for (std::size_t index = 0; index < work.path.evaluations(); ++index) {
    const std::uint64_t evaluation = index + 1;
    if (!is_compared(work, evaluation)) continue;
    ask(cancelled);
    const FreshMesh fresh =
        fresh_mesh(space, options.quality,
                   compared_design(space, work.path.coefficients(index), evaluation, work.path.sigma(index)));
    if (fresh.stopped != Stopped::done) break;
    rows.push_back({evaluation, fresh.triangles, fresh.seconds, fresh.error.bias, fresh.error.deviation});
  }
  return rows;
}

ReplayRows compute_replay(const StudyWork& work, const StudyCancelQuestion& cancelled) {
  return Replay(work).run(cancelled);
}

}  // namespace remodel
