#include "remodel/sqp.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "base/checked_json.h"
#include "design/quadratic_program.h"
#include "remodel/error.h"

namespace remodel {

namespace {

using SqpJson = nlohmann::ordered_json;

// The output "connectivity": the number of the mesh's connectivity, another one after each change; 0 where
// there is none.
double connectivity_of(const Evaluation& evaluation) {
  const auto found = evaluation.outputs.find("connectivity");
  return found == evaluation.outputs.end() ? 0.0 : found->second;
}

// Without other outputs.
SqpJson known_json(const std::vector<double>& design, const Evaluation& e) {
  return SqpJson{{"design", design},
                 {"objective", std::isfinite(e.objective) ? SqpJson(e.objective) : SqpJson()},
                 {"constraints", e.constraints},
                 {"gradient", e.gradient},
                 {"constraint_gradients", e.constraint_gradients},
                 {"connectivity", connectivity_of(e)}};
}

// Throws nlohmann's exceptions, and std::invalid_argument where sizes do not fit.
Evaluation known_evaluation(const SqpJson& json) {
  Evaluation result;
  if (!json.at("objective").is_null()) result.objective = json.at("objective").get<double>();
  json.at("constraints").get_to(result.constraints);
  json.at("gradient").get_to(result.gradient);
  json.at("constraint_gradients").get_to(result.constraint_gradients);
  result.outputs["connectivity"] = json.at("connectivity").get<double>();
  const auto fits = [n = json.at("design").size()](const std::vector<double>& gradient) {
    return gradient.empty() || gradient.size() == n;
  };
  const auto& rows = result.constraint_gradients;
  if (!fits(result.gradient) || !std::all_of(rows.begin(), rows.end(), fits) ||
      (!rows.empty() && rows.size() != result.constraints.size()))
    throw std::invalid_argument("found gradients of another number of variables or constraints");
  return result;
}

// Of the worst violation that a step leaves, beside the objective over its first value: at first, and the
// most that it grows to.
constexpr double first_elastic = 1000.0, most_elastic = 1e5;
constexpr double first_shift = 0.02;  // of the objective's first value: before any was seen

// Constraints are kept by this much more than they ask for, so that rounding does not violate them. Linear
// ones hold after a step that violates them by no more than rounding.
constexpr double margin = 1e-9, linear_rounding = 1e-7;

double product(const double* a, const std::vector<double>& b) {
  return std::inner_product(b.begin(), b.end(), a, 0.0);
}

// The worst of the constraints, linear ones, after a step; 0 where all hold.
double worst_after(const Evaluation& at, const std::vector<double>& step) {
  double worst = 0.0;
  for (std::size_t i = 0; i < at.constraints.size(); ++i)
    worst = std::max(worst, at.constraints[i] + margin + product(step.data(), at.constraint_gradients[i]));
  return worst;
}

// x' B x / 2 + g' x, over the objective's scale.
double quadratic_value(const Evaluation& at, const std::vector<double>& curvature, double scale,
                       const std::vector<double>& x) {
  const std::size_t n = x.size();
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i)
    sum += x[i] * (at.gradient[i] / scale + 0.5 * product(curvature.data() + i * n, x));
  return sum;
}

struct Model {
  const Evaluation& at;
  const std::vector<double>& curvature;
  double scale, elastic;
};

// The step in the box that makes the model small, with one variable more, by which all constraints may be
// violated: at most by twice as much as they are now.
QuadraticSolution small_step(const Model& model, const std::vector<double>& low,
                             const std::vector<double>& high) {
  const auto& [at, curvature, scale, elastic] = model;
  const std::size_t n = low.size();
  QuadraticProgram program{
      .h = std::vector<double>((n + 1) * (n + 1), 0.0), .g = {}, .a = {}, .b = {}, .low = low, .high = high};
  for (std::size_t i = 0; i < n; ++i) {
    std::copy_n(curvature.begin() + static_cast<std::ptrdiff_t>(i * n), n,
                program.h.begin() + static_cast<std::ptrdiff_t>(i * (n + 1)));
    program.g.push_back(at.gradient[i] / scale);
  }
  program.g.push_back(elastic);
  program.low.push_back(0.0);
  program.high.push_back(2.0 * worst_after(at, std::vector<double>(n, 0.0)) + margin);
  for (std::size_t i = 0; i < at.constraints.size(); ++i) {
    program.a.push_back(at.constraint_gradients[i]);
    program.a.back().push_back(-1.0);
    program.b.push_back(-at.constraints[i] - margin);
  }
  QuadraticSolution solution = solved(program);
  solution.x.pop_back();
  return solution;
}

}  // namespace

