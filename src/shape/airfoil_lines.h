#pragma once

// The lines of a coordinate file: what is a number, what is a row, what is text.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace remodel {

// Chords in millimetres are fine; beyond this it is no airfoil.
inline constexpr double largest_coordinate = 1e6;

// Words are separated by spaces, tabs, commas and semicolons; where the file writes decimal commas, not by
// commas.
enum class DecimalSign { point, comma };

std::string_view trimmed(std::string_view text);
std::string_view without_comment(std::string_view text);
std::vector<std::string_view> words_of(std::string_view text, DecimalSign sign = DecimalSign::point);

// -.0228, 1., +0.5, 1.2D-3 (Fortran). NaN and infinity are numbers here: they are refused by name later. What
// is too large for a double comes back as infinity.
std::optional<double> number_of(std::string_view word, DecimalSign sign = DecimalSign::point);
// The numbers of a line that has nothing else but a comment; otherwise none.
std::vector<double> numbers_of(std::string_view line, DecimalSign sign = DecimalSign::point);

// A whole number without a sign: "129".
bool is_whole_number(std::string_view word);
// Two numbers or more, all of them written with a decimal comma or whole: "0,5 -0,03".
bool has_decimal_commas(std::string_view line);

// Text is what cannot be a damaged coordinate: more than two words that are not all numbers, a count and a
// word ("61 points"), or a first word that begins with a letter or has no digit, and is no name of a number
// (nan).
bool is_remark(std::string_view line);
// The same behind other text or an empty line at the end of a file, where dates and addresses stand: what
// does not begin with a number.
bool is_footer(std::string_view line);

// What was found, short and printable.
std::string quoted(std::string_view text);

// A line of text without its end; \n, \r\n and \r all end lines. text is what follows.
std::string_view next_line(std::string_view& text);

}  // namespace remodel
