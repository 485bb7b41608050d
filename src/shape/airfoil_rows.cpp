#include "airfoil_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "airfoil_lines.h"
#include "remodel/error.h"

namespace remodel {
namespace {

constexpr int no_line = 0;  // the file as a whole

[[noreturn]] void refuse(const std::string& source, int line, const std::string& problem) {
  throw Error(ErrorCode::format, line > 0 ? source + ":" + std::to_string(line) : source, problem);
}

struct TextLine {
  std::string_view content;  // trimmed
  int number = 0;
  bool empty() const { return trimmed(without_comment(content)).empty(); }
};

void check_printable(std::string_view line, const std::string& source, int number) {
  for (const char c : line) {
    const unsigned char byte = static_cast<unsigned char>(c);
    const bool space = c == '\t' || c == '\f' || c == '\v';
    if ((byte < 0x20 && !space) || byte == 0x7f)
      refuse(source, number, "found byte " + std::to_string(byte) + ", expected text");
  }
}

// DOS ends a text with this byte.
std::string_view without_end_of_file(std::string_view text) {
  while (!text.empty() && text.back() == '\x1a') text.remove_suffix(1);
  return text;
}

std::vector<TextLine> lines_of(std::string_view text, const std::string& source) {
  std::vector<TextLine> lines;
  for (int number = 1; !text.empty(); ++number) {
    const std::string_view line = next_line(text);
    check_printable(line, source, number);
    lines.push_back({trimmed(line), number});
  }
  return lines;
}

// How the numbers of a file are written: by all its lines, so that one damaged line changes nothing.
struct Style {
  DecimalSign sign = DecimalSign::point;
  std::size_t columns = 2;
};

Style style_of(const std::vector<TextLine>& lines, const std::string& source) {
  std::size_t points = 0, commas = 0;
  for (const TextLine& line : lines) {
    if (has_decimal_commas(line.content)) ++commas;
    const std::string_view text = without_comment(line.content);
    if (text.find('.') != text.npos && numbers_of(text).size() >= 2) ++points;
  }
  Style style{.sign = commas > points ? DecimalSign::comma : DecimalSign::point};
  std::array<std::size_t, 32> count{};
  for (const TextLine& line : lines)
    ++count[std::min(numbers_of(line.content, style.sign).size(), count.size() - 1)];
  const auto most = std::max_element(count.begin() + 2, count.end());
  style.columns = *most > count[2] ? static_cast<std::size_t>(most - count.begin()) : 2;
  if (style.columns > 3)
    refuse(
        source, 0,
        "found rows of " + std::to_string(style.columns) +
            " numbers, as a table or a polar has them, expected coordinates of an airfoil: lines of x and y");
  return style;
}

// MSES' second line, the grid's box: left, right, lower, upper.
bool is_box_of_mses(const TextLine& line, const Style& style) {
  const std::vector<double> v = numbers_of(line.content, style.sign);
  return v.size() == 4 && v[0] < v[1] && v[2] < v[3] &&
         std::all_of(v.begin(), v.end(), [](double value) { return std::isfinite(value); });
}

// The row that MSES has between two elements.
bool is_end_of_element(const std::vector<double>& row) {
  return row[0] == 999.0 && row[1] == 999.0;
}

// Rows that follow each other, and what stands before them.
enum class Before { nothing, empty_line, text, end_of_element };
struct Block {
  Before before = Before::nothing;
  TextLine text = {};  // where there is one
  std::vector<std::vector<double>> values = {};
  std::vector<int> lines = {};
};

// What lines before the coordinates say of them.
struct Header {
  std::string name;
  std::optional<std::size_t> all, upper, lower;  // counts of OpenFAST; of OpenVSP
  bool symmetric = false;
};

bool has_words(std::string_view line, std::initializer_list<std::string_view> words) {
  return std::all_of(words.begin(), words.end(),
                     [&](std::string_view w) { return line.find(w) != line.npos; });
}

void read_header_line(std::string_view line, Header& header) {
  const std::vector<std::string_view> words = words_of(line);
  if (words.size() < 2 || !is_whole_number(words[0]) || words[0].size() > 7) return;
  const std::size_t value = std::stoul(std::string(words[0]));
  if (words[1] == "NumCoords") header.all = value;
  if (has_words(line, {"Num", "Pnts", "Upper"})) header.upper = value;
  if (has_words(line, {"Num", "Pnts", "Lower"})) header.lower = value;
  if (has_words(line, {"Sym", "Flag"})) header.symmetric = value == 1;
}

class Reader {
 public:
  Reader(std::string_view text, const std::string& source)
      : source_(source), lines_(lines_of(text, source)), style_(style_of(lines_, source)) {}

