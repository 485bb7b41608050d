// Design problems by flows (remodel/design_run.h), with functions in Python.

#include <cmath>
#include <map>

#include "functionals.h"
#include "remodel/design_run.h"
#include "run_watch.h"

namespace remodel::python {
namespace {

// A function in Python in the place of the objective (none) or of a constraint of the problem.
struct OwnFunction {
  std::optional<std::size_t> constraint;
  bool of_design;  // else of a flow
  py::object call;
  std::string name;
};
using OwnFunctions = std::vector<OwnFunction>;

// (value, dict of derivatives).
FlowValue flow_value_of(const py::tuple& answer, const std::string& name, std::size_t size) {
  static const std::map<std::string, double FlowValue::*> by_coefficient = {
      {"cl", &FlowValue::by_lift},
      {"cd", &FlowValue::by_drag},
      {"cm", &FlowValue::by_moment},
      {"cd_pressure", &FlowValue::by_pressure_drag}};
  FlowValue result{.value = answer[0].cast<double>()};
  for (const auto& [key, values] : answer[1].cast<py::dict>()) {
    const auto part = key.cast<std::string>();
    const std::string place = name + ", gradient, " + part;
    if (const auto found = by_coefficient.find(part); found != by_coefficient.end()) {
      result.*found->second = values.cast<double>();
      continue;
    }
    if (!result.by_flow) result.by_flow = zero_functional(size);
    if (!add_field(*result.by_flow, part, place, values, size))
      throw Error(
          ErrorCode::argument, place,
          "is no part of a gradient, expected cl, cd, cm, cd_pressure, mach, points, pressure, density, "
          "velocity_x or velocity_y");
  }
  return result;
}

FlowFunctionOf flow_function(const OwnFunction& own, Watch& watch) {
  return [own = &own, &watch](const FlowView& of) {
    auto flow = std::make_shared<FlowResult>(of.flow);
    auto mesh = std::make_shared<FrozenMesh>(of.frozen);
    const std::size_t size = mesh->points.size();
    return watch.ask([&] {
      py::object given = py::cast(std::move(flow));
      given.attr("mesh") = std::move(mesh);
      return flow_value_of(own->call(given).cast<py::tuple>(), own->name, size);
    });
  };
}

DesignFunctionOf design_function(const OwnFunction& own, Watch& watch) {
  return [own = &own, &watch](const DesignView& of) {
    return watch.ask([&] {
      const std::vector<double> design(of.design.begin(), of.design.end());
      std::vector<DesignValue> values;
      for (const auto& entry : own->call(copied(design), Domain(of.domain)).cast<py::list>()) {
        const auto pair = entry.cast<py::tuple>();
        values.push_back({.value = pair[0].cast<double>(),
                          .by_design = numbers_of(pair[1], own->name + ", gradient", design.size())});
      }
      return values;
    });
  };
}

// The problem's placeholders, by the functions that stand there.
void add_functions(const OwnFunctions& functions, Watch& watch, DesignProblem& problem) {
  for (const OwnFunction& own : functions) {
    if (!own.constraint) {
      problem.objective = own.name;
      problem.own_objective = flow_function(own, watch);
      continue;
    }
    DesignConstraint& constraint = problem.constraints.at(*own.constraint);
    if (own.of_design) {
      constraint = {.own_design = design_function(own, watch), .name = own.name};
    } else {
      constraint.kind.clear(), constraint.name = own.name;
      constraint.own_flow = flow_function(own, watch);
    }
  }
}

py::dict numbers_by_name(const std::vector<NamedNumber>& numbers) {
  py::dict result;
  for (const NamedNumber& number : numbers) result[py::str(number.name)] = number.value;
  return result;
}

py::object number_or_none(double value) {
  return std::isfinite(value) ? py::object(py::float_(value)) : py::none();
}

py::dict dict_of(const DesignResult& result, const std::filesystem::path& directory) {
  const auto json = py::module_::import("json");
  py::dict figures = figures_dict(optimise_figures, result.search);
  figures["objective"] = number_or_none(result.search.objective);
  figures["start_objective"] = py::cast(result.start_objective);
  figures["stopped"] = result.stopped, figures["converged"] = result.converged;
  figures["detail"] = result.detail;
  figures["best_design"] = copied(result.search.best_design);
  figures["best"] = json.attr("loads")(result.best);
  figures["outputs"] = result.search.outputs;
  figures["named"] = numbers_by_name(result.named);
  figures["constraints"] = numbers_by_name(result.constraints);
  figures["flows"] = result.flows, figures["gradients"] = result.gradients;
  figures["replacements"] = result.replacements;
  figures["cold_equivalents"] = py::cast(result.cold_equivalents);
  figures["verified"] = json.attr("loads")(fresh_json(result.verified));
  figures["verified_start"] = json.attr("loads")(fresh_json(result.verified_start));
  figures["stages"] = json.attr("loads")(stages_json(result.stages));
  figures["rows"] = rows_of(directory / "history.sqlite");
  return figures;
}

py::dict designed(const std::string& text, const std::string& source,
                  const std::optional<CstAirfoil>& airfoil, const std::optional<CstAirfoil>& target,
                  const py::list& functions, const std::optional<DesignStart>& start,
                  const DesignRunOptions& options, const py::object& callback) {
  OwnFunctions own;
  for (const auto& entry : functions) {
    const auto row = entry.cast<py::tuple>();
    own.push_back({row[0].cast<std::optional<std::size_t>>(), row[1].cast<bool>(), row[2].cast<py::object>(),
                   row[3].cast<std::string>()});
  }
  Watch watch(callback);
  DesignProblem problem = parse_design_problem(text, source);
  if (airfoil) problem.airfoil = *airfoil;
  if (target) problem.target = *target;
  if (start) problem.start = start;
  add_functions(own, watch, problem);
  if (airfoil || target || !own.empty()) problem.text.clear();  // no text has these
  problem = watch.raising([&] { return with_first_design(std::move(problem), source); });
  py::list warnings;
  for (const std::string& warning : problem.warnings) warnings.append(warning);
  const DesignResult result = watch.raising([&] {
    py::gil_scoped_release released;
    return run_design(problem, options, &watch);
  });
  watch.interrupts.rethrow();
  py::dict figures = dict_of(result, options.directory);
  figures["warnings"] = warnings;
  return figures;
}

}  // namespace

void add_designs(py::module_& module) {
  module.def(
      "_design",
      [](const std::string& text, const std::string& source, const std::optional<CstAirfoil>& airfoil,
         const std::optional<CstAirfoil>& target, const py::list& functions,
         const std::optional<std::filesystem::path>& history, const std::optional<std::uint64_t>& design,
         const std::filesystem::path& directory, bool resume, bool overwrite, std::size_t threads,
         const py::object& callback) {
        std::optional<DesignStart> start;
        if (history) start = DesignStart{.history = *history, .design = design};
        return designed(
            text, source, airfoil, target, functions, start,
            {.directory = directory, .resume = resume, .overwrite = overwrite, .threads = threads}, callback);
      },
      "text"_a, "source"_a, "airfoil"_a, "target"_a, "functions"_a, "history"_a, "design"_a, "directory"_a,
      "resume"_a, "overwrite"_a, "threads"_a, "callback"_a);
  module.def(
      "_design_page",
      [](const std::filesystem::path& directory, const std::filesystem::path& page) {
        std::string figures;
        {
          py::gil_scoped_release released;
          figures = write_design_page(directory, page);
        }
        return py::module_::import("json").attr("loads")(figures);
      },
      "directory"_a, "page"_a);
}

}  // namespace remodel::python
