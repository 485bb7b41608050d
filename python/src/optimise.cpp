// The library's own loop of a run, with an objective in Python or shape interpolation.

#include "remodel/optimise.h"

#include <cmath>

#include "living_layers.h"
#include "python_evaluator.h"

namespace remodel::python {
namespace {

OptimiseOptions options_of(const std::filesystem::path& directory, int points, double sigma,
                           std::uint64_t seed, std::size_t evaluations, double tolerance,
                           const std::string& strategy, std::size_t workers, std::size_t threads, bool resume,
                           bool overwrite) {
  OptimiseOptions options{.strategy = mesh_strategy(strategy),
                          .workers = workers,
                          .threads = threads,
                          .sigma = sigma,
                          .seed = seed,
                          .evaluations = evaluations,
                          .tolerance = tolerance,
                          .resume = resume,
                          .overwrite = overwrite,
                          .directory = directory};
  options.domain.points = points;
  options.quality.gradation = points / 50.0;
  return options;
}

// layers: None, or what generate_layered() is given: reynolds, model, first_height, thickness, growth,
// spacing, wake, wake_angle.
void add_layers_to(OptimiseOptions& options, const py::object& layers) {
  if (layers.is_none()) return;
  const auto [reynolds, model, first_height, thickness, growth, spacing, wake, wake_angle] =
      layers.cast<std::tuple<std::optional<double>, std::string, std::optional<double>, std::optional<double>,
                             double, double, std::optional<double>, double>>();
  options.layers =
      RunLayers{layer_of(reynolds, model, first_height, thickness, growth, {}), wall_spacing(spacing)};
  options.layers->wake = wake_line(wake, wake_angle);
  options.quality.gradation = 8.0;
}

py::dict optimised(const CstAirfoil& from, const py::object& objective, const OptimiseOptions& options,
                   const py::object& callback) {
  Watch watch(callback);
  OptimiseResult result;
  if (py::isinstance<CstAirfoil>(objective)) {
    const auto target = objective.cast<CstAirfoil>();
    py::gil_scoped_release released;
    result = optimise(from, target, options, &watch);
  } else {
    PythonEvaluator evaluator(objective, watch);
    py::gil_scoped_release released;
    result = optimise(from, evaluator, options, &watch);
  }
  watch.interrupts.rethrow();
  py::dict figures = figures_dict(optimise_figures, result);
  figures["best"] = result.best;
  figures["best_design"] = copied(result.best_design);
  figures["outputs"] = result.outputs;
  figures["rows"] = rows_of(options.directory / "history.sqlite");
  return figures;
}

}  // namespace

void add_optimise(py::module_& module) {
  module.def(
      "_optimise",
      [](const CstAirfoil& from, const py::object& objective, const std::filesystem::path& directory,
         int points, double sigma, std::uint64_t seed, std::size_t evaluations, double tolerance,
         const std::string& strategy, std::size_t workers, std::size_t threads, bool resume, bool overwrite,
         const py::object& callback, const py::object& layers) {
        OptimiseOptions options = options_of(directory, points, sigma, seed, evaluations, tolerance, strategy,
                                             workers, threads, resume, overwrite);
        add_layers_to(options, layers);
        return optimised(from, objective, options, callback);
      },
      "start"_a, "objective"_a, "directory"_a, "points"_a, "sigma"_a, "seed"_a, "evaluations"_a,
      "tolerance"_a, "strategy"_a, "workers"_a, "threads"_a, "resume"_a, "overwrite"_a, "callback"_a,
      "layers"_a);
}

}  // namespace remodel::python
