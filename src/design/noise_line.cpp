// Values along a line of designs, on meshes made in each of the ways.

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <optional>
#include <utility>

#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/noise.h"
#include "remodel/remodel.h"

namespace remodel {
namespace {

class EvaluatorObjective final : public LineObjective {
 public:
  explicit EvaluatorObjective(Evaluator& evaluator) : evaluator_(evaluator) {}
  std::vector<std::string> names() const override { return {"objective"}; }
  void forget() override { state_.reset(); }
  LineValues values(const Mesh& mesh, std::span<const double> design, StepObserver& observer) override {
    const MeshStep step;
    const EvaluationTask task{.design = design,
                              .mesh = mesh,
                              .step = step,
                              .before = nullptr,
                              .gradient = false,
                              .observer = observer};
    LineValues result;
    try {
      const Evaluation evaluation = evaluator_.evaluate(task, state_);
      if (std::isfinite(evaluation.objective)) return {.values = {evaluation.objective}};
      result.failure = "found an objective that is not finite";
    } catch (const std::exception& problem) {
      result.failure = problem.what();
    }
    state_.reset();
    return result;
  }

 private:
  Evaluator& evaluator_;
  std::unique_ptr<EvaluatorState> state_;
};

// The places of designs on the line, around 0, and the designs.
struct DesignLine {
  std::vector<double> direction;  // of length 1
  std::vector<double> places;
  std::vector<std::vector<double>> designs;

  std::size_t size() const { return designs.size(); }
  bool is_middle(std::size_t i) const { return i == size() / 2 || (size() % 2 == 0 && i + 1 == size() / 2); }
};

std::vector<double> unit_direction(const NoiseOptions& options, std::size_t size) {
  std::vector<double> direction = options.direction;
  if (direction.empty()) {
    direction.assign(size, 0.0);
    std::fill_n(direction.begin(), (size + 1) / 2, 1.0);
  }
  if (direction.size() != size)
    throw Error(ErrorCode::argument, "direction",
                "found " + std::to_string(direction.size()) + " numbers, expected " + std::to_string(size));
  double square = 0.0;
  for (const double d : direction) square += d * d;
  if (!(square > 0.0) || !std::isfinite(square))
    throw Error(ErrorCode::argument, "direction",
                std::string("found ") + (square == 0.0 ? "zeros alone" : "a number that is not finite") +
                    ", expected a direction");
  for (double& d : direction) d /= std::sqrt(square);
  return direction;
}

DesignLine line_of(const DesignSpace& space, const NoiseOptions& options) {
  if (options.degree < 1)
    throw Error(ErrorCode::argument, "degree",
                "found " + std::to_string(options.degree) + ", expected 1 or more");
  if (options.count < options.degree + 2)
    throw Error(ErrorCode::argument, "count",
                "found " + std::to_string(options.count) + ", expected at least two more than the degree, " +
                    std::to_string(options.degree + 2));
  if (!(options.spacing > 0.0) || !std::isfinite(options.spacing))
    throw Error(ErrorCode::argument, "spacing", "found 0, less or no number, expected more than 0");
  const std::vector<double> start = space.start();
  DesignLine line{.direction = unit_direction(options, start.size()), .places = {}, .designs = {}};
  for (int i = 0; i < options.count; ++i) {
    const double place = (i - 0.5 * (options.count - 1)) * options.spacing;
    std::vector<double> design = start;
    for (std::size_t k = 0; k < design.size(); ++k) design[k] += place * line.direction[k];
    if (!space.feasible(design))
      throw Error(ErrorCode::argument, "spacing",
                  "design " + std::to_string(i + 1) +
                      " of the line is none that can be meshed, expected designs nearer to one another");
    line.places.push_back(place);
    line.designs.push_back(std::move(design));
  }
  return line;
}

// The meshes of a line's designs, from the first to the last.
class MeshesOfLine {
 public:
  MeshesOfLine(LineMeshes way, const DesignSpace& space, const DesignLine& line, const NoiseOptions& options)
      : way_(way), space_(space), quality_(options.quality), observer_(options.observer) {
    if (way == LineMeshes::reference) quality_.refine_angle_deg = angle_with_slack(quality_);
    const std::size_t first = way == LineMeshes::living ? 0 : line.size() / 2;
    if (way != LineMeshes::fresh) mesh_ = generated(space.domain(line.designs[first]));
  }

  Mesh next(std::span<const double> design) {
    const Domain domain = space_.domain(design);
    if (way_ == LineMeshes::fresh) return generated(domain);
    const RemodelOptions options{.strategy = strategy(), .observer = observer_};
    Mesh copy;
    if (way_ != LineMeshes::living) copy = mesh_;
    Mesh& mesh = way_ == LineMeshes::living ? mesh_ : copy;
    note(remodel(mesh, domain, options).stopped);
    return mesh;
  }
  // Why one of the meshes is unfinished.
  Stopped stopped() const { return stopped_; }

