#pragma once

// Collects a subcommand's results and prints them once on standard output, as one JSON object (--json) or as
// aligned lines.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace remodel::app {

using Json = nlohmann::ordered_json;

class Report {
 public:
  // A figure in both forms: `key` in JSON; `label`, value and unit in text.
  void figure(const std::string& key, const std::string& label, const Json& value,
              const std::string& unit = "");
  // A figure in one of the forms only.
  void data(const std::string& key, Json value);
  void line(const std::string& label, const std::string& text);

  // The JSON object as text, with a final newline; "warnings" has those of warnings.h.
  std::string json_text() const;
  // Throws Error (file) if writing to standard output fails.
  void print_json() const;
  void print_text() const;
  void print(bool json) const { json ? print_json() : print_text(); }

 private:
  struct Line {
    std::string label;
    std::string text;
  };
  Json object_ = Json::object();
  std::vector<Line> lines_;
};

}  // namespace remodel::app
