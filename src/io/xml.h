#pragma once

// As much of XML as VTK's files use: tags, attributes, text between. No document tree.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace remodel::io {

struct XmlTag {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;  // entities resolved
  bool closing = false;                                         // </name>
  bool empty = false;                                           // <name/>
  std::size_t begin = 0;                                        // of '<' in the text
  std::size_t end = 0;                                          // behind '>'

  // Empty if there is no such attribute.
  std::string_view attribute(std::string_view key) const;
};

class XmlScanner {
 public:
  XmlScanner(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  // The next tag; comments and processing instructions are passed over.
  std::optional<XmlTag> next();
  std::size_t line_of(std::size_t position) const;
  [[noreturn]] void fail(std::size_t position, const std::string& problem) const;

 private:
  XmlTag read_tag(std::size_t begin) const;

  std::string_view text_;
  std::string file_;
  std::size_t position_ = 0;
};

std::string xml_escaped(std::string_view text);

}  // namespace remodel::io
