// Reads VTK's XML unstructured grids: what we write, and what others do with one piece and no compression:
// ASCII, inline base64, appended base64 and appended raw.

#include <bit>
#include <cstring>
#include <map>
#include <optional>
#include <type_traits>
#include <utility>

#include "io/base64.h"
#include "io/formats.h"
#include "io/scanner.h"
#include "io/vtk_grid.h"
#include "io/xml.h"
#include "remodel/error.h"

namespace remodel::io {

namespace {

static_assert(std::endian::native == std::endian::little, "the binary data of .vtu files is taken as it is");

struct DataArray {
  XmlTag tag;
  std::string_view content;
};

class VtuReader {
 public:
  VtuReader(std::string_view text, const std::string& file) : text_(text), file_(file), xml_(text, file) {}

  FrozenMesh read() {
    find_arrays();
    VtkGrid grid;
    grid.points = values<double>(required("Points/"));
    grid.connectivity = values<std::int64_t>(required("Cells/connectivity"));
    grid.offsets = values<std::int64_t>(required("Cells/offsets"));
    grid.offsets.insert(grid.offsets.begin(), 0);
    grid.types = values<std::uint8_t>(required("Cells/types"));
    expect_count("Points/", grid.points.size(), 3 * points_);
    expect_count("Cells/types", grid.types.size(), cells_);
    read_boundary_names(grid);
    for_each_point_array(grid,
                         [this](const char* name, auto& array) { read_optional("PointData/", name, array); });
    for_each_cell_array(grid,
                        [this](const char* name, auto& array) { read_optional("CellData/", name, array); });
    return from_vtk_grid(grid, file_, [this](std::string_view name) { return place_of(name); });
  }

 private:
  void find_arrays() {
    std::string section;
    for (auto tag = xml_.next(); tag; tag = xml_.next()) {
      if (tag->closing) continue;
      if (tag->name == "VTKFile") {
        check_header(*tag);
      } else if (!header_seen_) {
        xml_.fail(tag->begin, in_quotes(tag->name) + " found, <VTKFile> expected");
      } else if (tag->name == "Piece") {
        read_piece(*tag);
      } else if (tag->name == "DataArray" || tag->name == "Array") {
        const std::size_t end = std::min(text_.find('<', tag->end), text_.size());
        if (end == text_.size() && !tag->empty)
          xml_.fail(end, "the end found, </" + tag->name + "> expected");
        const auto content = tag->empty ? std::string_view{} : text_.substr(tag->end, end - tag->end);
        // Points has one array, whatever its name.
        const std::string key =
            section + "/" + (section == "Points" ? "" : std::string(tag->attribute("Name")));
        arrays_[key] = {*tag, content};
      } else if (tag->name == "AppendedData") {
        read_appended(*tag);
        return;
      } else {
        section = tag->name;
      }
    }
    if (!header_seen_) xml_.fail(text_.size(), "no <VTKFile> found, an XML file of VTK expected");
    if (!closed()) xml_.fail(text_.size(), "the end found, </VTKFile> expected");
  }

  bool closed() const { return text_.find("</VTKFile", text_.rfind("</")) != std::string_view::npos; }

  void check_header(const XmlTag& tag) {
    header_seen_ = true;
    if (const auto type = tag.attribute("type"); type != "UnstructuredGrid") {
      xml_.fail(tag.begin, "type " + in_quotes(type) + " found, 'UnstructuredGrid' expected");
    }
    const auto version = tag.attribute("version");
    if (!version.empty() && !version.starts_with("0.") && !version.starts_with("1.") &&
        !version.starts_with("2.")) {
      xml_.fail(tag.begin, "version " + in_quotes(version) + " found, 0.1 to 2.x expected");
    }
    if (tag.attribute("byte_order") == "BigEndian") {
      xml_.fail(tag.begin, "byte order 'BigEndian' found, 'LittleEndian' expected");
    }
    if (!tag.attribute("compressor").empty())
      xml_.fail(tag.begin, "compressed data found, uncompressed expected");
    wide_header_ = tag.attribute("header_type") == "UInt64";
  }

