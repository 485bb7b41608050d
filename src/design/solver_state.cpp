#include "design/solver_state.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

#include "remodel/error.h"
#include "remodel/transfer.h"

namespace remodel {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// Values by position have the same numbers on both.
bool same_connectivity(const FrozenMesh& a, const FrozenMesh& b) {
  const auto same_edges = [](const FrozenBoundary& one, const FrozenBoundary& other) {
    return one.name == other.name && one.edges == other.edges;
  };
  return a.vertex_keys == b.vertex_keys && a.triangles == b.triangles && a.quads == b.quads &&
         std::equal(a.boundaries.begin(), a.boundaries.end(), b.boundaries.begin(), b.boundaries.end(),
                    same_edges);
}

Json binary(const std::string& text) {
  return Json::binary(std::vector<std::uint8_t>(text.begin(), text.end()));
}

std::string text_of(const Json& json) {
  const auto& bytes = json.get_binary();
  return {bytes.begin(), bytes.end()};
}

}  // namespace

std::unique_ptr<SolverState> SolverState::read(const fs::path& directory, const StateFiles& files,
                                               FrozenMesh mesh) {
  auto state = std::make_unique<SolverState>();
  const fs::path file = directory / files.restart;
  if (!files.restart.empty() && fs::exists(file)) {
    state->restart_ = read_su2_restart(file);
    set_coordinates(*state->restart_, mesh, file.string());
  }
  if (files.foam_case)
    if (const fs::path latest = latest_foam_time(directory / "case"); !latest.empty())
      state->time_ = read_foam_time(latest, mesh);
  if (!state->restart_ && !state->time_) return nullptr;
  state->mesh_ = std::move(mesh);
  return state;
}

std::string SolverState::bytes() const {
  Json content = Json::object();
  if (restart_) content["restart"] = binary(su2_restart_bytes(*restart_));
  if (time_)
    for (const FoamField& field : time_->fields) content["time"][field.name] = binary(foam_text(field));
  if (earlier_)
    for (const Snapshots::Snapshot& snapshot : earlier_->kept())
      content["snapshots"].push_back({{"design", snapshot.design}, {"values", snapshot.values}});
  const std::vector<std::uint8_t> bytes = Json::to_cbor(content);
  return {bytes.begin(), bytes.end()};
}

std::unique_ptr<SolverState> SolverState::from(const std::string& bytes, FrozenMesh mesh,
                                               const std::string& source, std::size_t limit) {
  auto state = std::make_unique<SolverState>();
  try {
    const Json content = Json::from_cbor(bytes);
    if (content.contains("restart"))
      state->restart_ = parse_su2_restart(text_of(content.at("restart")), source);
    if (content.contains("time")) state->time_.emplace();
    if (state->time_)
      for (const auto& [name, field] : content.at("time").items())
        state->time_->fields.push_back(parse_foam_field(name, text_of(field), source, mesh));
    if (limit != 0) state->earlier_.emplace(SnapshotOptions{.limit = limit});
    if (limit != 0 && content.contains("snapshots"))
      for (const Json& snapshot : content.at("snapshots"))
        state->earlier_->add(snapshot.at("design").get<std::vector<double>>(),
                             snapshot.at("values").get<std::vector<double>>());
  } catch (const Json::exception& problem) {
    throw Error(ErrorCode::format, source, std::string("expected the state of a solver: ") + problem.what());
  }
  if (state->earlier_ && state->earlier_->size() != 0 &&
      state->earlier_->kept().back().values.size() != state->values().size())
    throw Error(ErrorCode::format, source, "found earlier states of another size than the last one");
  if (state->restart_) set_coordinates(*state->restart_, mesh, source);
  state->mesh_ = std::move(mesh);
  return state;
}

// The lists of numbers of a state, with the number of components of each entry.
template <class State, class Visit>
void SolverState::each_list(State& state, const Visit& visit) {
  if (state.restart_) visit(state.restart_->values, state.restart_->names.size());
  if (state.time_)
    for (auto& field : state.time_->fields)
      for (auto& list : field.lists) visit(list.values, static_cast<std::size_t>(list.components));
}

