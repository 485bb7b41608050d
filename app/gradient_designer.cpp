#include "gradient_designer.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <nlopt.hpp>
#include <stdexcept>

#include "remodel/error.h"

namespace remodel::app {

namespace {

using DesignJson = nlohmann::ordered_json;

constexpr double constraint_tolerance = 1e-7;
constexpr int most_rounds = 100, most_a_round = 40;
constexpr double least_gain = 1e-4;  // of a round, that is worth another one in a box of this size
constexpr double shrinking = 0.25;   // of the box where there was less
constexpr double least_step = 1e-2;  // of a design from others of its round, in half-widths of the box

// One number that orders designs: the objective, over that of the start, and what constraints are violated
// by.
double merit_of(const Evaluation& evaluation, double scale) {
  constexpr double weight = 100.0;
  const double violation = violation_of(evaluation.constraints);
  return evaluation.objective / scale + weight * std::max(0.0, violation - 10.0 * constraint_tolerance);
}

}  // namespace

double connectivity_of(const Evaluation& evaluation) {
  const auto found = evaluation.outputs.find("connectivity");
  return found == evaluation.outputs.end() ? 0.0 : found->second;
}

std::string json_of(const KnownDesign& known) {
  const Evaluation& e = known.evaluation;
  return DesignJson{{"design", known.design},
                    {"objective", std::isfinite(e.objective) ? DesignJson(e.objective) : DesignJson()},
                    {"constraints", e.constraints},
                    {"gradient", e.gradient},
                    {"constraint_gradients", e.constraint_gradients},
                    {"connectivity", connectivity_of(e)}}
      .dump();
}

KnownDesign known_design(const std::string& text) {
  const DesignJson json = DesignJson::parse(text);
  KnownDesign one{.design = json.at("design").get<std::vector<double>>(), .evaluation = {}};
  if (!json.at("objective").is_null()) one.evaluation.objective = json.at("objective").get<double>();
  json.at("constraints").get_to(one.evaluation.constraints);
  json.at("gradient").get_to(one.evaluation.gradient);
  json.at("constraint_gradients").get_to(one.evaluation.constraint_gradients);
  one.evaluation.outputs["connectivity"] = json.at("connectivity").get<double>();
  const auto fits = [&](const std::vector<double>& gradient) {
    return gradient.empty() || gradient.size() == one.design.size();
  };
  const auto& rows = one.evaluation.constraint_gradients;
  if (!fits(one.evaluation.gradient) || !std::all_of(rows.begin(), rows.end(), fits) ||
      (!rows.empty() && rows.size() != one.evaluation.constraints.size()))
    throw std::invalid_argument("found gradients of another number of variables or constraints");
  return one;
}

std::string description_of(const std::string& method, const GradientOptions& options) {
  return DesignJson{{"designer", method},
                    {"trust", options.trust},
                    {"least_trust", options.least_trust},
                    {"low", options.low},
                    {"high", options.high}}
      .dump();
}

// Answers from what is known, in order, and stops the search where it ends.
class GradientDesigner::Oracle {
 public:
  explicit Oracle(const std::vector<Known>& known) : known_(known) {}

  // Null: not known yet.
  const Known* ask(const std::vector<double>& design) {
    if (next_ < known_.size()) return &known_[next_++];
    pending = design;
    return nullptr;
  }
  // The same within a round: what was asked in it is not asked again.
  const Known* ask_in_round(const std::vector<double>& design) {
    for (std::size_t i = round_begin_; i < next_; ++i)
      if (known_[i].design == design) return &known_[i];
    return ask(design);
  }
  // `again`: how many of the last answers belong to the round that begins.
  void begin_round(std::size_t again) { round_begin_ = next_ - again; }
  std::size_t next() const { return next_; }
  std::optional<std::vector<double>> pending;

 private:
  const std::vector<Known>& known_;
  std::size_t next_ = 0, round_begin_ = 0;
};

GradientDesigner::GradientDesigner(std::vector<double> start, GradientOptions options)
    : start_(std::move(start)), options_(std::move(options)) {
  if (options_.method != "slsqp" && options_.method != "mma")
    throw Error(ErrorCode::argument, "designer", "found '" + options_.method + "', expected slsqp or mma");
  if (options_.low.size() != start_.size() || options_.high.size() != start_.size())
    throw Error(ErrorCode::argument, "designer", "expected bounds for each variable");
  advance();
}

void GradientDesigner::advance() {
  Oracle oracle(known_);
  search(oracle);
  pending_ = std::move(oracle.pending);
}

// What NLopt asks for in a round, and what comes of it. Its calls throw nlopt::forced_stop where the round is
// at its end, or waits for an evaluation.
class GradientDesigner::Round {
 public:
  Round(Oracle& oracle, const Known& first, double scale, double least_step)
      : best(first),
        oracle_(oracle),
        first_(first),
        scale_(scale),
        least_step_(least_step),
        seen_{first.design} {}

