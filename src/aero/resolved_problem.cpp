#include "aero/resolved_problem.h"

#include <algorithm>
#include <cmath>

#include "aero/deformed_space.h"
#include "aero/element_space.h"
#include "aero/first_design.h"
#include "aero/layered_space.h"
#include "aero/problem_openings.h"
#include "aero/section_space.h"
#include "remodel/flow_layer.h"

namespace remodel {
namespace {

constexpr std::size_t most_functions = 10000;  // of all constraints together: with more a search does not end

// A function of the problem's user.
class OwnFlowFunction final : public FlowFunction {
 public:
  explicit OwnFlowFunction(FlowFunctionOf function) : function_(std::move(function)) {}
  FlowValue at(const FlowView& of) const override { return function_(of); }

 private:
  FlowFunctionOf function_;
};

class OwnDomainConstraint final : public DomainConstraint {
 public:
  OwnDomainConstraint(DesignFunctionOf function, const FlowSpace& space)
      : function_(std::move(function)), numbers_(space.start().size()) {
    const std::vector<double> start = space.start();
    count_ = function_({space, start, space.domain(start)}).size();
  }
  std::size_t count() const override { return count_; }
  std::vector<DesignValue> at(const DesignView& of) const override {
    std::vector<DesignValue> values = function_(of);
    if (values.size() != count_)
      throw Error(ErrorCode::argument, "own_design",
                  "found " + std::to_string(values.size()) + " values, expected " + std::to_string(count_) +
                      " as of the start");
    for (const DesignValue& value : values)
      if (value.by_design.size() != numbers_)
        throw Error(ErrorCode::argument, "own_design",
                    "found " + std::to_string(value.by_design.size()) + " derivatives, expected " +
                        std::to_string(numbers_));
    return values;
  }

 private:
  DesignFunctionOf function_;
  std::size_t numbers_, count_ = 0;
};

bool is_own(const DesignConstraint& constraint) {
  return constraint.own_flow || constraint.own_design;
}

// Which members a constraint may have.
struct Members {
  bool x = false, airfoil = false, between = false, point = false, at_most = false, of_start = false,
       at_least = false, element = false;
};

Members members_of(const FlowKind& kind, bool has_elements) {
  return {.point = true,
          .at_most = kind.at_most.has_value(),
          .at_least = kind.at_least.has_value(),
          .element = has_elements && kind.of_element};
}

Members members_of(const DomainKind& kind, bool has_elements) {
  return {.x = kind.takes_x,
          .airfoil = kind.takes_airfoil,
          .between = kind.takes_between,
          .at_most = kind.takes_most,
          .of_start = kind.takes_start,
          .at_least = kind.takes_least,
          .element = has_elements && kind.of_section};
}

// Throws for members that a constraint of this kind has no use for.
void require_members(const DesignConstraint& of, const Members& may, const ProblemPlace& place) {
  const auto refuse = [&](bool given, bool useful, const char* key) {
    if (given && !useful)
      place.fail("found the key '" + std::string(key) + "', which '" + (of.kind.empty() ? "own" : of.kind) +
                 "' has not");
  };
  refuse(of.x.has_value(), may.x, "x");
  refuse(of.airfoil.has_value(), may.airfoil, "airfoil");
  refuse(of.between.has_value(), may.between, "between");
  refuse(of.point.has_value(), may.point, "point");
  refuse(of.at_most.has_value(), may.at_most, "at_most");
  refuse(of.of_start.has_value(), may.of_start, "of_start");
  refuse(of.at_least.has_value(), may.at_least, "at_least");
  refuse(of.element.has_value(), may.element, "element");
}

void require_surfaces(const CstAirfoil& airfoil, const ProblemPlace& place, const char* key) {
  if (airfoil.upper.size() != airfoil.lower.size() || airfoil.upper.size() < 2)
    place.fail("found " + shown(airfoil.upper.size()) + " and " + shown(airfoil.lower.size()) +
               " coefficients of the surfaces of '" + key + "', expected as many of both, 2 or more");
}

class Resolver {
 public:
  Resolver(const DesignProblem& problem, const std::string& source) : problem_(problem), place_(source) {}

