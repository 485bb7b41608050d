// remodel film RUN -o FILE.webp: a moving picture of the mesh that lived through an optimisation.

#include "remodel/film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "arguments.h"
#include "command.h"
#include "figures.h"
#include "outputs.h"
#include "picture_options.h"
#include "remodel/design_run.h"
#include "remodel/error.h"
#include "remodel/history.h"
#include "remodel/io.h"
#include "remodel/replay.h"

namespace remodel::app {
namespace {

struct FilmCommand {
  std::filesystem::path run;
  std::string output;
  std::size_t frames = 80;
  std::uint64_t worker = 1;
  FilmOptions film;
  bool json = false;
};

// The designs of a run are samples around a mean that moves: a film of every n-th of them only shakes. So the
// run is cut into equal parts, one a frame, and each shows its best design.
std::vector<std::uint64_t> best_of_parts(const FilmCommand& command, std::size_t parts) {
  struct Row {
    std::uint64_t evaluation;
    double objective;
  };
  std::vector<Row> rows;
  History::open(command.run / "history.sqlite").each([&](const EvaluationRecord& record) {
    if (record.worker == command.worker) rows.push_back({record.evaluation, record.objective});
  });
  parts = std::min(parts, rows.size());
  const auto begin_of = [&](std::size_t part) {
    return rows.begin() + static_cast<std::ptrdiff_t>(part * rows.size() / parts);
  };
  std::vector<std::uint64_t> chosen;
  for (std::size_t part = 0; part < parts; ++part) {
    const auto best = std::min_element(begin_of(part), begin_of(part + 1),
                                       [](const Row& a, const Row& b) { return a.objective < b.objective; });
    chosen.push_back(best->evaluation);
  }
  return chosen;
}

// What the objective is: of a run of `remodel design` itself, otherwise the square of a distance.
std::string objective_text(const EvaluationRecord& record, bool is_design) {
  char text[64];
  if (is_design)
    std::snprintf(text, sizeof text, "objective %.5f", record.objective);
  else
    std::snprintf(text, sizeof text, "RMS distance %.1e chords", std::sqrt(record.objective));
  return text;
}

std::string cells_of(const FrozenMesh& mesh) {
  return std::to_string(mesh.cell_count()) + (mesh.quads.empty() ? " triangles" : " cells");
}

// The mesh of a row's design, with its layers.
FrozenMesh frozen_in(const DesignSpace& space, const EvaluationRecord& record, const Mesh& mesh) {
  if (space.layers() == nullptr) return mesh.freeze();
  return space.layers()->around(mesh, space.walls(record.coefficients)).freeze();
}

std::string caption(const EvaluationRecord& record, const FrozenMesh& mesh, bool is_design) {
  const auto kept = std::count(mesh.fate.begin(), mesh.fate.end(), Fate::kept);
  char text[160];
  std::snprintf(text, sizeof text, "design %llu: %s; %s, %.1f %% kept since the last frame",
                static_cast<unsigned long long>(record.evaluation), objective_text(record, is_design).c_str(),
                cells_of(mesh).c_str(),
                100.0 * static_cast<double>(kept) / static_cast<double>(mesh.cell_count()));
  return text;
}

Status run(const FilmCommand& command) {
  require_writable_as(command.output, {".webp"});
  const std::vector<std::uint64_t> chosen = best_of_parts(command, command.frames - 1);
  std::optional<DesignRun> design;
  if (holds_design_run(command.run)) design = read_design_run(command.run);
  const auto shown = [&](const FrozenMesh& mesh) {
    return design && design->space->half() ? mirrored(mesh) : mesh;
  };
  constexpr std::array one_section = {-0.1, -0.25, 1.1, 0.25};
  FilmOptions options = command.film;
  if (!options.picture.window)
    options.picture.window = design ? window_of(*design, one_section, 0.08, 0.08) : one_section;
  Film film(options);
  FrozenMesh last = read_frozen_mesh(command.run / "first.vtkhdf");
  last.fate.assign(last.cell_count(), Fate::kept);
  const FrozenMesh first = shown(last);
  film.add(first, "the start: " + cells_of(first));
  auto next = chosen.begin();
  const std::unique_ptr<DesignSpace> own = design ? nullptr : replayed_space(command.run);
  const DesignSpace& space = design ? static_cast<const DesignSpace&>(*design->space) : *own;
  const auto visit = [&](const EvaluationRecord& record, const Mesh& mesh) {
    if (next == chosen.end() || record.evaluation != *next) return;
    ++next;
    FrozenMesh frame = frozen_in(space, record, mesh);
    frame.fate = fates(last, frame);
    const FrozenMesh whole = shown(frame);
    film.add(whole, caption(record, whole, design.has_value()));
    last = std::move(frame);
  };
  if (design)
    replay(command.run, *design->space, command.worker, visit);
  else
    replay(command.run, command.worker, visit);
  const std::size_t bytes = film.write(command.output);

  Report report;
  report.figure("run", "run", command.run.string());
  report.figure("frames", "frames", film.frames());
  report.figure("bytes", "size", bytes, "bytes");
  add_output_figures(report, {command.output});
  report.print(command.json);
  return Status::done;
}

}  // namespace

void add_film_command(CLI::App& program, Action& action) {
  auto command = std::make_shared<FilmCommand>();
  CLI::App& app =
      add_command(program, "film", "Films the mesh of a run of `optimise` or `design`, as animated WebP",
                  command, action);
  add_text(app, {"RUN", "", "", "Run directory of `remodel optimise` or of `remodel design`"},
           Presence::required, command->run);
  add_text(app, {"-o,--output", "FILE", "", "Film to write: .webp"}, Presence::required, command->output);
  add_integer(
      app,
      {"--frames", "N", "80",
       "Pictures: the start, then the best design of each of N - 1 equal parts of the run; 2 to 10000"},
      {.low = 2, .high = 10000}, command->frames);
  add_integer(app, {"--frame-ms", "T", "100", "Duration of each picture in milliseconds: 10 to 60000"},
              {.low = 10, .high = 60000}, command->film.frame_ms);
  add_integer(app, {"--worker", "W", "1", "Worker whose mesh is shown, in a run with --workers: from 1"},
              {.low = 1}, command->worker);
  add_window(app, "-0.1,-0.25,1.1,0.25, or around all elements of a design", command->film.picture);
  add_integer(app, {"--width", "PIXELS", "960", "Width in pixels, 100 to 8000; the height follows"},
              {.low = 100, .high = 8000}, command->film.picture.width);
  add_json_flag(app, command->json);
}

}  // namespace remodel::app
