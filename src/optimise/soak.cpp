#include "remodel/soak.h"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>

#include "optimise/portable_math.h"
#include "remodel/airfoil.h"
#include "remodel/check.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/remodel.h"

namespace remodel {

namespace {

double peak_memory_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

class Soak {
 public:
  explicit Soak(const SoakOptions& options) : options_(options), random_(options.seed) {}

  SoakResult run() {
    const auto start = std::chrono::steady_clock::now();
    while (going()) episode();
    result_.peak_memory_mib = peak_memory_mib();
    result_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result_;
  }

 private:
  // What one episode keeps fixed.
  struct Setting {
    AirfoilDomainOptions domain;
    QualityOptions quality;
    RemodelOptions remodel;
    double sigma;
    CstAirfoil centre;
  };

  template <class Value, std::size_t n>
  Value pick(const std::array<Value, n>& values) {
    return values[random_.next() % n];
  }

  CstAirfoil any_airfoil() {
    return airfoil_catalogue()[random_.next() % airfoil_catalogue().size()].airfoil();
  }

  bool going() {
    if (result_.steps >= options_.steps) return false;
    stopped_ = stopped_ || (options_.keep_going && !options_.keep_going(result_.steps));
    return !stopped_;
  }

  Setting draw_setting() {
    Setting setting;
    setting.domain.points = pick(std::array{8, 20, 50, 50, 50, 80, 100, 100, 150, 200, 400});
    setting.quality.gradation =
        std::max(0.5, setting.domain.points / 50.0 * pick(std::array{0.5, 1.0, 1.0, 2.0}));
    setting.remodel.distance = pick(std::array{0.5, 1.0, 2.0, 4.0});
    setting.remodel.method = pick(std::array{Method::automatic, Method::automatic, Method::general});
    setting.remodel.strategy = pick(std::array{Strategy::renew, Strategy::chain});
    setting.sigma = 0.25 * portable::exp(-6.0 * random_.uniform());  // 0.0006 to 0.25
    setting.centre = any_airfoil();
    return setting;
  }

  // A walk's next design; one in twenty jumps to another airfoil, one in twenty crosses itself.
  CstAirfoil draw_design(Setting& setting) {
    const double kind = random_.uniform();
    CstAirfoil design = setting.centre;
    if (kind < 0.05) return setting.centre = any_airfoil();
    for (auto* surface : {&design.upper, &design.lower})
      for (double& coefficient : *surface) coefficient += setting.sigma * random_.normal();
    if (kind < 0.10)
      std::swap(design.upper, design.lower);
    else if (kind < 0.40 && surfaces_apart(design))
      setting.centre = mean(setting.centre, design);
    return design;
  }

  static CstAirfoil mean(const CstAirfoil& a, const CstAirfoil& b) {
    CstAirfoil m = a;
    for (std::size_t i = 0; i < m.upper.size(); ++i) {
      m.upper[i] = 0.5 * (a.upper[i] + b.upper[i]);
      m.lower[i] = 0.5 * (a.lower[i] + b.lower[i]);
    }
    return surfaces_apart(m) ? m : a;
  }

  void episode() {
    Setting setting = draw_setting();
    Mesh mesh = generate(airfoil_domain(setting.centre, setting.domain), setting.quality).mesh;
    for (int i = 0; i < 200 && going(); ++i) step(mesh, draw_design(setting), setting);
  }

  void step(Mesh& mesh, const CstAirfoil& design, const Setting& setting) {
    ++result_.steps;
    std::optional<MeshState> before;  // to compare with, now and then
    if (result_.steps % 50 == 0 && !surfaces_apart(design)) before = mesh.state();
    const std::uint32_t step_before = mesh.step();
    try {
      const RemodelResult outcome = remodel(mesh, airfoil_domain(design, setting.domain), setting.remodel);
      result_.recoveries += outcome.regenerated ? 1 : 0;
      result_.full_adjustments += outcome.full_adjustment ? 1 : 0;
    } catch (const Error& error) {
      ++result_.refused;
      if (mesh.step() != step_before || (before && !(mesh.state() == *before)))
        fail("a refused design changed the mesh");
      return;
    }
    validate(mesh);
  }

  void validate(const Mesh& mesh) {
    if (const std::string broken = mesh.quick_check(); !broken.empty()) fail(broken);
    if (options_.full_check_every == 0 || result_.steps % options_.full_check_every != 0) return;
    ++result_.full_checks;
    const CheckResult checked = check(mesh.freeze(), {.min_angle_deg = mesh.options().min_angle_deg,
                                                      .max_gradation = promised_gradation(mesh.options()),
                                                      .design = &mesh.domain()});
    result_.min_angle_deg = std::min(result_.min_angle_deg, checked.min_angle_deg);
    if (!checked.valid) fail(checked.violations.front().rule + ": " + checked.violations.front().detail);
  }

  void fail(const std::string& rule) {
    ++result_.invalid_meshes;
    if (result_.first_failure.empty())
      result_.first_failure =
          "step " + std::to_string(result_.steps) + " of seed " + std::to_string(options_.seed) + ": " + rule;
  }

  const SoakOptions& options_;
  portable::Generator random_;
  SoakResult result_;
  bool stopped_ = false;
};

}  // namespace

SoakResult soak(const SoakOptions& options) {
  return Soak(options).run();
}

}  // namespace remodel