std::vector<double> SolverState::values() const {
  std::vector<double> all;
  each_list(*this, [&](const std::vector<double>& list, std::size_t) {
    all.insert(all.end(), list.begin(), list.end());
  });
  return all;
}

void SolverState::set_values(const std::vector<double>& values) {
  auto from = values.begin();
  each_list(*this, [&](std::vector<double>& list, std::size_t) {
    const auto end = from + static_cast<std::ptrdiff_t>(list.size());
    list.assign(std::exchange(from, end), end);
  });
}

// The same lists, of the same variables: values() of both have the same meaning.
bool SolverState::same_numbers(const SolverState& other) const {
  const auto shape = [](const SolverState& state) {
    std::vector<std::string> names;
    std::vector<std::array<std::size_t, 2>> sizes;
    if (state.restart_) names = state.restart_->names;
    if (state.time_)
      for (const FoamField& field : state.time_->fields) {
        names.push_back(field.name);
        for (const FoamList& list : field.lists) names.push_back(list.patch);
      }
    each_list(state, [&](const std::vector<double>& list, std::size_t components) {
      sizes.push_back({list.size(), components});
    });
    return std::pair(names, sizes);
  };
  return same_connectivity(mesh_, other.mesh_) && shape(*this) == shape(other);
}

void SolverState::remember(SolverState* before, std::span<const double> design, std::size_t limit) {
  if (limit == 0) return;
  if (before != nullptr && before->earlier_ && same_numbers(*before))
    earlier_ = std::move(before->earlier_);
  else
    earlier_.emplace(SnapshotOptions{.limit = limit});
  earlier_->add(design, values());
}

// Whether each variable that is positive in all states kept is so in the combination: density, pressure and
// temperature have to be.
bool SolverState::keeps_positive(const SnapshotStart& start) const {
  bool good = true;
  std::size_t begin = 0;
  each_list(*this, [&](const std::vector<double>& list, std::size_t components) {
    for (std::size_t k = 0; k < components && good; ++k) {
      const auto positive = [&](const std::vector<double>& values) {
        for (std::size_t i = k; i < list.size(); i += components)
          if (!(values[begin + i] > 0.0)) return false;
        return true;
      };
      if (positive(start.values)) continue;
      const auto& kept = earlier_->kept();
      good = !std::all_of(kept.begin(), kept.end(),
                          [&](const Snapshots::Snapshot& one) { return positive(one.values); });
    }
    begin += list.size();
  });
  return good;
}

StartRecord SolverState::write(const FrozenMesh& now, std::span<const double> design,
                               const fs::path& directory, const StateFiles& files) const {
  SolverState on;
  on.restart_ = restart_, on.time_ = time_;
  StartRecord record;
  std::optional<SnapshotStart> start;
  if (earlier_ && same_connectivity(mesh_, now)) start = earlier_->start(design);
  if (start) {
    record = {.snapshots = start->snapshots, .misfit = start->misfit};
    if (!keeps_positive(*start)) {
      start->values = earlier_->kept()[start->base].values;
      record = {.snapshots = 1, .misfit = 1.0};
    }
    on.set_values(start->values);
  } else {
    const Transfer transfer(mesh_, now);
    if (on.restart_)
      transfer.ride(FieldPlace::vertices, static_cast<int>(on.restart_->names.size()), on.restart_->values);
    // Within the bounds of old values: weights of a ride on triangles may be negative.
    if (on.time_)
      carry_foam_time(*on.time_, mesh_, now, [&](int components, std::vector<double>& values) {
        transfer.remap(FieldPlace::triangles, components, values);
      });
  }
  if (on.restart_ && !files.restart.empty()) {
    set_coordinates(*on.restart_, now, files.restart);
    write_su2_restart(*on.restart_, directory / files.restart);
  }
  if (on.time_) write_foam_time(*on.time_, directory / "case" / "0");
  return record;
}

}  // namespace remodel
