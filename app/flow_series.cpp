// Rows of designs on one living mesh: `remodel flow --series`.

#include <algorithm>
#include <optional>

#include "euler_run.h"
#include "flow_files.h"
#include "flow_report.h"
#include "interrupt.h"
#include "layered_update.h"
#include "new_airfoil.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/io.h"
#include "remodel/remodel.h"

namespace remodel::app {
namespace {

// A JSON array of airfoils, each as `remodel fit` writes it.
std::vector<CstAirfoil> read_series(const std::string& file) {
  Json list;
  try {
    list = Json::parse(read_text(file));
  } catch (const Json::exception&) {
    throw Error(ErrorCode::format, file, "found no JSON, expected an array of airfoils");
  }
  if (!list.is_array() || list.empty())
    throw Error(ErrorCode::format, file,
                std::string("found ") + (list.is_array() ? "an empty array" : list.type_name()) +
                    ", expected an array of airfoils as `remodel fit` writes them");
  std::vector<CstAirfoil> airfoils;
  for (const Json& entry : list)
    airfoils.push_back(
        airfoil_from_json(entry.dump(), file + ", airfoil " + std::to_string(airfoils.size() + 1)));
  return airfoils;
}

// The living mesh of a series: of triangles alone, or with layers.
class SeriesMesh {
 public:
  virtual ~SeriesMesh() = default;
  virtual Domain with(const CstAirfoil& airfoil) const = 0;
  virtual RemodelResult step(const Domain& domain, StepObserver& observer) = 0;
  virtual FlowResult solve(LivingFlow& living, const FlowConditions& conditions) const = 0;
  // A fresh mesh of the same options, and the flow through it from nothing.
  virtual FrozenMesh fresh(const Domain& domain) = 0;
  virtual FlowResult cold(const FlowConditions& conditions, const FlowOptions& options) const = 0;
};

class PlainSeriesMesh final : public SeriesMesh {
 public:
  explicit PlainSeriesMesh(StartMesh start) : start_(std::move(start)) {}
  Domain with(const CstAirfoil& airfoil) const override { return with_new_airfoil(start_, {}, airfoil); }
  RemodelResult step(const Domain& domain, StepObserver& observer) override {
    return remodel(start_.mesh, domain, {.strategy = strategy_with_flows, .observer = &observer});
  }
  FlowResult solve(LivingFlow& living, const FlowConditions& conditions) const override {
    return living.solve(start_.mesh, conditions);
  }
  FrozenMesh fresh(const Domain& domain) override {
    fresh_ = generate(domain, start_.mesh.options()).mesh;
    return fresh_.freeze();
  }
  FlowResult cold(const FlowConditions& conditions, const FlowOptions& options) const override {
    return solve_flow(fresh_, conditions, options);
  }

 private:
  StartMesh start_;
  Mesh fresh_;
};

class LayeredSeriesMesh final : public SeriesMesh {
 public:
  LayeredSeriesMesh(LayeredMesh start, const std::string& source)
      : mesh_(std::move(start)), source_(source) {}
  Domain with(const CstAirfoil& airfoil) const override {
    return walls_with_airfoil(mesh_.domain(), airfoil, source_);
  }
  RemodelResult step(const Domain& domain, StepObserver& observer) override {
    return remodel(mesh_, domain, {.strategy = strategy_with_flows, .observer = &observer});
  }
  FlowResult solve(LivingFlow& living, const FlowConditions& conditions) const override {
    return living.solve(mesh_.freeze(), conditions);
  }
  FrozenMesh fresh(const Domain& domain) override {
    return fresh_ = generate_layered(domain, mesh_.options(), mesh_.outer().options()).mesh.freeze();
  }
  FlowResult cold(const FlowConditions& conditions, const FlowOptions& options) const override {
    return solve_flow(fresh_, conditions, options);
  }

 private:
  LayeredMesh mesh_;
  std::string source_;
  FrozenMesh fresh_;
};

// The same designs on fresh meshes, for comparison.
class Comparison {
 public:
  Comparison(Compare kind, SeriesMesh& mesh, const FlowConditions& conditions, const FlowOptions& options)
      : kind_(kind), series_(mesh), conditions_(conditions), options_(options) {}

  void add(const Domain& domain, Json& entry) {
    if (kind_ == Compare::none) return;
    FrozenMesh mesh = series_.fresh(domain);
    const bool cold = kind_ == Compare::cold || !flow_;
    FlowResult flow = cold ? series_.cold(conditions_, options_)
                           : solve_flow_from(mesh_, *flow_, mesh, conditions_, options_);
    const std::string name = kind_ == Compare::cold ? "cold" : "rival";
    entry[name + "_seconds"] = flow.seconds;
    entry[name + "_cl"] = flow.lift_determined ? Json(flow.cl) : Json(nullptr);
    entry[name + "_converged"] = flow.converged();
    if (!flow.converged()) return;
    flow_ = std::move(flow), mesh_ = std::move(mesh);
  }

