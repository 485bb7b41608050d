// remodel batch MESH SHAPE... -o DIR: one living mesh, remodelled to designs that are all known before.

#include "remodel/batch.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <set>

#include "arguments.h"
#include "batch_mesh.h"
#include "command.h"
#include "figures.h"
#include "interrupt.h"
#include "meshing_options.h"
#include "outputs.h"
#include "remodel/directory_lock.h"
#include "remodel/error.h"
#include "remodel/io.h"
#include "remodel/remodel.h"
#include "remodel_options.h"
#include "report.h"
#include "shape_input.h"
#include "timing.h"
#include "warnings.h"

namespace remodel::app {
namespace {

enum class Order { given, nearest };

struct BatchCommand {
  std::string mesh;
  StartMeshOptions start;
  LayerChoice layers;
  std::vector<std::string> shapes;
  std::filesystem::path directory;
  Order order = Order::nearest;
  std::vector<std::string> meshes;  // extensions of the files to write
  FitOptions fit;
  RemodelOptions remodelling;
  bool inner_markers = false;
  bool overwrite = false;
  bool json = false;
  std::function<bool(const std::string&)> given;  // on the command line
};

struct Design {
  std::string shape;
  CstAirfoil airfoil;
  Domain domain;
};

// Reads all designs and checks that each is a domain before the first is meshed.
std::vector<Design> read_designs(const BatchCommand& command, const BatchMesh& start,
                                 std::vector<ShapeFit>& fits) {
  std::vector<Design> designs;
  for (const std::string& shape : command.shapes) {
    const CstAirfoil airfoil = fit_shape(shape, command.fit, fits).airfoil;
    try {
      Domain domain = start.with_airfoil(airfoil);
      validate(domain);
      designs.push_back({shape, airfoil, std::move(domain)});
    } catch (const Error& error) {
      throw Error(error.code(), shape, error.what());
    }
  }
  return designs;
}

std::vector<std::size_t> order_of(const BatchCommand& command, const BatchMesh& start,
                                  const std::vector<Design>& designs) {
  if (command.order == Order::given) {
    std::vector<std::size_t> order(designs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    return order;
  }
  std::vector<CstAirfoil> airfoils;
  for (const Design& design : designs) airfoils.push_back(design.airfoil);
  return order_designs(start.airfoil(command.fit.degree), airfoils, {.points = start.points()});
}

constexpr std::array mesh_extensions{"vtkhdf", "su2", "msh", "vtu"};

std::vector<std::string> formats_of(const std::string& option, const std::string& text) {
  std::vector<std::string> formats = parse_list(option, text);
  for (std::size_t i = 0; i < formats.size(); ++i) {
    const auto end = formats.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::count(mesh_extensions.begin(), mesh_extensions.end(), formats[i]) == 0 ||
        std::find(formats.begin(), end, formats[i]) != end)
      throw Error(ErrorCode::argument, option,
                  "found '" + text + "', expected each at most once of vtkhdf, su2, msh and vtu");
  }
  return formats;
}

std::string file_of(std::size_t number, const std::string& extension) {
  std::string digits = std::to_string(number);
  if (digits.size() < 3) digits.insert(0, 3 - digits.size(), '0');
  return digits + "." + extension;
}

// Whether a batch gives files such names: 001.su2.
bool is_named_as_of_a_batch(const std::filesystem::path& file) {
  const std::string stem = file.stem().string();
  const std::string extension = file.extension().string();
  return stem.size() >= 3 && stem.find_first_not_of("0123456789") == std::string::npos &&
         std::any_of(mesh_extensions.begin(), mesh_extensions.end(),
                     [&](const char* known) { return extension == std::string(".") + known; });
}

constexpr const char* report_name = "report.json";

// What a directory holds of an earlier batch, and beside it.
struct Earlier {
  bool report = false;             // of a batch
  std::set<std::string> written;   // as the report says
  std::vector<std::string> alike;  // named like files of a batch; no report says that one wrote them
};

// Files that a report says its batch wrote: all at once, or in an older one design by design.
std::set<std::string> files_in_report(const std::filesystem::path& file) {
  const auto refuse = [&] {
    throw Error(ErrorCode::argument, file.string(),
                "found a file that no batch wrote, expected another directory");
  };
  const Json report = Json::parse(read_text(file), nullptr, false);
  if (!report.is_object() || !report.contains("designs") || !report["designs"].is_array()) refuse();
  std::set<std::string> names;
  const auto take = [&](const Json& list) {
    if (!list.is_array()) return;
    for (const Json& name : list)
      if (name.is_string() && is_named_as_of_a_batch(name.get<std::string>()) &&
          !std::filesystem::path(name.get<std::string>()).has_parent_path())
        names.insert(name.get<std::string>());
  };
  if (report.contains("files")) take(report["files"]);
  for (const Json& design : report["designs"])
    if (design.is_object() && design.contains("meshes")) take(design["meshes"]);
  return names;
}

Earlier earlier_in(const std::filesystem::path& directory) {
  Earlier earlier;
  earlier.report = std::filesystem::exists(directory / report_name);
  if (earlier.report) earlier.written = files_in_report(directory / report_name);
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    const std::string name = entry.path().filename().string();
    if (is_named_as_of_a_batch(name) && !earlier.written.contains(name)) earlier.alike.push_back(name);
  }
  std::sort(earlier.alike.begin(), earlier.alike.end());
  return earlier;
}

// All that a batch may write beside its report.
std::vector<std::string> files_to_write(const BatchCommand& command) {
  std::vector<std::string> files;
  for (std::size_t i = 1; i <= command.shapes.size(); ++i)
    for (const std::string& extension : command.meshes) files.push_back(file_of(i, extension));
  return files;
}

// Nothing that this batch did not write is lost, whatever is to be overwritten.
void require_room(const BatchCommand& command) {
  const Earlier earlier = earlier_in(command.directory);
  const std::string directory = command.directory.string();
  if (!command.overwrite && (earlier.report || !earlier.alike.empty()))
    throw Error(ErrorCode::argument, directory,
                "holds a batch: expected another directory, or --overwrite to replace it");
  const std::vector<std::string> files = files_to_write(command);
  for (const std::string& name : earlier.alike)
    if (std::find(files.begin(), files.end(), name) != files.end())
      throw Error(ErrorCode::argument, directory,
                  "holds " + name +
                      ", of which no report.json there says that a batch wrote it: expected another "
                      "directory, or that file elsewhere");
}

void require_directory(const BatchCommand& command) {
  const std::filesystem::path& directory = command.directory;
  std::error_code error;
  if (!std::filesystem::exists(directory, error)) {
    require_writable(directory.has_filename() ? directory : directory.parent_path());
    return;
  }
  if (!std::filesystem::is_directory(directory, error))
    throw Error(ErrorCode::file, directory.string(), "is a file, expected a directory");
  require_writable(directory / report_name);
  for (const char* file : {"history.sqlite", "checkpoint.json", "study.sqlite"})
    if (std::filesystem::exists(directory / file, error))
      throw Error(ErrorCode::argument, directory.string(),
                  std::string("holds ") + file + " of a run: expected another directory");
  require_room(command);
}

// Removes what the batch before wrote, and records what this one will write: a batch that is killed leaves
// files that are known to be its own.
void begin_record(const BatchCommand& command) {
  const Earlier earlier = earlier_in(command.directory);
  for (const std::string& name : earlier.written) std::filesystem::remove(command.directory / name);
  for (const std::string& name : earlier.alike)
    std::fprintf(stderr, "remodel: %s: left as it is: no batch's report says that it wrote it\n",
                 (command.directory / name).c_str());
  const Json record{{"designs", Json::array()}, {"files", files_to_write(command)}, {"finished", false}};
  write_text_atomically(command.directory / report_name, record.dump(2) + "\n");
}

// Remodels the mesh to one design after the other. Sums are over the designs so far.
class Batch {
 public:
  Batch(const BatchCommand& command, BatchMesh& mesh)
      : command_(command), mesh_(mesh), designs_(Json::array()) {
    for (std::size_t i = 0; i < command.shapes.size(); ++i) designs_.push_back(nullptr);
  }

