// Noise along a line of designs (remodel/noise.h), of flows or of an objective in Python.

#include "remodel/noise.h"

#include <limits>

#include "python_evaluator.h"
#include "remodel/design_space.h"
#include "remodel/flow_noise.h"

namespace remodel::python {
namespace {

// By name: values of all designs (NaN: none), figures of the fit, the adjoint's slope.
py::dict dict_of(const NoiseSeries& series, const std::vector<std::string>& names) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  py::dict values, rms, slope, slope_error, step, step_error, adjoint;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const py::str name(names[k]);
    std::vector<double> column;
    for (const std::vector<double>& design : series.values)
      column.push_back(design.empty() ? none : design[k]);
    values[name] = copied(column);
    const LineFit fit = series.fits.empty() ? LineFit{none, none, none, none, none, {}} : series.fits[k];
    rms[name] = fit.rms, slope[name] = fit.slope, slope_error[name] = fit.slope_error;
    step[name] = fit.step, step_error[name] = fit.step_error;
    if (!series.adjoint.empty()) adjoint[name] = series.adjoint[k];
  }
  return py::dict("values"_a = values, "rms"_a = rms, "slope"_a = slope, "slope_error"_a = slope_error,
                  "step"_a = step, "step_error"_a = step_error, "adjoint"_a = adjoint,
                  "failures"_a = series.failures);
}

py::dict measured(const CstAirfoil& shape, const py::object& function, double mach, double alpha,
                  double tolerance, int points, const NoiseOptions& given) {
  Watch watch{py::none()};
  NoiseOptions options = given;
  options.quality.gradation = points / 50.0;
  options.observer = &watch.interrupts;
  const AirfoilSpace space(shape, {.points = points});
  std::optional<PythonEvaluator> evaluator;
  std::unique_ptr<LineObjective> objective;
  if (function.is_none()) {
    objective = flow_line_objective({.mach = mach, .alpha_deg = alpha}, FlowOptions{.tolerance = tolerance});
  } else {
    evaluator.emplace(function, watch);
    objective = line_objective(*evaluator);
  }
  NoiseResult result;
  {
    py::gil_scoped_release released;
    result = measure_noise(space, *objective, options);
  }
  watch.interrupts.rethrow();
  py::dict figures("names"_a = result.names, "places"_a = copied(result.places),
                   "stopped"_a = name_of(result.stopped));
  for (const NoiseSeries& series : result.series)
    figures[name_of(series.meshes)] = dict_of(series, result.names);
  return figures;
}

}  // namespace

void add_noise(py::module_& module) {
  module.def(
      "_noise",
      [](const CstAirfoil& shape, const py::object& objective, double mach, double alpha, double tolerance,
         int points, const std::vector<double>& direction, double spacing, int count, int degree) {
        return measured(shape, objective, mach, alpha, tolerance, points,
                        {.direction = direction, .spacing = spacing, .count = count, .degree = degree});
      },
      "shape"_a, "objective"_a, "mach"_a, "alpha"_a, "tolerance"_a, "points"_a, "direction"_a, "spacing"_a,
      "count"_a, "degree"_a);
}

}  // namespace remodel::python
