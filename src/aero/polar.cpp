#include "remodel/polar.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <map>
#include <span>
#include <utility>

#include "aero/flow_march.h"
#include "aero/flow_row.h"
#include "base/stopwatch.h"
#include "remodel/error.h"

namespace remodel {

namespace {

void require_ascending(const char* what, const std::vector<double>& values) {
  if (std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end()) return;
  throw Error(ErrorCode::argument, what,
              "found values that do not ascend, expected each to be above the one before");
}

void require_possible_polar(const PolarOptions& options) {
  if (options.machs.empty()) throw Error(ErrorCode::argument, "machs", "found none, expected a Mach number");
  if (options.alphas_deg.empty() == options.lifts.empty())
    throw Error(ErrorCode::argument, "alphas_deg",
                options.lifts.empty() ? "found neither angles nor lifts, expected one of them"
                                      : "found angles and lifts, expected one of them");
  require_ascending("machs", options.machs);
  require_ascending("alphas_deg", options.alphas_deg);
  require_ascending("lifts", options.lifts);
  if (options.halvings < 0 || options.halvings > 20)
    throw Error(ErrorCode::argument, "halvings",
                "found " + std::to_string(options.halvings) + ", expected 0 to 20");
  if (options.misses < 1)
    throw Error(ErrorCode::argument, "misses",
                "found " + std::to_string(options.misses) + ", expected 1 or more");
}

// What a point is made of; a flow's fields are the largest part of it by far.
FlowResult without_fields(FlowResult flow) {
  for (auto* field : {&flow.density, &flow.velocity_x, &flow.velocity_y, &flow.pressure, &flow.history})
    *field = std::vector<double>();
  if (flow.friction)
    for (auto* field : {&flow.friction->cf, &flow.friction->y_plus, &flow.friction->viscosity_ratio,
                        &flow.friction->working})
      *field = std::vector<double>();
  return flow;
}

// With friction a search from undisturbed flow takes long, and finds little where one from the last flow, by
// halved steps, does not.
FlowOptions options_of_row(const PolarOptions& options) {
  FlowOptions flow = options.flow;
  if (flow.model != FlowModel::euler && options.halvings > 0) flow.retry_cold = false;
  return flow;
}

// The rows of one mesh.
class PolarSearch {
 public:
  PolarSearch(aero::RowSolve solve, const std::string& name, const PolarOptions& options)
      : solve_(std::move(solve)),
        name_(name),
        options_(options),
        values_(options.alphas_deg.empty() ? options.lifts : options.alphas_deg),
        living_(options_of_row(options)) {}

  PolarResult run() {
    const Stopwatch watch;
    for (const double mach : options_.machs) {
      begin_curve(mach);
      const aero::March row = march_at(mach);
      set_points(row.flows);
      result_.interrupted = row.interrupted;
      if (row.interrupted) break;
    }
    result_.seconds = watch.seconds();
    return std::move(result_);
  }

 private:
  bool over_lift() const { return options_.alphas_deg.empty(); }

  void begin_curve(double mach) {
    PolarCurve& curve = result_.curves.emplace_back();
    curve.name = name_, curve.model = options_.flow.model, curve.mach = mach;
    curve.over_lift = over_lift();
    if (curve.model != FlowModel::euler) curve.reynolds = options_.conditions.reynolds;
    curve.transition = options_.conditions.transition;
  }

  void set_points(std::span<const aero::MarchedFlow> flows) {
    std::vector<PolarPoint>& points = result_.curves.back().points;
    points.clear();
    for (const aero::MarchedFlow& flow : flows) points.push_back(aero::point_of(flow, over_lift()));
  }

  void show(std::span<const aero::MarchedFlow> flows) {
    if (!options_.on_curves) return;
    set_points(flows);
    options_.on_curves(result_.curves);
  }

