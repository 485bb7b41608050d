#include "io/xml.h"

#include <algorithm>
#include <array>

#include "io/scanner.h"
#include "remodel/error.h"

namespace remodel::io {

namespace {

constexpr std::array<std::pair<std::string_view, char>, 5> entities = {
    {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}}};

std::string unescaped(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const auto found = std::find_if(entities.begin(), entities.end(),
                                    [&](const auto& entity) { return text.starts_with(entity.first); });
    result += found != entities.end() ? found->second : text.front();
    text.remove_prefix(found != entities.end() ? found->first.size() : 1);
  }
  return result;
}

bool is_xml_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

}  // namespace

std::string xml_escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const auto found = std::find_if(entities.begin(), entities.end(),
                                    [&](const auto& entity) { return entity.second == c; });
    if (found != entities.end()) {
      result += found->first;
    } else {
      result += c;
    }
  }
  return result;
}

std::string_view XmlTag::attribute(std::string_view key) const {
  for (const auto& [name_found, value] : attributes) {
    if (name_found == key) return value;
  }
  return {};
}

std::size_t XmlScanner::line_of(std::size_t position) const {
  const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(position, text_.size()));
  return 1 + static_cast<std::size_t>(std::count(text_.begin(), end, '\n'));
}

void XmlScanner::fail(std::size_t position, const std::string& problem) const {
  throw Error(ErrorCode::format, file_ + ":" + std::to_string(line_of(position)), problem);
}

std::optional<XmlTag> XmlScanner::next() {
  for (;;) {
    const std::size_t begin = text_.find('<', position_);
    if (begin == std::string_view::npos) return std::nullopt;
    const std::string_view rest = text_.substr(begin);
    std::string_view terminator;
    if (rest.starts_with("<!--")) {
      terminator = "-->";
    } else if (rest.starts_with("<?") || rest.starts_with("<!")) {
      terminator = ">";
    } else {
      XmlTag tag = read_tag(begin);
      position_ = tag.end;
      return tag;
    }
    const std::size_t end = text_.find(terminator, begin);
    if (end == std::string_view::npos)
      fail(begin, "the end found, '" + std::string(terminator) + "' expected");
    position_ = end + terminator.size();
  }
}

XmlTag XmlScanner::read_tag(std::size_t begin) const {
  XmlTag tag;
  tag.begin = begin;
  std::size_t at = begin + 1;
  const auto current = [&] { return at < text_.size() ? text_[at] : '\0'; };
  const auto skip_blanks = [&] {
    while (is_xml_blank(current())) ++at;
  };
  const auto read_name = [&] {
    const std::size_t start = at;
    while (at < text_.size() && !is_xml_blank(text_[at]) && text_.substr(at, 1).find_first_of("=/><\"") != 0)
      ++at;
    if (at == start) fail(at, in_quotes(text_.substr(at, 1)) + " found, a name expected");
    return std::string(text_.substr(start, at - start));
  };

  if (current() == '/') {
    tag.closing = true;
    ++at;
  }
  tag.name = read_name();
  for (skip_blanks(); current() != '>' && current() != '/'; skip_blanks()) {
    std::string key = read_name();
    skip_blanks();
    if (current() != '=') fail(at, "attribute " + in_quotes(key) + " found, a value expected");
    ++at;
    skip_blanks();
    const char quote = current();
    const std::size_t end =
        quote == '"' || quote == '\'' ? text_.find(quote, at + 1) : std::string_view::npos;
    if (end == std::string_view::npos)
      fail(at, "attribute " + in_quotes(key) + " found, a value in quotes expected");
    tag.attributes.emplace_back(std::move(key), unescaped(text_.substr(at + 1, end - at - 1)));
    at = end + 1;
  }
  if (current() == '/') {
    tag.empty = true;
    ++at;
  }
  if (current() != '>') fail(at, in_quotes(text_.substr(at, 1)) + " found, '>' expected");
  tag.end = at + 1;
  return tag;
}

}  // namespace remodel::io
