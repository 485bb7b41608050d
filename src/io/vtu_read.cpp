// Reads VTK's XML unstructured grids: what we write, and what others do with one piece: ASCII, inline base64,
// appended base64 and appended raw, the binary ones compressed by zlib or not.

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <type_traits>
#include <utility>

#include "io/assemble.h"
#include "io/base64.h"
#include "io/formats.h"
#include "io/inflate.h"
#include "io/plane_vectors.h"
#include "io/scanner.h"
#include "io/vtk_grid.h"
#include "remodel/error.h"

namespace remodel::io {

namespace {

static_assert(std::endian::native == std::endian::little, "the binary data of .vtu files is taken as it is");

struct DataArray {
  pugi::xml_node tag;
  std::string_view content;

  std::string_view attribute(const char* name) const { return tag.attribute(name).value(); }
  std::string_view type() const { return attribute("type"); }
  std::string_view format() const { return attribute("format"); }
};

class VtuReader {
 public:
  VtuReader(std::string_view text, const std::string& file, const Warnings& warnings)
      : text_(text), file_(file), warnings_(warnings) {
    allowance_ += largest_growth * text.size();
  }

  FrozenMesh read() {
    find_arrays();
    std::vector<double> points = values<double>(required("Points/"));
    VtkGrid grid = read_cells();
    grid.points = std::move(points);
    expect_count("Points/", grid.points.size(), 3 * points_);
    grid.boundary_names = names(boundary_names_array);
    grid.region_names = names(region_names_array);
    grid.periodic_names = names(periodic_names_array);
    std::vector<std::uint32_t> last_generation;
    read_optional("FieldData/", std::string(last_generation_array).c_str(), last_generation);
    if (!last_generation.empty()) grid.last_generation = last_generation.front();
    for_each_point_array(grid,
                         [this](const char* name, auto& array) { read_optional("PointData/", name, array); });
    for_each_cell_array(grid,
                        [this](const char* name, auto& array) { read_optional("CellData/", name, array); });
    for (const char* name : foreign_region_arrays)
      if (grid.region.empty()) {
        read_optional("CellData/", name, grid.region);
        grid.foreign_region = !grid.region.empty();
      }
    warn_of_arrays();
    return from_vtk_grid(
        grid, file_, [this](std::string_view name) { return place_of(name); }, warnings_);
  }

  std::vector<Field> read_fields() {
    find_arrays();
    const VtkGrid grid = read_cells();
    std::vector<Field> fields;
    add_fields(fields, FieldPlace::vertices, points_, grid.types);
    add_fields(fields, FieldPlace::triangles, cells_, grid.types);
    keep_used_points(fields, used_points(grid, points_));
    return fields;
  }

 private:
  VtkGrid read_cells() {
    VtkGrid grid;
    grid.connectivity = values<std::int64_t>(required("Cells/connectivity"));
    grid.offsets = values<std::int64_t>(required("Cells/offsets"));
    grid.offsets.insert(grid.offsets.begin(), 0);
    grid.types = values<std::uint8_t>(required("Cells/types"));
    expect_count("Cells/types", grid.types.size(), cells_);
    return grid;
  }

  // Those that are neither the mesh's nor fields of reals, which read_fields() finds.
  void warn_of_arrays() const {
    std::vector<std::string> left_out;
    const VtkGrid none;
    for (const auto& [key, array] : arrays_) {
      const std::string name = key.substr(key.find('/') + 1);
      bool known = false;
      const auto compare = [&](const char* other, const auto&) { known = known || name == other; };
      if (key.starts_with("PointData/"))
        for_each_point_array(none, compare);
      else if (key.starts_with("CellData/"))
        for_each_cell_array(none, compare);
      else if (!key.starts_with("FieldData/") || name == boundary_names_array || name == region_names_array ||
               name == periodic_names_array || name == last_generation_array)
        continue;
      for (const char* region : foreign_region_arrays) known = known || name == region;
      const bool is_field = !key.starts_with("FieldData/") && array.type().starts_with("Float") &&
                            array.tag.attribute("NumberOfComponents").as_int(1) <= 3;
      if (!known && !is_field) left_out.push_back(name);
    }
    if (!left_out.empty())
      warnings_.add("arrays that are no fields of one to three reals are left out: " + listed(left_out));
  }

  void add_fields(std::vector<Field>& fields, FieldPlace place, std::size_t places,
                  std::span<const std::uint8_t> types) {
    const std::string section = place == FieldPlace::vertices ? "PointData/" : "CellData/";
    for (const auto& [key, array] : arrays_) {
      if (!key.starts_with(section) || !array.type().starts_with("Float")) continue;
      const std::size_t components = array.attribute("NumberOfComponents").empty()
                                         ? 1
                                         : attribute_count(array.tag, "NumberOfComponents");
      if (components < 1 || components > 3) continue;
      VtkArray found{key.substr(section.size()), components, values<double>(array),
                     array.attribute(plane_mark) == "2"};
      expect_count(key, found.values.size(), components * places);
      if (auto field = to_field(std::move(found), place, types)) fields.push_back(std::move(*field));
    }
  }

