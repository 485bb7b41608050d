#include "remodel/su2_restart.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "io/scanner.h"
#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel {

namespace {

using io::in_quotes;

static_assert(std::endian::native == std::endian::little);

constexpr std::int32_t su2_magic = 535532;
constexpr std::size_t su2_name_size = 33;
constexpr std::size_t most_columns = 10000;

[[noreturn]] void refuse_format(const std::string& place, const std::string& problem) {
  throw Error(ErrorCode::format, place, problem);
}

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

// A line of values between commas.
class Row {
 public:
  Row(std::string_view line, std::string place) : rest_(line), place_(std::move(place)) {}
  bool at_end() const { return done_; }
  std::string_view next() {
    const std::size_t comma = rest_.find(',');
    const std::string_view value = trimmed(rest_.substr(0, comma));
    done_ = comma == std::string_view::npos;
    rest_.remove_prefix(done_ ? rest_.size() : comma + 1);
    return value;
  }
  template <class Number>
  Number number(const char* expected) {
    const std::string_view text = next();
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    bool good = error == std::errc() && end == text.data() + text.size();
    if constexpr (std::is_floating_point_v<Number>) good = good && std::isfinite(value);
    if (!good) refuse_format(place_, "found " + in_quotes(text) + ", expected " + expected);
    return value;
  }
  const std::string& place() const { return place_; }

 private:
  std::string_view rest_;
  std::string place_;
  bool done_ = false;
};

std::vector<std::string> read_su2_names(Row row) {
  std::vector<std::string> names;
  while (!row.at_end()) {
    std::string_view name = row.next();
    if (name.size() >= 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
    names.emplace_back(name);
  }
  if (names.size() < 2 || names.front() != "PointID")
    refuse_format(row.place(), "found no row of names, expected \"PointID\",\"x\",\"y\",...");
  names.erase(names.begin());
  return names;
}

Su2Restart parse_ascii(std::string_view text, const std::string& file) {
  Su2Restart restart;
  std::size_t line = 0, point = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view content = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    ++line;
    if (content.empty()) continue;
    Row row(content, file + ":" + std::to_string(line));
    if (restart.names.empty()) {
      restart.names = read_su2_names(row);
      continue;
    }
    // Metadata of older versions: "EXT_ITER= 12".
    if (content.find('=') != std::string_view::npos) break;
    if (const auto number = row.number<std::uint64_t>("the number of a point"); number != point)
      refuse_format(row.place(), "found point " + std::to_string(number) + ", expected " +
                                     std::to_string(point) + ": rows in the mesh's order");
    for (std::size_t k = 0; k < restart.names.size(); ++k)
      restart.values.push_back(row.number<double>("a finite number in each column"));
    if (!row.at_end())
      refuse_format(row.place(),
                    "found more values than the " + std::to_string(restart.names.size()) + " columns");
    ++point;
  }
  if (point == 0) refuse_format(file, "found no rows, expected one a point");
  return restart;
}

Su2Restart parse_binary(std::string_view bytes, const std::string& file) {
  std::array<std::int32_t, 5> header;
  std::memcpy(header.data(), bytes.data(), sizeof header);
  bytes.remove_prefix(sizeof header);
  if (header[1] < 1 || static_cast<std::size_t>(header[1]) > most_columns || header[2] < 1)
    refuse_format(file, "found " + std::to_string(header[1]) + " columns and " + std::to_string(header[2]) +
                            " points in the header, expected 1 or more of each");
  const auto columns = static_cast<std::size_t>(header[1]), points = static_cast<std::size_t>(header[2]);
  const std::size_t expected = columns * (su2_name_size + points * sizeof(double));
  if (bytes.size() < expected)
    refuse_format(file, "found " + std::to_string(bytes.size()) + " bytes behind the header, expected " +
                            std::to_string(expected));
  Su2Restart restart;
  for (std::size_t k = 0; k < columns; ++k) {
    const std::string_view name = bytes.substr(k * su2_name_size, su2_name_size);
    restart.names.emplace_back(name.substr(0, name.find('\0')));
  }
  restart.values.resize(columns * points);
  std::memcpy(restart.values.data(), bytes.data() + columns * su2_name_size,
              restart.values.size() * sizeof(double));
  const auto bad =
      std::find_if(restart.values.begin(), restart.values.end(), [](double v) { return !std::isfinite(v); });
  if (bad != restart.values.end())
    refuse_format(file, "found a value that is not finite in row " +
                            std::to_string(static_cast<std::size_t>(bad - restart.values.begin()) / columns) +
                            ", expected finite ones");
  return restart;
}

std::string ascii_of(const Su2Restart& restart) {
  std::string text = "\"PointID\"";
  for (const std::string& name : restart.names) text += ",\"" + name + "\"";
  text += '\n';
  const std::size_t columns = restart.names.size();
  char digits[40];
  for (std::size_t i = 0; i < restart.points(); ++i) {
    text += std::to_string(i);
    for (std::size_t k = 0; k < columns; ++k) {
      const auto end = std::to_chars(digits, digits + sizeof digits, restart.values[i * columns + k],
                                     std::chars_format::scientific, 16);
      text += ", ";
      text.append(digits, end.ptr);
    }
    text += '\n';
  }
  return text;
}

void require_names(const Su2Restart& restart, const std::string& file) {
  for (const std::string& name : restart.names) {
    const auto bad = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '"' || c == ','; };
    if (name.empty() || name.size() >= su2_name_size || std::any_of(name.begin(), name.end(), bad))
      throw Error(
          ErrorCode::argument, file,
          "found a column " + in_quotes(name) + ", expected 1 to 32 characters without quotes and commas");
  }
  if (restart.points() > 0x7fffffffU)
    throw Error(ErrorCode::argument, file,
                "found more than 2147483647 points, expected as many as SU2 can count");
}

