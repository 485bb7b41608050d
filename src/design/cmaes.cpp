// CMA-ES. Source: N. Hansen, "The CMA Evolution Strategy: A Tutorial", arXiv:1604.00772 (2016); equation
// numbers are of that paper. Where we depart: weights are positive only (the "pure" rank-mu update), the
// exponent of the step-size update is at most 1, and the four guards that cmaes.h names.

#include "remodel/cmaes.h"

#include "design/deterministic_eigen.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/checked_json.h"
#include "design/portable_math.h"
#include "remodel/error.h"

namespace remodel {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
using Json = nlohmann::json;

constexpr int max_dimension = 1000;
constexpr double infinity = std::numeric_limits<double>::infinity();

// Strategy parameters, table 1: functions of dimension and population alone.
struct Parameters {
  Parameters(int dimension, int population);
  Vector weights;  // of the best mu samples, best first; sum 1
  double mu_eff = 0.0;
  double c_sigma = 0.0, d_sigma = 0.0;      // step size
  double c_c = 0.0, c_1 = 0.0, c_mu = 0.0;  // covariance
  double chi = 0.0;                         // expected length of a standard normal vector
};

Parameters::Parameters(int dimension, int population) : weights(population / 2) {
  const double n = dimension;
  const double middle = portable::log(0.5 * (population + 1));
  for (int i = 0; i < weights.size(); ++i) weights[i] = middle - portable::log(i + 1.0);  // (49)
  weights /= weights.sum();
  mu_eff = 1.0 / weights.squaredNorm();
  c_sigma = (mu_eff + 2.0) / (n + mu_eff + 5.0);  // (55)
  d_sigma = 1.0 + 2.0 * std::max(0.0, std::sqrt((mu_eff - 1.0) / (n + 1.0)) - 1.0) + c_sigma;
  c_c = (4.0 + mu_eff / n) / (n + 4.0 + 2.0 * mu_eff / n);                                             // (56)
  c_1 = 2.0 / ((n + 1.3) * (n + 1.3) + mu_eff);                                                        // (57)
  c_mu = std::min(1.0 - c_1, 2.0 * (mu_eff - 2.0 + 1.0 / mu_eff) / ((n + 2.0) * (n + 2.0) + mu_eff));  // (58)
  chi = std::sqrt(n) * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n * n));
}

int default_population(int dimension) {
  return 4 + static_cast<int>(std::floor(3.0 * portable::log(dimension)));
}

struct Told {
  Vector sample;
  double value;
};

}  // namespace

struct Cmaes::State {
  State(int dimension, int population_size, std::uint64_t seed)
      : parameters(dimension, population_size),
        population(population_size),
        mean(Vector::Zero(dimension)),
        path_sigma(Vector::Zero(dimension)),
        path_c(Vector::Zero(dimension)),
        covariance(Matrix::Identity(dimension, dimension)),
        axes(Matrix::Identity(dimension, dimension)),
        lengths(Vector::Ones(dimension)),
        generator(seed) {}

  void update();
  void move_mean_and_paths();
  void adapt_covariance(bool stalled);
  void decompose();
  void keep_in_range();

  Parameters parameters;
  int population;
  Vector mean;
  double sigma = 1.0;
  double least_deviation = 1e-150;
  Vector path_sigma;
  Vector path_c;
  Matrix covariance;
  Matrix axes;     // columns: eigenvectors of the covariance; with lengths a function of it
  Vector lengths;  // square roots of its eigenvalues
  std::uint64_t generation = 0;
  portable::Generator generator;
  std::vector<Told> told;
};

void Cmaes::State::update() {
  std::stable_sort(told.begin(), told.end(), [](const Told& a, const Told& b) { return a.value < b.value; });
  for (Told& one : told) one.sample = (one.sample - mean) / sigma;
  move_mean_and_paths();
  decompose();
  keep_in_range();
  told.clear();
  ++generation;
}

// Equations (41) to (47). told[i].sample holds y_i = (x_i - mean) / sigma, best first.
void Cmaes::State::move_mean_and_paths() {
  const Parameters& p = parameters;
  const double n = static_cast<double>(mean.size());
  Vector step = Vector::Zero(mean.size());
  for (int i = 0; i < p.weights.size(); ++i) step += p.weights[i] * told[static_cast<std::size_t>(i)].sample;
  mean += sigma * step;

  const Vector whitened = axes * (axes.transpose() * step).cwiseQuotient(lengths);
  path_sigma =
      (1.0 - p.c_sigma) * path_sigma + std::sqrt(p.c_sigma * (2.0 - p.c_sigma) * p.mu_eff) * whitened;
  const double length = path_sigma.norm();

  const double updates = static_cast<double>(generation) + 1.0;
  const double decayed = portable::exp(std::max(-700.0, 2.0 * updates * portable::log(1.0 - p.c_sigma)));
  const bool stalled = length / std::sqrt(1.0 - decayed) >= (1.4 + 2.0 / (n + 1.0)) * p.chi;
  path_c *= 1.0 - p.c_c;
  if (!stalled) path_c += std::sqrt(p.c_c * (2.0 - p.c_c) * p.mu_eff) * step;
  adapt_covariance(stalled);
  sigma *= portable::exp(std::min(1.0, p.c_sigma / p.d_sigma * (length / p.chi - 1.0)));
}