  // The places of line ends are looked for once: every array begins with the question for its line.
  std::size_t line_of(std::size_t position) const {
    if (!lines_known_)
      for (std::size_t at = text_.find('\n'); at != text_.npos; at = text_.find('\n', at + 1))
        line_ends_.push_back(at);
    lines_known_ = true;
    const auto before = std::lower_bound(line_ends_.begin(), line_ends_.end(), position);
    return 1 + static_cast<std::size_t>(before - line_ends_.begin());
  }
  std::size_t line_of(const pugi::xml_node& tag) const {
    return line_of(static_cast<std::size_t>(std::max<std::ptrdiff_t>(tag.offset_debug(), 0)));
  }
  [[noreturn]] void fail(std::size_t line, const std::string& problem) const {
    throw Error(ErrorCode::format, file_ + ":" + std::to_string(line), problem);
  }
  [[noreturn]] void fail(const pugi::xml_node& tag, const std::string& problem) const {
    fail(line_of(tag), problem);
  }
  [[noreturn]] void fail_at_end(const std::string& problem) const { fail(line_of(text_.size()), problem); }

  // The parser works in place, on a copy. Appended data need not be XML: they are taken out before.
  void parse() {
    const std::size_t appended = text_.find("<AppendedData");
    const std::size_t end = appended == text_.npos ? appended : text_.find('>', appended);
    copy_ = text_.substr(0, end == text_.npos ? end : end + 1);
    if (end != text_.npos) {
      const std::size_t mark = text_.find('_', end);
      if (mark == text_.npos) fail_at_end("the end found, '_' before the data expected");
      appended_ = text_.substr(mark + 1);
      if (text_.find("</VTKFile", text_.rfind("</")) == text_.npos)
        fail_at_end("the end found, </VTKFile> expected");
      copy_ += "</AppendedData></VTKFile>";
    }
    const auto result = document_.load_buffer_inplace(
        copy_.data(), copy_.size(), pugi::parse_minimal | pugi::parse_escapes, pugi::encoding_utf8);
    if (result) return;
    fail(line_of(static_cast<std::size_t>(result.offset)),
         std::string(result.description()) + ": an XML file of VTK expected");
  }

  void find_arrays() {
    parse();
    const pugi::xml_node file = document_.document_element();
    if (std::string_view(file.name()) != "VTKFile")
      fail(file, in_quotes(file.name()) + " found, <VTKFile> expected");
    check_header(file);
    appended_raw_ = std::string_view(file.child("AppendedData").attribute("encoding").value()) == "raw";
    const pugi::xml_node grid = file.child("UnstructuredGrid");
    add_arrays(grid.child("FieldData"));
    const pugi::xml_node piece = grid.child("Piece");
    if (const auto second = piece.next_sibling("Piece")) fail(second, "a second <Piece> found, one expected");
    points_ = attribute_count(piece, "NumberOfPoints");
    cells_ = attribute_count(piece, "NumberOfCells");
    for (const pugi::xml_node section : piece.children()) add_arrays(section);
  }

  // Points has one array, whatever its name.
  void add_arrays(const pugi::xml_node& section) {
    const std::string name = section.name();
    for (const pugi::xml_node array : section.children())
      arrays_[name + "/" + (name == "Points" ? "" : array.attribute("Name").value())] = {array,
                                                                                         array.child_value()};
  }

  void check_header(const pugi::xml_node& tag) {
    if (const std::string_view type = tag.attribute("type").value(); type != "UnstructuredGrid") {
      fail(tag, "type " + in_quotes(type) + " found, 'UnstructuredGrid' expected");
    }
    const std::string_view version = tag.attribute("version").value();
    if (!version.empty() && !version.starts_with("0.") && !version.starts_with("1.") &&
        !version.starts_with("2.")) {
      fail(tag, "version " + in_quotes(version) + " found, 0.1 to 2.x expected");
    }
    if (std::string_view(tag.attribute("byte_order").value()) == "BigEndian") {
      fail(tag, "byte order 'BigEndian' found, 'LittleEndian' expected");
    }
    const std::string_view compressor = tag.attribute("compressor").value();
    compressed_ = !compressor.empty();
    if (compressed_ && compressor != "vtkZLibDataCompressor") {
      fail(tag, "compressor " + in_quotes(compressor) + " found, 'vtkZLibDataCompressor' or none expected");
    }
    wide_header_ = std::string_view(tag.attribute("header_type").value()) == "UInt64";
  }

