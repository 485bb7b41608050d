#pragma once

// A place in a design problem, for messages about it.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "remodel/error.h"

namespace remodel {

struct Limits {
  double low = 0.0, high = 0.0;
};

// Numbers and texts as problem files have them.
template <class T>
std::string shown(const T& value) {
  return nlohmann::json(value).dump();
}

class ProblemPlace {
 public:
  explicit ProblemPlace(std::string where) : where_(std::move(where)) {}
  ProblemPlace inner(const std::string& name) const { return ProblemPlace(where_ + ", " + name); }

  [[noreturn]] void fail(const std::string& problem) const {
    throw Error(ErrorCode::argument, where_, problem);
  }
  void require_number(double value, const char* key, Limits limits) const {
    if (!(value >= limits.low && value <= limits.high))
      fail("found " + shown(value) + " as '" + key + "', expected " + shown(limits.low) + " to " +
           shown(limits.high));
  }
  void require_word(const std::string& value, const char* key, const std::vector<std::string>& words) const {
    std::string names;
    for (const std::string& word : words) {
      if (word == value) return;
      names += (names.empty() ? "" : ", ") + word;
    }
    fail("found '" + value + "' as '" + key + "', expected " + names);
  }
  template <class T>
  const T& given(const std::optional<T>& value, const char* key) const {
    if (!value) fail("the key '" + std::string(key) + "' is missing");
    return *value;
  }

 private:
  std::string where_;
};

}  // namespace remodel
