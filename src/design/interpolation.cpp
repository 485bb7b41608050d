#include "design/interpolation.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "remodel/evaluator.h"

namespace remodel {

InterpolationObjective::InterpolationObjective(const CstAirfoil& target) {
  const int all = 2 * stations_per_surface + 2;  // with the trailing and the leading edge, which never move
  for (int i = 1; i < all; ++i) {
    if (i != all / 2) stations_.emplace_back(static_cast<double>(i) / all, target);
  }
  for (const CachedStation& station : stations_) heights_.push_back(station.height(target));
}

double InterpolationObjective::mean_square(const CstAirfoil& design) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    const double distance = stations_[i].height(design) - heights_[i];
    sum += distance * distance;
  }
  return sum / static_cast<double>(stations_.size());
}

double InterpolationObjective::max_error(const CstAirfoil& design) const {
  double largest = 0.0;
  for (std::size_t i = 0; i < stations_.size(); ++i)
    largest = std::max(largest, std::abs(stations_[i].height(design) - heights_[i]));
  return largest;
}

std::vector<double> InterpolationObjective::gradient(const CstAirfoil& design) const {
  std::vector<double> result(design.upper.size() + design.lower.size(), 0.0);
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    const CachedStation& station = stations_[i];
    const double factor =
        2.0 * (station.height(design) - heights_[i]) / static_cast<double>(stations_.size());
    double* surface = result.data() + (station.upper() ? 0 : design.upper.size());
    for (std::size_t k = 0; k < station.row().size(); ++k) surface[k] += factor * station.row()[k];
  }
  return result;
}

namespace {

class InterpolationEvaluator final : public Evaluator {
 public:
  explicit InterpolationEvaluator(const CstAirfoil& target) : target_(target), objective_(target) {}

  Evaluation evaluate(const EvaluationTask& task, std::unique_ptr<EvaluatorState>&) override {
    const CstAirfoil design = with_coefficients(target_, task.design);
    Evaluation evaluation{.objective = objective_.mean_square(design)};
    if (task.gradient) evaluation.gradient = objective_.gradient(design);
    return evaluation;
  }
  std::string description() const override {
    using OrderedJson = nlohmann::ordered_json;
    return OrderedJson{{"to", OrderedJson::parse(airfoil_to_json(target_))}}.dump();
  }

 private:
  CstAirfoil target_;
  InterpolationObjective objective_;
};

}  // namespace

std::unique_ptr<Evaluator> interpolation_evaluator(const CstAirfoil& target) {
  return std::make_unique<InterpolationEvaluator>(target);
}

}  // namespace remodel
