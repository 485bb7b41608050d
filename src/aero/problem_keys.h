#pragma once

// Objects of a design problem, read key by key.

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "aero/problem_json.h"
#include "remodel/airfoil.h"
#include "remodel/design_space.h"
#include "remodel/error.h"
#include "remodel/flow.h"
#include "remodel/io.h"
#include "remodel/layers.h"
#include "remodel/shape_files.h"

namespace remodel {

// What a value of a type is called in messages.
template <class T>
constexpr const char* kind_of() {
  if constexpr (std::is_same_v<T, bool>) return "true or false";
  if constexpr (std::is_same_v<T, std::string>) return "a text in quotes";
  if constexpr (std::is_same_v<T, double>) return "a number";
  if constexpr (std::is_same_v<T, std::vector<double>>) return "an array of numbers";
  if constexpr (std::is_same_v<T, std::vector<std::string>>) return "an array of texts in quotes";
}

// A JSON object of which every key has to be known.
class Keys {
 public:
  // Of which keys are read that another one knows.
  Keys(const Json& object, std::string where) : object_(object), where_(std::move(where)) {
    if (!object.is_object()) fail("found " + std::string(object.type_name()) + ", expected an object");
  }
  Keys(const Json& object, std::string where, std::initializer_list<const char*> known)
      : Keys(object, std::move(where)) {
    for (const auto& [key, value] : object.items())
      if (std::find(known.begin(), known.end(), key) == known.end()) {
        std::string names;
        for (const char* name : known) names += (names.empty() ? "" : ", ") + std::string(name);
        fail("found the key '" + key + "', expected " + names);
      }
  }
  bool has(const char* key) const { return object_.contains(key); }
  void require(const char* key) const {
    if (!has(key)) fail("the key '" + std::string(key) + "' is missing");
  }
  template <class T>
  T get(const char* key, std::optional<T> fallback = {}) const {
    if (!has(key) && fallback) return *fallback;
    require(key);
    try {
      return object_.at(key).get<T>();
    } catch (const Json::exception&) {
      fail("found " + object_.at(key).dump() + " as '" + key + "', expected " + kind_of<T>());
    }
  }
  // None where there is no such key.
  template <class T>
  std::optional<T> find(const char* key) const {
    return has(key) ? std::optional<T>(get<T>(key)) : std::nullopt;
  }
  // A whole number, 0 or more.
  template <class T>
  T whole(const char* key, std::optional<T> fallback, T low, T high) const {
    if (!has(key) && fallback) return *fallback;
    require(key);
    return whole_number<T>(object_.at(key), key, low, high);
  }
  template <class T>
  T whole_number(const Json& value, const char* key, T low, T high) const {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() < static_cast<std::uint64_t>(low) ||
        value.get<std::uint64_t>() > static_cast<std::uint64_t>(high))
      fail("found " + value.dump() + " as '" + key + "', expected a whole number from " +
           std::to_string(low) + " to " + std::to_string(high));
    return value.get<T>();
  }
  // At most so many entries: a search with more of them would not end.
  Json list(const char* key, std::size_t most) const {
    if (!has(key)) return Json::array();
    if (!object_.at(key).is_array()) fail("expected an array as '" + std::string(key) + "'");
    if (const std::size_t found = object_.at(key).size(); found > most)
      fail("found " + std::to_string(found) + " entries in '" + key + "', expected at most " +
           std::to_string(most));
    return object_.at(key);
  }
  // Two numbers, the second one not below the first one.
  std::array<double, 2> pair(const char* key) const {
    const auto values = get<std::vector<double>>(key);
    if (values.size() != 2 || !(values[0] <= values[1]))
      fail("found " + Json(values).dump() + " as '" + key + "', expected two numbers, the lower one first");
    return {values[0], values[1]};
  }
  [[noreturn]] void fail(const std::string& problem) const {
    throw Error(ErrorCode::format, where_, problem);
  }

 private:
  const Json& object_;
  std::string where_;
};

constexpr int usual_degree = 5;  // of a design problem's sections