  std::size_t attribute_count(const pugi::xml_node& tag, const char* key) {
    Scanner scan(tag.attribute(key).value(), file_, '\0', line_of(tag));
    const auto value = scan.integer(key);
    const std::size_t most = compressed_ ? allowance_ : text_.size();
    if (value < 0 || static_cast<std::uint64_t>(value) > most) {
      scan.fail(std::string(key) + " " + std::to_string(value) + " found, 0 to " + std::to_string(most) +
                " expected: the file holds no more");
    }
    return static_cast<std::size_t>(value);
  }

  const DataArray* find(const std::string& key) const {
    const auto found = arrays_.find(key);
    return found != arrays_.end() ? &found->second : nullptr;
  }

  const DataArray& required(const std::string& key) const {
    const auto* array = find(key);
    if (array == nullptr) fail_at_end("no array " + in_quotes(key) + " found, one expected");
    return *array;
  }

  void expect_count(const std::string& key, std::size_t found, std::size_t expected) const {
    if (found == expected) return;
    fail(required(key).tag, std::to_string(found) + " values found in " + in_quotes(key) + ", " +
                                std::to_string(expected) + " expected");
  }

  template <class Value>
  void read_optional(const std::string& section, const char* name, std::vector<Value>& array) {
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
        return file_ + ":" + std::to_string(line_of(array.tag));
      }
    }
    return file_;
  }

  // Values in the file's own type, converted one by one.
  template <class Value>
  std::vector<Value> values(const DataArray& array) {
    return array.format() == "ascii" ? ascii_values<Value>(array) : binary_values<Value>(array);
  }

  template <class Value>
  std::vector<Value> ascii_values(const DataArray& array) const {
    std::vector<Value> result;
    Scanner scan(array.content, file_, '\0',
                 line_of(static_cast<std::size_t>(array.content.data() - copy_.data())));
    const std::string_view type = array.type();
    const bool real = type.starts_with("Float");
    while (!scan.at_end()) {
      if constexpr (std::is_floating_point_v<Value>) {
        result.push_back(scan.real("a number"));
      } else {
        using Wide = std::conditional_t<std::is_unsigned_v<Value>, std::uint64_t, std::int64_t>;
        const auto value = real ? rounded<Wide>(scan) : scan.integer<Wide>("an integer");
        if (!std::in_range<Value>(value)) scan.fail_found(std::to_string(value), "a smaller integer");
        result.push_back(static_cast<Value>(value));
      }
    }
    return result;
  }

  template <class Wide>
  static Wide rounded(Scanner& scan) {
    const double value = scan.real("an integer");
    if (!(value > (std::is_unsigned_v<Wide> ? -1.0 : -9e15) && value < 9e15))
      scan.fail_found(std::to_string(value), "an integer");
    return static_cast<Wide>(value);
  }

  // The first `most` bytes of an array, decoded, its header among them.
  std::string decoded(const DataArray& array, std::size_t most) const {
    std::string_view source = array.content;
    bool raw = false;
    if (array.format() == "appended") {
      Scanner scan(array.attribute("offset"), file_, '\0', line_of(array.tag));
      const auto offset = scan.integer("an offset");
      if (offset < 0 || static_cast<std::uint64_t>(offset) > appended_.size()) {
        scan.fail("offset " + std::to_string(offset) + " found, one in the appended data expected");
      }
      source = appended_.substr(static_cast<std::size_t>(offset));
      raw = appended_raw_;
    } else if (array.format() != "binary") {
      fail(array.tag,
           "format " + in_quotes(array.format()) + " found, 'ascii', 'binary' or 'appended' expected");
    }
    if (raw) return std::string(source.substr(0, most));
    if (auto bytes = decode_base64(source, most)) return *bytes;
    fail(array.tag, "data cut off found, base64 expected");
  }

  // All `count` bytes, of which the file must have that many.
  std::string decoded_all(const DataArray& array, std::uint64_t count) const {
    if (count > text_.size()) {
      fail(array.tag, std::to_string(count) + " bytes announced, no more than the file holds expected");
    }
    std::string bytes = decoded(array, static_cast<std::size_t>(count));
    if (bytes.size() != count) {
      fail(array.tag, std::to_string(bytes.size()) + " bytes found, " + std::to_string(count) + " announced");
    }
    return bytes;
  }

  // The first numbers of an array's header.
  std::vector<std::uint64_t> header_of(const DataArray& array, std::uint64_t count) const {
    const std::size_t size = wide_header_ ? 8 : 4;
    if (count > text_.size() / size) {
      fail(array.tag,
           std::to_string(count) + " numbers in a header announced, no more than the file holds expected");
    }
    const std::string bytes = decoded_all(array, count * size);
    std::vector<std::uint64_t> numbers(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < numbers.size(); ++i) std::memcpy(&numbers[i], bytes.data() + i * size, size);
    return numbers;
  }