  // Returns false if a limit ended the mesh before it was finished.
  bool evaluate(const Design& design, std::size_t index) {
    const Stopwatch watch;
    const RemodelResult result = mesh_.step(design.domain, command_.remodelling);
    const double seconds = watch.seconds();
    const std::string broken = mesh_.quick_check();
    const std::size_t lost = result.triangles_before - result.preserved;
    Json entry = {{"design", index + 1}, {"shape", design.shape}, {"position", ++done_}};
    add_counts(entry, result);
    entry.update(Json{{"preserved", result.preserved},
                      {"preserved_percent", result.preserved_percent()},
                      {"connected", result.connected},
                      {"connectivity_percent", result.connectivity_percent()},
                      {"born", result.born()},
                      {"gone", result.gone()},
                      {"flipped", result.flipped},
                      {"morphed", result.morphed},
                      {"lost", lost},
                      {"moved", result.moved},
                      {"inserted", result.inserted},
                      {"removed", result.removed},
                      {"full_adjustment", result.full_adjustment},
                      {"refreshed", result.refreshed},
                      {"regenerated", result.regenerated},
                      {"valid", broken.empty()},
                      {"min_angle_deg", mesh_.smallest_angle()},
                      {"seconds", seconds},
                      {"stopped", name_of(result.stopped)}});
    if (!broken.empty()) entry["detail"] = broken;
    for (const std::string& extension : command_.meshes) {
      const std::string file = file_of(index + 1, extension);
      mesh_.write(command_.directory / file,
                  {.inner = command_.inner_markers ? InnerCurves::markers : InnerCurves::left_out,
                   .su2_boxes = mesh_.su2_boxes()});
      if (!entry.contains("mesh")) entry["mesh"] = file;
      entry["meshes"].push_back(file);
      files_.push_back(file);
    }
    designs_[index] = std::move(entry);
    lost_ += static_cast<double>(lost);
    preserved_percent_ += result.preserved_percent();
    seconds_ += seconds;
    full_adjustments_ += result.full_adjustment;
    invalid_ += !broken.empty();
    return result.stopped == Stopped::done;
  }