  const Known& at(const std::vector<double>& x) {
    const Known* found = over_ || is_near(x) ? nullptr : oracle_.ask_in_round(x);
    over_ = over_ || found == nullptr;
    if (over_) throw nlopt::forced_stop();
    seen_.push_back(x);
    failed = !std::isfinite(found->evaluation.objective) || found->evaluation.gradient.size() != x.size();
    const bool is_better = !failed && merit_of(found->evaluation, scale_) < merit_of(best.evaluation, scale_);
    if (is_better) best = *found;
    unlike = ends_where_unlike && !is_better && !failed &&
             connectivity_of(found->evaluation) != connectivity_of(first_.evaluation);
    over_ = failed || unlike;
    if (over_) throw nlopt::forced_stop();
    return *found;
  }

  Known best;
  bool failed = false;  // the last design
  bool unlike = false;  // it is on another connectivity than the first one, and not better
  // MMA makes a step shorter until its model is on the safe side, which is never where meshes have shifted
  // the objective. SLSQP goes back along its line a few times and has done.
  bool ends_where_unlike = false;
  double objective_factor = 1.0;
  std::vector<double> constraint_factors = {};

 private:
  // Nearer to a design of the round than a step that can tell anything, but not that design: there methods
  // creep on where meshes have changed, or their models promise what the box does not hold.
  bool is_near(const std::vector<double>& x) const {
    const auto distance = [&](const std::vector<double>& other) {
      double farthest = 0.0;
      for (std::size_t i = 0; i < x.size(); ++i) farthest = std::max(farthest, std::fabs(x[i] - other[i]));
      return farthest;
    };
    return std::find(seen_.begin(), seen_.end(), x) == seen_.end() &&
           std::any_of(seen_.begin(), seen_.end(),
                       [&](const std::vector<double>& other) { return distance(other) < least_step_; });
  }