  ResolvedProblem result() {
    require_sections();
    require_points();
    resolve_objective();
    for (std::size_t i = 0; i < problem_.constraints.size(); ++i) resolve_flow_limit(i);
    make_space();
    std::vector<std::size_t> of_domain;  // behind those of sections
    for (std::size_t i = 0; i < problem_.constraints.size(); ++i) {
      const DomainKind* kind = find_domain_kind(problem_.constraints[i].kind);
      if (!is_own(problem_.constraints[i]) && kind != nullptr && kind->of_section)
        resolve_domain_limit(i);
      else
        of_domain.push_back(i);
    }
    for (const std::size_t i : of_domain) resolve_domain_limit(i);
    place_.require_number(problem_.constraint_tolerance, "constraint_tolerance", {0.0, 1.0});
    require_weights();
    require_designer();
    resolved_.first_design = first_design_of(problem_, *resolved_.space, place_);
    return std::move(resolved_);
  }

 private:
  ProblemPlace place_of(const char* what, std::size_t index) const {
    return place_.inner(std::string(what) + " " + std::to_string(index + 1));
  }

  void require_sections() const {
    const bool has_airfoil = !problem_.airfoil.upper.empty() || !problem_.airfoil.lower.empty();
    if (has_airfoil + !problem_.elements.empty() + problem_.deformation.has_value() != 1)
      place_.fail("expected one of 'airfoil', 'elements' and 'space'");
    if (has_airfoil) require_surfaces(problem_.airfoil, place_, "airfoil");
    for (std::size_t i = 0; i < problem_.elements.size(); ++i)
      require_surfaces(problem_.elements[i].airfoil, place_of("element", i), "airfoil");
    if (problem_.target) require_surfaces(*problem_.target, place_, "target");
    if (!problem_.text.empty() && !nlohmann::json::parse(problem_.text, nullptr, false).is_object())
      place_.fail("found a 'text' that is no JSON object");
    if (!has_airfoil && problem_.symmetric)
      place_.fail("found 'symmetric' with '" + instead_of_airfoil() + "', expected 'airfoil'");
    if (problem_.gradation)
      place_.inner("mesh").require_number(*problem_.gradation, "gradation", {0.1, 1000.0});
    place_.inner("mesh").require_number(problem_.domain.farfield_radius, "farfield_radius", {2.0, 1e6});
    require_increasing_points();
  }

  void require_increasing_points() const {
    int before = 7;
    std::vector<int> all = problem_.coarse_points;
    all.push_back(problem_.domain.points);
    for (const int points : all) {
      if (all.size() > 1 && (points <= before || points > 100000))
        place_.inner("mesh").fail("found " + shown(all) +
                                  " as 'points', expected meshes from coarse to fine, of 8 "
                                  "to 100000 points");
      before = points;
    }
  }

  std::string instead_of_airfoil() const { return problem_.deformation ? "space" : "elements"; }

  void require_given_domain() const {
    if (!problem_.deformation) return;
    try {
      validate(problem_.deformation->domain);
    } catch (const Error& error) {
      place_.inner("space").fail("found a domain that is none: " + std::string(error.what()));
    }
  }

