#include "json_reader.h"

#include <algorithm>
#include <cmath>

#include "base/strict_json.h"
#include "remodel/error.h"

namespace remodel {
namespace {

using nlohmann::json;

// Without the library's own prefix in brackets.
std::string message_of(const json::exception& e) {
  std::string message = e.what();
  if (const std::size_t end = message.find("] "); end != std::string::npos) message.erase(0, end + 2);
  return message;
}

// Where the text is no JSON.
[[noreturn]] void refuse_text(std::string_view text, std::size_t byte, const std::string& source) {
  const std::string_view before = text.substr(0, std::min(text.size(), std::max<std::size_t>(byte, 1) - 1));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  throw Error(ErrorCode::format, source + ":" + std::to_string(line),
              "found no JSON at column " + std::to_string(before.size() - before.rfind('\n')) +
                  ", expected a JSON object");
}

struct Watch {
  [[noreturn]] void too_deep() const {
    throw Error(ErrorCode::format, source, "found more than 64 brackets inside each other");
  }
  [[noreturn]] void repeated(const std::string& key) const {
    throw Error(ErrorCode::format, source, "found key " + json(key).dump() + " twice in one object");
  }
  const std::string& source;
};

}  // namespace

json parse_json(std::string_view text, const std::string& source) {
  try {
    StrictJson<json, Watch> strict(Watch{source});
    json::sax_parse(text, &strict);
    return json::parse(text);
  } catch (const json::parse_error& e) {
    refuse_text(text, e.byte, source);
  } catch (const json::exception& e) {
    throw Error(ErrorCode::format, source, message_of(e));
  }
}

double finite_for_json(double value, const char* what) {
  if (!std::isfinite(value)) throw Error(ErrorCode::argument, what, "expected finite numbers");
  return value;
}

std::vector<double> finite_for_json(const std::vector<double>& values, const char* what) {
  for (const double value : values) finite_for_json(value, what);
  return values;
}

void JsonReader::expect_keys(std::initializer_list<std::string_view> required,
                             std::initializer_list<std::string_view> optional) const {
  if (!value_->is_object()) refuse_kind("an object");
  for (const std::string_view key : required) {
    if (!value_->contains(key)) refuse("expected the key \"" + std::string(key) + "\"");
  }
  const auto among = [](const auto& keys, const std::string& key) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
  };
  for (const auto& [key, value] : value_->items()) {
    if (!among(required, key) && !among(optional, key)) refuse("found the unknown key " + json(key).dump());
  }
}

JsonReader JsonReader::operator[](const char* key) const {
  return {value_->at(key), source_, path_.empty() ? key : path_ + "." + key};
}

std::vector<JsonReader> JsonReader::elements() const {
  if (!value_->is_array()) refuse_kind("an array");
  std::vector<JsonReader> result;
  result.reserve(value_->size());
  for (std::size_t i = 0; i < value_->size(); ++i) {
    result.push_back({(*value_)[i], source_, path_ + "[" + std::to_string(i) + "]"});
  }
  return result;
}

double JsonReader::number() const {
  if (!value_->is_number() || !std::isfinite(value_->get<double>())) refuse_kind("a finite number");
  return value_->get<double>();
}

double JsonReader::number_or(const char* key, double otherwise) const {
  return has(key) ? (*this)[key].number() : otherwise;
}

std::vector<double> JsonReader::numbers() const {
  if (!value_->is_array()) refuse_kind("an array of numbers");
  std::vector<double> result;
  result.reserve(value_->size());
  for (const json& element : *value_) {
    if (!element.is_number()) break;
    result.push_back(element.get<double>());
  }
  if (result.size() < value_->size()) elements()[result.size()].refuse_kind("a finite number");
  return result;
}

std::string JsonReader::text() const {
  if (!value_->is_string()) refuse_kind("a string");
  return value_->get<std::string>();
}

bool JsonReader::truth() const {
  if (!value_->is_boolean()) refuse_kind("true or false");
  return value_->get<bool>();
}

void JsonReader::refuse(const std::string& problem) const {
  throw Error(ErrorCode::format, path_.empty() ? source_ : source_ + ": " + path_, problem);
}

void JsonReader::refuse_kind(const char* expected) const {
  std::string found = value_->dump(-1, ' ', true, json::error_handler_t::replace);
  if (found.size() > 40) found = found.substr(0, 40) + "...";
  refuse("found " + found + ", expected " + expected);
}

}  // namespace remodel