void Cmaes::State::adapt_covariance(bool stalled) {
  const Parameters& p = parameters;
  const double lost_variance = stalled ? p.c_c * (2.0 - p.c_c) : 0.0;
  covariance *= 1.0 + p.c_1 * lost_variance - p.c_1 - p.c_mu;
  covariance += p.c_1 * (path_c * path_c.transpose());
  for (int i = 0; i < p.weights.size(); ++i) {
    const Vector& y = told[static_cast<std::size_t>(i)].sample;
    covariance += p.c_mu * p.weights[i] * (y * y.transpose());
  }
}

void Cmaes::State::decompose() {
  Eigen::SelfAdjointEigenSolver<Matrix> solver(covariance);  // reads the lower triangle
  Vector values = solver.eigenvalues();
  const double smallest = values.minCoeff(), largest = values.maxCoeff();
  if (smallest < 1e-14 * largest) {
    const double lift = 1e-14 * largest - smallest;
    covariance.diagonal().array() += lift;
    values.array() += lift;
  }
  axes = solver.eigenvectors();
  lengths = values.cwiseSqrt();
}

void Cmaes::State::keep_in_range() {
  const double longest = lengths.maxCoeff();
  if (longest < 1e-10 || longest > 1e10) {
    covariance /= longest * longest;
    lengths /= longest;
    path_c /= longest;
    sigma *= longest;
  }
  const double epsilon = std::numeric_limits<double>::epsilon();
  const double least = std::max(least_deviation, 4.0 * epsilon * mean.cwiseAbs().maxCoeff());
  sigma = std::clamp(sigma, least / lengths.maxCoeff(), 1e50 / lengths.maxCoeff());
}

Cmaes::Cmaes(std::vector<double> start, const CmaesOptions& options) {
  const auto check = [](bool good, const char* what, const char* expected) {
    if (!good) throw Error(ErrorCode::argument, what, expected);
  };
  check(!start.empty() && start.size() <= max_dimension, "CMA-ES start", "expected 1 to 1000 coordinates");
  for (const double x : start) check(std::isfinite(x), "CMA-ES start", "expected finite coordinates");
  check(options.sigma > 0.0 && options.sigma <= 1e50, "CMA-ES sigma", "expected more than 0, at most 1e50");
  check(options.population == 0 || options.population >= 4, "CMA-ES population", "expected 0 or at least 4");
  check(options.least_deviation >= 1e-150 && options.least_deviation <= 1e50, "CMA-ES least_deviation",
        "expected 1e-150 to 1e50");
  const int n = static_cast<int>(start.size());
  const int population = options.population == 0 ? default_population(n) : options.population;
  state_ = std::make_unique<State>(n, population, options.seed);
  state_->mean = Eigen::Map<const Vector>(start.data(), n);
  state_->sigma = options.sigma;
  state_->least_deviation = options.least_deviation;
}

Cmaes::Cmaes(std::unique_ptr<State> state) : state_(std::move(state)) {}
Cmaes::~Cmaes() = default;
Cmaes::Cmaes(Cmaes&&) noexcept = default;
Cmaes& Cmaes::operator=(Cmaes&&) noexcept = default;

int Cmaes::dimension() const {
  return static_cast<int>(state_->mean.size());
}
int Cmaes::population() const {
  return state_->population;
}
std::span<const double> Cmaes::mean() const {
  return {state_->mean.data(), static_cast<std::size_t>(state_->mean.size())};
}
double Cmaes::sigma() const {
  return state_->sigma;
}
double Cmaes::largest_deviation() const {
  return state_->sigma * state_->lengths.maxCoeff();
}
std::uint64_t Cmaes::generation() const {
  return state_->generation;
}
std::size_t Cmaes::told() const {
  return state_->told.size();
}
std::span<const double> Cmaes::weights() const {
  const Vector& weights = state_->parameters.weights;
  return {weights.data(), static_cast<std::size_t>(weights.size())};
}