SqpDesigner::SqpDesigner(std::vector<double> start, SqpOptions options)
    : options_(std::move(options)),
      pending_(std::move(start)),
      elastic_(first_elastic),
      trust_(options_.trust),
      shift_(first_shift) {
  if (options_.low.size() != pending_.size() || options_.high.size() != pending_.size())
    throw Error(ErrorCode::argument, "designer", "expected bounds for each variable");
  const std::size_t n = pending_.size();
  if (options_.metric.empty()) {
    options_.metric.assign(n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i) options_.metric[i * n + i] = 1.0;
  }
  best_.design = pending_;
}

double SqpDesigner::merit(const Evaluation& evaluation) const {
  return evaluation.objective / scale_ + penalty_ * violation_of(evaluation.constraints);
}

double SqpDesigner::model(const std::vector<double>& step) const {
  const double violated = worst_after(best_.evaluation, step) - violation_of(best_.evaluation.constraints);
  return quadratic_value(best_.evaluation, curvature_, scale_, step) + penalty_ * violated;
}

// The penalty follows the multipliers (M. J. D. Powell, "A fast algorithm for nonlinearly constrained
// optimization calculations", 1978): with much more than they ask for, steps along a curved constraint would
// be short. Where the box is too small to satisfy all, a fall of the violation pays for what the objective
// rises by.
void SqpDesigner::settle_penalty(const std::vector<double>& step, const std::vector<double>& multipliers) {
  constexpr double safety = 2.0;
  const double after = worst_after(best_.evaluation, step);
  const double fall = violation_of(best_.evaluation.constraints) - after;
  double wanted = 0.0;
  if (after <= linear_rounding) {
    multipliers_ = multipliers;
    wanted = safety * std::accumulate(multipliers_.begin(), multipliers_.end(), 0.0);
  }
  if (fall > 0.0) {
    const double rise = quadratic_value(best_.evaluation, curvature_, scale_, step);
    wanted = std::max(wanted, safety * rise / fall);
  }
  penalty_ = std::max(wanted, 0.5 * (penalty_ + wanted));
}

void SqpDesigner::propose() {
  const std::size_t n = best_.design.size();
  std::vector<double> low(n), high(n);
  const auto box = [&] {
    for (std::size_t i = 0; i < n; ++i) {
      low[i] = std::min(0.0, std::max(options_.low[i] - best_.design[i], -trust_));
      high[i] = std::max(0.0, std::min(options_.high[i] - best_.design[i], trust_));
    }
  };
  box();
  const auto search = [&] { return small_step({best_.evaluation, curvature_, scale_, elastic_}, low, high); };
  QuadraticSolution solution = search();
  std::vector<double>& step = solution.x;
  // Where the objective's fall pays for a violation that need not be, too little is asked for it.
  constexpr double worth_it = 0.9, growth = 10.0;
  const double violated = std::max(linear_rounding, worth_it * violation_of(best_.evaluation.constraints));
  while (worst_after(best_.evaluation, step) > violated && elastic_ < most_elastic) {
    elastic_ *= growth;
    solution = search();
  }
  const double of_last_design = penalty_;  // it falls once a design, however many boxes are tried
  const auto judge_model = [&] {
    penalty_ = of_last_design;
    settle_penalty(step, solution.multipliers);
    promised_ = -model(step);
  };
  judge_model();
  constexpr double part_of_first = 1e-3;  // a small first box is no reason to end
  // A first box in which the model promises next to nothing is too small, and says nothing of the start.
  constexpr double largest_trust = 1e6, next_to_nothing = 1e-4, worth_a_step = 1e-2, nearly = 0.99;
  const auto is_held_by_box = [&] {
    return std::any_of(step.begin(), step.end(), [&](double x) { return std::fabs(x) >= nearly * trust_; });
  };
  const bool is_too_small = steps_ == 0 && promised_ < next_to_nothing;
  while (is_too_small && promised_ < worth_a_step && trust_ < largest_trust && is_held_by_box()) {
    trust_ *= growth;
    box();
    solution = search();
    judge_model();
  }
  finished_ = trust_ < std::min(options_.least_trust, part_of_first * options_.trust) ||
              (!(promised_ > options_.least_promise) &&
               violation_of(best_.evaluation.constraints) <= options_.constraint_tolerance);
  pending_ = best_.design;
  for (std::size_t i = 0; i < n; ++i) pending_[i] += step[i];
}

// The start failed. Designs beside it are tried, in a box that doubles with each, within the bounds: points
// of a sequence that fills boxes evenly, the fractions of k 2^(i / (n + 1)) (H. Niederreiter, "Random Number
// Generation and Quasi-Monte Carlo Methods", 1992).
void SqpDesigner::propose_start() {
  finished_ = ++starts_ > options_.other_starts;
  if (finished_) return;
  const auto k = static_cast<double>(starts_), n = static_cast<double>(pending_.size());
  const double half = options_.trust * std::exp2(k - 1.0);
  for (std::size_t i = 0; i < pending_.size(); ++i) {
    const double multiple = k * std::exp2(static_cast<double>(i + 1) / (n + 1.0));
    const double place = 2.0 * (multiple - std::floor(multiple)) - 1.0;
    pending_[i] = std::clamp(best_.design[i] + half * place, options_.low[i], options_.high[i]);
  }
}

