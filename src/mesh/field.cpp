#include "remodel/field.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "remodel/error.h"

namespace remodel {

namespace {

const char* name_of(FieldPlace place, const FrozenMesh& mesh) {
  if (place == FieldPlace::vertices) return "vertices";
  return mesh.quads.empty() ? "triangles" : "cells";
}

bool is_possible_name(const std::string& name) {
  const auto bad = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; };
  return !name.empty() && std::none_of(name.begin(), name.end(), bad);
}

[[noreturn]] void refuse(const Field& field, const std::string& problem) {
  throw Error(ErrorCode::argument, "field '" + field.name + "'", problem);
}

}  // namespace

bool is_finite(const Field& field) {
  return std::all_of(field.values.begin(), field.values.end(), [](double v) { return std::isfinite(v); });
}

void require_fit(const Field& field, const FrozenMesh& mesh) {
  if (!is_possible_name(field.name)) {
    throw Error(ErrorCode::argument, "field",
                "an empty name or one with control characters found, another expected");
  }
  if (field.components < 1 || field.components > 3) {
    refuse(field, std::to_string(field.components) + " components found, 1 to 3 expected");
  }
  const auto components = static_cast<std::size_t>(field.components);
  const std::size_t places = field.place == FieldPlace::vertices ? mesh.points.size() : mesh.cell_count();
  if (field.values.size() != components * places) {
    refuse(field, std::to_string(field.values.size()) + " values found, " +
                      std::to_string(components * places) + " expected: " + std::to_string(field.components) +
                      " for each of " + std::to_string(places) + " " + name_of(field.place, mesh));
  }
  if (is_finite(field)) return;
  const auto bad = std::find_if_not(field.values.begin(), field.values.end(),
                                    [](double value) { return std::isfinite(value); });
  const auto index = static_cast<std::size_t>(bad - field.values.begin()) / components;
  refuse(field, std::to_string(*bad) + " found at number " + std::to_string(index) + " of the " +
                    name_of(field.place, mesh) + ", finite values expected");
}

void require_fit(std::span<const Field> fields, const FrozenMesh& mesh) {
  std::set<std::pair<FieldPlace, std::string>> names;
  for (const Field& field : fields) {
    require_fit(field, mesh);
    if (!names.emplace(field.place, field.name).second) {
      refuse(field, std::string("a second one on ") + name_of(field.place, mesh) +
                        " found, each name once expected");
    }
  }
}

const Field* find_field(std::span<const Field> fields, const std::string& name) {
  const Field* found = nullptr;
  for (const Field& field : fields) {
    if (field.name != name) continue;
    if (field.place == FieldPlace::vertices) return &field;
    if (found == nullptr) found = &field;
  }
  return found;
}

}  // namespace remodel
