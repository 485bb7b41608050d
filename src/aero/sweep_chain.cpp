// One chain of a sweep: a living mesh that goes from section to section, and the flows around each.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <numbers>
#include <utility>

#include "aero/field_template.h"
#include "aero/flow_row.h"
#include "aero/layered_space.h"
#include "aero/resolved_problem.h"
#include "aero/sweep_record.h"
#include "aero/table_cell.h"
#include "base/stopwatch.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/io.h"
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

// A state of the living mesh, as flows see it.
struct SectionMesh {
  Mesh plain;  // empty where there is a layer
  FrozenMesh frozen;
  FlowResult solve(LivingFlow& flow, const FlowConditions& conditions) const {
    return plain.empty() ? flow.solve(frozen, conditions) : flow.solve(plain, conditions);
  }
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
  }
  SectionMesh now() const {
    return {.plain = plain_, .frozen = has_layer() ? layered_.freeze() : plain_.freeze()};
  }

 private:
  bool has_layer() const { return problem_.model != FlowModel::euler; }
  RemodelOptions step_options() const { return {.strategy = strategy_with_flows, .observer = &observer_}; }

  // Those of the first section, where it has as many curves: columns stand on the same stations then.
  void set_stations(Domain& walls) {
    Stations& stations = stations_[walls.loops.front().curves.size()];
    if (stations.empty()) stations = LayeredSpace::stations_of(walls, problem_.domain.points);
    walls = with_stations(std::move(walls), stations);
  }
  void make_plain(const Domain& walls) {
    GenerateResult result = generate(walls, quality_, &observer_);
    require_done(result);
    plain_ = std::move(result.mesh);
  }
  void make_layered(const Domain& walls) {
    LayeredGenerateResult result = generate_layered(walls, sweep_layer(problem_), quality_, &observer_);
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
  std::map<std::size_t, Stations> stations_;  // by the number of the section's curves
  Mesh plain_;
  LayeredMesh layered_;
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

// A condition of the chain. They are in an order in which each is near an earlier one: a row begins at the
// value nearest to 0, goes up from there, then down.
struct Condition {
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  std::size_t row = 0;
  double value = 0.0;
  std::size_t before = none;  // the near one
  bool in_row = false;        // that is of the same row
};

std::vector<Condition> conditions_of(const std::vector<SweepRow>& rows) {
  std::vector<Condition> conditions;
  std::size_t first_of_last_row = Condition::none;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const std::vector<double>& values = rows[r].values;
    const std::size_t start = aero::nearest_to_zero(values);
    const std::size_t first = conditions.size();
    conditions.push_back({.row = r, .value = values[start], .before = first_of_last_row});
    for (std::size_t i = start + 1; i < values.size(); ++i)
      conditions.push_back({.row = r, .value = values[i], .before = conditions.size() - 1, .in_row = true});
    for (std::size_t i = start; i-- > 0;)
      conditions.push_back({.row = r,
                            .value = values[i],
                            .before = i + 1 == start ? first : conditions.size() - 1,
                            .in_row = true});
    first_of_last_row = first;
  }
  return conditions;
}

// Of each condition the last one that begins with its flows, or itself.
std::vector<std::size_t> last_uses_of(const std::vector<Condition>& conditions) {
  std::vector<std::size_t> last(conditions.size());
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    last[c] = c;
    if (conditions[c].before != Condition::none) last[conditions[c].before] = c;
  }
  return last;
}

// The meshes of all sections first, then one condition after the other, each through all sections, to and
// fro:
//
//   sections     1    2    3    4
//   condition 1  o -> o -> o -> o
//                               |
//   condition 2  o <- o <- o <- o
//
// Each flow goes on from the one before, changed as the flows of the condition before differ between the same
// two sections, with the factors that there are. So factors of one flow serve the next ones: nothing differs
// but the section, by little.
class Chain {
 public:
  Chain(const ChainWork& work, const std::function<bool()>& cancelled)
      : work_(work),
        problem_(work.problem),
        question_(cancelled),
        stations_(problem_.stations),
        living_(flow_options()) {}

