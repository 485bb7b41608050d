// One chain of a sweep: a living mesh that goes from section to section, and the flows around each.

#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <utility>

#include "aero/flow_rows.h"
#include "aero/layered_space.h"
#include "aero/resolved_problem.h"
#include "aero/sweep_record.h"
#include "base/stopwatch.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/layers.h"
#include "remodel/remodel.h"

namespace remodel {
namespace {

class Question final : public StepObserver {
 public:
  explicit Question(const std::function<bool()>& cancelled) : cancelled_(cancelled) {}
  bool cancelled() override { return cancelled_ && cancelled_(); }

 private:
  const std::function<bool()>& cancelled_;
};

// A mesh was not finished: interrupted, or ended by a limit.
struct Unfinished {
  Stopped stopped;
};

// The living mesh of a chain, with a layer where there is friction.
class ChainMesh {
 public:
  ChainMesh(const SweepProblem& problem, StepObserver& observer)
      : problem_(problem),
        observer_(observer),
        quality_{.gradation = problem.gradation.value_or(problem.domain.points / 50.0)} {}

  // Throws Error (geometry) where the section has no mesh: then it is as it was. Throws Unfinished.
  void go_to(const CstAirfoil& airfoil) {
    Domain walls = airfoil_domain(airfoil, problem_.domain);
    if (has_layer()) set_stations(walls);
    validate(walls);
    if (has_layer())
      layered_.empty() ? make_layered(walls) : require_done(remodel(layered_, walls, step_options()));
    else
      plain_.empty() ? make_plain(walls) : require_done(remodel(plain_, walls, step_options()));
    frozen_ = has_layer() ? layered_.freeze() : plain_.freeze();
  }
  FlowResult solve(LivingFlow& flow, const FlowConditions& conditions) const {
    return has_layer() ? flow.solve(frozen_, conditions) : flow.solve(plain_, conditions);
  }
  const FrozenMesh& frozen() const { return frozen_; }

 private:
  bool has_layer() const { return problem_.model != FlowModel::euler; }
  RemodelOptions step_options() const { return {.strategy = strategy_with_flows, .observer = &observer_}; }

  // Those of the first section, where it has as many curves: columns stand on the same stations then.
  void set_stations(Domain& walls) {
    LayeredSpace::Stations& stations = stations_[walls.loops.front().curves.size()];
    if (stations.empty()) stations = LayeredSpace::stations_of(walls, problem_.domain.points);
    walls = LayeredSpace::with_stations(std::move(walls), stations);
  }
  LayerOptions layer() const {
    std::vector<DesignPoint> points;
    for (const SweepRow& row : problem_.rows)
      points.push_back({.conditions = {.mach = row.mach, .reynolds = row.reynolds}, .model = problem_.model});
    return layer_for_points(points);
  }
  void make_plain(const Domain& walls) {
    GenerateResult result = generate(walls, quality_, &observer_);
    require_done(result);
    plain_ = std::move(result.mesh);
  }
  void make_layered(const Domain& walls) {
    LayeredGenerateResult result = generate_layered(walls, layer(), quality_, &observer_);
    require_done(result);
    layered_ = std::move(result.mesh);
  }
  template <class Result>
  static void require_done(const Result& result) {
    if (result.stopped != Stopped::done) throw Unfinished{result.stopped};
  }

  const SweepProblem& problem_;
  StepObserver& observer_;
  QualityOptions quality_;
  std::map<std::size_t, LayeredSpace::Stations> stations_;  // by the number of the section's curves
  Mesh plain_;
  LayeredMesh layered_;
  FrozenMesh frozen_;
};

// Values on the section by the parameter of its curve, at the stations of both surfaces.
class SurfaceStations {
 public:
  explicit SurfaceStations(std::size_t count) : count_(count) {}

  std::vector<double> at(const FrozenMesh& mesh, const std::vector<double>& values) const {
    if (count_ == 0) return {};
    const std::map<double, double> on_section = by_parameter(mesh, values);
    std::vector<double> result;
    for (const double side : {-1.0, 1.0})  // the nose is at 1/2, the upper surface before it
      for (std::size_t j = 0; j < count_; ++j)
        result.push_back(interpolated(
            on_section, 0.5 * (1.0 + side * static_cast<double>(j) / static_cast<double>(count_ - 1))));
    return result;
  }

