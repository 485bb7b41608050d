#include "carry.h"

#include <algorithm>
#include <utility>

#include "outputs.h"
#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel::app {

namespace {

std::vector<std::string> columns_of(const std::string& name, std::size_t components) {
  if (components == 1) return {name};
  std::vector<std::string> columns;
  for (std::size_t k = 0; k < components; ++k) columns.push_back(name + "." + std::to_string(k));
  return columns;
}

}  // namespace

// All values of one place side by side, so that they share intersections and limits.
struct Cargo::Table {
  std::vector<std::string> names;  // of columns, as figures call them
  std::vector<double> values;

  int width() const { return static_cast<int>(names.size()); }
  void take(const std::string& name, std::size_t components, const std::vector<double>& from) {
    const std::size_t rows = from.size() / components, before = names.size();
    for (std::string& column : columns_of(name, components)) names.push_back(std::move(column));
    std::vector<double> wider(rows * names.size());
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t k = 0; k < before; ++k) wider[i * names.size() + k] = values[i * before + k];
      for (std::size_t k = 0; k < components; ++k)
        wider[i * names.size() + before + k] = from[i * components + k];
    }
    values = std::move(wider);
  }
  std::vector<double> give(std::size_t first, std::size_t components) const {
    std::vector<double> result;
    for (std::size_t i = 0; i + names.size() <= values.size(); i += names.size())
      for (std::size_t k = 0; k < components; ++k) result.push_back(values[i + first + k]);
    return result;
  }
};

namespace {

// SU2's names of the conserved variables of a gas in the plane.
std::optional<std::array<int, 4>> conserved_columns(const std::vector<std::string>& names) {
  std::array<int, 4> found{};
  const char* const wanted[] = {"Density", "Momentum_x", "Momentum_y", "Energy"};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto at = std::find(names.begin(), names.end(), wanted[k]);
    if (at == names.end()) return std::nullopt;
    found[k] = static_cast<int>(at - names.begin());
  }
  return found;
}

// Component by component: tensors of OpenFOAM have more than a field of a mesh may have.
std::vector<double> integrals_of(const Field& field, const FrozenMesh& mesh) {
  const auto width = static_cast<std::size_t>(field.components);
  std::vector<double> result;
  for (std::size_t k = 0; k < width; ++k) {
    Field one{field.name, field.place, 1, {}};
    for (std::size_t i = k; i < field.values.size(); i += width) one.values.push_back(field.values[i]);
    result.push_back(integral(one, mesh).front());
  }
  return result;
}

// SU2 writes a row for each point of its mesh, also for those that no cell uses and our view leaves out.
void keep_rows_of_view(Su2Restart& restart, const FrozenMesh& mesh, const std::string& file) {
  if (restart.points() <= mesh.points.size()) return;
  ReadNotes notes;
  read_frozen_mesh(file, &notes);
  if (restart.points() != mesh.points.size() + notes.unused_points) return;
  std::vector<double> kept;
  const std::size_t columns = restart.names.size();
  for (const std::uint32_t point : notes.kept_points) {
    const auto row = restart.values.begin() + static_cast<std::ptrdiff_t>(point * columns);
    kept.insert(kept.end(), row, row + static_cast<std::ptrdiff_t>(columns));
  }
  restart.values = std::move(kept);
}

void require_time_out(const std::string& directory) {
  const std::string extension = std::filesystem::path(directory).extension().string();
  if (extension == ".csv" || extension == ".dat")
    throw Error(ErrorCode::argument, directory,
                "found a restart file for --state-out, expected a time directory, as --state is one");
  require_writable_directory(directory);
}

}  // namespace