std::vector<double> Cmaes::ask() {
  State& s = *state_;
  Vector z(s.mean.size());
  for (double& value : z) value = s.generator.normal();
  const Vector sample = s.mean + s.sigma * (s.axes * s.lengths.cwiseProduct(z));
  return {sample.begin(), sample.end()};
}

bool Cmaes::tell(std::span<const double> sample, double value) {
  State& s = *state_;
  if (sample.size() != static_cast<std::size_t>(s.mean.size()))
    throw Error(ErrorCode::argument, "CMA-ES sample",
                "expected " + std::to_string(s.mean.size()) + " coordinates");
  const Vector x = Eigen::Map<const Vector>(sample.data(), s.mean.size());
  // Far beyond anything ask() gives; its square must not overflow in the covariance.
  const bool in_range = ((x - s.mean) / s.sigma).cwiseAbs().maxCoeff() <= 1e100 && x.allFinite();
  if (!in_range) throw Error(ErrorCode::argument, "CMA-ES sample", "expected a sample of the distribution");
  s.told.push_back({x, std::isfinite(value) ? value : infinity});
  if (s.told.size() < static_cast<std::size_t>(s.population)) return false;
  s.update();
  return true;
}

namespace {

template <typename EigenObject>
Json to_json(const EigenObject& values) {
  return std::vector<double>(values.data(), values.data() + values.size());
}

// Fills an object of known size; nlohmann writes doubles so that they read back exactly.
template <typename EigenObject>
void from_json(const Json& json, const char* key, EigenObject& values) {
  const auto read = json.at(key).get<std::vector<double>>();
  if (read.size() != static_cast<std::size_t>(values.size()))
    throw std::invalid_argument(std::string("\"") + key + "\" has " + std::to_string(read.size()) +
                                " values");
  std::copy(read.begin(), read.end(), values.data());
}

}  // namespace

std::string Cmaes::state() const {
  const State& s = *state_;
  Json told = Json::array();
  for (const Told& one : s.told)
    told.push_back({{"sample", to_json(one.sample)}, {"value", one.value}});  // infinity is written as null
  const Json json = {{"format", "remodel-cmaes"},
                     {"version", 1},
                     {"population", s.population},
                     {"generation", s.generation},
                     {"sigma", s.sigma},
                     {"least_deviation", s.least_deviation},
                     {"mean", to_json(s.mean)},
                     {"path_sigma", to_json(s.path_sigma)},
                     {"path_c", to_json(s.path_c)},
                     {"covariance", to_json(s.covariance)},
                     {"axes", to_json(s.axes)},
                     {"lengths", to_json(s.lengths)},
                     {"generator", s.generator.state()},
                     {"told", told}};
  return json.dump();
}

Cmaes Cmaes::restore(std::string_view text, const std::string& source) {
  try {
    const Json json = Json::parse(text);
    const auto require = [](bool good, const char* problem) {
      if (!good) throw std::invalid_argument(problem);
    };
    require(json.at("format") == "remodel-cmaes" && json.at("version") == 1,
            "not a CMA-ES state of version 1");
    const std::size_t n = json.at("mean").size();
    require(n >= 1 && n <= max_dimension, "\"mean\" has not 1 to 1000 values");
    const std::uint64_t population = count_at(json, "population", 4, 1'000'000);
    auto s = std::make_unique<State>(static_cast<int>(n), static_cast<int>(population), 0);
    s->generation = count_at(json, "generation");
    s->sigma = number_at(json, "sigma", 0.0, 1e100);
    s->least_deviation = number_at(json, "least_deviation", 0.0, 1e100);
    from_json(json, "mean", s->mean);
    from_json(json, "path_sigma", s->path_sigma);
    from_json(json, "path_c", s->path_c);
    from_json(json, "covariance", s->covariance);
    from_json(json, "axes", s->axes);
    from_json(json, "lengths", s->lengths);
    require(s->sigma > 0.0 && (s->lengths.array() > 0.0).all(), "a standard deviation is not positive");
    s->generator = portable::Generator(json.at("generator").get<portable::Generator::State>());
    for (const Json& one : json.at("told")) {
      Told told{Vector::Zero(static_cast<Eigen::Index>(n)), infinity};
      from_json(one, "sample", told.sample);
      if (!one.at("value").is_null()) one.at("value").get_to(told.value);
      s->told.push_back(std::move(told));
    }
    require(s->told.size() < static_cast<std::size_t>(population), "more samples told than a generation has");
    return Cmaes(std::move(s));
  } catch (const std::exception& problem) {
    throw Error(ErrorCode::format, source, std::string("expected the state of a CMA-ES: ") + problem.what());
  }
}

}  // namespace remodel