  // Nothing if it was cancelled.
  std::optional<ChainResult> run() {
    if (!make_meshes()) return std::nullopt;
    const std::vector<Condition> conditions = conditions_of(problem_.rows);
    const std::vector<std::size_t> last_uses = last_uses_of(conditions);
    found_.resize(conditions.size());
    for (std::size_t c = 0; c < conditions.size(); ++c) {
      found_[c].resize(places_.size());
      std::optional<std::size_t> last;  // section of this condition that has a flow
      for (std::size_t i = 0; i < places_.size(); ++i) {
        const std::size_t k = c % 2 == 0 ? i : places_.size() - 1 - i;
        if (!add(conditions, c, k, last)) return std::nullopt;
        if (!found_[c][k].flow.empty()) last = k;
      }
      forget(conditions[c].before, last_uses, c);
      forget(c, last_uses, c);
    }
    return std::move(result_);
  }

 private:
  // A section that has a mesh.
  struct Place {
    std::size_t section = 0;
    SectionMesh mesh;
    TemplatePlaces points;
  };
  struct Found {
    KeptFlow flow;
    double alpha_deg = 0.0;
    int misses = 0;  // in a row, up to this condition
  };

  FlowOptions flow_options() {
    FlowOptions options;
    options.tolerance = problem_.tolerance;
    options.max_steps = problem_.max_steps;
    options.model = problem_.model;
    options.observer = &question_;
    return options;
  }

  bool make_meshes() {
    const Stopwatch watch;
    ChainMesh mesh(problem_, question_);
    for (std::size_t i = 0; i < problem_.sections.size(); ++i) {
      std::string problem = problem_.sections[i].problem;
      try {
        if (problem.empty()) mesh.go_to(problem_.sections[i].airfoil);
      } catch (const Error& error) {
        if (error.code() != ErrorCode::geometry) throw;
        problem = error.what();
      } catch (const Unfinished& unfinished) {
        if (unfinished.stopped == Stopped::interrupted) return false;
        problem = std::string("the mesh was not finished: ") + name_of(unfinished.stopped);
      }
      if (problem.empty())
        add_place(work_.sections[i], mesh.now());
      else
        refuse(work_.sections[i], problem);
    }
    result_.mesh_seconds = watch.seconds();
    return true;
  }

  void add_place(std::size_t section, SectionMesh mesh) {
    TemplatePlaces points(mesh.frozen, problem_.field_points);
    places_.push_back({section, std::move(mesh), std::move(points)});
  }
  void refuse(std::size_t section, const std::string& why) {
    for (const SweepRow& row : problem_.rows) {
      for (const double value : row.values) {
        SweepFlow& flow = result_.flows.emplace_back(SweepFlow{
            .section = section, .mach = row.mach, .reynolds = row.reynolds, .asked = value, .refused = true});
        (problem_.over_lift ? flow.point.cl : flow.point.alpha_deg) = value;
        flow.point.reason = why;
      }
    }
  }

  // Beginnings of a search, the best first. One is empty: nothing that is known.
  std::vector<Found> beginnings(const std::vector<Condition>& all, std::size_t c, std::size_t k,
                                const std::optional<std::size_t>& last) const {
    const std::size_t before = all[c].before;
    const Found* same_section = before == Condition::none ? nullptr : &found_[before][k];
    if (same_section != nullptr && same_section->flow.empty()) same_section = nullptr;
    std::vector<Found> result;
    if (last) {
      Found from_last = found_[c][*last];
      if (same_section != nullptr && !found_[before][*last].flow.empty()) {
        const Found& other = found_[before][*last];
        from_last.flow = changed(from_last.flow, other.flow, same_section->flow);
        from_last.alpha_deg += same_section->alpha_deg - other.alpha_deg;
      }
      result.push_back(std::move(from_last));
    }
    if (same_section != nullptr) result.push_back(*same_section);
    if (result.empty()) result.push_back({});
    return result;
  }