 private:
  Strategy strategy() const {
    if (way_ == LineMeshes::reference) return Strategy::reference;
    return way_ == LineMeshes::living ? strategy_with_flows : default_strategy;
  }
  Mesh generated(const Domain& domain) {
    GenerateResult result = generate(domain, quality_, observer_);
    note(result.stopped);
    return std::move(result.mesh);
  }
  void note(Stopped stopped) {
    if (stopped_ == Stopped::done) stopped_ = stopped;
  }

  LineMeshes way_;
  const DesignSpace& space_;
  QualityOptions quality_;
  StepObserver* observer_;
  Mesh mesh_;
  Stopped stopped_ = Stopped::done;
};

// One measurement: the line, what is measured, and with which options.
struct Measurement {
  const DesignSpace& space;
  const DesignLine& line;
  LineObjective& objective;
  const NoiseOptions& options;
  StepObserver& observer;
};

Stopped evaluate(const Measurement& of, NoiseSeries& series) {
  of.objective.forget();
  MeshesOfLine meshes(series.meshes, of.space, of.line, of.options);
  std::vector<std::vector<double>> slopes;  // of the middle
  series.values.resize(of.line.size());
  for (std::size_t i = 0; i < of.line.size(); ++i) {
    if (of.observer.cancelled()) return Stopped::interrupted;
    if (meshes.stopped() != Stopped::done) return meshes.stopped();
    const Mesh mesh = meshes.next(of.line.designs[i]);
    if (meshes.stopped() != Stopped::done) return meshes.stopped();
    if (series.meshes == LineMeshes::fresh) of.objective.forget();
    LineValues found = of.objective.values(mesh, of.line.designs[i], of.observer);
    if (found.values.empty() && of.observer.cancelled()) return Stopped::interrupted;
    if (found.values.empty()) series.failures.push_back(std::move(found.failure));
    series.values[i] = std::move(found.values);
    if (series.values[i].empty() || !of.line.is_middle(i)) continue;
    std::vector<double> along = of.objective.slopes(mesh, of.line.direction, series.meshes);
    if (!along.empty()) slopes.push_back(std::move(along));
  }
  if (slopes.size() == 2 - of.line.size() % 2)
    for (std::size_t k = 0; k < slopes.front().size(); ++k)
      series.adjoint.push_back(0.5 * (slopes.front()[k] + slopes.back()[k]));
  return Stopped::done;
}

LineFit fit_of(const DesignLine& line, const NoiseSeries& series, std::size_t k, int degree) {
  std::vector<double> places, values;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (series.values[i].empty()) continue;
    places.push_back(line.places[i]), values.push_back(series.values[i][k]);
  }
  return fit_line(places, values, degree);
}

void add_fits(const DesignLine& line, int degree, NoiseSeries& series) {
  const auto found = static_cast<std::size_t>(
      std::count_if(series.values.begin(), series.values.end(), [](const auto& v) { return !v.empty(); }));
  if (found < static_cast<std::size_t>(degree) + 2) return;
  const auto any =
      std::find_if(series.values.begin(), series.values.end(), [](const auto& v) { return !v.empty(); });
  for (std::size_t k = 0; k < any->size(); ++k) series.fits.push_back(fit_of(line, series, k, degree));
}

}  // namespace

const char* name_of(LineMeshes meshes) {
  constexpr std::array names = {"fresh", "living", "hub", "reference"};
  return names[static_cast<std::size_t>(meshes)];
}

std::unique_ptr<LineObjective> line_objective(Evaluator& evaluator) {
  return std::make_unique<EvaluatorObjective>(evaluator);
}

bool NoiseResult::complete() const {
  return std::none_of(series.begin(), series.end(), [](const NoiseSeries& one) { return one.fits.empty(); });
}

NoiseResult measure_noise(const DesignSpace& space, LineObjective& objective, const NoiseOptions& options) {
  const DesignLine line = line_of(space, options);
  StepObserver silent;
  const Measurement of{space, line, objective, options,
                       options.observer != nullptr ? *options.observer : silent};
  NoiseResult result{.names = objective.names(), .places = line.places, .series = {}};
  for (const LineMeshes way : all_line_meshes) {
    NoiseSeries& series = result.series.emplace_back();
    series.meshes = way;
    if (result.stopped == Stopped::done) result.stopped = evaluate(of, series);
    series.values.resize(line.size());
    add_fits(line, options.degree, series);
  }
  return result;
}

}  // namespace remodel