// Second derivatives of the Lagrangian, damped, so that they stay positive. The first step says how large
// they are.
void SqpDesigner::learn(const Known& trial) {
  const std::size_t n = best_.design.size();
  std::vector<double> s(n), y(n), bend(n, 0.0);
  double ss = 0.0, sy = 0.0, sbs = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    s[i] = trial.design[i] - best_.design[i];
    y[i] = (trial.evaluation.gradient[i] - best_.evaluation.gradient[i]) / scale_;
    for (std::size_t k = 0; k < multipliers_.size(); ++k)
      y[i] += multipliers_[k] *
              (trial.evaluation.constraint_gradients[k][i] - best_.evaluation.constraint_gradients[k][i]);
    ss += s[i] * s[i], sy += s[i] * y[i];
  }
  if (ss == 0.0) return;
  if (!learnt_ && sy > 0.0) {
    double sms = 0.0;
    for (std::size_t i = 0; i < n; ++i) sms += s[i] * product(options_.metric.data() + i * n, s);
    for (std::size_t k = 0; k < n * n; ++k) curvature_[k] = sy / sms * options_.metric[k];
  }
  learnt_ = learnt_ || sy > 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) bend[i] += curvature_[i * n + j] * s[j];
    sbs += s[i] * bend[i];
  }
  constexpr double damping = 0.2;
  const double part = sy >= damping * sbs ? 1.0 : (1.0 - damping) * sbs / (sbs - sy);
  for (std::size_t i = 0; i < n; ++i) y[i] = part * y[i] + (1.0 - part) * bend[i];
  sy = part * sy + (1.0 - part) * sbs;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) curvature_[i * n + j] += y[i] * y[j] / sy - bend[i] * bend[j] / sbs;
}

// Whether the trial is on the best design's connectivity, or better by more than connectivities differ.
bool SqpDesigner::comparable(const Known& trial) const {
  return connectivity_of(trial.evaluation) == connectivity_of(best_.evaluation) ||
         merit(best_.evaluation) - merit(trial.evaluation) > shift_;
}

// Takes the trial or leaves it, and says where to look next.
void SqpDesigner::judge(const Known& trial, bool failed) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < best_.design.size(); ++i)
    farthest = std::max(farthest, std::fabs(trial.design[i] - best_.design[i]));
  const double gain = failed ? 0.0 : merit(best_.evaluation) - merit(trial.evaluation);
  constexpr double poor = 0.25, good = 0.6;
  if (failed || gain < poor * promised_)
    trust_ = (gain > 0.0 ? 0.7 : 0.4) * farthest;
  else if (gain > good * promised_ && farthest > 0.99 * trust_)
    trust_ *= 2.0;
  // Over a change of connectivity small steps say nothing about second derivatives.
  if (gain > 0.0 || (!failed && connectivity_of(trial.evaluation) == connectivity_of(best_.evaluation)))
    learn(trial);
  if (gain > 0.0) best_ = trial;
  ++steps_;
  propose();
  constexpr double worth = 1e-3;
  if (!finished_ || options_.least_promise >= worth || !(begun_at_ - merit(best_.evaluation) > worth)) return;
  // What was gathered may have come to say that nothing leads on: once more without it.
  trust_ = options_.trust;
  begin_model();
}

// Second derivatives of which nothing is known: such that the first step goes about as far as the box.
void SqpDesigner::begin_model() {
  const std::size_t n = best_.design.size();
  begun_at_ = merit(best_.evaluation);
  learnt_ = false;
  double steepest = 1e-12;
  for (const double slope : best_.evaluation.gradient)
    steepest = std::max(steepest, std::fabs(slope) / scale_);
  double farthest = 0.0;
  for (double bend = steepest / trust_; farthest < 0.5 * trust_ && bend > 1e-6 * steepest; bend *= 0.1) {
    curvature_ = options_.metric;
    for (double& x : curvature_) x *= bend;
    propose();
    for (std::size_t i = 0; i < n; ++i)
      farthest = std::max(farthest, std::fabs(pending_[i] - best_.design[i]));
  }
}

void SqpDesigner::refuse(const Proposal& proposal) {
  tell(proposal, {});
}

