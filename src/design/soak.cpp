#include "remodel/soak.h"
#include "remodel/mesh_state.h"

#include <sys/resource.h>

#include <algorithm>
#include <optional>

#include "base/stopwatch.h"
#include "design/soak_cases.h"
#include "remodel/check.h"
#include "remodel/error.h"
#include "remodel/remodel.h"

namespace remodel {

namespace {

// What soak() asks of a mesh with or without layers.
const Mesh& outer_of(const Mesh& mesh) {
  return mesh;
}
const Mesh& outer_of(const LayeredMesh& mesh) {
  return mesh.outer();
}

double peak_memory_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

class Soak {
 public:
  explicit Soak(const SoakOptions& options) : options_(options) {}

  SoakResult run() {
    const Stopwatch watch;
    portable::Generator seeds(options_.seed);
    for (std::size_t skipped = 1; skipped < options_.first_episode; ++skipped) seeds.next();
    for (episode_ = options_.first_episode; going(); ++episode_) episode(seeds.next());
    result_.peak_memory_mib = peak_memory_mib();
    result_.seconds = watch.seconds();
    return result_;
  }

 private:
  bool going() {
    if (result_.steps >= options_.steps) return false;
    stopped_ = stopped_ || (options_.keep_going && !options_.keep_going(result_.steps));
    return !stopped_;
  }

  void episode(std::uint64_t seed) {
    portable::Generator random(seed);
    if (options_.layers)
      episode(draw_layered_case(random));
    else
      episode(draw_case(random));
  }

  template <class AnyMesh>
  void episode(SoakCase<AnyMesh> drawn) {
    for (std::size_t i = 1; i <= steps_of_an_episode && going(); ++i) {
      number_ = (episode_ - 1) * steps_of_an_episode + i;
      step(drawn);
    }
  }

  template <class AnyMesh>
  void step(SoakCase<AnyMesh>& drawn) {
    ++result_.steps;
    AnyMesh& mesh = drawn.mesh;
    std::optional<decltype(mesh.state())> before;  // to compare with, now and then
    if (number_ % 50 == 0) before = mesh.state();
    const std::uint32_t step_before = outer_of(mesh).step();
    const ThreadStopwatch watch;
    bool finished = true;
    try {
      const auto outcome = remodel(mesh, drawn.walk->next(), drawn.remodel);
      finished = outcome.stopped == Stopped::done;
      result_.recoveries += outcome.regenerated ? 1 : 0;
      result_.full_adjustments += outcome.full_adjustment ? 1 : 0;
      result_.limited += finished ? 0 : 1;
      note_time(1e3 * watch.seconds());
    } catch (const Error& error) {
      ++result_.refused;
      if (outer_of(mesh).step() != step_before || (before && !(mesh.state() == *before)))
        fail("a refused design changed the mesh");
      return;
    }
    validate(mesh, finished);
  }

  void note_time(double milliseconds) {
    if (milliseconds <= result_.slowest_step_ms) return;
    result_.slowest_step_ms = milliseconds;
    result_.slowest_step = number_;
    result_.slowest_episode = episode_;
  }

  // A mesh that a limit left unfinished has the quality that it has, and is valid in all else.
  template <class AnyMesh>
  void validate(const AnyMesh& mesh, bool finished) {
    if (const std::string broken = finished ? mesh.quick_check() : ""; !broken.empty()) fail(broken);
    const bool chosen = options_.full_check_every != 0 && number_ % options_.full_check_every == 0;
    if (finished && !chosen) return;
    ++result_.full_checks;
    CheckOptions promised = promises(outer_of(mesh), finished);
    promised.design = &mesh.domain();
    const CheckResult checked = check(mesh.freeze(), promised);
    if (finished) result_.min_angle_deg = std::min(result_.min_angle_deg, checked.min_angle_deg);
    if (!checked.valid) fail(checked.violations.front().rule + ": " + checked.violations.front().detail);
    try {  // reading back looks at what lies outside the domain too
      AnyMesh::restore(mesh.state(), "mesh");
    } catch (const Error& error) {
      fail(std::string("cannot be restored: ") + error.what());
    }
  }

  static CheckOptions promises(const Mesh& mesh, bool finished) {
    CheckOptions promised{.delaunay_slack_deg = mesh.delaunay_slack_deg()};
    if (!finished) return promised;
    promised.min_angle_deg = mesh.options().min_angle_deg;
    promised.max_gradation = mesh.promised_gradation();
    return promised;
  }

  void fail(const std::string& rule) {
    ++result_.invalid_meshes;
    if (result_.first_failure.empty())
      result_.first_failure = "step " + std::to_string(number_) + ", --seed " +
                              std::to_string(options_.seed) + " --episode " + std::to_string(episode_) +
                              ": " + rule;
  }

  const SoakOptions& options_;
  static constexpr std::size_t steps_of_an_episode = 200;
  std::size_t episode_ = 0,
              number_ = 0;  // of what is under way, as if the run had begun with the first episode
  SoakResult result_;
  bool stopped_ = false;
};

}  // namespace

SoakResult soak(const SoakOptions& options) {
  if (options.first_episode == 0)
    throw Error(ErrorCode::argument, "first_episode", "found 0, expected 1 or more");
  return Soak(options).run();
}

}  // namespace remodel