  void read() {
    for (const TextLine& line : lines_) {
      if (line.empty()) {
        quiet_ = true;
        if (before_ == Before::nothing && !blocks_.empty()) before_ = Before::empty_line;
      } else if (blocks_.empty() && takes_for_header(line)) {
        said_anything_ = true;
      } else if (is_text(line)) {
        if (!blocks_.empty() && before_ != Before::text) before_ = Before::text, text_ = line;
        quiet_ = said_anything_ = true;
      } else {
        add_row(line);
        said_anything_ = true;
        quiet_ = false;
      }
    }
  }

  const std::vector<Block>& blocks() const { return blocks_; }
  Header& header() { return header_; }
  std::size_t columns() const { return style_.columns; }

 private:
  // Only the first line that says anything may be a name: "2412" or "63-206 modified" as well.
  bool takes_for_header(const TextLine& line) {
    const bool box = is_box_of_mses(line, style_);
    const bool row = numbers_of(line.content, style_.sign).size() == style_.columns;
    read_header_line(line.content, header_);
    if (!said_anything_ && !box && !row) {
      header_.name = line.content;
      return true;
    }
    return box || (is_whole_number(line.content) && line.content.size() > 1);
  }

  // Behind an empty line or text a footer may begin, which nothing follows.
  bool is_text(const TextLine& line) const {
    if (numbers_of(line.content, style_.sign).size() == style_.columns) return false;
    return is_remark(line.content) ||
           (!blocks_.empty() && quiet_ && (before_ == Before::text || is_footer(line.content)));
  }

  std::vector<double> values_of(const TextLine& line) const {
    const std::vector<std::string_view> words = words_of(without_comment(line.content), style_.sign);
    if (words.size() != style_.columns)
      refuse(source_, line.number,
             "found " + quoted(line.content) + ", expected " +
                 (style_.columns == 2 ? "two numbers, x and y" : "three numbers, as in most lines"));
    std::vector<double> values;
    for (const std::string_view word : words) {
      const std::optional<double> value = number_of(word, style_.sign);
      if (!value) refuse(source_, line.number, "found " + quoted(word) + ", expected a number");
      if (!(std::abs(*value) <= largest_coordinate))
        refuse(source_, line.number,
               "found " + quoted(word) + ", expected a finite coordinate of at most 1e6");
      values.push_back(*value);
    }
    return values;
  }

  void add_row(const TextLine& line) {
    std::vector<double> values = values_of(line);
    if (is_end_of_element(values)) {
      before_ = Before::end_of_element;
      return;
    }
    if (blocks_.empty() || before_ != Before::nothing) blocks_.push_back({.before = before_, .text = text_});
    before_ = Before::nothing;
    blocks_.back().values.push_back(std::move(values));
    blocks_.back().lines.push_back(line.number);
  }