  void add_figures(Report& report) const {
    const double n = static_cast<double>(done_);
    const auto mean = [&](double sum) { return done_ == 0 ? Json() : Json(sum / n); };
    report.figure("evaluations", "designs meshed", done_);
    report.figure("full_adjustments", "full adjustments", full_adjustments_);
    report.figure("preserved_percent", "preserved, mean", mean(preserved_percent_), "%");
    report.figure("lost_mean", "lost, mean", mean(lost_), mesh_.layered() ? "cells" : "triangles");
    report.figure("remodel_ms_mean", "remodelling, mean", mean(1e3 * seconds_), "ms");
    report.figure("invalid_meshes", "invalid meshes", invalid_);
    Json all = Json::array();  // those that were reached, in the order of the command line
    for (const Json& entry : designs_)
      if (!entry.is_null()) all.push_back(entry);
    report.data("designs", std::move(all));
  }
  std::size_t invalid() const { return invalid_; }
  const std::vector<std::string>& files() const { return files_; }  // written, in their order

 private:
  // Of a mesh with layers all other counts are of cells.
  void add_counts(Json& entry, const RemodelResult& result) const {
    const std::string cells = mesh_.layered() ? "cells" : "triangles";
    entry[cells + "_before"] = result.triangles_before;
    entry[cells] = result.triangles;
    if (!mesh_.layered()) return;
    const FrozenMesh view = mesh_.freeze();
    entry["triangles"] = view.triangles.size();
    entry["quadrilaterals"] = view.quads.size();
    entry["cells"] = view.cell_count();
  }