// The airfoil that a design problem in this directory calls by this name: a path leads on from the directory,
// whatever the program's own is.
inline CstFit airfoil_beside(const std::filesystem::path& directory, const std::string& name, int degree) {
  if (name.starts_with("naca:") || name == standard_input) return load_fit(name, degree);
  const std::filesystem::path file = directory / name;
  std::error_code ignored;
  if (name.find_first_of("/.") == std::string::npos && !std::filesystem::is_regular_file(file, ignored))
    return {.airfoil = named_airfoil(name, degree)};
  // With its directory, so that a name without a dot is one of a file too.
  return load_fit(file.has_parent_path() ? file.string() : "./" + file.string(), degree);
}

// The section that a key names; `warnings` gets what its file lost. Fits are of degree 8 at most; what is
// beyond is raised, exactly. Coefficients of a higher degree stay as they are.
inline CstAirfoil section_named(const Keys& keys, const char* key, int degree,
                                const std::filesystem::path& directory, std::vector<std::string>& warnings) {
  const std::string name = keys.get<std::string>(key);
  try {
    const CstFit fit = airfoil_beside(directory, name, std::min(degree, 8));
    warnings.insert(warnings.end(), fit.warnings.begin(), fit.warnings.end());
    return raise_degree(fit.airfoil, degree);
  } catch (const Error& error) {
    keys.fail("as '" + std::string(key) + "', " + error.what());
  }
}

// The same of a start, of which a design has as many numbers: coefficients of a file have the degree that the
// problem gives, if it does.
inline CstAirfoil start_named(const Keys& keys, const char* key, const std::optional<int>& given, int usual,
                              const std::filesystem::path& directory, std::vector<std::string>& warnings) {
  const CstAirfoil start = section_named(keys, key, given.value_or(usual), directory, warnings);
  const bool by_coefficients =
      std::filesystem::path(keys.get<std::string>(key)).extension() == ".json";  // fits may have another one
  return given && by_coefficients ? with_degree(start, *given) : start;
}

// The object of a key, empty where there is none.
inline Json object_of(const Json& json, const char* key) {
  return json.contains(key) ? json.at(key) : Json::object();
}

// The value whose name_of() a key has; without the key the first one.
template <class Enum>
Enum choice(const Keys& keys, const char* key, std::initializer_list<Enum> values) {
  const std::string name = keys.get<std::string>(key, name_of(*values.begin()));
  std::string expected;
  for (const Enum& value : values) {
    if (name == name_of(value)) return value;
    const bool is_last = &value == values.end() - 1;
    expected += (expected.empty() ? "" : is_last ? " or " : ", ") + std::string(name_of(value));
  }
  keys.fail("found '" + name + "' as '" + key + "', expected " + expected);
}

inline FlowModel model_named(const Keys& keys) {
  return choice(keys, "model", {FlowModel::euler, FlowModel::laminar, FlowModel::sa});
}

// FlowConditions::transition.
inline std::optional<std::array<double, 2>> transition_of(const Keys& keys) {
  if (!keys.has("transition")) return std::nullopt;
  const auto places = keys.get<std::vector<double>>("transition");
  if (places.size() != 2)
    keys.fail("found " + std::to_string(places.size()) +
              " numbers as 'transition', expected two: of upper and lower sides, 0 to 1");
  return std::array{places[0], places[1]};
}

// A Reynolds number is there with friction, and with it alone.
inline void require_reynolds(const Keys& keys, FlowModel model) {
  if (model != FlowModel::euler) return keys.require("reynolds");
  if (keys.has("reynolds"))
    keys.fail("found 'reynolds' without a model with friction, expected \"laminar\" or \"sa\" as 'model'");
}

// A layer of cells by its keys, what is not given as usual.
inline LayerOptions layer_given(const Json& object, const std::string& where, const LayerOptions& usual) {
  const Keys keys(object, where, {"first_height", "growth", "thickness"});
  LayerOptions layer = usual;
  layer.first_height = keys.get<double>("first_height", usual.first_height);
  layer.growth = keys.get<double>("growth", usual.growth);
  layer.thickness = keys.get<double>("thickness", usual.thickness);
  return layer;
}

}  // namespace remodel