 private:
  static std::map<double, double> by_parameter(const FrozenMesh& mesh, const std::vector<double>& values) {
    std::map<double, double> result;
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
      if (mesh.curve[p] != 0) continue;
      result[mesh.parameter[p]] = values[p];
      if (mesh.parameter[p] == 0.0) result.emplace(1.0, values[p]);  // a closed trailing edge is both ends
    }
    return result;
  }
  static double interpolated(const std::map<double, double>& values, double t) {
    auto after = values.lower_bound(t);
    if (after == values.end()) return values.rbegin()->second;
    if (after == values.begin()) return after->second;
    const auto before = std::prev(after);
    const double part = (t - before->first) / (after->first - before->first);
    return (1.0 - part) * before->second + part * after->second;
  }

  std::size_t count_;
};

class Chain {
 public:
  Chain(const ChainWork& work, const std::function<bool()>& cancelled)
      : work_(work),
        problem_(work.problem),
        question_(cancelled),
        stations_(problem_.stations),
        mesh_(problem_, question_),
        rows_(flow_options(), {.halvings = 2, .misses = 2}, problem_.over_lift, true) {}

  // Nothing if it was cancelled.
  std::optional<ChainResult> run() {
    for (std::size_t i = 0; i < problem_.sections.size(); ++i)
      if (!add_section(problem_.sections[i], work_.sections[i])) return std::nullopt;
    return std::move(result_);
  }

 private:
  FlowOptions flow_options() {
    FlowOptions options;
    options.tolerance = problem_.tolerance;
    options.max_steps = problem_.max_steps;
    options.model = problem_.model;
    options.observer = &question_;
    return options;
  }

  bool add_section(const SweepSection& section, std::size_t number) {
    std::string problem = section.problem;
    if (problem.empty()) {
      const Stopwatch watch;
      try {
        mesh_.go_to(section.airfoil);
      } catch (const Error& error) {
        if (error.code() != ErrorCode::geometry) throw;
        problem = error.what();
      } catch (const Unfinished& unfinished) {
        if (unfinished.stopped == Stopped::interrupted) return false;
        problem = std::string("the mesh was not finished: ") + name_of(unfinished.stopped);
      }
      result_.mesh_seconds += watch.seconds();
    }
    for (const SweepRow& row : problem_.rows) {
      if (!problem.empty())
        refuse(row, number, problem);
      else if (!add_row(row, number))
        return false;
    }
    return true;
  }

  void refuse(const SweepRow& row, std::size_t section, const std::string& why) {
    for (const double value : row.values) {
      SweepFlow& flow = result_.flows.emplace_back(SweepFlow{
          .section = section, .mach = row.mach, .reynolds = row.reynolds, .asked = value, .refused = true});
      (problem_.over_lift ? flow.point.cl : flow.point.alpha_deg) = value;
      flow.point.reason = why;
    }
  }

  bool add_row(const SweepRow& row, std::size_t section) {
    const FlowConditions conditions{
        .mach = row.mach, .reynolds = row.reynolds, .transition = problem_.transition};
    struct Surface {
      std::vector<double> cp, cf;
    };
    std::map<double, Surface> surfaces;  // by the value
    const auto solve = [&](LivingFlow& living, const FlowConditions& at) { return mesh_.solve(living, at); };
    const auto see = [&](double value, const FlowResult& flow) {
      surfaces[value] = {
          stations_.at(mesh_.frozen(), pressure_coefficients(flow)),
          flow.friction ? stations_.at(mesh_.frozen(), flow.friction->cf) : std::vector<double>()};
    };
    const aero::March march = rows_.march(conditions, row.values, solve, {.before = {}, .found = see});
    if (march.interrupted) return false;
    for (const aero::MarchedFlow& marched : march.flows) {
      if (!marched.asked) continue;
      Surface& surface = surfaces[marched.value];  // empty where there is no flow
      result_.flows.push_back({.section = section,
                               .mach = row.mach,
                               .reynolds = row.reynolds,
                               .asked = marched.value,
                               .point = aero::point_of(marched, problem_.over_lift),
                               .cp = std::move(surface.cp),
                               .cf = std::move(surface.cf)});
    }
    return true;
  }

  const ChainWork& work_;
  const SweepProblem& problem_;
  Question question_;
  SurfaceStations stations_;
  ChainMesh mesh_;
  aero::FlowRows rows_;
  ChainResult result_;
};

}  // namespace

std::vector<double> sweep_stations(std::size_t count) {
  std::vector<double> stations;
  for (std::size_t j = 0; j < count; ++j)
    stations.push_back(
        0.5 * (1.0 - std::cos(std::numbers::pi * static_cast<double>(j) / static_cast<double>(count - 1))));
  return stations;
}

std::optional<std::string> run_sweep_chain(const std::string& bytes, const std::function<bool()>& cancelled) {
  const ChainWork work = decode_chain_work(bytes);
  const std::optional<ChainResult> result = Chain(work, cancelled).run();
  if (!result) return std::nullopt;
  return encode(*result);
}

}  // namespace remodel