std::string shortest(double value) {
  char digits[40];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

void require_points(const Su2Restart& restart, const FrozenMesh& mesh, const std::string& source) {
  if (restart.points() != mesh.points.size())
    throw Error(ErrorCode::argument, source,
                "found " + std::to_string(restart.points()) + " rows, expected one for each of the " +
                    std::to_string(mesh.points.size()) + " points of its mesh");
}

}  // namespace

std::size_t Su2Restart::column(const std::string& name) const {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

Su2Restart parse_su2_restart(std::string_view bytes, const std::string& source) {
  std::int32_t first = 0;
  if (bytes.size() >= 5 * sizeof first) std::memcpy(&first, bytes.data(), sizeof first);
  Su2Restart restart = first == su2_magic ? parse_binary(bytes, source) : parse_ascii(bytes, source);
  require_names(restart, source);  // whatever is read can be written
  return restart;
}

Su2Restart read_su2_restart(const std::filesystem::path& file) {
  return parse_su2_restart(read_text(file), file.string());
}

std::string su2_restart_bytes(const Su2Restart& restart) {
  const std::array<std::int32_t, 5> header{su2_magic, static_cast<std::int32_t>(restart.names.size()),
                                           static_cast<std::int32_t>(restart.points()), 0, 0};
  std::string bytes(reinterpret_cast<const char*>(header.data()), sizeof header);
  for (std::string name : restart.names) {
    name.resize(su2_name_size, '\0');
    bytes += name;
  }
  bytes.append(reinterpret_cast<const char*>(restart.values.data()), restart.values.size() * sizeof(double));
  return bytes;
}

void write_su2_restart(const Su2Restart& restart, const std::filesystem::path& file) {
  const std::string extension = file.extension().string(), name = file.string();
  if (extension != ".csv" && extension != ".dat")
    throw Error(ErrorCode::argument, name,
                "found extension " + in_quotes(extension) + ", expected .csv (ASCII) or .dat (binary)");
  require_names(restart, name);
  write_text_atomically(file, extension == ".csv" ? ascii_of(restart) : su2_restart_bytes(restart));
}

void require_coordinates(const Su2Restart& restart, const FrozenMesh& mesh, const std::string& source) {
  require_points(restart, mesh, source);
  constexpr double of_value = 1e-5, of_extent = 1e-7;
  const std::size_t columns = restart.names.size();
  for (const auto& [name, coordinate] : {std::pair("x", &Point::x), std::pair("y", &Point::y)}) {
    const std::size_t column = restart.column(name);
    if (column == columns) continue;
    const auto [least, most] = std::ranges::minmax_element(mesh.points, {}, coordinate);
    const double extent = (*most).*coordinate - (*least).*coordinate;
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
      const double found = restart.values[i * columns + column], expected = mesh.points[i].*coordinate;
      if (std::abs(found - expected) <= of_value * std::abs(expected) + of_extent * extent) continue;
      throw Error(ErrorCode::argument, source,
                  "found " + std::string(name) + " = " + shortest(found) + " in the row of point " +
                      std::to_string(i) + ", expected " + shortest(expected) +
                      " as in its mesh: the file is of another mesh");
    }
  }
}

void set_coordinates(Su2Restart& restart, const FrozenMesh& mesh, const std::string& source) {
  require_points(restart, mesh, source);
  const std::size_t columns = restart.names.size(), x = restart.column("x"), y = restart.column("y");
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    if (x < columns) restart.values[i * columns + x] = mesh.points[i].x;
    if (y < columns) restart.values[i * columns + y] = mesh.points[i].y;
  }
}

}  // namespace remodel
