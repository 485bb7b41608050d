#include "report.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "number_text.h"
#include "remodel/error.h"
#include "warnings.h"

namespace remodel::app {
namespace {

std::string readable(const Json& value) {
  if (value.is_number_float()) return short_text(value.get<double>());
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_string()) return value.get<std::string>();
  return value.dump();
}

void put(const std::string& text) {
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!written || std::fflush(stdout) != 0) {
    throw Error(ErrorCode::file, "standard output",
                std::string("cannot be written: ") + std::strerror(errno));
  }
}

}  // namespace

void Report::figure(const std::string& key, const std::string& label, const Json& value,
                    const std::string& unit) {
  data(key, value);
  line(label, unit.empty() ? readable(value) : readable(value) + " " + unit);
}

void Report::data(const std::string& key, Json value) {
  object_[key] = std::move(value);
}

void Report::line(const std::string& label, const std::string& text) {
  lines_.push_back({label, text});
}

// Names in a foreign file may be invalid UTF-8; a replacement character is better than no figures at all.
std::string Report::json_text() const {
  Json object = object_;
  Json said = warnings();
  if (object.contains("warnings"))
    for (const Json& sentence : object["warnings"])
      if (std::find(said.begin(), said.end(), sentence) == said.end()) said.push_back(sentence);
  object["warnings"] = std::move(said);
  return object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void Report::print_json() const {
  put(json_text());
}

void Report::print_text() const {
  std::size_t width = 0;
  for (const Line& line : lines_) width = std::max(width, line.label.size());
  std::string text;
  for (const Line& line : lines_) {
    text += line.label + std::string(width - line.label.size() + 2, ' ') + line.text + "\n";
  }
  put(text);
}

}  // namespace remodel::app