  const BatchCommand& command_;
  BatchMesh& mesh_;
  Json designs_;
  std::vector<std::string> files_;
  std::size_t done_ = 0, full_adjustments_ = 0, invalid_ = 0;
  double lost_ = 0.0, preserved_percent_ = 0.0, seconds_ = 0.0;
};

// Solvers with friction want their cells to stay joined.
BatchCommand with_strategy_of(const BatchMesh& mesh, BatchCommand command) {
  if (mesh.layered() && !command.given("--strategy")) command.remodelling.strategy = Strategy::morph;
  return command;
}

Status run(const BatchCommand& given) {
  require_directory(given);
  if (given.inner_markers && std::count(given.meshes.begin(), given.meshes.end(), "su2") == 0)
    throw Error(ErrorCode::argument, "--inner-markers",
                "given without .su2 files to write, expected --meshes su2");
  require_coordinate_file(given.shapes, given.fit);
  const std::unique_ptr<BatchMesh> mesh = read_batch_mesh(given.mesh, given.start, given.layers);
  if (!mesh->layered() && given.given("--layer-cells"))
    throw Error(ErrorCode::argument, "--layer-cells",
                "given for '" + given.mesh + "', expected a mesh with layers, or --layers");
  const BatchCommand command = with_strategy_of(*mesh, given);
  require_used(command.given, command.remodelling.strategy, mesh->imported(), command.mesh);
  std::vector<ShapeFit> fits;
  const std::vector<Design> designs = read_designs(command, *mesh, fits);
  const std::vector<std::size_t> order = order_of(command, *mesh, designs);
  const DirectoryLock lock(command.directory);
  require_directory(command);  // another batch may have ended there meanwhile
  begin_record(command);

  if (std::count(command.meshes.begin(), command.meshes.end(), "su2") != 0 && !command.inner_markers)
    warn_of_inner_curves(mesh->freeze(), (command.directory / "*.su2").string(), "--inner-markers writes it");
  for (const std::string& extension : command.meshes)
    if (extension == "su2")
      warn_of_names(mesh->freeze(), (command.directory / "*.su2").string(), MeshFormat::su2,
                    command.inner_markers ? InnerCurves::markers : InnerCurves::left_out);
  if (!mesh->su2_boxes().empty())
    for (const std::string& extension : command.meshes)
      if (extension != "su2" && extension != "vtkhdf")
        warn((command.directory / ("*." + extension)).string() + boxes_left_out);
  const InterruptFlag interrupt;
  Batch batch(command, *mesh);
  bool finished = true;
  for (const std::size_t index : order) {
    finished = !interrupt.raised() && batch.evaluate(designs[index], index);
    if (!finished) break;
  }

  Report report;
  report.figure("mesh", "mesh", command.mesh);
  report.figure("order", "order", command.order == Order::given ? "given" : "nearest");
  report.figure("strategy", "strategy", name_of(command.remodelling.strategy));
  add_fit_figures(report, fits);
  batch.add_figures(report);
  mesh->add_figures(report);
  report.data("files", batch.files());
  report.data("finished", finished);
  write_text_atomically(command.directory / report_name, report.json_text());
  report.line("written", (command.directory / report_name).string());
  report.print(command.json);
  if (!finished) return Status::limit;
  return batch.invalid() == 0 ? Status::done : Status::answer_is_no;
}

}  // namespace

void add_batch_command(CLI::App& program, Action& action) {
  auto command = std::make_shared<BatchCommand>();
  CLI::App& app = add_command(
      program, "batch", "Remodels a mesh to one airfoil after the other, nearest first", command, action);
  add_text(app, {"mesh", "MESH", "", "Mesh: a native one (.vtkhdf), or .su2, .msh, .vtu with --boundary"},
           Presence::required, command->mesh);
  add_texts(app, {"shapes", "SHAPE", "", shape_help}, Presence::required, command->shapes);
  add_start_mesh_options(app, command->start);
  add_layer_options(app, command->layers);
  command->given = [&app](const std::string& name) { return given(app, name); };
  add_text(app, {"-o,--output", "DIR", "", "Directory for report.json and the meshes, made if it is missing"},
           Presence::required, command->directory);
  add_choice(
      app,
      {"--order", "ORDER", "nearest",
       "nearest (always the design that is nearest to the last one) or given (as on the command line)"},
      {"nearest", "given"},
      [command](std::size_t choice) { command->order = choice == 0 ? Order::nearest : Order::given; });
  add_text(app,
           {"--meshes", "FORMATS", "none",
            "Also write the mesh of each design as DIR/001.FORMAT and so on: one or several of vtkhdf, su2, "
            "msh and vtu, between commas"},
           Presence::optional,
           [command](const std::string& text) { command->meshes = formats_of("--meshes", text); });
  add_flag(app, "--inner-markers",
           "Write curves inside the mesh as markers of .su2 files too, where SU2 takes them for walls",
           command->inner_markers);
  add_flag(app, "--overwrite", "Replace the batch that the directory holds", command->overwrite);
  add_fit_options(app, command->fit);
  add_remodel_options(app, command->remodelling);
  add_step_strategy(app, command->remodelling);
  add_json_flag(app, command->json);
}

}  // namespace remodel::app