  void require_points() const {
    require_given_domain();
    if (problem_.points.empty()) place_.fail("expected at least one point of 'flow'");
    for (std::size_t i = 0; i < problem_.points.size(); ++i) {
      const FlowConditions& conditions = problem_.points[i].conditions;
      const FlowModel model = problem_.points[i].model;
      const ProblemPlace place = place_of("flow", i);
      place.require_number(conditions.mach, "mach", {0.01, 3.0});
      place.require_number(conditions.alpha_deg, "alpha_deg", {-90.0, 90.0});
      if (conditions.cl) place.require_number(*conditions.cl, "cl", {-10.0, 10.0});
      if (conditions.cl && conditions.mach > 1.0)
        place.fail(
            "found 'cl' with a 'mach' above 1, expected 'alpha_deg': lift is given below the speed of sound");
      place.require_number(problem_.points[i].weight, "weight", {0.0, 1e6});
      require_openings_of(problem_.points[i], place);
      if (has_friction() != (model != FlowModel::euler))
        place.fail("found the model " + shown(name_of(model)) +
                   " beside points of another kind, expected friction at all points or at none");
      if (conditions.transition) {
        if (model != FlowModel::sa)
          place.fail("found 'transition' with the model " + shown(name_of(model)) + ", expected \"sa\"");
        for (const double x : *conditions.transition) place.require_number(x, "transition", {0.0, 1.0});
      }
      if (has_friction()) place.require_number(conditions.reynolds, "reynolds", {1.0, 1e10});
      if (!has_friction() && conditions.reynolds != 0.0)
        place.fail("found 'reynolds' with the model \"euler\", expected \"laminar\" or \"sa\" as 'model'");
    }
    require_layer();
  }

  void require_openings_of(const DesignPoint& point, const ProblemPlace& place) const {
    const bool has_any = !point.inlets.empty() || !point.outlets.empty() || !point.symmetry.empty();
    if (has_any && !problem_.deformation)
      place.fail("found 'inlets', 'outlets' or 'symmetry', expected them with 'space'");
    if (problem_.deformation) require_openings(point, problem_.deformation->domain, place);
  }

  bool has_friction() const { return problem_.points.front().model != FlowModel::euler; }

  void require_layer() const {
    if ((problem_.layer || problem_.wake) && !has_friction())
      place_.inner("mesh").fail(std::string("found '") + (problem_.layer ? "layers" : "wake") +
                                "' without friction, expected 'model' and 'reynolds' at all points");
    constexpr int least_points = 150;
    const int coarsest =
        problem_.coarse_points.empty() ? problem_.domain.points : problem_.coarse_points.front();
    if (has_friction() && coarsest < least_points)
      place_.inner("mesh").fail("found " + shown(coarsest) + " as 'points' with friction, expected " +
                                shown(least_points) + " or more; " + shown(usual_points_with_friction) +
                                " are usual");
  }

  // Each function once: constraints of one kind share what it takes.
  std::size_t index_of(const FlowKind& kind, std::optional<std::size_t> section) {
    const auto same = [&](const auto& known) { return known.kind == &kind && known.section == section; };
    const auto found = std::find_if(known_.begin(), known_.end(), same);
    if (found != known_.end()) return found->index;
    resolved_.functions.push_back(kind.make(section));
    known_.push_back({&kind, section, resolved_.functions.size() - 1});
    return known_.back().index;
  }

  void resolve_objective() {
    if (problem_.own_objective) {
      resolved_.functions.push_back(std::make_shared<OwnFlowFunction>(problem_.own_objective));
    } else {
      place_.require_word(problem_.objective, "objective", objective_names());
      const FlowKind& kind = *find_flow_kind(problem_.objective);
      resolved_.sense = kind.objective;
      index_of(kind, std::nullopt);
    }
    const FlowFunction& objective = *resolved_.functions.front();
    require_friction(objective, place_, problem_.objective);
    for (const DesignPoint& point : problem_.points)
      if (objective.is_given(point.conditions))
        place_.fail("found the objective '" + problem_.objective + "' with 'cl', expected 'alpha_deg' alone");
    const bool has_airfoil = problem_.elements.empty() && !problem_.deformation;
    if (objective.needs_target() && !has_airfoil)
      place_.fail("found the objective '" + problem_.objective + "' with '" + instead_of_airfoil() +
                  "', expected 'airfoil'");
    require_farfield_for(objective, place_, problem_.objective);
    for (std::size_t i = 0; i < problem_.points.size(); ++i)
      require_openings_for(objective, problem_.points[i], place_of("flow", i), problem_.objective);
    if (objective.needs_target()) place_.given(problem_.target, "target");
    if (!objective.needs_target() && !problem_.own_objective && problem_.target)
      place_.fail("found 'target' with the objective '" + problem_.objective + "', expected 'inverse'");
    if (problem_.target && !has_airfoil)
      place_.fail("found 'target' with '" + instead_of_airfoil() + "', expected 'airfoil'");
  }