  // The bytes of an array, behind the header that holds their number.
  std::string bytes_of(const DataArray& array) {
    if (compressed_) return inflated_bytes_of(array);
    const std::size_t header = wide_header_ ? 8 : 4;
    const std::uint64_t size = header_of(array, 1).front();
    return decoded_all(array, header + std::min<std::uint64_t>(size, text_.size())).substr(header);
  }

  // Blocks, each a zlib stream. Header: their number, the size of one, that of the last where it is another,
  // and the compressed sizes.
  std::string inflated_bytes_of(const DataArray& array) {
    const std::uint64_t blocks = header_of(array, 1).front();
    if (blocks == 0) return {};
    const auto header = header_of(array, 3 + std::min<std::uint64_t>(blocks, text_.size()));
    const std::uint64_t size = header[1];
    const std::uint64_t last = header[2] == 0 ? size : header[2];
    if (last > size || size == 0 || last > allowance_ || (allowance_ - last) / size < blocks - 1) {
      fail(array.tag, std::to_string(blocks) + " blocks of " + std::to_string(size) +
                          " bytes announced, no more than a file of this size can hold expected");
    }
    allowance_ -= static_cast<std::size_t>((blocks - 1) * size + last);
    std::uint64_t end = header.size() * (wide_header_ ? 8 : 4);
    std::size_t from = static_cast<std::size_t>(end);
    for (std::size_t i = 3; i < header.size(); ++i) end += std::min<std::uint64_t>(header[i], text_.size());
    const std::string streams = decoded_all(array, end);
    std::string bytes;
    for (std::size_t i = 3; i < header.size(); ++i) {
      const auto length = static_cast<std::size_t>(header[i]);
      const auto block = inflated(std::string_view(streams).substr(from, length),
                                  static_cast<std::size_t>(i + 1 == header.size() ? last : size));
      if (!block) {
        fail(array.tag, "block " + std::to_string(i - 2) + " of " + std::to_string(blocks) +
                            " found damaged, a zlib stream of the size announced expected");
      }
      bytes += *block;
      from += length;
    }
    return bytes;
  }

  template <class Value>
  std::vector<Value> binary_values(const DataArray& array) {
    const std::string_view type = array.type();
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
    fail(array.tag, "type " + in_quotes(type) + " found, 'Float64' or another of VTK's expected");
  }

  template <class Value, class Stored>
  std::vector<Value> converted(const DataArray& array) {
    const std::string bytes = bytes_of(array);
    std::vector<Value> result(bytes.size() / sizeof(Stored));
    for (std::size_t i = 0; i < result.size(); ++i) {
      Stored value;
      std::memcpy(&value, bytes.data() + i * sizeof(Stored), sizeof(Stored));
      if constexpr (std::is_integral_v<Value> && std::is_integral_v<Stored>) {
        if (!std::in_range<Value>(value)) {
          fail(array.tag, std::to_string(value) + " found, a smaller integer expected");
        }
      } else if constexpr (std::is_integral_v<Value>) {
        constexpr Stored exact = 9e15F;  // reals this large are integers, and doubles still tell them apart
        if (!(value > -exact && value < exact) || !std::in_range<Value>(static_cast<std::int64_t>(value))) {
          fail(array.tag, std::to_string(value) + " found, an integer expected");
        }
      }
      result[i] = static_cast<Value>(value);
    }
    return result;
  }

  std::vector<std::string> names(std::string_view array) {
    std::vector<std::string> result;
    const auto* found = find("FieldData/" + std::string(array));
    if (found == nullptr) return result;
    std::string name;
    for (const auto code : values<std::uint8_t>(*found)) {
      if (code != 0) {
        name += static_cast<char>(code);
      } else {
        result.push_back(std::exchange(name, {}));
      }
    }
    return result;
  }

  std::string_view text_;
  std::string file_;
  mutable std::vector<std::size_t> line_ends_;
  mutable bool lines_known_ = false;
  Warnings warnings_;
  std::string copy_;  // of all but appended data; the document's texts lie in it
  pugi::xml_document document_;
  std::map<std::string, DataArray> arrays_;  // "PointData/length_scale"; "Points/"
  std::string_view appended_;
  bool appended_raw_ = false;
  bool wide_header_ = false;
  bool compressed_ = false;
  std::size_t allowance_ = always_allowed;  // of bytes that compressed data may still become
  std::size_t points_ = 0;
  std::size_t cells_ = 0;
};

}  // namespace

FrozenMesh parse_vtu(std::string_view text, const std::string& file, ReadNotes* notes) {
  return VtuReader(text, file, Warnings(notes, file)).read();
}

std::vector<Field> parse_vtu_fields(std::string_view text, const std::string& file) {
  return VtuReader(text, file, Warnings(nullptr, file)).read_fields();
}

}  // namespace remodel::io