 private:
  Compare kind_;
  SeriesMesh& series_;
  FlowConditions conditions_;
  FlowOptions options_;
  FrozenMesh mesh_;
  std::optional<FlowResult> flow_;
};

// A design that has no flow because it has no mesh.
Json refused_design(const std::string& why) {
  return {{"converged", false}, {"status", "refused"}, {"detail", why}};
}

// The row so far.
class Row {
 public:
  Row(std::string source, FlowModel model) : source_(std::move(source)), model_(model) {}

  void add(const FlowResult& flow, Json entry) {
    factorisations_ += flow.factorisations;
    seconds_ += flow.seconds;
    not_found_ += !flow.converged();
    if (!flow.converged()) ended(status_of(flow));
    designs_.push_back(std::move(entry));
    warn(flow.warnings);
  }
  void add_refused(const std::string& why) {
    ++not_found_;
    ended(Status::answer_is_no);
    designs_.push_back(refused_design(why));
  }
  // The first that did not go well says how the row ends, but for a limit, at which it ends.
  void ended(Status status) {
    if (worst_ == Status::done || status == Status::limit) worst_ = status;
  }
  Status report(bool json) const {
    Report report;
    report.figure("mesh", "mesh", source_);
    report.data("model", name_of(model_));
    report.figure("flows", "flows", designs_.size());
    report.figure("not_converged", "flows that were not found", not_found_);
    report.figure("factorisations", "factorisations", factorisations_);
    report.figure("seconds", "solving", seconds_, "seconds");
    for (std::size_t i = 0; i < designs_.size(); ++i)
      report.line("design " + std::to_string(i + 1), text_of(designs_[i]));
    report.data("designs", designs_);
    report.data("warnings", warnings_);
    report.print(json);
    return worst_;
  }

 private:
  // Once for all designs.
  void warn(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) {
      if (std::find(warnings_.begin(), warnings_.end(), warning) != warnings_.end()) continue;
      print_warnings(source_, {warning});
      warnings_.push_back(warning);
    }
  }
  static std::string text_of(const Json& design) {
    if (!design.contains("cl"))
      return design["status"].get<std::string>() + ": " + design["detail"].get<std::string>();
    const std::string cl = design["cl"].is_null() ? not_determined : design["cl"].dump();
    const std::string figures = "CL " + cl + ", CD " + design["cd"].dump() + ", " +
                                design["warm"].get<std::string>() + ", " +
                                design["status"].get<std::string>();
    return (design["converged"].get<bool>() ? figures : "not converged: " + figures) + compared_text(design);
  }
  static std::string compared_text(const Json& design) {
    for (const std::string kind : {"cold", "rival"}) {
      if (!design.contains(kind + "_cl")) continue;
      const Json& cl = design[kind + "_cl"];
      return "; " + kind + ": CL " + (cl.is_null() ? not_determined : cl.dump()) +
             (design[kind + "_converged"].get<bool>() ? "" : " (not converged)") + ", " +
             design[kind + "_seconds"].dump() + " s for " + design["seconds"].dump();
    }
    return {};
  }

  std::string source_;
  FlowModel model_;
  Json designs_ = Json::array();
  std::vector<std::string> warnings_;
  Status worst_ = Status::done;
  int factorisations_ = 0, not_found_ = 0;
  double seconds_ = 0.0;
};

Status run_row(const EulerRun& run, SeriesMesh& mesh, const std::string& source) {
  require_mach(run);
  InterruptObserver observer;
  FlowOptions options = options_of(run);
  options.observer = &observer;
  LivingFlow living(options);
  Comparison comparison(run.compare, mesh, run.conditions, options);
  Row row(source, options.model);
  for (const CstAirfoil& airfoil : read_series(run.series)) {
    std::optional<Domain> domain;
    RemodelResult step;
    try {
      domain = mesh.with(airfoil);
      step = mesh.step(*domain, observer);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::geometry) throw;
      row.add_refused(error.what());
      continue;
    }
    if (step.stopped == Stopped::interrupted) {
      row.ended(Status::limit);
      break;
    }
    const FlowResult flow = mesh.solve(living, run.conditions);
    Json entry = to_json(flow, run.conditions);
    entry["full_adjustment"] = step.full_adjustment;
    comparison.add(*domain, entry);
    row.add(flow, std::move(entry));
    if (flow.status == FlowStatus::interrupted || flow.status == FlowStatus::memory) break;
  }
  return row.report(run.json);
}

}  // namespace

Status run_series(const EulerRun& run, StartMesh start) {
  const std::string source = start.source;
  PlainSeriesMesh mesh(std::move(start));
  return run_row(run, mesh, source);
}

Status run_layered_series(const EulerRun& run, LayeredMesh start, const std::string& source) {
  LayeredSeriesMesh mesh(std::move(start), source);
  return run_row(run, mesh, source);
}

}  // namespace remodel::app
