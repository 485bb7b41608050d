#include "gradient_designer.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <nlopt.hpp>

#include "remodel/error.h"

namespace remodel::app {

namespace {

using DesignJson = nlohmann::ordered_json;

constexpr double constraint_tolerance = 1e-7;
constexpr int most_rounds = 100, most_a_round = 40;

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

// The best design of the box around the centre, as far as it is known; none where the search waits.
std::optional<GradientDesigner::Known> GradientDesigner::search_box(Oracle& oracle, bool& failed) {
  const std::size_t n = start_.size();
  const Known* first = oracle.ask_in_round(centre_);
  if (first == nullptr) return std::nullopt;
  const double scale = std::max(std::fabs(known_.front().evaluation.objective), 1e-12);
  Known best = *first;
  bool stop = false;
  const auto answer = [&](const std::vector<double>& x) -> const Known* {
    if (stop) return nullptr;
    const Known* found = oracle.ask_in_round(x);
    if (found == nullptr) stop = true;
    if (found != nullptr &&
        !(std::isfinite(found->evaluation.objective) && found->evaluation.gradient.size() == n))
      stop = failed = true, found = nullptr;
    if (found != nullptr && merit_of(found->evaluation, scale) < merit_of(best.evaluation, scale))
      best = *found;
    return found;
  };
  const std::size_t m = first->evaluation.constraints.size();
  const nlopt::vfunc objective = [](const std::vector<double>& x, std::vector<double>& gradient, void* data) {
    const auto& [ask, size] = *static_cast<std::pair<decltype(answer)*, double>*>(data);
    const Known* found = (*ask)(x);
    if (found == nullptr) throw nlopt::forced_stop();
    for (std::size_t i = 0; i < gradient.size(); ++i) gradient[i] = found->evaluation.gradient[i] / size;
    return found->evaluation.objective / size;
  };
  const nlopt::mfunc constraints = [](unsigned count, double* values, unsigned dimension, const double* x,
                                      double* gradient, void* data) {
    const auto& [ask, size] = *static_cast<std::pair<decltype(answer)*, double>*>(data);
    const Known* found = (*ask)(std::vector<double>(x, x + dimension));
    if (found == nullptr) throw nlopt::forced_stop();
    for (unsigned i = 0; i < count; ++i) {
      values[i] = found->evaluation.constraints[i];
      if (gradient != nullptr)
        std::copy_n(found->evaluation.constraint_gradients[i].begin(), dimension, gradient + i * dimension);
    }
  };
  std::pair data{&answer, scale};
  nlopt::opt search(options_.method == "mma" ? nlopt::LD_MMA : nlopt::LD_SLSQP, static_cast<unsigned>(n));
  std::vector<double> low(n), high(n);
  for (std::size_t i = 0; i < n; ++i) {
    low[i] = std::max(options_.low[i], centre_[i] - trust_);
    high[i] = std::min(options_.high[i], centre_[i] + trust_);
  }
  search.set_lower_bounds(low), search.set_upper_bounds(high);
  search.set_min_objective(objective, &data);
  if (m != 0)
    search.add_inequality_mconstraint(constraints, &data, std::vector<double>(m, constraint_tolerance));
  search.set_ftol_rel(1e-5);
  search.set_xtol_abs(1e-3 * options_.least_trust);
  search.set_maxeval(most_a_round);
  std::vector<double> x = centre_;
  double value = 0.0;
  try {
    search.optimize(x, value);
  } catch (const nlopt::forced_stop&) {
  } catch (const nlopt::roundoff_limited&) {
  } catch (const std::runtime_error&) {
    if (!stop) failed = true;
  }
  if (oracle.pending) return std::nullopt;
  return best;
}

void GradientDesigner::search(Oracle& oracle) {
  centre_ = start_;
  trust_ = options_.trust;
  round_ = 0;
  const Known* at = oracle.ask(centre_);
  if (at == nullptr) return;
  if (at->evaluation.gradient.size() != start_.size()) return;  // the start failed: nothing to go on from
  const double scale = std::max(std::fabs(at->evaluation.objective), 1e-12);
  Known centre = *at;
  for (; round_ < most_rounds && trust_ >= options_.least_trust; ++round_) {
    std::size_t again = 1;
    const Known& last = known_[oracle.next() - 1];
    if (last.design != centre.design) {
      if (connectivity_of(last.evaluation) != connectivity_of(centre.evaluation) ||
          !std::isfinite(last.evaluation.objective)) {
        at = oracle.ask(centre_);
        if (at == nullptr) return;
        if (at->evaluation.gradient.size() != start_.size()) return;
        centre = *at;
      } else {
        // The same mesh: what is known of the centre holds.
        again = 0;
        for (std::size_t i = oracle.next(); i-- > 0 && known_[i].design != centre.design;) ++again;
        ++again;
      }
    }
    oracle.begin_round(again);
    bool failed = false;
    const std::optional<Known> best = search_box(oracle, failed);
    if (!best) return;
    const double gain = merit_of(centre.evaluation, scale) - merit_of(best->evaluation, scale);
    double farthest = 0.0;
    for (std::size_t i = 0; i < centre_.size(); ++i)
      farthest = std::max(farthest, std::fabs(best->design[i] - centre_[i]));
    constexpr double least_gain = 1e-4;
    if (gain > 0.0) centre = *best, centre_ = centre.design;
    if (failed || gain < least_gain)
      trust_ *= 0.25;
    else if (farthest > 0.99 * trust_)
      trust_ *= 2.0;
  }
}

Proposal GradientDesigner::ask() {
  // Refused at its start, the search has nothing to ask for: the start again, which ends the run.
  return {.design = pending_ ? *pending_ : centre_, .gradient = true, .from = centre_};
}

void GradientDesigner::refuse(const Proposal& proposal) {
  tell(proposal, {});
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
  } catch (const DesignJson::exception&) {
    throw Error(ErrorCode::format, source, "found no state of a search by gradients");
  }
  advance();
}

std::string GradientDesigner::description() const {
  return description_of(options_.method, options_);
}

}  // namespace remodel::app