void SqpDesigner::tell(const Proposal& proposal, const Evaluation& evaluation) {
  if (finished_) return;
  const std::size_t n = proposal.design.size();
  const bool failed = !std::isfinite(evaluation.objective) || evaluation.gradient.size() != n ||
                      !std::isfinite(violation_of(evaluation.constraints)) ||
                      evaluation.constraint_gradients.size() != evaluation.constraints.size();
  const Known known{proposal.design, evaluation};
  if (!started_) {
    if (failed) return propose_start();
    started_ = true;
    best_ = known;
    if (std::exchange(carried_, false)) {
      begun_at_ = merit(best_.evaluation);
      return propose();
    }
    scale_ = std::max(std::fabs(evaluation.objective), 1e-12);
    return begin_model();
  }
  if (waiting_) {
    const Known trial = *waiting_;
    waiting_.reset();
    constexpr double forgetting = 0.5;
    if (!failed) {
      shift_ = std::max(forgetting * shift_, 2.0 * std::fabs(merit(evaluation) - merit(best_.evaluation)));
      best_ = known;
    }
    return judge(trial, failed || !comparable(trial));
  }
  if (!failed && !comparable(known)) {
    waiting_ = known;
    pending_ = best_.design;
    return;
  }
  judge(known, failed);
}

std::string SqpDesigner::state() const {
  SqpJson json = {{"pending", pending_},
                  {"curvature", curvature_},
                  {"learnt", learnt_},
                  {"carried", carried_},
                  {"scale", scale_},
                  {"trust", trust_},
                  {"promised", promised_},
                  {"elastic", elastic_},
                  {"penalty", penalty_},
                  {"multipliers", multipliers_},
                  {"shift", shift_},
                  {"begun_at", begun_at_},
                  {"steps", steps_},
                  {"starts", starts_},
                  {"started", started_},
                  {"finished", finished_},
                  {"best", known_json(best_.design, best_.evaluation)},
                  {"waiting", nullptr}};
  if (waiting_) json["waiting"] = known_json(waiting_->design, waiting_->evaluation);
  return json.dump();
}

void SqpDesigner::restore(const std::string& state, const std::string& source) {
  try {
    const SqpJson json = SqpJson::parse(state);
    const std::size_t n = pending_.size();
    if (json.at("pending").size() != n || json.at("best").at("design").size() != n)
      throw Error(ErrorCode::format, source, "found another number of variables");
    json.at("pending").get_to(pending_), json.at("curvature").get_to(curvature_);
    json.at("learnt").get_to(learnt_), carried_ = json.value("carried", false);
    constexpr double least = std::numeric_limits<double>::min(), most = std::numeric_limits<double>::max();
    scale_ = number_at(json, "scale", least, most), trust_ = number_at(json, "trust", 0.0, most);
    penalty_ = number_at(json, "penalty", 0.0, most);
    elastic_ = json.contains("elastic") ? number_at(json, "elastic", 0.0, most) : first_elastic;
    multipliers_ = json.value("multipliers", std::vector<double>{});
    json.at("promised").get_to(promised_), json.at("shift").get_to(shift_),
        json.at("begun_at").get_to(begun_at_);
    steps_ = count_at(json, "steps"), json.at("started").get_to(started_);
    starts_ = json.contains("starts") ? count_at(json, "starts") : 0;
    json.at("finished").get_to(finished_);
    const auto known = [](const SqpJson& of) {
      return Known{of.at("design").get<std::vector<double>>(), known_evaluation(of)};
    };
    best_ = known(json.at("best"));
    waiting_.reset();
    if (!json.at("waiting").is_null()) waiting_ = known(json.at("waiting"));
    const bool goes_on = started_ && !finished_;
    if (!multipliers_.empty() && multipliers_.size() != best_.evaluation.constraints.size())
      throw std::invalid_argument("found multipliers of another number of constraints");
    if ((waiting_ && (waiting_->design.size() != n || waiting_->evaluation.gradient.size() != n)) ||
        (carried_ && curvature_.size() != n * n) ||
        (goes_on && (curvature_.size() != n * n || best_.evaluation.gradient.size() != n)))
      throw std::invalid_argument("found a model of another number of variables");
  } catch (const Error&) {
    throw;
  } catch (const std::exception& problem) {
    throw Error(ErrorCode::format, source,
                std::string("found no state of a search by gradients: ") + problem.what());
  }
}

void SqpDesigner::carry(const std::string& state, const std::string& source) {
  constexpr double least_part = 0.25;
  SqpDesigner other = *this;
  other.restore(state, source);
  if (!other.learnt_) return;
  curvature_ = std::move(other.curvature_);
  learnt_ = carried_ = true;
  scale_ = other.scale_, elastic_ = other.elastic_, penalty_ = other.penalty_;
  trust_ = std::max(other.trust_, least_part * options_.trust);
}

std::string SqpDesigner::description() const {
  return SqpJson{{"designer", "sqp"},
                 {"trust", options_.trust},
                 {"least_trust", options_.least_trust},
                 {"low", options_.low},
                 {"high", options_.high}}
      .dump();
}

}  // namespace remodel
