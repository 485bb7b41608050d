// Triangle's .poly and .node files: https://www.cs.cmu.edu/~quake/triangle.poly.html

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>

#include "geometry/place_text.h"
#include "io/scanner.h"
#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel {
namespace {

constexpr std::size_t largest_file = std::size_t{256} << 20;

// The lines that hold something, as scanners of their own: what a line does not have cannot come from the
// next.
class Lines {
 public:
  Lines(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  // The next line with a word in it; none at the end.
  std::optional<io::Scanner> next() {
    while (position_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', position_), text_.size());
      io::Scanner line(text_.substr(position_, end - position_), file_, '#', ++number_);
      position_ = end + 1;
      if (!line.at_end()) return line;
    }
    return std::nullopt;
  }
  io::Scanner require(const char* expected) {
    std::optional<io::Scanner> line = next();
    if (!line)
      throw Error(ErrorCode::format, file_ + ":" + std::to_string(std::max<std::size_t>(number_, 1)),
                  std::string("the end of the file found, ") + expected + " expected");
    return *line;
  }
  // A number of lines that follow, bounded by what is left of the text.
  std::size_t count(io::Scanner& line, const char* expected) const {
    const std::int64_t value = line.integer(expected);
    if (value < 0 ||
        static_cast<std::size_t>(value) > (text_.size() - std::min(position_, text_.size())) / 2 + 1)
      line.fail_found(std::to_string(value), expected);
    return static_cast<std::size_t>(value);
  }

 private:
  std::string_view text_;
  std::string file_;
  std::size_t position_ = 0, number_ = 0;
};

class PolyReader {
 public:
  PolyReader(std::string_view poly, const std::string& source, std::string_view node,
             const std::string& node_source)
      : lines_(poly, source), source_(source), node_(node), node_source_(node_source) {}

  PlanarGraph read() {
    read_vertices(lines_);
    if (graph_.points.empty()) {
      if (node_.data() == nullptr)
        throw Error(ErrorCode::file, node_source_.empty() ? source_ : node_source_,
                    "is missing: " + source_ + " has no vertices of its own, which are expected there");
      Lines node(node_, node_source_);
      read_vertices(node);
    }
    read_segments();
    read_holes();
    read_regions();
    if (point_data_) graph_.left_out.push_back(source_ + ": attributes and markers of points are left out");
    return std::move(graph_);
  }

 private:
  void read_vertices(Lines& lines) {
    io::Scanner header = lines.require("a line with the number of vertices");
    const std::size_t count = lines.count(header, "a number of vertices");
    if (!header.at_end() && header.integer("the dimension, 2") != 2)
      header.fail("another dimension than 2 found");
    const std::int64_t attributes = header.at_end() ? 0 : header.integer("a number of attributes");
    if (attributes < 0 || attributes > 1000) header.fail("expected 0 to 1000 attributes");
    for (std::size_t i = 0; i < count; ++i) {
      io::Scanner line = lines.require("a vertex");
      const std::int64_t number = line.integer("a vertex number");
      if (i == 0) {
        if (number != 0 && number != 1) line.fail_found(std::to_string(number), "0 or 1, the first vertex");
        base_ = number;
      } else if (number != base_ + static_cast<std::int64_t>(i)) {
        line.fail_found(std::to_string(number), std::to_string(base_ + static_cast<std::int64_t>(i)));
      }
      const double x = line.coordinate();
      graph_.points.push_back({x, line.coordinate()});
      if (!line.at_end()) point_data_ = point_data_ || attributes > 0 || line.word("a marker") != "0";
    }
  }

  std::uint32_t end_of(io::Scanner& line) const {
    const std::int64_t number = line.integer("a vertex number") - base_;
    if (number < 0 || static_cast<std::size_t>(number) >= graph_.points.size())
      line.fail_found(std::to_string(number + base_),
                      "a vertex from " + std::to_string(base_) + " to " +
                          std::to_string(base_ + static_cast<std::int64_t>(graph_.points.size()) - 1));
    return static_cast<std::uint32_t>(number);
  }

