#pragma once

// The kinds of functions that a design problem may name: each is an object with its name, what it takes, and
// what makes it. A new one is a file that defines its kind, and a row of the table in kinds.cpp.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "aero/problem_place.h"
#include "remodel/design_problem.h"

namespace remodel {

// A function of a flow.
class FlowFunction {
 public:
  virtual ~FlowFunction() = default;
  virtual FlowValue at(const FlowView& of) const = 0;
  // Whether half of a flow that is its own mirror image says all of it.
  virtual bool is_even() const { return false; }
  virtual bool needs_target() const { return false; }
  virtual bool needs_friction() const { return false; }
  virtual bool needs_outlets() const { return false; }
  virtual bool needs_farfield() const { return false; }
  // Whether it looks at all walls, which are told from openings by their names alone.
  virtual bool is_of_walls() const { return false; }
  // Whether the conditions give its value, so that there is nothing to design.
  virtual bool is_given(const FlowConditions& conditions) const {
    static_cast<void>(conditions);
    return false;
  }
  // What the violation of a limit is counted in.
  virtual double unit(double limit) const {
    static_cast<void>(limit);
    return 1.0;
  }
};
using FlowFunctionPtr = std::shared_ptr<const FlowFunction>;

struct FlowKind {
  const char* name;
  // As an objective: 1 made small, -1 made large, 0 it is none.
  double objective = 0.0;
  // As a constraint: the values that a limit may have; without both it is none.
  std::optional<Limits> at_least = {}, at_most = {};
  bool of_element = false;  // as a constraint it may be of one of several sections
  // section: the element's loop in the domain; none: of all.
  FlowFunctionPtr (*make)(std::optional<std::size_t> section) = nullptr;

  bool is_constraint() const { return at_least || at_most; }
};

// Functions of the design, each of which is to be at most 0.
class DomainConstraint {
 public:
  virtual ~DomainConstraint() = default;
  virtual std::size_t count() const = 0;
  virtual std::vector<DesignValue> at(const DesignView& of) const = 0;
};
using DomainConstraintPtr = std::shared_ptr<const DomainConstraint>;

// What a constraint of the domain is made of.
struct DomainRequest {
  const DesignConstraint& given;
  const DesignProblem& problem;
  ProblemPlace place;
  std::size_t section = 0;   // of a constraint of a section
  CstAirfoil start = {};     // that section, as it is at the start
  Domain start_domain = {};  // of a deformed domain, of which `section` is a loop
  bool symmetric = false;

  std::size_t element(const std::string& name) const;  // its index; throws where there is none
  // The least value that the constraint asks for: at_least within the limits, or of_start, a part of this.
  double least(Limits limits, double of_start) const;
};

struct DomainKind {
  const char* name;
  bool of_section = true;  // otherwise of the whole domain
  // Beside at_least, which all but `contains` take.
  bool takes_least = true, takes_start = true, takes_most = false, takes_x = false, takes_airfoil = false,
       takes_between = false;
  DomainConstraintPtr (*make)(const DomainRequest& request) = nullptr;
  // Of a loop of a deformed domain; none: there is no such constraint of these.
  DomainConstraintPtr (*make_of_loop)(const DomainRequest& request) = nullptr;
};

std::span<const FlowKind* const> flow_kinds();
std::span<const DomainKind* const> domain_kinds();
// The stations `x` of a constraint, as they are: one or more.
const std::vector<double>& station_list_of(const DomainRequest& request);
const FlowKind* find_flow_kind(const std::string& name);  // null where there is none
const DomainKind* find_domain_kind(const std::string& name);

std::size_t element_index(const DesignProblem& problem, const std::string& name, const ProblemPlace& place);

}  // namespace remodel
