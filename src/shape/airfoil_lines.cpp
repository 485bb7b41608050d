#include "airfoil_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "remodel/error.h"

namespace remodel {
namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\f' || c == '\v';
}

bool is_separator(char c, DecimalSign sign) {
  return is_space(c) || c == ';' || (c == ',' && sign == DecimalSign::point);
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool begins_with_letter(std::string_view word) {
  return (word[0] >= 'a' && word[0] <= 'z') || (word[0] >= 'A' && word[0] <= 'Z');
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const auto separates = [](char c) { return is_separator(c, DecimalSign::point); };
  while (!text.empty() && separates(text.front())) text.remove_prefix(1);
  while (!text.empty() && separates(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view without_comment(std::string_view text) {
  return text.substr(0, text.find_first_of("#!%"));
}

std::vector<std::string_view> words_of(std::string_view text, DecimalSign sign) {
  std::vector<std::string_view> words;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    std::size_t length = 0;
    while (length < text.size() && !is_separator(text[length], sign)) ++length;
    words.push_back(text.substr(0, length));
    text.remove_prefix(length);
  }
  return words;
}

std::optional<double> number_of(std::string_view word, DecimalSign sign) {
  std::string text(word);
  if (sign == DecimalSign::comma) std::replace(text.begin(), text.end(), ',', '.');
  for (std::size_t i = 1; i < text.size(); ++i) {
    const bool after_mantissa = is_digit(text[i - 1]) || text[i - 1] == '.';
    if ((text[i] == 'D' || text[i] == 'd') && after_mantissa) text[i] = 'e';
  }
  const std::size_t first = text.starts_with('+') ? 1 : 0;
  if (first == 1 && text.starts_with("+-")) return std::nullopt;
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + first, end, value);
  if (stop != end || error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc::result_out_of_range) return text.find("e-") == std::string::npos ? HUGE_VAL : 0.0;
  return value;
}

std::vector<double> numbers_of(std::string_view line, DecimalSign sign) {
  std::vector<double> values;
  for (const std::string_view word : words_of(without_comment(line), sign)) {
    const std::optional<double> value = number_of(word, sign);
    if (!value) return {};
    values.push_back(*value);
  }
  return values;
}

bool is_whole_number(std::string_view word) {
  return !word.empty() && std::all_of(word.begin(), word.end(), is_digit);
}

bool has_decimal_commas(std::string_view line) {
  const std::vector<std::string_view> words = words_of(without_comment(line), DecimalSign::comma);
  bool comma = false;
  for (const std::string_view word : words) {
    if (word.find('.') != word.npos || !number_of(word, DecimalSign::comma)) return false;
    const std::size_t at = word.find(',');
    if (at == word.npos) continue;
    if (at + 1 == word.size() || !is_digit(word[at + 1])) return false;
    comma = true;
  }
  return comma && words.size() >= 2;
}

bool is_remark(std::string_view line) {
  const std::vector<std::string_view> words = words_of(without_comment(line));
  if (words.empty()) return true;
  const auto is_word = [](std::string_view word) { return !number_of(word); };
  if (words.size() > 2) return std::any_of(words.begin(), words.end(), is_word);
  const std::string_view first = words.front();
  if (is_word(first)) return begins_with_letter(first) || std::none_of(first.begin(), first.end(), is_digit);
  const bool count = first.size() > 1 && is_whole_number(first);
  return count && words.size() == 2 && is_word(words[1]) && begins_with_letter(words[1]);
}

bool is_footer(std::string_view line) {
  if (is_remark(line)) return true;
  const std::string_view first = words_of(line).front();
  return !number_of(first) && !first.starts_with("0x");
}

std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 40;
  return "\"" + one_line(text.substr(0, longest)) + (text.size() > longest ? "...\"" : "\"");
}

std::string_view next_line(std::string_view& text) {
  const std::size_t length = std::min(text.find_first_of("\r\n"), text.size());
  const std::string_view line = text.substr(0, length);
  text.remove_prefix(length);
  if (text.starts_with("\r\n")) text.remove_prefix(1);
  if (!text.empty()) text.remove_prefix(1);
  return line;
}

}  // namespace remodel
