// VTK's XML format for unstructured grids, as ASCII: every XML reader can have the numbers, exactly.
// https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html

#include <algorithm>
#include <cstdint>
#include <utility>

#include "io/formats.h"
#include "io/plane_vectors.h"
#include "io/text_writer.h"
#include "io/vtk_grid.h"

namespace remodel::io {

namespace {

template <class Value>
constexpr const char* vtk_type_name();
template <>
constexpr const char* vtk_type_name<double>() {
  return "Float64";
}
template <>
constexpr const char* vtk_type_name<std::int64_t>() {
  return "Int64";
}
template <>
constexpr const char* vtk_type_name<std::int32_t>() {
  return "Int32";
}
template <>
constexpr const char* vtk_type_name<std::uint64_t>() {
  return "UInt64";
}
template <>
constexpr const char* vtk_type_name<std::uint32_t>() {
  return "UInt32";
}
template <>
constexpr const char* vtk_type_name<std::uint8_t>() {
  return "UInt8";
}

std::string xml_escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    constexpr std::pair<char, const char*> entities[] = {
        {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&apos;"}};
    const auto entity = std::find_if(std::begin(entities), std::end(entities),
                                     [&](const auto& other) { return other.first == c; });
    entity != std::end(entities) ? result += entity->second : result += c;
  }
  return result;
}

class VtuWriter {
 public:
  explicit VtuWriter(const VtkGrid& grid) : grid_(grid) {}

  std::string write() {
    out_ << "<?xml version=\"1.0\"?>\n"
            "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
            "header_type=\"UInt64\">\n<UnstructuredGrid>\n";
    field_data();
    out_ << "<Piece NumberOfPoints=\"" << grid_.points.size() / 3 << "\" NumberOfCells=\""
         << grid_.types.size() << "\">\n<PointData>\n";
    for_each_point_array(grid_,
                         [this](const char* name, const auto& values) { optional_array(name, values); });
    fields(grid_.point_fields);
    out_ << "</PointData>\n<CellData>\n";
    for_each_cell_array(grid_,
                        [this](const char* name, const auto& values) { optional_array(name, values); });
    fields(grid_.cell_fields);
    out_ << "</CellData>\n<Points>\n";
    array("Points", grid_.points, 0, 3);
    out_ << "</Points>\n<Cells>\n";
    array("connectivity", grid_.connectivity, 0, 3);
    array("offsets", grid_.offsets, 1, 1);  // without the first, 0
    array("types", grid_.types, 0, 1);
    out_ << "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    return out_.take();
  }

 private:
  // Names as character codes, each name with its 0: as VTK itself writes an array of strings, but declared as
  // numbers. Readers that are not VTK's know no strings and refuse the file.
  void names(std::string_view array, const std::vector<std::string>& values) {
    if (values.empty()) return;
    std::size_t codes = 0;
    for (const auto& name : values) codes += name.size() + 1;
    out_ << "<DataArray type=\"UInt8\" Name=\"" << array << "\" NumberOfTuples=\"" << codes
         << "\" format=\"ascii\">\n";
    for (const auto& name : values) {
      for (const char c : name) out_ << static_cast<int>(static_cast<unsigned char>(c)) << ' ';
      out_ << "0\n";
    }
    out_ << "</DataArray>\n";
  }

  void field_data() {
    if (grid_.boundary_names.empty() && grid_.region_names.empty() && grid_.vertex_key.empty() &&
        grid_.periodic_names.empty())
      return;
    out_ << "<FieldData>\n";
    names(boundary_names_array, grid_.boundary_names);
    names(region_names_array, grid_.region_names);
    names(periodic_names_array, grid_.periodic_names);
    if (!grid_.vertex_key.empty())
      out_ << "<DataArray type=\"UInt32\" Name=\"" << last_generation_array
           << "\" NumberOfTuples=\"1\" format=\"ascii\">" << grid_.last_generation << "</DataArray>\n";
    out_ << "</FieldData>\n";
  }

  void fields(const std::vector<VtkArray>& arrays) {
    for (const auto& [name, components, values, in_plane] : arrays) {
      out_ << "<DataArray type=\"Float64\" Name=\"" << xml_escaped(name) << "\" ";
      if (components > 1) out_ << "NumberOfComponents=\"" << components << "\" ";
      if (in_plane) out_ << plane_mark << "=\"2\" ";
      out_ << "format=\"ascii\">\n";
      for (std::size_t i = 0; i < values.size(); ++i)
        out_ << values[i] << ((i + 1) % components == 0 ? '\n' : ' ');
      out_ << "</DataArray>\n";
    }
  }

  template <class Value>
  void optional_array(const char* name, const std::vector<Value>& values) {
    if (!values.empty()) array(name, values, 0, 1);
  }

  template <class Value>
  void array(const char* name, const std::vector<Value>& values, std::size_t first, std::size_t per_line) {
    out_ << "<DataArray type=\"" << vtk_type_name<Value>() << "\" Name=\"" << name << "\" ";
    if (values.data() == static_cast<const void*>(grid_.points.data())) out_ << "NumberOfComponents=\"3\" ";
    out_ << "format=\"ascii\">\n";
    for (std::size_t i = first; i < values.size(); ++i) {
      if constexpr (sizeof(Value) == 1) {
        out_ << static_cast<int>(values[i]);
      } else {
        out_ << values[i];
      }
      out_ << ((i + 1 - first) % per_line == 0 ? '\n' : ' ');
    }
    out_ << "</DataArray>\n";
  }

  const VtkGrid& grid_;
  TextWriter out_;
};

}  // namespace

std::string vtu_text(const FrozenMesh& mesh, std::span<const Field> fields) {
  return VtuWriter(to_vtk_grid(mesh, fields)).write();
}

}  // namespace remodel::io
