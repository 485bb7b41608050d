// Sweeps (remodel/sweep.h) as arrays.

#include <thread>

#include "bindings.h"
#include "interrupts.h"
#include "remodel/sweep.h"

namespace remodel::python {
namespace {

class SweepWatch final : public SweepObserver {
 public:
  explicit SweepWatch(py::object callback) : callback_(std::move(callback)) {}
  void finished(const SweepProgress& progress) override {
    const auto figures = [&] {
      return py::dict("flows"_a = progress.flows, "done"_a = progress.flows_done, "found"_a = progress.found);
    };
    callback_.tell(figures, interrupts);
  }
  bool cancelled() override { return callback_.ended() || interrupts.cancelled(); }

  Interrupts interrupts;

 private:
  Callback callback_;
};

template <class Of>
auto column_of(const std::vector<SweepFlow>& flows, Of of) {
  std::vector<decltype(of(flows.front()))> values;
  values.reserve(flows.size());
  for (const SweepFlow& flow : flows) values.push_back(of(flow));
  return values;
}

// Flows by twice the stations; not a number where there is no flow.
py::array surfaces(const std::vector<SweepFlow>& flows, std::size_t stations,
                   std::vector<double> SweepFlow::*member) {
  std::vector<double> values;
  for (const SweepFlow& flow : flows) {
    values.insert(values.end(), (flow.*member).begin(), (flow.*member).end());
    values.resize(values.size() + 2 * stations - (flow.*member).size(), PolarPoint::none);
  }
  return copied(values).reshape(
      {static_cast<py::ssize_t>(flows.size()), static_cast<py::ssize_t>(2 * stations)});
}

py::dict swept(const std::filesystem::path& directory) {
  const SweepProblem problem = read_sweep_problem(directory);
  const std::vector<SweepFlow> flows = read_sweep_flows(directory);
  py::list names, airfoils;
  for (const SweepSection& section : problem.sections) {
    names.append(section.name);
    airfoils.append(section.problem.empty() ? py::cast(section.airfoil) : py::none());
  }
  const auto numbers = [&](auto of) { return copied(column_of(flows, of)); };
  py::dict result("names"_a = names, "airfoils"_a = airfoils, "model"_a = name_of(problem.model));
  result["section"] = numbers([](const SweepFlow& f) { return static_cast<std::int64_t>(f.section); });
  result["mach"] = numbers([](const SweepFlow& f) { return f.mach; });
  result["reynolds"] = numbers([](const SweepFlow& f) { return f.reynolds; });
  result["asked"] = numbers([](const SweepFlow& f) { return f.asked; });
  result["alpha"] = numbers([](const SweepFlow& f) { return f.point.alpha_deg; });
  result["cl"] = numbers([](const SweepFlow& f) { return f.point.cl; });
  result["cd"] = numbers([](const SweepFlow& f) { return f.point.cd; });
  result["cm"] = numbers([](const SweepFlow& f) { return f.point.cm; });
  result["cd_pressure"] = numbers([](const SweepFlow& f) { return f.point.cd_pressure; });
  result["cd_friction"] = numbers([](const SweepFlow& f) { return f.point.cd_friction; });
  result["y_plus_max"] = numbers([](const SweepFlow& f) { return f.point.y_plus_max; });
  result["converged"] =
      numbers([](const SweepFlow& f) { return f.point.converged ? std::uint8_t{1} : std::uint8_t{0}; });
  result["status"] = column_of(flows, [](const SweepFlow& f) { return std::string(status_of(f)); });
  result["reason"] = column_of(flows, [](const SweepFlow& f) { return f.point.reason; });
  result["warnings_of"] = column_of(flows, [](const SweepFlow& f) { return f.point.warnings; });
  if (problem.stations != 0) {
    result["x"] = copied(sweep_stations(problem.stations));
    result["cp"] = surfaces(flows, problem.stations, &SweepFlow::cp);
    if (problem.model != FlowModel::euler) result["cf"] = surfaces(flows, problem.stations, &SweepFlow::cf);
  }
  return result;
}

py::dict run_swept(const std::string& text, const std::string& source, const std::filesystem::path& directory,
                   bool resume, std::size_t threads, const py::object& callback) {
  const SweepProblem problem = parse_sweep(text, source);
  SweepWatch watch(callback);
  ThreadCrew crew(threads != 0 ? threads : std::max(1U, std::thread::hardware_concurrency()));
  SweepResult result;
  {
    py::gil_scoped_release released;
    result = sweep(directory, problem, resume ? SweepMode::resume : SweepMode::begin, crew, &watch);
  }
  watch.interrupts.rethrow();
  py::dict figures = swept(directory);
  figures["planned"] = result.planned;
  figures["found"] = result.found;
  figures["not_found"] = result.not_found;
  figures["flow_seconds"] = result.flow_seconds;
  figures["cold_seconds_estimate"] = result.cold_seconds_estimate;
  figures["stopped"] = name_of(result.stopped);
  figures["warnings"] = problem.warnings;
  return figures;
}

}  // namespace

void add_sweeps(py::module_& module) {
  module.def("_sweep", &run_swept, "text"_a, "source"_a, "directory"_a, "resume"_a, "threads"_a,
             "callback"_a);
  module.def(
      "_sweep_page",
      [](const std::filesystem::path& directory, const std::filesystem::path& page) {
        py::gil_scoped_release released;
        write_sweep_page(directory, page);
      },
      "directory"_a, "page"_a);
}

}  // namespace remodel::python