void add_carry_options(CLI::App& app, CarryOptions& options) {
  add_text(app,
           {"--state", "FILE", "",
            "SU2 restart file of the old mesh, ASCII or binary: rows in the order of its points; or a time "
            "directory of OpenFOAM, in ASCII"},
           Presence::optional, options.state);
  add_text(app,
           {"--state-out", "FILE", "",
            "Restart file to write for the new mesh: .csv (ASCII) or .dat (binary); or a time directory"},
           Presence::optional, options.state_out);
  add_flag(app, "--conservative",
           "Carry values over with their integrals, within bounds; otherwise vertices keep their values, "
           "and new ones are interpolated",
           options.conservative);
  add_choice(app,
             {"--outside", "HOW", "nearest",
              "Values of new vertices beyond the old domain: nearest, extrapolate, or refuse"},
             {"nearest", "extrapolate", "refuse"},
             [&options](std::size_t choice) { options.outside = static_cast<Outside>(choice); });
}

Cargo::Cargo(const std::string& file, const FrozenMesh& mesh, const CarryOptions& options)
    : options_(options) {
  if (options.state.empty() != options.state_out.empty())
    throw Error(ErrorCode::argument, options.state.empty() ? "--state-out" : "--state",
                "found alone, expected --state and --state-out together");
  const bool is_time = !options.state.empty() && std::filesystem::is_directory(options.state);
  if (is_time)
    require_time_out(options.state_out);
  else if (!options.state_out.empty())
    require_writable_as(options.state_out, {".csv", ".dat"});
  for (Field& field : read_fields(file)) {
    if (is_finite(field))
      fields_.push_back(std::move(field));
    else
      left_out_.push_back(field.name);
  }
  if (is_time) {
    time_ = read_foam_time(options.state, mesh);
    left_out_.insert(left_out_.end(), time_->left_out.begin(), time_->left_out.end());
  }
  if (options.state.empty() || is_time) return;
  state_ = read_su2_restart(options.state);
  keep_rows_of_view(*state_, mesh, file);
  require_coordinates(*state_, mesh, options.state);
  set_coordinates(*state_, mesh, options.state);
}

std::vector<Field> Cargo::with_state() const {
  std::vector<Field> all = fields_;
  if (!state_) return all;
  const std::size_t columns = state_->names.size();
  for (std::size_t k = 0; k < columns; ++k) {
    if (state_->names[k] == "x" || state_->names[k] == "y") continue;
    Field field{state_->names[k], FieldPlace::vertices, 1, {}};
    for (std::size_t i = 0; i < state_->points(); ++i)
      field.values.push_back(state_->values[i * columns + k]);
    all.push_back(std::move(field));
  }
  return all;
}

std::vector<Field> Cargo::in_cells() const {
  std::vector<Field> all;
  if (!time_) return all;
  for (const FoamField& field : time_->fields)
    for (const FoamList& list : field.lists)
      if (list.patch.empty())
        all.push_back({field.name, FieldPlace::triangles, list.components, list.values});
  return all;
}

void Cargo::note_integrals(const FrozenMesh& mesh, Json& integrals) const {
  const auto note = [&](const std::vector<Field>& fields) {
    for (const Field& field : fields) {
      const std::vector<double> values = integrals_of(field, mesh);
      integrals[field.name] = values.size() == 1 ? Json(values[0]) : Json(values);
    }
  };
  note(with_state());
  note(in_cells());
}

void Cargo::note_balance(const std::vector<std::string>& names, const Balance& balance) {
  Json& swept = figures_["swept"];
  swept["area_gained"] = balance.area_gained, swept["area_lost"] = balance.area_lost;
  for (std::size_t k = 0; k < names.size(); ++k) {
    swept["gained"][names[k]] = balance.gained[k];
    swept["lost"][names[k]] = balance.lost[k];
  }
}