  static void require_openings_for(const FlowFunction& function, const DesignPoint& point,
                                   const ProblemPlace& place, const std::string& kind) {
    if (function.needs_outlets() && point.outlets.empty())
      place.fail("found '" + kind + "' without 'outlets', expected one or more");
    if (function.is_of_walls() && (!point.inlets.empty() || !point.outlets.empty()))
      place.fail("found '" + kind + "' with inlets or outlets, expected a far field alone");
  }

  // Lift of a duct's walls is that of half of them, or none; that of a blade in a row is its own.
  void require_farfield_for(const FlowFunction& function, const ProblemPlace& place,
                            const std::string& kind) const {
    if (!function.needs_farfield() || !problem_.deformation) return;
    if (!problem_.deformation->domain.periodic.empty()) return;
    for (const Loop& loop : problem_.deformation->domain.loops)
      for (const Curve& curve : loop.curves)
        if (curve.name == "farfield") return;
    place.fail("found '" + kind +
               "' with a domain without a curve 'farfield', expected drag, moment, mass_flow, "
               "total_pressure, pressure_loss or flow_angle");
  }

  void require_friction(const FlowFunction& function, const ProblemPlace& place,
                        const std::string& kind) const {
    if (function.needs_friction() && !has_friction())
      place.fail("found '" + kind + "' without friction, expected 'model' and 'reynolds' at all points");
  }

  std::string name_of_constraint(std::size_t index) const {
    const DesignConstraint& constraint = problem_.constraints[index];
    if (!constraint.name.empty()) return constraint.name;
    const std::string& kind = is_own(constraint) && constraint.kind.empty() ? "own" : constraint.kind;
    const bool is_only = std::count_if(problem_.constraints.begin(), problem_.constraints.end(),
                                       [&](const auto& other) { return other.kind == constraint.kind; }) == 1;
    return is_only ? kind : kind + " (constraint " + std::to_string(index + 1) + ")";
  }

  // Also says of every other constraint whether its kind is known and its members of use.
  void resolve_flow_limit(std::size_t index) {
    const DesignConstraint& constraint = problem_.constraints[index];
    const ProblemPlace place = place_of("constraint", index);
    const bool has_elements = !problem_.elements.empty();
    if (constraint.airfoil) require_surfaces(*constraint.airfoil, place, "airfoil");
    if (constraint.own_flow && constraint.own_design)
      place.fail("found own_flow and own_design, expected one of them");
    if (constraint.own_design) return require_members(constraint, {}, place);
    if (!constraint.own_flow) {
      place.require_word(constraint.kind, "kind", constraint_kinds());
      if (const DomainKind* kind = find_domain_kind(constraint.kind))
        return require_members(constraint, members_of(*kind, has_elements || problem_.deformation), place);
    }
    constexpr Limits any = {-1e300, 1e300};
    const FlowKind own = {.name = "own", .at_least = any, .at_most = any};
    const FlowKind& kind = constraint.own_flow ? own : *find_flow_kind(constraint.kind);
    require_members(constraint, members_of(kind, has_elements), place);
    if (kind.at_least && kind.at_most && constraint.at_least.has_value() == constraint.at_most.has_value())
      place.fail("expected one of at_least and at_most");
    ResolvedProblem::FlowLimit limit{.point = constraint.point.value_or(0),
                                     .name = name_of_constraint(index)};
    if (limit.point >= problem_.points.size())
      place.fail("found " + shown(limit.point) + " as 'point', expected a whole number from 0 to " +
                 shown(problem_.points.size() - 1));
    const bool is_upper = !constraint.at_least;
    limit.limit = is_upper ? place.given(constraint.at_most, "at_most") : *constraint.at_least;
    place.require_number(limit.limit, is_upper ? "at_most" : "at_least",
                         is_upper ? *kind.at_most : *kind.at_least);
    std::optional<std::size_t> section;
    if (constraint.element) section = element_index(problem_, *constraint.element, place);
    if (constraint.own_flow) {
      limit.function = resolved_.functions.size();
      resolved_.functions.push_back(std::make_shared<OwnFlowFunction>(constraint.own_flow));
    } else {
      limit.function = index_of(kind, section);
    }
    const FlowFunction& function = *resolved_.functions[limit.function];
    require_friction(function, place, constraint.kind);
    require_openings_for(function, problem_.points[limit.point], place, constraint.kind);
    require_farfield_for(function, place, constraint.kind);
    if (function.is_given(problem_.points[limit.point].conditions))
      place.fail("found '" + constraint.kind +
                 "' of a point whose 'cl' is given, expected 'alpha_deg' alone there");
    limit.factor = (is_upper ? 1.0 : -1.0) / function.unit(limit.limit);
    resolved_.flow.push_back(std::move(limit));
  }