  Oracle& oracle_;
  const Known first_;
  double scale_, least_step_;
  std::vector<std::vector<double>> seen_;
  bool over_ = false;
};

namespace {

double steepest(const std::vector<double>& gradient) {
  double most = 0.0;
  for (const double slope : gradient) most = std::max(most, std::fabs(slope));
  return most;
}

// MMA begins with second derivatives of 1 over the half-width of the box: against them slopes have to count,
// those of constraints above all, or its first steps are tiny.
double mma_factor(const std::vector<double>& gradient, double trust, double slope) {
  const double most = steepest(gradient) * trust;
  return most > 0.0 ? slope / most : 1.0;
}

}  // namespace

void GradientDesigner::scale(Round& round, double objective_scale) const {
  const Evaluation& first = round.best.evaluation;
  round.objective_factor = 1.0 / objective_scale;
  round.constraint_factors.assign(first.constraints.size(), 1.0);
  if (options_.method != "mma") return;
  round.ends_where_unlike = true;
  round.objective_factor = mma_factor(first.gradient, trust_, 1.0);
  for (std::size_t i = 0; i < first.constraints.size(); ++i)
    round.constraint_factors[i] = mma_factor(first.constraint_gradients[i], trust_, 10.0);
}

// Searches the box around the centre.
void GradientDesigner::search_box(Round& round) const {
  const std::size_t n = start_.size();
  const nlopt::vfunc objective = [](const std::vector<double>& x, std::vector<double>& gradient, void* data) {
    Round& of = *static_cast<Round*>(data);
    const Evaluation& found = of.at(x).evaluation;
    for (std::size_t i = 0; i < gradient.size(); ++i) gradient[i] = of.objective_factor * found.gradient[i];
    return of.objective_factor * found.objective;
  };
  const nlopt::mfunc constraints = [](unsigned count, double* values, unsigned dimension, const double* x,
                                      double* gradient, void* data) {
    Round& of = *static_cast<Round*>(data);
    const Evaluation& found = of.at(std::vector<double>(x, x + dimension)).evaluation;
    for (unsigned i = 0; i < count; ++i) {
      values[i] = of.constraint_factors[i] * found.constraints[i];
      if (gradient == nullptr) continue;
      for (unsigned k = 0; k < dimension; ++k)
        gradient[i * dimension + k] = of.constraint_factors[i] * found.constraint_gradients[i][k];
    }
  };
  nlopt::opt search(options_.method == "mma" ? nlopt::LD_MMA : nlopt::LD_SLSQP, static_cast<unsigned>(n));
  std::vector<double> low(n), high(n), tolerances = round.constraint_factors;
  for (std::size_t i = 0; i < n; ++i) {
    low[i] = std::max(options_.low[i], centre_[i] - trust_);
    high[i] = std::min(options_.high[i], centre_[i] + trust_);
  }
  for (double& tolerance : tolerances) tolerance *= constraint_tolerance;
  search.set_lower_bounds(low), search.set_upper_bounds(high);
  search.set_min_objective(objective, &round);
  if (!tolerances.empty()) search.add_inequality_mconstraint(constraints, &round, tolerances);
  search.set_ftol_rel(1e-5);
  search.set_maxeval(most_a_round);
  std::vector<double> x = centre_;
  double value = 0.0;
  try {
    search.optimize(x, value);
  } catch (const nlopt::forced_stop&) {
  } catch (const nlopt::roundoff_limited&) {
  } catch (const std::runtime_error&) {
    round.failed = true;
  }
}

// Evaluates the centre once more where the mesh has another connectivity than with it. If the last design,
// on the same one, proves better then, it is the centre. How many of the last answers are of one mesh; none
// where the search waits, or the centre has no flow any more.
std::optional<std::size_t> GradientDesigner::compare_again(Oracle& oracle, Known& centre, bool unlike,
                                                           double scale) {
  const Known last = known_[oracle.next() - 1];
  if (last.design == centre.design) return 1;
  if (connectivity_of(last.evaluation) == connectivity_of(centre.evaluation)) {
    std::size_t again = 1;
    for (std::size_t i = oracle.next(); i-- > 0 && known_[i].design != centre.design;) ++again;
    return again;
  }
  const Known* at = oracle.ask(centre_);
  if (at == nullptr || at->evaluation.gradient.size() != start_.size()) return std::nullopt;
  centre = *at;
  if (!unlike) return 1;
  const bool is_like = connectivity_of(last.evaluation) == connectivity_of(centre.evaluation);
  const double gain = merit_of(centre.evaluation, scale) - merit_of(last.evaluation, scale);
  if (is_like && gain > least_gain)
    centre = last, centre_ = centre.design;
  else
    trust_ *= shrinking;
  return is_like ? 2 : 1;
}

void GradientDesigner::search(Oracle& oracle) {
  centre_ = start_;
  trust_ = options_.trust;
  round_ = 0;
  const Known* at = oracle.ask(centre_);
  if (at == nullptr) return;
  if (at->evaluation.gradient.size() != start_.size()) return;  // the start failed: nothing to go on from
  const double scale_of_start = std::max(std::fabs(at->evaluation.objective), 1e-12);
  Known centre = *at;
  bool unlike = false;
  for (; round_ < most_rounds && trust_ >= options_.least_trust; ++round_) {
    const std::optional<std::size_t> again = compare_again(oracle, centre, unlike, scale_of_start);
    if (!again) return;
    oracle.begin_round(*again);
    Round round(oracle, centre, scale_of_start, least_step * trust_);
    scale(round, scale_of_start);
    search_box(round);
    if (oracle.pending) return;
    const double gain =
        merit_of(centre.evaluation, scale_of_start) - merit_of(round.best.evaluation, scale_of_start);
    double farthest = 0.0;
    for (std::size_t i = 0; i < centre_.size(); ++i)
      farthest = std::max(farthest, std::fabs(round.best.design[i] - centre_[i]));
    if (gain > 0.0) centre = round.best, centre_ = centre.design;
    unlike = round.unlike && gain < least_gain;
    if (unlike) continue;
    if (round.failed || gain < least_gain)
      trust_ *= shrinking;
    else if (farthest > 0.99 * trust_)
      trust_ *= 2.0;
  }
}

Proposal GradientDesigner::ask() {
  // Refused at its start, the search has nothing to ask for: the start again, which ends the run.
  return {.design = pending_ ? *pending_ : centre_, .gradient = true, .from = centre_};
}

// The mesh has not changed.
void GradientDesigner::refuse(const Proposal& proposal) {
  Evaluation refused;
  if (!known_.empty()) refused.outputs["connectivity"] = connectivity_of(known_.back().evaluation);
  tell(proposal, refused);
}

void GradientDesigner::tell(const Proposal& proposal, const Evaluation& evaluation) {
  known_.push_back({proposal.design, evaluation});
  advance();
}

std::string GradientDesigner::state() const {
  DesignJson list = DesignJson::array();
  for (const Known& known : known_) list.push_back(DesignJson::parse(json_of(known)));
  return list.dump();
}

void GradientDesigner::restore(const std::string& state, const std::string& source) {
  try {
    std::vector<Known> known;
    for (const DesignJson& entry : DesignJson::parse(state)) {
      known.push_back(known_design(entry.dump()));
      if (known.back().design.size() != start_.size())
        throw Error(ErrorCode::format, source, "found another number of variables");
    }
    known_ = std::move(known);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& problem) {
    throw Error(ErrorCode::format, source,
                std::string("found no state of a search by gradients: ") + problem.what());
  }
  advance();
}

std::string GradientDesigner::description() const {
  return description_of(options_.method, options_);
}

}  // namespace remodel::app