// Coordinates in the state are carried along, and replaced afterwards.
void Cargo::move(const Transfer& transfer, FieldPlace place, bool conservative) {
  Table table;
  for (const Field& field : fields_)
    if (field.place == place)
      table.take(field.name, static_cast<std::size_t>(field.components), field.values);
  const bool with_state = state_ && place == FieldPlace::vertices;
  const std::size_t first_of_state = table.names.size();
  if (with_state) {
    table.take("", state_->names.size(), state_->values);
    std::copy(state_->names.begin(), state_->names.end(),
              table.names.begin() + static_cast<std::ptrdiff_t>(first_of_state));
  }
  if (table.names.empty()) return;
  if (conservative)
    note_balance(table.names, transfer.remap(place, table.width(), table.values,
                                             {.conserved = conserved_columns(table.names)}));
  else
    transfer.ride(place, table.width(), table.values);
  std::size_t column = 0;
  for (Field& field : fields_) {
    if (field.place != place) continue;
    field.values = table.give(column, static_cast<std::size_t>(field.components));
    column += static_cast<std::size_t>(field.components);
  }
  if (with_state) state_->values = table.give(first_of_state, state_->names.size());
}

void Cargo::move_time(const Transfer& transfer, const FrozenMesh& before, const FrozenMesh& after,
                      bool conservative) {
  if (!time_) return;
  const std::vector<Field> cells = in_cells();
  auto field = cells.begin();
  carry_foam_time(*time_, before, after, [&](int components, std::vector<double>& values) {
    const std::string& name = (field++)->name;
    if (conservative)
      note_balance(columns_of(name, static_cast<std::size_t>(components)),
                   transfer.remap(FieldPlace::triangles, components, values));
    else
      transfer.ride(FieldPlace::triangles, components, values);
  });
}

void Cargo::renumber(const FrozenMesh& before, const FrozenMesh& after) {
  if (empty()) return;
  const Transfer transfer(before, after, {.outside = options_.outside});
  for (const FieldPlace place : {FieldPlace::vertices, FieldPlace::triangles}) move(transfer, place, false);
  move_time(transfer, before, after, false);
}

void Cargo::carry(const FrozenMesh& before, const FrozenMesh& after) {
  if (empty()) return;
  const Transfer transfer(before, after, {.outside = options_.outside});
  const std::size_t made = transfer.vertices().rows.size();
  figures_["points"] = after.points.size();
  figures_["carried"] = after.points.size() - made;
  figures_["interpolated"] = made;
  figures_["outside"] = transfer.outside();
  figures_["farthest_outside"] = transfer.farthest_outside();
  note_integrals(before, figures_["integral_before"]);
  for (const FieldPlace place : {FieldPlace::vertices, FieldPlace::triangles})
    move(transfer, place, options_.conservative);
  move_time(transfer, before, after, options_.conservative);
  if (state_) set_coordinates(*state_, after, options_.state_out);
  note_integrals(after, figures_["integral_after"]);
}

void Cargo::write_state(const FrozenMesh& mesh) const {
  if (time_) write_foam_time(*time_, options_.state_out);
  if (!state_) return;
  Su2Restart restart = *state_;
  set_coordinates(restart, mesh, options_.state_out);
  write_su2_restart(restart, options_.state_out);
}

void Cargo::add_figures(Report& report) const {
  if (figures_.empty()) return;
  for (const auto& [key, value] : figures_.items()) report.data(key, value);
  report.line("vertices that kept their values", figures_["carried"].dump());
  report.line("new vertices, interpolated", figures_["interpolated"].dump());
  report.line("of these beyond the old domain", figures_["outside"].dump());
  if (figures_.contains("swept"))
    report.line("area gained and lost at moving boundaries",
                figures_["swept"]["area_gained"].dump() + ", " + figures_["swept"]["area_lost"].dump());
  Json names = Json::array();
  std::string text;
  for (const Field& field : with_state()) {
    names.push_back(field.name);
    text += (text.empty() ? "" : ", ") + field.name;
  }
  if (time_)
    for (const FoamField& field : time_->fields) {
      names.push_back(field.name);
      text += (text.empty() ? "" : ", ") + field.name;
    }
  report.data("fields", names);
  report.line("fields", text);
  if (!left_out_.empty())
    report.figure("fields_left_out", "not finite or on faces, left out", Json(left_out_));
  if (state_ || time_) report.figure("state", "state", options_.state_out);
}

}  // namespace remodel::app
