#include "remodel/polar.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

#include "aero/flow_rows.h"
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

// The rows of one mesh.
PolarResult find_rows(const aero::FlowRows::Solve& solve, const std::string& name,
                      const PolarOptions& options) {
  const Stopwatch watch;
  const bool over_lift = options.alphas_deg.empty();
  const std::vector<double>& values = over_lift ? options.lifts : options.alphas_deg;
  aero::FlowRows rows(options.flow, {.halvings = options.halvings, .misses = options.misses}, over_lift,
                      false);
  PolarResult result;
  for (const double mach : options.machs) {
    FlowConditions conditions = options.conditions;
    conditions.mach = mach;
    const auto before = [&](double value) {
      if (options.on_search) options.on_search(mach, value);
    };
    const aero::March row = rows.march(conditions, values, solve, {.before = before, .found = {}});
    PolarCurve& curve = result.curves.emplace_back();
    curve.name = name, curve.model = options.flow.model, curve.mach = mach, curve.over_lift = over_lift;
    if (curve.model != FlowModel::euler) curve.reynolds = options.conditions.reynolds;
    for (const aero::MarchedFlow& flow : row.flows) curve.points.push_back(aero::point_of(flow, over_lift));
    result.interrupted = row.interrupted;
    if (row.interrupted) break;
  }
  result.seconds = watch.seconds();
  return result;
}

}  // namespace

PolarResult find_polar(const Mesh& mesh, const std::string& name, const PolarOptions& options) {
  require_possible_polar(options);
  const auto solve = [&](LivingFlow& living, const FlowConditions& conditions) {
    return living.solve(mesh, conditions);
  };
  return find_rows(solve, name, options);
}

PolarResult find_polar(const FrozenMesh& given, const std::string& name, const PolarOptions& options) {
  require_possible_polar(options);
  FrozenMesh mesh = given;
  if (mesh.vertex_keys.empty())  // of another program: one mesh for all flows
    for (std::size_t i = 0; i < mesh.points.size(); ++i) mesh.vertex_keys.push_back(i);
  const auto solve = [&](LivingFlow& living, const FlowConditions& conditions) {
    return living.solve(mesh, conditions);
  };
  return find_rows(solve, name, options);
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