  // Whether all flows are their own mirror images, so that half of each says all: a symmetric section closed
  // behind, along the x axis, and no word of lift, moment or suction.
  bool is_half() const {
    const auto along_axis = [](const DesignPoint& point) {
      return point.conditions.alpha_deg == 0.0 && !point.conditions.cl;
    };
    const auto is_even = [](const FlowFunctionPtr& function) { return function->is_even(); };
    return problem_.symmetric && problem_.airfoil.te_upper == 0.0 && !has_friction() &&
           std::all_of(problem_.points.begin(), problem_.points.end(), along_axis) &&
           std::all_of(resolved_.functions.begin(), resolved_.functions.end(), is_even);
  }

  // All points have one mesh, and so the same walls.
  std::vector<std::string> walls_of_points(const Domain& domain) const {
    const auto walls_of = [&](const DesignPoint& point) {
      return walls_of_flow(domain,
                           {.inlets = point.inlets, .outlets = point.outlets, .symmetry = point.symmetry});
    };
    const std::vector<std::string> walls = walls_of(problem_.points.front());
    for (const DesignPoint& point : problem_.points)
      if (walls_of(point) != walls)
        throw Error(ErrorCode::argument, "points",
                    "found points of flow with other walls than the first, expected the same inlets, outlets "
                    "and symmetry where there is friction");
    return walls;
  }

  void make_space() {
    make_space_of_bodies();
    if (!has_friction()) return;
    try {
      LayerOptions layer =
          problem_.layer.value_or(layer_for_points(problem_.points, problem_.deformation.has_value()));
      if (problem_.deformation) layer.walls = walls_of_points(problem_.deformation->domain);
      resolved_.space = std::make_unique<LayeredSpace>(std::move(resolved_.space), layer,
                                                       problem_.domain.points, problem_.wake);
    } catch (const Error& error) {
      const std::string why = error.what();
      const bool by_wake = problem_.wake && why.find("wake") != std::string::npos;
      place_.inner("mesh").fail(std::string("found ") + (by_wake ? "a 'wake'" : "'layers'") +
                                " that no walls can have: " + why);
    }
    if (resolved_.target) put_layer_on_target();
  }

  // With the start's stations and wake. What comes of it is not needed here but for whether there is any.
  void put_layer_on_target() {
    const Domain walls = resolved_.space->walls(resolved_.space->start());
    if (problem_.wake) resolved_.target->loops.push_back(walls.loops.back());
    resolved_.target = with_stations(std::move(*resolved_.target), stations_of(walls));
    try {
      resolved_.space->layers()->outside(*resolved_.target);
    } catch (const Error& error) {
      place_.fail("found a 'target' that has no layer: " + std::string(error.what()));
    }
  }

