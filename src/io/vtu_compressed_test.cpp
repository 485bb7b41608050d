// VTK's own default: arrays in blocks, each a zlib stream, inline or appended.

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <vector>

#include "io/formats.h"
#include "io/test_meshes.h"
#include "support.h"

namespace remodel {
namespace {

using test::error_of;

std::string base64(std::string_view bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    const std::size_t here = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < here ? static_cast<unsigned char>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k) text += k <= here ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string deflated(std::string_view bytes) {
  std::string stream(compressBound(bytes.size()), '\0');
  uLongf size = stream.size();
  compress(reinterpret_cast<Bytef*>(stream.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
           bytes.size());
  stream.resize(size);
  return stream;
}

// How VTK may have written a file.
struct Style {
  bool compressed = true;
  bool wide_header = false;
  std::size_t block = 32768;
  enum { inline_base64, appended_base64, appended_raw } place = inline_base64;
};

class Encoder {
 public:
  explicit Encoder(const Style& style) : style_(style) {}

  std::string file(const FrozenMesh& mesh) {
    std::vector<double> points;
    for (const Point p : mesh.points) points.insert(points.end(), {p.x, p.y, 0.0});
    std::vector<std::int64_t> corners, ends;
    for (const auto& triangle : mesh.triangles) {
      corners.insert(corners.end(), triangle.begin(), triangle.end());
      ends.push_back(static_cast<std::int64_t>(corners.size()));
    }
    const std::vector<std::uint8_t> types(ends.size(), 5);
    std::string text = "<VTKFile type='UnstructuredGrid' version='1.0' byte_order='LittleEndian'";
    if (style_.wide_header) text += " header_type='UInt64'";
    if (style_.compressed) text += " compressor='vtkZLibDataCompressor'";
    text += "><UnstructuredGrid><Piece NumberOfPoints='" + std::to_string(mesh.points.size()) +
            "' NumberOfCells='" + std::to_string(ends.size()) + "'><Points>" +
            array("Float64", "Points", points) + "</Points><Cells>" +
            array("Int64", "connectivity", corners) + array("Int64", "offsets", ends) +
            array("UInt8", "types", types) + "</Cells></Piece></UnstructuredGrid>";
    if (style_.place != Style::inline_base64) {
      text += std::string("<AppendedData encoding='") +
              (style_.place == Style::appended_raw ? "raw" : "base64") + "'>\n_" + appended_ +
              "</AppendedData>";
    }
    return text + "</VTKFile>";
  }

 private:
  std::string numbers(const std::vector<std::uint64_t>& values) const {
    std::string bytes;
    for (const std::uint64_t value : values)
      bytes.append(reinterpret_cast<const char*>(&value), style_.wide_header ? 8 : 4);
    return bytes;
  }

  std::string encoded(std::string_view bytes) const {
    const auto coded = [&](const std::string& part) {
      return style_.place == Style::appended_raw ? part : base64(part);
    };
    if (!style_.compressed) return coded(numbers({bytes.size()}) + std::string(bytes));
    std::vector<std::uint64_t> header = {(bytes.size() + style_.block - 1) / style_.block, style_.block,
                                         bytes.size() % style_.block};
    std::string streams;
    for (; !bytes.empty(); bytes.remove_prefix(std::min(style_.block, bytes.size()))) {
      const std::string stream = deflated(bytes.substr(0, style_.block));
      header.push_back(stream.size());
      streams += stream;
    }
    return coded(numbers(header)) + coded(streams);
  }

  template <class Value>
  std::string array(const char* type, const char* name, const std::vector<Value>& values) {
    const std::string data =
        encoded({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)});
    std::string tag = std::string("<DataArray type='") + type + "' Name='" + name + "' format='";
    if (style_.place == Style::inline_base64) return tag + "binary'>\n" + data + "\n</DataArray>";
    tag += "appended' offset='" + std::to_string(appended_.size()) + "'/>";
    appended_ += data;
    return tag;
  }

  Style style_;
  std::string appended_;
};

std::vector<Style> all_styles() {
  std::vector<Style> styles;
  for (const auto place : {Style::inline_base64, Style::appended_base64, Style::appended_raw})
    for (const bool wide : {false, true})
      for (const std::size_t block : {32768, 1000, 8, 0})
        styles.push_back({.compressed = block > 0, .wide_header = wide, .block = block, .place = place});
  return styles;
}

TEST(CompressedVtu, IsReadHoweverItIsStored) {
  const FrozenMesh mesh = test::graded_ring(40, 12);
  for (const Style& style : all_styles()) {
    SCOPED_TRACE(std::to_string(style.block) + " wide " + std::to_string(style.wide_header) + " place " +
                 std::to_string(style.place));
    const FrozenMesh back = io::parse_vtu(Encoder(style).file(mesh), "m.vtu");
    EXPECT_EQ(back.points, mesh.points);
    EXPECT_EQ(back.triangles, mesh.triangles);
  }
}

TEST(CompressedVtu, CutOffAnywhereIsRefused) {
  for (const Style& style : all_styles()) {
    const std::string text = Encoder(style).file(test::square_ring());
    for (std::size_t size = 0; size + 20 < text.size(); size += 7)
      EXPECT_NE(error_of([&] { io::parse_vtu(text.substr(0, size), "m.vtu"); }), "");
  }
}

TEST(CompressedVtu, DamagedIsReadOrRefusedInOneLine) {
  std::mt19937 random(static_cast<unsigned>(test::seed(2)));
  for (const Style& style : all_styles()) {
    const std::string text = Encoder(style).file(test::square_ring());
    for (int i = 0; i < 300; ++i) {
      std::string damaged = text;
      damaged[random() % damaged.size()] = static_cast<char>(random());
      EXPECT_EQ(error_of([&] { io::parse_vtu(damaged, "m.vtu"); }).find('\n'), std::string::npos);
    }
  }
}

// The header of the blocks alone asks for the memory.
TEST(CompressedVtu, NeverBecomesAHundredTimesItsFile) {
  const auto with_header = [](const std::vector<std::uint64_t>& header) {
    std::string bytes;
    for (const std::uint64_t value : header) bytes.append(reinterpret_cast<const char*>(&value), 8);
    return "<VTKFile type='UnstructuredGrid' header_type='UInt64' compressor='vtkZLibDataCompressor'>"
           "<UnstructuredGrid><Piece NumberOfPoints='3' NumberOfCells='1'><Points><DataArray type='Float64' "
           "format='binary'>" +
           base64(bytes) + "</DataArray></Points></Piece></UnstructuredGrid></VTKFile>";
  };
  const std::uint64_t huge = std::uint64_t{1} << 63;
  for (const std::vector<std::uint64_t>& header :
       std::vector<std::vector<std::uint64_t>>{{1, std::uint64_t{1} << 32, 0, 10},
                                               {1, huge, 0, 10},
                                               {2, huge, 1, 10, 10},
                                               {3, 0, 0, 1, 1, 1},
                                               {huge, 8, 0},
                                               {1, 8, 9, 10},
                                               {2, 8, 0, huge, huge}}) {
    const std::string error = error_of([&] { io::parse_vtu(with_header(header), "m.vtu"); });
    EXPECT_NE(error.find(" expected"), std::string::npos) << header[0] << ' ' << header[1] << ' ' << error;
  }
  // A stream of zeros that keeps its word, a thousand times as large as it says it is in the file.
  const std::string zeros(std::size_t{8} << 20, '\0');
  const std::string stream = deflated(zeros);
  ASSERT_LT(stream.size(), zeros.size() / 500);
  std::string text = with_header({1, zeros.size(), 0, stream.size()});
  const std::size_t at = text.find("</DataArray>");
  EXPECT_NE(error_of([&] { io::parse_vtu(text.insert(at, base64(stream)), "m.vtu"); }).find("can hold"),
            std::string::npos);
}

TEST(CompressedVtu, ByAnotherCompressorIsNamed) {
  std::string text = Encoder({}).file(test::square_ring());
  text.replace(text.find("vtkZLib"), 7, "vtkLZ4");
  EXPECT_EQ(error_of([&] { io::parse_vtu(text, "m.vtu"); }),
            "m.vtu:1: compressor 'vtkLZ4DataCompressor' found, 'vtkZLibDataCompressor' or none expected");
}

}  // namespace
}  // namespace remodel