  bool add(const std::vector<Condition>& all, std::size_t c, std::size_t k,
           const std::optional<std::size_t>& last) {
    constexpr int most_misses = 2;
    const Condition& condition = all[c];
    const SweepRow& row = problem_.rows[condition.row];
    const int misses = condition.in_row ? found_[condition.before][k].misses : 0;
    aero::MarchedFlow marched{
        .value = condition.value, .tried = misses < most_misses, .flow = {}, .reason = {}};
    SweepFlow flow{
        .section = places_[k].section, .mach = row.mach, .reynolds = row.reynolds, .asked = condition.value};
    if (!marched.tried) {
      marched.reason = "not looked for: no flow was found at two values before";
    } else {
      double seconds = 0.0;
      for (const Found& beginning : beginnings(all, c, k, last)) {
        marched.flow = search(condition, k, beginning);
        marched.flow.seconds = seconds += marched.flow.seconds;
        if (marched.flow.status == FlowStatus::interrupted) return false;
        if (marched.flow.converged()) break;
      }
      marched.reason = marched.flow.reason;
    }
    Found& found = found_[c][k];
    found.misses = misses + 1;
    if (marched.tried && marched.flow.converged()) {
      found = {.flow = living_.keep(), .alpha_deg = marched.flow.alpha_deg};
      const FrozenMesh& mesh = places_[k].mesh.frozen;
      flow.cp = stations_.at(mesh, pressure_coefficients(marched.flow));
      if (marched.flow.friction) flow.cf = stations_.at(mesh, marched.flow.friction->cf);
      if (!problem_.field_points.empty()) flow.fields = template_values(marched.flow, places_[k].points);
      if (problem_.fields) write_fields(mesh, marched.flow, flow);
    }
    flow.point = aero::point_of(marched, problem_.over_lift);
    result_.flows.push_back(std::move(flow));
    return true;
  }

  void write_fields(const FrozenMesh& mesh, const FlowResult& found, const SweepFlow& flow) const {
    const std::filesystem::path file = std::filesystem::path(work_.directory) / sweep_fields_file(flow);
    std::filesystem::create_directories(file.parent_path());
    const std::vector<Field> fields = fields_of(found);
    write_mesh(mesh, file, {.fields = fields});
  }

  FlowResult search(const Condition& condition, std::size_t k, const Found& beginning) {
    const SweepRow& row = problem_.rows[condition.row];
    if (beginning.flow.empty())
      living_.forget();
    else
      living_.go_on_from(beginning.flow);
    const auto solve = [&](LivingFlow& living, const FlowConditions& at) {
      return places_[k].mesh.solve(living, at);
    };
    return aero::find_at(living_, solve,
                         {.mach = row.mach, .reynolds = row.reynolds, .transition = problem_.transition},
                         condition.value, problem_.over_lift, beginning.alpha_deg);
  }

  // Flows that no later condition begins with.
  void forget(std::size_t condition, const std::vector<std::size_t>& last_uses, std::size_t now) {
    if (condition == Condition::none || last_uses[condition] > now) return;
    for (Found& found : found_[condition]) found.flow = {};
  }

  const ChainWork& work_;
  const SweepProblem& problem_;
  Question question_;
  SurfaceStations stations_;
  LivingFlow living_;
  std::vector<Place> places_;
  std::vector<std::vector<Found>> found_;  // by condition and place
  ChainResult result_;
};

}  // namespace

std::string sweep_fields_file(const SweepFlow& flow) {
  char section[32];
  std::snprintf(section, sizeof section, "%06zu", flow.section);
  const std::string reynolds = flow.reynolds > 0.0 ? "_Re" + table_cell(flow.reynolds) : "";
  return std::string("fields/") + section + "_M" + table_cell(flow.mach) + reynolds + "_" +
         table_cell(flow.asked) + ".vtu";
}

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