  void make_space_of_bodies() {
    if (problem_.deformation) return make_deformed_space();
    if (!problem_.elements.empty()) {
      resolved_.space = std::make_unique<ElementSpace>(space_of_elements(problem_, place_));
      return;
    }
    const CstAirfoil start =
        problem_.symmetric ? symmetric_start(problem_.airfoil, place_) : problem_.airfoil;
    auto space = std::make_unique<SectionSpace>(
        start,
        SectionSpaceOptions{.symmetric = problem_.symmetric, .half = is_half(), .domain = problem_.domain});
    try {
      validate(space->domain(space->start()));
    } catch (const Error& error) {
      place_.fail("found an airfoil as 'airfoil' that makes no domain: " + std::string(error.what()));
    }
    if (problem_.target) resolved_.target = space->domain_of(*problem_.target, problem_.domain.points);
    resolved_.space = std::move(space);
  }

  void make_deformed_space() {
    const ProblemPlace place = place_.inner("space");
    const Domain& start = problem_.deformation->domain;
    if (problem_.domain.points < 3 || problem_.domain.points > 100000)
      place_.inner("mesh").require_number(problem_.domain.points, "points", {3.0, 1e5});
    auto space = std::make_unique<DeformedSpace>(start, variables_of(*problem_.deformation, place),
                                                 problem_.domain.points);
    moving_ = space->moving_loops();
    try {
      validate(space->domain(space->start()));
    } catch (const Error& error) {
      place_.inner("mesh").fail("found 'points' with which there is no domain: " + std::string(error.what()));
    }
    resolved_.space = std::move(space);
  }

  void resolve_domain_limit(std::size_t index) {
    const DesignConstraint& constraint = problem_.constraints[index];
    if (constraint.own_flow) return;
    const ProblemPlace place = place_of("constraint", index);
    DomainConstraintPtr made;
    if (constraint.own_design) {
      made = std::make_shared<OwnDomainConstraint>(constraint.own_design, *resolved_.space);
    } else if (const DomainKind* kind = find_domain_kind(constraint.kind)) {
      const DomainRequest request = request_of(constraint, *kind, place);
      made = problem_.deformation ? kind->make_of_loop(request) : kind->make(request);
    } else {
      return;
    }
    functions_ += made->count();
    if (functions_ + resolved_.flow.size() > most_functions)
      place_.fail("found " + std::to_string(functions_ + resolved_.flow.size()) +
                  " entries in 'constraints, counting stations', expected at most " +
                  std::to_string(most_functions));
    resolved_.domain.push_back({std::move(made), name_of_constraint(index)});
  }

  DomainRequest request_of(const DesignConstraint& constraint, const DomainKind& kind,
                           const ProblemPlace& place) const {
    DomainRequest request{
        .given = constraint, .problem = problem_, .place = place, .symmetric = problem_.symmetric};
    if (problem_.deformation) {
      if (kind.make_of_loop == nullptr)
        place.fail("found '" + constraint.kind + "' with 'space', expected area, thickness, or one of flows");
      request.start_domain = resolved_.space->walls(resolved_.space->start());
      request.section = loop_of(constraint, request.start_domain, place);
    } else if (kind.of_section) {
      if (!problem_.elements.empty()) {
        const std::string& name = place.given(constraint.element, "element");
        request.section = request.element(name);
        if (!problem_.elements[request.section].coefficients)
          place.fail("found '" + name + "' as 'element', whose coefficients are no variables");
      }
      request.start = resolved_.space->section(resolved_.space->start(), request.section);
    }
    if (kind.takes_least && kind.takes_start) {
      if (constraint.at_least.has_value() == constraint.of_start.has_value())
        place.fail("expected one of at_least and of_start");
    } else if (kind.takes_least && !kind.takes_most) {
      place.given(constraint.at_least, "at_least");
    }
    return request;
  }

