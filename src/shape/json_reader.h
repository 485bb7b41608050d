#pragma once

// Strict reading of JSON: every complaint names the source and the key.

#include <cstddef>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace remodel {

// The parsed text. Throws Error (format) for what is no JSON, for a key that appears twice in one object, and
// for brackets nested deeper than 64. Of any length: a domain of a million points is one.
nlohmann::json parse_json(std::string_view text, const std::string& source);

// Refuses to write what JSON cannot hold: throws Error (argument) for NaN and infinity.
double finite_for_json(double value, const char* what);
std::vector<double> finite_for_json(const std::vector<double>& values, const char* what);

// A value and where it is. Every function throws Error (format) where the value is of another kind. The
// parsed text has to outlive its readers.
class JsonReader {
 public:
  JsonReader(const nlohmann::json& value, std::string source) : JsonReader(value, std::move(source), "") {}

  // An object with all of the required keys and no others than these and the optional ones.
  void expect_keys(std::initializer_list<std::string_view> required,
                   std::initializer_list<std::string_view> optional = {}) const;
  bool is_object() const { return value_->is_object(); }
  bool has(const char* key) const { return value_->contains(key); }
  JsonReader operator[](const char* key) const;
  std::vector<JsonReader> elements() const;

  double number() const;  // finite
  double number_or(const char* key, double otherwise) const;
  std::vector<double> numbers() const;
  std::string text() const;
  bool truth() const;

  [[noreturn]] void refuse(const std::string& problem) const;

 private:
  JsonReader(const nlohmann::json& value, std::string source, std::string path)
      : value_(&value), source_(std::move(source)), path_(std::move(path)) {}
  [[noreturn]] void refuse_kind(const char* expected) const;

  const nlohmann::json* value_;
  std::string source_;
  std::string path_;  // such as loops[0].curves[1].name; empty for the whole text
};

}  // namespace remodel