  std::size_t attribute_count(const XmlTag& tag, const char* key) {
    Scanner scan(tag.attribute(key), file_, '\0', xml_.line_of(tag.begin));
    const auto value = scan.integer(key);
    if (value < 0 || static_cast<std::uint64_t>(value) > text_.size()) {
      scan.fail(std::string(key) + " " + std::to_string(value) + " found, 0 to " +
                std::to_string(text_.size()) + " expected: the file holds no more");
    }
    return static_cast<std::size_t>(value);
  }

  void read_piece(const XmlTag& tag) {
    if (piece_seen_) xml_.fail(tag.begin, "a second <Piece> found, one expected");
    piece_seen_ = true;
    points_ = attribute_count(tag, "NumberOfPoints");
    cells_ = attribute_count(tag, "NumberOfCells");
  }

  void read_appended(const XmlTag& tag) {
    appended_raw_ = tag.attribute("encoding") == "raw";
    const std::size_t mark = text_.find('_', tag.end);
    if (mark == std::string_view::npos) xml_.fail(tag.begin, "the end found, '_' before the data expected");
    appended_ = text_.substr(mark + 1);
  }

  const DataArray* find(const std::string& key) const {
    const auto found = arrays_.find(key);
    return found != arrays_.end() ? &found->second : nullptr;
  }

  const DataArray& required(const std::string& key) const {
    const auto* array = find(key);
    if (array == nullptr) xml_.fail(text_.size(), "no array " + in_quotes(key) + " found, one expected");
    return *array;
  }

  void expect_count(const std::string& key, std::size_t found, std::size_t expected) const {
    if (found == expected) return;
    xml_.fail(required(key).tag.begin, std::to_string(found) + " values found in " + in_quotes(key) + ", " +
                                           std::to_string(expected) + " expected");
  }

  template <class Value>
  void read_optional(const std::string& section, const char* name, std::vector<Value>& array) const {
    if (const auto* found = find(section + name)) array = values<Value>(*found);
  }

  std::string place_of(std::string_view name) const {
    std::string key(name);
    if (name == "Points") key = "Points/";
    for (const auto& [other, lower] : {std::pair{"Connectivity", "Cells/connectivity"},
                                       {"Offsets", "Cells/offsets"},
                                       {"Types", "Cells/types"}}) {
      if (name == other) key = lower;
    }
    for (const auto& [other, array] : arrays_) {
      if (other == key || other.ends_with("/" + key)) {
        return file_ + ":" + std::to_string(xml_.line_of(array.tag.begin));
      }
    }
    return file_;
  }

  // Values in the file's own type, converted one by one.
  template <class Value>
  std::vector<Value> values(const DataArray& array) const {
    return array.tag.attribute("format") == "ascii" ? ascii_values<Value>(array)
                                                    : binary_values<Value>(array);
  }

  template <class Value>
  std::vector<Value> ascii_values(const DataArray& array) const {
    std::vector<Value> result;
    Scanner scan(array.content, file_, '\0', xml_.line_of(array.tag.end));
    const std::string_view type = array.tag.attribute("type");
    const bool real = type.starts_with("Float");
    while (!scan.at_end()) {
      if constexpr (std::is_floating_point_v<Value>) {
        result.push_back(scan.real("a number"));
      } else {
        const auto value = real ? rounded(scan) : scan.integer("an integer");
        if (!std::in_range<Value>(value)) scan.fail_found(std::to_string(value), "a smaller integer");
        result.push_back(static_cast<Value>(value));
      }
    }
    return result;
  }

  static std::int64_t rounded(Scanner& scan) {
    const double value = scan.real("an integer");
    if (!(value > -9e15 && value < 9e15)) scan.fail_found(std::to_string(value), "an integer");
    return static_cast<std::int64_t>(value);
  }