  // The loop that a constraint of a deformed domain is of.
  std::size_t loop_of(const DesignConstraint& constraint, const Domain& domain,
                      const ProblemPlace& place) const {
    std::vector<std::string> names;
    std::optional<std::size_t> found;
    for (const std::size_t loop : moving_)
      for (const Curve& curve : domain.loops[loop].curves) {
        names.push_back(curve.name);
        if (constraint.element != curve.name || found == loop) continue;
        if (found)
          place.fail("found '" + curve.name +
                     "' as 'element', the name of curves of several loops that move, expected "
                     "that of one");
        found = loop;
      }
    if (!constraint.element && moving_.size() == 1) found = moving_.front();
    if (!found) place.require_word(place.given(constraint.element, "element"), "element", names);
    if (domain.loops[*found].open) place.fail("found an open chain, expected a closed loop");
    return *found;
  }

  // A point without a weight is looked at for its constraints alone.
  void require_weights() const {
    bool any = false;
    for (std::size_t i = 0; i < problem_.points.size(); ++i) {
      any = any || problem_.points[i].weight > 0.0;
      const bool is_constrained = std::any_of(resolved_.flow.begin(), resolved_.flow.end(),
                                              [&](const auto& limit) { return limit.point == i; });
      if (problem_.points[i].weight == 0.0 && !is_constrained)
        place_of("flow", i).fail(
            "found 0 as 'weight' of a point that no constraint names, expected a number above 0");
    }
    if (!any) place_.fail("found 0 as 'weight' of each point of 'flow', expected a number above 0 of one");
  }

  void require_designer() const {
    const ProblemPlace place = place_.inner("designer");
    place.require_word(problem_.designer, "name", designer_names());
    place.require_number(static_cast<double>(problem_.evaluations), "evaluations", {1.0, 1e6});
    place.require_number(problem_.bounds, "bounds", {1e-9, 10.0});
    place.require_number(problem_.trust, "trust", {1e-6, 10.0});
    place.require_number(problem_.sigma, "sigma", {1e-9, 10.0});
    for (const int points : problem_.verify) {
      if (points < 8 || points > 100000)
        place_.fail("found " + shown(points) + " as 'verify', expected a whole number from 8 to 100000");
      if (points % 2 != 0 && !problem_.deformation)
        place_.fail("found " + shown(points) + " in 'verify', expected even numbers");
    }
  }

  struct Known {
    const FlowKind* kind;
    std::optional<std::size_t> section;
    std::size_t index;
  };

  const DesignProblem& problem_;
  ProblemPlace place_;
  ResolvedProblem resolved_;
  std::vector<Known> known_;
  std::vector<std::size_t> moving_;  // loops of a deformed domain
  std::size_t functions_ = 0;
};

}  // namespace

LayerOptions layer_for_points(const std::vector<DesignPoint>& points, bool of_domain) {
  std::optional<LayerOptions> layer;
  for (const DesignPoint& point : points) {
    const double reference = point.conditions.reference_length, chord = of_domain ? reference : 1.0;
    LayerOptions own = layer_for_flow(point.model, point.conditions.reynolds * (chord / reference));
    own.first_height *= chord, own.thickness *= chord;
    if (!layer) layer = own;
    layer->first_height = std::min(layer->first_height, own.first_height);
    layer->thickness = std::max(layer->thickness, own.thickness);
  }
  return layer.value();
}

ResolvedProblem resolved(const DesignProblem& problem, const std::string& source) {
  return Resolver(problem, source).result();
}

std::vector<std::string> ResolvedProblem::names() const {
  std::vector<std::string> names;
  for (const DomainLimit& limit : domain) names.insert(names.end(), limit.constraint->count(), limit.name);
  for (const FlowLimit& limit : flow) names.push_back(limit.name);
  return names;
}

}  // namespace remodel