  void read_segments() {
    io::Scanner header = lines_.require("a line with the number of segments");
    const std::size_t count = lines_.count(header, "a number of segments");
    for (std::size_t i = 0; i < count; ++i) {
      io::Scanner line = lines_.require("a segment");
      line.integer("a segment number");
      PlanarGraph::Segment segment{.from = end_of(line)};
      segment.to = end_of(line);
      if (!line.at_end()) segment.marker = marker_of(line);
      graph_.segments.push_back(segment);
      graph_.segment_lines.push_back(line.line());
    }
  }

  static int marker_of(io::Scanner& line) {
    const std::int64_t marker = line.integer("a boundary marker");
    if (marker < -1'000'000'000 || marker > 1'000'000'000)
      line.fail("expected a marker of at most nine digits");
    return static_cast<int>(marker);
  }

  // The section may be missing.
  void read_holes() {
    std::optional<io::Scanner> header = lines_.next();
    if (!header) return;
    const std::size_t count = lines_.count(*header, "a number of holes");
    for (std::size_t i = 0; i < count; ++i) {
      io::Scanner line = lines_.require("a hole");
      line.integer("a hole number");
      const double x = line.coordinate();
      graph_.holes.push_back({x, line.coordinate()});
    }
  }

  // It may be missing too. A line has a number, a place, an attribute, which is the region's name, and an
  // area that its triangles should not exceed; without the last one, or where it is not positive, there is no
  // such bound.
  void read_regions() {
    std::optional<io::Scanner> header = lines_.next();
    if (!header) return;
    const std::size_t count = lines_.count(*header, "a number of regions");
    std::size_t bounds = 0;
    for (std::size_t i = 0; i < count; ++i) {
      io::Scanner line = lines_.require("a region");
      line.integer("a region number");
      const double x = line.coordinate();
      PlanarGraph::Region region{.at = {x, line.coordinate()}, .name = ""};
      if (!line.at_end()) region.name = exact_text(line.real("a region's attribute"));
      if (!line.at_end()) region.max_area = std::max(line.real("a region's largest area"), 0.0);
      bounds += region.max_area > 0.0 ? 1 : 0;
      graph_.regions.push_back(std::move(region));
    }
    if (bounds > 0)
      graph_.left_out.push_back(
          source_ + ": the area bounds of " + std::to_string(bounds) +
          (bounds == 1 ? " region" : " regions") +
          " are left out: sizes follow from the distances of points alone; more of them in "
          "the region, or --resolution, make it finer");
  }

  Lines lines_;
  std::string source_;
  bool point_data_ = false;  // there is some that a graph has no place for
  std::string_view node_;
  std::string node_source_;
  PlanarGraph graph_;
  std::int64_t base_ = 0;
};

}  // namespace

PlanarGraph parse_poly(std::string_view poly, const std::string& source, std::string_view node,
                       const std::string& node_source) {
  return PolyReader(poly, source, node, node_source).read();
}

bool holds_graph(const std::filesystem::path& file) {
  if (file.has_extension() || !is_pipe(file)) return file.extension() == ".poly";
  const std::string text = read_text(file, largest_file);
  std::optional<io::Scanner> line = Lines(text, file.string()).next();
  if (!line) return false;
  std::array<std::int64_t, 4> numbers{};
  std::size_t count = 0;
  for (std::istringstream words{std::string(line->rest_of_line())}; !words.eof(); ++count)
    if (count == numbers.size() || !(words >> numbers[count])) return false;
  return count >= 3 && numbers[1] == 2;
}

PlanarGraph read_poly(const std::filesystem::path& file) {
  const std::string poly = read_text(file, largest_file);
  std::filesystem::path node = file;
  node.replace_extension(".node");
  std::error_code ignored;
  if (!std::filesystem::exists(node, ignored)) return parse_poly(poly, file.string(), {}, node.string());
  return parse_poly(poly, file.string(), read_text(node, largest_file), node.string());
}

}  // namespace remodel
