#include "io/scanner.h"

#include <charconv>
#include <cmath>

#include "remodel/error.h"
#include "remodel/ids.h"

namespace remodel::io {

namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v';
}

// from_chars takes no leading plus sign.
std::string_view without_plus(std::string_view word) {
  return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
}

}  // namespace

std::string in_quotes(std::string_view word) {
  constexpr std::size_t longest = 40;
  return "'" + one_line(word.substr(0, longest)) + (word.size() > longest ? "...'" : "'");
}

void Scanner::skip_blanks() {
  while (position_ < text_.size()) {
    const char c = text_[position_];
    if (c == comment_ && comment_ != '\0') {
      while (position_ < text_.size() && text_[position_] != '\n') ++position_;
    } else if (is_blank(c)) {
      if (c == '\n') ++line_;
      ++position_;
    } else {
      return;
    }
  }
}

bool Scanner::at_end() {
  skip_blanks();
  return position_ == text_.size();
}

char Scanner::peek() {
  return at_end() ? '\0' : text_[position_];
}

std::string_view Scanner::word(std::string_view expected) {
  if (at_end()) fail_found("", expected);
  const std::size_t start = position_;
  while (position_ < text_.size() && !is_blank(text_[position_]) &&
         (text_[position_] != comment_ || comment_ == '\0')) {
    ++position_;
  }
  return text_.substr(start, position_ - start);
}

std::string_view Scanner::keyword() {
  constexpr std::string_view expected = "a keyword and '='";
  if (at_end()) fail_found("", expected);
  const std::size_t start = position_;
  while (position_ < text_.size() && !is_blank(text_[position_]) && text_[position_] != '=') ++position_;
  const std::string_view name = text_.substr(start, position_ - start);
  while (position_ < text_.size() && (text_[position_] == ' ' || text_[position_] == '\t')) ++position_;
  if (position_ == text_.size() || text_[position_] != '=') fail_found(name, expected);
  ++position_;
  return name;
}

std::string_view Scanner::rest_of_line() {
  std::size_t end = position_;
  while (end < text_.size() && text_[end] != '\n') ++end;
  std::string_view rest = text_.substr(position_, end - position_);
  position_ = end;  // the newline stays, so that line() is still this line
  if (comment_ != '\0') rest = rest.substr(0, rest.find(comment_));
  while (!rest.empty() && is_blank(rest.front())) rest.remove_prefix(1);
  while (!rest.empty() && is_blank(rest.back())) rest.remove_suffix(1);
  return rest;
}

double Scanner::real(std::string_view expected) {
  const std::string_view found = word(expected);
  const std::string_view digits = without_plus(found);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size()) fail_found(found, expected);
  return value;
}

double Scanner::coordinate() {
  const std::size_t start = (skip_blanks(), position_);
  const double value = real("a coordinate");
  if (!(std::abs(value) <= largest_coordinate)) {
    fail_found(text_.substr(start, position_ - start), "a finite coordinate, at most 1e60 in size,");
  }
  return value;
}

template <class Integer>
Integer Scanner::integer(std::string_view expected) {
  const std::string_view found = word(expected);
  const std::string_view digits = without_plus(found);
  Integer value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size()) fail_found(found, expected);
  return value;
}

template std::int64_t Scanner::integer(std::string_view);
template std::uint64_t Scanner::integer(std::string_view);

std::uint32_t Scanner::index(std::string_view expected) {
  const std::int64_t value = integer(expected);
  if (value < 0 || value >= no_index) fail_found(std::to_string(value), expected);
  return static_cast<std::uint32_t>(value);
}

std::size_t Scanner::count(std::string_view expected) {
  const std::int64_t value = integer(expected);
  const std::size_t most = (text_.size() - position_) / 2 + 1;
  if (value < 0 || static_cast<std::uint64_t>(value) > most) {
    fail(std::to_string(value) + " found, " + std::string(expected) + " from 0 to " + std::to_string(most) +
         " expected: what is left of the file holds no more");
  }
  return static_cast<std::size_t>(value);
}

void Scanner::begin_binary() {
  binary_ = true;
  rest_of_line();
  if (position_ < text_.size()) ++position_;
}

std::string_view Scanner::bytes(std::size_t count, std::string_view expected) {
  if (bytes_left() < count) fail_found("", expected);
  const std::string_view found = text_.substr(position_, count);
  position_ += count;
  return found;
}

void Scanner::skip_past(std::string_view end) {
  const std::size_t found = text_.find(end, position_);
  if (found == std::string_view::npos) fail_found("", end);
  position_ = found + end.size();
}

void Scanner::fail(const std::string& problem) const {
  throw Error(ErrorCode::format, place(), problem);
}

void Scanner::fail_found(std::string_view found, std::string_view expected) const {
  fail((found.empty() ? "the end" : in_quotes(found)) + " found, " + std::string(expected) + " expected");
}

}  // namespace remodel::io