  const std::string& source_;
  std::vector<TextLine> lines_;
  Style style_;
  Header header_;
  std::vector<Block> blocks_;
  Before before_ = Before::nothing;  // since the last row
  TextLine text_;
  bool said_anything_ = false, quiet_ = false;
};

// Of three columns, the two of the plane of the section: not numbers of rows, not what is the same
// everywhere.
std::array<std::size_t, 2> plane_of(const std::vector<Block>& blocks, std::vector<std::string>& notes,
                                    const std::string& source) {
  constexpr const char* names[] = {"first", "second", "third"};
  constexpr std::array<std::size_t, 2> others[] = {{1, 2}, {0, 2}, {0, 1}};
  std::array<bool, 3> constant{true, true, true};
  const std::vector<double>& first = blocks.front().values.front();
  bool numbered = true;
  double next = first[0];
  for (const Block& block : blocks) {
    for (const std::vector<double>& row : block.values) {
      for (std::size_t i = 0; i < 3; ++i) constant[i] = constant[i] && row[i] == first[i];
      numbered = numbered && row[0] == next;
      next += 1.0;
    }
  }
  for (const std::size_t i : {2u, 1u, 0u}) {
    if (!constant[i] && !(i == 0 && numbered)) continue;
    notes.push_back("three columns: the " + std::string(names[i]) +
                    (constant[i] ? ", the same everywhere," : ", the numbers of the rows,") +
                    " is left out, the section lies in the plane of the others");
    return others[i];
  }
  refuse(source, no_line,
         "found three columns, none of which is the same everywhere, expected a section in a plane");
}

AirfoilRowList rows_of(const Block& block, std::array<std::size_t, 2> plane) {
  AirfoilRowList rows;
  for (std::size_t i = 0; i < block.values.size(); ++i)
    rows.push_back({{block.values[i][plane[0]], block.values[i][plane[1]]}, block.lines[i]});
  return rows;
}

// The whole outline of an element ends where it begins, up to a blunt trailing edge.
bool is_outline(const AirfoilRowList& rows) {
  double extent = 0.0;
  for (const AirfoilRow& row : rows) extent = std::max(extent, distance(row.point, rows.front().point));
  return rows.size() >= 5 && distance(rows.front().point, rows.back().point) <= 0.1 * extent;
}

void append(AirfoilRowList& rows, const AirfoilRowList& more) {
  rows.insert(rows.end(), more.begin(), more.end());
}

// Blocks make elements where they are set apart as elements; otherwise they are one.
std::vector<AirfoilElement> elements_of(const std::vector<Block>& blocks, std::array<std::size_t, 2> plane,
                                        const std::string& source) {
  std::vector<AirfoilRowList> rows;
  bool marked = false, all_outlines = true;
  const Block* text = nullptr;
  for (const Block& block : blocks) {
    rows.push_back(rows_of(block, plane));
    all_outlines = all_outlines && is_outline(rows.back());
    marked = marked || block.before == Before::end_of_element;
    if (block.before == Before::text && text == nullptr) text = &block;
  }
  if (text != nullptr && !(all_outlines && blocks.size() > 1))
    refuse(source, text->text.number,
           "found " + quoted(text->text.content) + " between rows, expected two numbers, x and y");
  std::vector<AirfoilElement> elements(1);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const bool apart = marked ? blocks[i].before == Before::end_of_element : i > 0 && all_outlines;
    if (apart && !elements.back().rows.empty()) elements.emplace_back();
    append(elements.back().rows, rows[i]);
  }
  // Two surfaces, an empty line between them, without their counts.
  const bool two = blocks.size() == 2 && !marked && elements.size() == 1;
  if (two &&
      distance(rows[0].front().point, rows[1].front().point) <
          0.1 * distance(rows[0].front().point, rows[0].back().point) &&
      distance(rows[0].back().point, rows[1].back().point) <
          0.1 * distance(rows[0].front().point, rows[0].back().point))
    elements[0].first_surface = rows[0].size();
  return elements;
}

// OpenFAST counts a point of reference along with the coordinates, and has it first.
void apply_openfast(const Header& header, AirfoilText& result, const std::string& source) {
  AirfoilRowList& rows = result.elements.front().rows;
  if (rows.size() != *header.all)
    refuse(
        source, 0,
        "found " + std::to_string(rows.size()) + " rows, but NumCoords says " + std::to_string(*header.all));
  rows.erase(rows.begin());
  result.elements.front().first_surface = 0;
  result.name.clear();
}

void apply_openvsp(const Header& header, AirfoilText& result, const std::string& source) {
  AirfoilElement& element = result.elements.front();
  AirfoilRowList& rows = element.rows;
  const std::size_t lower = header.lower.value_or(0);
  if (header.symmetric && rows.size() == *header.upper) {
    const AirfoilRowList upper = rows;
    for (const AirfoilRow& row : upper) rows.push_back({{row.point.x, -row.point.y}, row.line});
  } else if (rows.size() != *header.upper + lower) {
    refuse(source, no_line,
           "found counts of " + std::to_string(*header.upper) + " and " + std::to_string(lower) +
               " points, but " + std::to_string(rows.size()) + " points follow");
  }
  element.first_surface = *header.upper;
}

}  // namespace

// Lines of text stand before the first row, after the last one, and between whole outlines.
AirfoilText read_airfoil_rows(std::string_view text, const std::string& source) {
  if (text.size() > airfoil_text_limit)
    throw Error(ErrorCode::format, source, "more than 16 MiB, expected a small text file");
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // UTF-8 byte order mark
  text = without_end_of_file(text);
  refuse_other_kinds(text, source);
  Reader reader(text, source);
  reader.read();
  AirfoilText result;
  const std::vector<Block>& blocks = reader.blocks();
  if (blocks.empty()) refuse(source, no_line, "found no coordinates, expected lines of two numbers, x and y");
  std::array<std::size_t, 2> plane{0, 1};
  if (reader.columns() == 3) plane = plane_of(blocks, result.notes, source);
  const Header& header = reader.header();
  result.name = header.name;
  if (header.all || header.upper) {
    AirfoilElement whole;
    for (const Block& block : blocks) append(whole.rows, rows_of(block, plane));
    result.elements.push_back(std::move(whole));
    header.all ? apply_openfast(header, result, source) : apply_openvsp(header, result, source);
  } else {
    result.elements = elements_of(blocks, plane, source);
  }
  return result;
}

}  // namespace remodel