  aero::March march_at(double mach) {
    living_.go_on_from(first_of_row_);  // of the Mach number before
    first_of_row_ = {};
    alpha_deg_ = 0.0;
    return aero::march(values_, aero::nearest_to_zero(values_),
                       {.find = [&](double value) { return find(mach, value); },
                        .return_to_first = [&] { living_.go_on_from(first_of_row_); },
                        .on_flow = [&](std::span<const aero::MarchedFlow> flows) { show(flows); }},
                       {.halvings = options_.halvings, .misses = options_.misses});
  }

  FlowResult find(double mach, double value) {
    if (options_.on_search) options_.on_search(mach, value);
    FlowConditions conditions = options_.conditions;
    conditions.mach = mach;
    FlowResult flow = aero::find_at(living_, solve_, conditions, value, over_lift(), alpha_deg_);
    if (flow.converged()) {
      alpha_deg_ = flow.alpha_deg;
      if (first_of_row_.empty()) first_of_row_ = living_.keep();
    }
    return without_fields(std::move(flow));
  }

  aero::RowSolve solve_;
  const std::string& name_;
  const PolarOptions& options_;
  const std::vector<double>& values_;
  LivingFlow living_;
  KeptFlow first_of_row_;
  double alpha_deg_ = 0.0;  // where the search for a lift begins
  PolarResult result_;
};

}  // namespace

PolarResult find_polar(const Mesh& mesh, const std::string& name, const PolarOptions& options) {
  require_possible_polar(options);
  const auto solve = [&](LivingFlow& living, const FlowConditions& conditions) {
    return living.solve(mesh, conditions);
  };
  return PolarSearch(solve, name, options).run();
}

PolarResult find_polar(const FrozenMesh& given, const std::string& name, const PolarOptions& options) {
  require_possible_polar(options);
  FrozenMesh mesh = given;
  if (mesh.vertex_keys.empty())  // of another program: one mesh for all flows
    for (std::size_t i = 0; i < mesh.points.size(); ++i) mesh.vertex_keys.push_back(i);
  const auto solve = [&](LivingFlow& living, const FlowConditions& conditions) {
    return living.solve(mesh, conditions);
  };
  return PolarSearch(solve, name, options).run();
}

std::optional<LargestLift> largest_lift(const PolarCurve& curve) {
  std::optional<LargestLift> largest;
  double last_alpha = PolarPoint::none;
  for (const PolarPoint& point : curve.points) {
    if (!point.converged || std::isnan(point.cl)) continue;
    if (!largest || point.cl > largest->cl) largest = {.cl = point.cl, .alpha_deg = point.alpha_deg};
    last_alpha = std::isnan(last_alpha) ? point.alpha_deg : std::fmax(last_alpha, point.alpha_deg);
  }
  if (largest) largest->passed = last_alpha > largest->alpha_deg;
  return largest;
}

std::vector<std::string> polar_warnings(const PolarCurve& curve) {
  struct Kind {
    std::string first;
    double alpha_deg = 0.0;
    int flows = 0;
  };
  std::vector<std::pair<std::string, Kind>> kinds;  // by the sentence without its numbers
  for (const PolarPoint& point : curve.points) {
    for (const std::string& warning : point.warnings) {
      std::string key;
      for (const char c : warning)
        if (std::isdigit(static_cast<unsigned char>(c)) == 0 && c != '.') key += c;
      auto kind =
          std::find_if(kinds.begin(), kinds.end(), [&](const auto& entry) { return entry.first == key; });
      if (kind == kinds.end()) kind = kinds.insert(kinds.end(), {key, {warning, point.alpha_deg}});
      ++kind->second.flows;
    }
  }
  std::vector<std::string> sentences;
  for (const auto& [key, kind] : kinds) {
    char where[100];
    std::snprintf(where, sizeof where,
                  kind.flows == 1 ? " (%d flow, at %.6g degrees)" : " (%d flows, the first at %.6g degrees)",
                  kind.flows, kind.alpha_deg);
    sentences.push_back(kind.first + where);
  }
  return sentences;
}

}  // namespace remodel