  // The bytes of an array, behind the header that holds their number.
  std::string bytes_of(const DataArray& array) const {
    const XmlTag& tag = array.tag;
    std::string_view source = array.content;
    bool raw = false;
    if (tag.attribute("format") == "appended") {
      Scanner scan(tag.attribute("offset"), file_, '\0', xml_.line_of(tag.begin));
      const auto offset = scan.integer("an offset");
      if (offset < 0 || static_cast<std::uint64_t>(offset) > appended_.size()) {
        scan.fail("offset " + std::to_string(offset) + " found, one in the appended data expected");
      }
      source = appended_.substr(static_cast<std::size_t>(offset));
      raw = appended_raw_;
    } else if (tag.attribute("format") != "binary") {
      xml_.fail(tag.begin, "format " + in_quotes(tag.attribute("format")) +
                               " found, 'ascii', 'binary' or 'appended' expected");
    }
    const auto decoded = [&](std::size_t most) -> std::string {
      if (raw) return std::string(source.substr(0, most));
      if (auto bytes = decode_base64(source, most)) return *bytes;
      xml_.fail(tag.begin, "data cut off found, base64 expected");
    };
    const std::size_t header = wide_header_ ? 8 : 4;
    const std::string start = decoded(header);
    std::uint64_t size = 0;
    if (start.size() == header) std::memcpy(&size, start.data(), header);
    if (start.size() < header || size > source.size()) {
      xml_.fail(tag.begin, std::to_string(size) + " bytes announced, no more than the file holds expected");
    }
    std::string bytes = decoded(header + static_cast<std::size_t>(size));
    if (bytes.size() != header + size) {
      xml_.fail(tag.begin, std::to_string(bytes.size()) + " bytes found, " + std::to_string(header + size) +
                               " announced");
    }
    return bytes.substr(header);
  }

  template <class Value>
  std::vector<Value> binary_values(const DataArray& array) const {
    const std::string_view type = array.tag.attribute("type");
    if (type == "Float64") return converted<Value, double>(array);
    if (type == "Float32") return converted<Value, float>(array);
    if (type == "Int64") return converted<Value, std::int64_t>(array);
    if (type == "UInt64") return converted<Value, std::uint64_t>(array);
    if (type == "Int32") return converted<Value, std::int32_t>(array);
    if (type == "UInt32") return converted<Value, std::uint32_t>(array);
    if (type == "Int16") return converted<Value, std::int16_t>(array);
    if (type == "UInt16") return converted<Value, std::uint16_t>(array);
    if (type == "Int8") return converted<Value, std::int8_t>(array);
    if (type == "UInt8" || type == "String") return converted<Value, std::uint8_t>(array);
    xml_.fail(array.tag.begin, "type " + in_quotes(type) + " found, 'Float64' or another of VTK's expected");
  }

  template <class Value, class Stored>
  std::vector<Value> converted(const DataArray& array) const {
    const std::string bytes = bytes_of(array);
    std::vector<Value> result(bytes.size() / sizeof(Stored));
    for (std::size_t i = 0; i < result.size(); ++i) {
      Stored value;
      std::memcpy(&value, bytes.data() + i * sizeof(Stored), sizeof(Stored));
      if constexpr (std::is_integral_v<Value> && std::is_integral_v<Stored>) {
        if (!std::in_range<Value>(value)) {
          xml_.fail(array.tag.begin, std::to_string(value) + " found, a smaller integer expected");
        }
      } else if constexpr (std::is_integral_v<Value>) {
        constexpr Stored exact = 9e15F;  // reals this large are integers, and doubles still tell them apart
        if (!(value > -exact && value < exact) || !std::in_range<Value>(static_cast<std::int64_t>(value))) {
          xml_.fail(array.tag.begin, std::to_string(value) + " found, an integer expected");
        }
      }
      result[i] = static_cast<Value>(value);
    }
    return result;
  }

  void read_boundary_names(VtkGrid& grid) const {
    const auto* array = find("FieldData/" + std::string(boundary_names_array));
    if (array == nullptr) return;
    std::string name;
    for (const auto code : values<std::uint8_t>(*array)) {
      if (code != 0) {
        name += static_cast<char>(code);
      } else {
        grid.boundary_names.push_back(std::exchange(name, {}));
      }
    }
  }

  std::string_view text_;
  std::string file_;
  XmlScanner xml_;
  std::map<std::string, DataArray> arrays_;  // "PointData/length_scale"; "Points/"
  std::string_view appended_;
  bool appended_raw_ = false;
  bool header_seen_ = false;
  bool piece_seen_ = false;
  bool wide_header_ = false;
  std::size_t points_ = 0;
  std::size_t cells_ = 0;
};

}  // namespace

FrozenMesh parse_vtu(std::string_view text, const std::string& file) {
  return VtuReader(text, file).read();
}

}  // namespace remodel::io
