#include "aero/problem_json.h"

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string_view>
#include <vector>

#include "base/strict_json.h"
#include "remodel/error.h"

namespace remodel {

namespace {

// Says what was found before this byte of the text, from 0, and what was expected in its place.
[[noreturn]] void fail_at(const std::string& file, const std::string& text, std::size_t byte,
                          const std::string& found, const std::string& expected) {
  const std::string_view before(text.data(), std::min(text.size(), byte));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t line_start = before.rfind('\n') + 1;  // 0 in the first line
  throw Error(
      ErrorCode::format, file + ":" + std::to_string(line),
      found + " at column " + std::to_string(before.size() - line_start + 1) + ", expected " + expected);
}

// How much of the text has been read.
std::size_t read_of(std::istringstream& stream, const std::string& text) {
  const auto at = stream.tellg();
  return at < 0 ? text.size() : static_cast<std::size_t>(at);
}

// Where the text that ends with this quotation mark begins.
std::size_t begin_of_quoted(const std::string& text, std::size_t end) {
  std::size_t at = end - 1;
  const auto is_escaped = [&](std::size_t quote) {
    std::size_t backslashes = 0;
    while (quote > backslashes && text[quote - backslashes - 1] == '\\') ++backslashes;
    return backslashes % 2 == 1;
  };
  do at = text.rfind('"', at - 1);
  while (is_escaped(at));
  return at;
}

struct Watch {
  [[noreturn]] void too_deep() const {
    fail_at(file, text, read_of(stream, text) - 1, "found more than 64 brackets inside each other", "fewer");
  }
  [[noreturn]] void repeated(const std::string& key) const {
    fail_at(file, text, begin_of_quoted(text, read_of(stream, text)),
            "found the key " + Json(key).dump() + " a second time in one object", "each key once");
  }
  const std::string &file, &text;
  std::istringstream& stream;
};

}  // namespace

Json parse_design_json(const std::string& text, const std::string& file, const char* expected) {
  std::istringstream watched(text), stream(text);
  StrictJson<Json, Watch> strict(Watch{file, text, watched});
  Json::sax_parse(watched, &strict);
  try {
    return Json::parse(stream);
  } catch (const Json::parse_error& error) {
    fail_at(file, text, std::max<std::size_t>(error.byte, 1) - 1, "found no JSON", expected);
  } catch (const Json::out_of_range&) {
    fail_at(file, text, read_of(stream, text) - 1, "found a number that is too large", "one below 1.8e308");
  }
}

}  // namespace remodel
