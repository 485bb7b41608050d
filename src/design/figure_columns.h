#pragma once

// Figures (remodel/figures.h) as columns of a table.

#include <algorithm>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "design/sqlite.h"
#include "remodel/figures.h"
#include "remodel/living_mesh.h"

namespace remodel {

// How a figure is kept in a column: its type in SQL, and the way there and back. NULL where it may be
// missing.
template <class Value>
struct Column;

template <>
struct Column<double> {
  static constexpr const char* type = "REAL";
  static constexpr bool null = false;
  static void bind(Statement& row, double value) { row.bind(value); }
  static double read(Statement& row) { return row.real(); }
};
template <>
struct Column<std::uint64_t> {  // std::size_t too
  static constexpr const char* type = "INTEGER";
  static constexpr bool null = false;
  static void bind(Statement& row, std::uint64_t value) { row.bind_integer(value); }
  static std::uint64_t read(Statement& row) { return row.integer(); }
};
template <>
struct Column<bool> {
  static constexpr const char* type = "INTEGER";
  static constexpr bool null = false;
  static void bind(Statement& row, bool value) { row.bind_integer(std::uint64_t{value}); }
  static bool read(Statement& row) { return row.integer() != 0; }
};
template <>
struct Column<std::optional<double>> {
  static constexpr const char* type = "REAL";
  static constexpr bool null = true;
  static void bind(Statement& row, std::optional<double> value) { row.bind(value); }
  static std::optional<double> read(Statement& row) { return row.optional_real(); }
};
template <>
struct Column<std::optional<std::size_t>> {
  static constexpr const char* type = "INTEGER";
  static constexpr bool null = true;
  static void bind(Statement& row, std::optional<std::size_t> value) { row.bind_integer(value); }
  static std::optional<std::size_t> read(Statement& row) { return row.optional_integer(); }
};
template <>
struct Column<std::string> {
  static constexpr const char* type = "TEXT";
  static constexpr bool null = true;
  static void bind(Statement& row, const std::string& value) {
    value.empty() ? row.bind_null() : row.bind(value);
  }
  static std::string read(Statement& row) { return row.text(); }
};
template <>
struct Column<Checked> {
  static constexpr const char* type = "TEXT";
  static constexpr bool null = false;
  static void bind(Statement& row, Checked value) { row.bind(std::string(name_of(value))); }
  static Checked read(Statement& row) { return checked_named(row.text()); }
};
// Lists as JSON: nlohmann writes doubles so that they read back exactly.
template <class List>
struct JsonColumn {
  static constexpr const char* type = "TEXT";
  static constexpr bool null = true;
  static void bind(Statement& row, const List& list) {
    list.empty() ? row.bind_null() : row.bind(nlohmann::json(list).dump());
  }
  static List read(Statement& row) {
    const std::string text = row.text();
    return text.empty() ? List() : nlohmann::json::parse(text).get<List>();
  }
};
template <>
struct Column<std::vector<double>> : JsonColumn<std::vector<double>> {};
template <>
struct Column<std::map<std::string, double>> : JsonColumn<std::map<std::string, double>> {};

// Whether rows are inserted with all their figures, or figures may be filled in later.
enum class Missing { never, at_first };

template <class List>
std::string column_definitions(const List& figures, Missing missing) {
  std::string result;
  const auto add = [&]<class Record, class Value>(const Figure<Record, Value>& figure) {
    result += (result.empty() ? "" : ", ") + std::string(figure.name) + " " + Column<Value>::type;
    if (missing == Missing::never && !Column<Value>::null) result += " NOT NULL";
  };
  std::apply([&](const auto&... figure) { (add(figure), ...); }, figures);
  return result;
}

template <class List>
std::string column_names(const List& figures) {
  std::string result;
  const auto add = [&](const auto& figure) {
    result += (result.empty() ? "" : ", ") + std::string(figure.name);
  };
  std::apply([&](const auto&... figure) { (add(figure), ...); }, figures);
  return result;
}

// "?,?,?": one for each figure.
template <class List>
std::string placeholders(const List&) {
  std::string result = "?";
  for (std::size_t i = 1; i < std::tuple_size_v<List>; ++i) result += ",?";
  return result;
}

template <class List, class Record>
void bind_figures(Statement& row, const List& figures, const Record& record) {
  for_each_figure(figures, record,
                  [&]<class Value>(const auto&, const Value& value) { Column<Value>::bind(row, value); });
}

// Throws nlohmann::json::exception and std::invalid_argument for what was not written by bind_figures().
template <class List, class Record>
void read_figures(Statement& row, const List& figures, Record& record) {
  for_each_figure(figures, record,
                  [&]<class Value>(const auto&, Value& value) { value = Column<Value>::read(row); });
}

}  // namespace remodel
