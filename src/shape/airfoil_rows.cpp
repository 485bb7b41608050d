#include "airfoil_rows.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "remodel/error.h"

namespace remodel {
namespace {

// Chords in millimetres are fine; beyond this it is no airfoil.
constexpr double largest_coordinate = 1e6;

[[noreturn]] void refuse(const std::string& source, int line, const std::string& problem) {
  throw Error(ErrorCode::format, source + ":" + std::to_string(line), problem);
}

// What was found, short; tabs, which separate columns too, as tabs.
std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 40;
  return "\"" + one_line(text.substr(0, longest)) + (text.size() > longest ? "...\"" : "\"");
}

bool is_separator(char c) {
  return c == ' ' || c == '\t' || c == ',' || c == '\f' || c == '\v';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_separator(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_separator(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view without_comment(std::string_view text) {
  return text.substr(0, text.find_first_of("#!%"));
}

std::vector<std::string_view> tokens_of(std::string_view text) {
  std::vector<std::string_view> tokens;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    std::size_t length = 0;
    while (length < text.size() && !is_separator(text[length])) ++length;
    tokens.push_back(text.substr(0, length));
    text.remove_prefix(length);
  }
  return tokens;
}

// -.0228, 1., +0.5, 1.2D-3 (Fortran). NaN and infinity are numbers here: they are refused by name later. What
// is too large for a double comes back as infinity.
std::optional<double> number_of(std::string_view token) {
  std::string text(token);
  for (std::size_t i = 1; i < text.size(); ++i) {
    const bool after_mantissa = (text[i - 1] >= '0' && text[i - 1] <= '9') || text[i - 1] == '.';
    if ((text[i] == 'D' || text[i] == 'd') && after_mantissa) text[i] = 'e';
  }
  std::size_t sign = text.starts_with('+') ? 1 : 0;
  if (sign == 1 && text.starts_with("+-")) return std::nullopt;
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + sign, end, value);
  if (stop != end || error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc::result_out_of_range) return text.find("e-") == std::string::npos ? HUGE_VAL : 0.0;
  return value;
}

// A line of text without its end; \n, \r\n and \r all end lines.
std::string_view next_line(std::string_view& text) {
  const std::size_t length = std::min(text.find_first_of("\r\n"), text.size());
  const std::string_view line = text.substr(0, length);
  text.remove_prefix(length);
  if (text.starts_with("\r\n")) text.remove_prefix(1);
  if (!text.empty()) text.remove_prefix(1);
  return line;
}

void check_printable(std::string_view line, const std::string& source, int number) {
  for (const char c : line) {
    const unsigned char byte = static_cast<unsigned char>(c);
    if ((byte < 0x20 && !is_separator(c)) || byte == 0x7f) {
      refuse(source, number, "found byte " + std::to_string(byte) + ", expected text");
    }
  }
}

Point point_of(std::string_view line, const std::string& source, int number) {
  const std::vector<std::string_view> tokens = tokens_of(without_comment(line));
  if (tokens.size() != 2) {
    refuse(source, number, "found " + quoted(trimmed(line)) + ", expected two numbers, x and y");
  }
  double values[2];
  for (std::size_t i = 0; i < 2; ++i) {
    const std::optional<double> value = number_of(tokens[i]);
    if (!value) refuse(source, number, "found " + quoted(tokens[i]) + ", expected a number");
    if (!(std::abs(*value) <= largest_coordinate)) {
      refuse(source, number, "found " + quoted(tokens[i]) + ", expected a finite coordinate of at most 1e6");
    }
    values[i] = *value;
  }
  return {values[0], values[1]};
}

bool is_two_numbers(std::string_view line) {
  const std::vector<std::string_view> tokens = tokens_of(without_comment(line));
  return tokens.size() == 2 && number_of(tokens[0]) && number_of(tokens[1]);
}

// A line of its own before the coordinates: "129".
bool is_count(std::string_view line) {
  return line.size() > 1 &&
         std::all_of(line.begin(), line.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool begins_with_letter(std::string_view word) {
  return (word[0] >= 'a' && word[0] <= 'z') || (word[0] >= 'A' && word[0] <= 'Z');
}

// Text is what cannot be a damaged coordinate: more than two words that are not all numbers, a count and a
// word
// ("61 points"), or a first word that begins with a letter or has no digit, and is no name of a number (nan).
bool is_remark(std::string_view line) {
  const std::vector<std::string_view> tokens = tokens_of(without_comment(line));
  const auto is_word = [](std::string_view token) { return !number_of(token); };
  if (tokens.size() > 2) return std::any_of(tokens.begin(), tokens.end(), is_word);
  const std::string_view first = tokens.front();
  if (is_word(first)) return begins_with_letter(first) || std::none_of(first.begin(), first.end(), is_digit);
  const bool count = first.size() > 1 && std::all_of(first.begin(), first.end(), is_digit);
  return count && tokens.size() == 2 && is_word(tokens[1]) && begins_with_letter(tokens[1]);
}

// MSES' second line, the grid's box: left, right, lower, upper.
bool is_box_of_mses(std::string_view line) {
  const std::vector<std::string_view> tokens = tokens_of(without_comment(line));
  if (tokens.size() != 4) return false;
  double values[4];
  for (std::size_t i = 0; i < 4; ++i) {
    const std::optional<double> value = number_of(tokens[i]);
    if (!value || !std::isfinite(*value)) return false;
    values[i] = *value;
  }
  return values[0] < values[1] && values[2] < values[3];
}

// The row that MSES has between two elements.
bool is_end_of_element(Point p) {
  return p == Point{999.0, 999.0};
}

// DOS ends a text with this byte.
std::string_view without_end_of_file(std::string_view text) {
  while (!text.empty() && text.back() == '\x1a') text.remove_suffix(1);
  return text;
}

}  // namespace

// Lines of text stand before the first row, after the last one, and nowhere else.
AirfoilRows read_airfoil_rows(std::string_view text, const std::string& source) {
  if (text.size() > airfoil_text_limit)
    throw Error(ErrorCode::format, source, "more than 16 MiB, expected a small text file");
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // UTF-8 byte order mark
  text = without_end_of_file(text);
  std::string remark;  // the first one behind a row
  int remark_line = 0;
  AirfoilRows result;
  bool first = true, ended = false;  // a first line that says something; the end of an element of MSES
  for (int number = 1; !text.empty(); ++number) {
    const std::string_view line = next_line(text);
    check_printable(line, source, number);
    const std::string_view content = trimmed(line);
    if (content.empty() || trimmed(without_comment(content)).empty()) continue;
    // Only the first line that says anything may be a name: "2412" or "63-206 modified" as well.
    const bool box = result.rows.empty() && is_box_of_mses(content);
    if (first && !box && !is_two_numbers(content)) {
      result.name = content;
    } else if (box || (result.rows.empty() && is_count(content))) {
      // It says nothing of the airfoil.
    } else if (is_remark(content)) {
      if (remark.empty() && !result.rows.empty()) remark = content, remark_line = number;
    } else {
      if (!remark.empty()) point_of(remark, source, remark_line);  // says what it is
      const Point point = point_of(content, source, number);
      if (ended)
        refuse(source, number, "found another element of a file of MSES, expected one airfoil in a file");
      ended = is_end_of_element(point);
      if (!ended) result.rows.push_back({point, number});
    }
    first = false;
  }
  return result;
}

}  // namespace remodel
