// What readers say to files that are not what their extension promises: one line, naming the place, and no
// allocation that a header alone asks for.

#include <gtest/gtest.h>

#include <random>

#include "io/formats.h"
#include "io/test_meshes.h"
#include "remodel/io.h"
#include "support.h"

namespace remodel {
namespace {

using test::error_of;
using test::Scratch;

using Parser = FrozenMesh (*)(std::string_view, const std::string&, ReadNotes*);

// The message without the file's name; "read" if the text is taken.
std::string problem(Parser parse, const std::string& text) {
  const std::string error = error_of([&] { parse(text, "f", nullptr); });
  EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  if (error.empty()) return "read";
  EXPECT_EQ(error.substr(0, 1), "f");
  return error.substr(1);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

// ---------------------------------------------------------------------------------------- all text formats

const std::string order_advice =
    ": cells of second order have points in the middle of edges; write the mesh with cells of first order "
    "(Gmsh: SetOrder 1)";

struct TextFormat {
  const char* name;
  Parser parse;
  std::string text;
};

std::vector<TextFormat> text_formats() {
  const FrozenMesh mesh = test::square_ring();
  return {{"su2", io::parse_su2, io::su2_text(mesh, "f")},
          {"msh 4.1", io::parse_msh, io::msh_text(mesh, 41, "f")},
          {"msh 2.2", io::parse_msh, io::msh_text(mesh, 22, "f")},
          {"vtu", io::parse_vtu, io::vtu_text(mesh)}};
}

TEST(BadTextFiles, EmptyOnesAreRefusedAtLineOne) {
  for (const auto& format : text_formats())
    EXPECT_EQ(problem(format.parse, "").substr(0, 3), ":1:") << format.name;
}

TEST(BadTextFiles, BinaryGarbageIsRefusedWithItsCharactersEscaped) {
  std::mt19937 random(static_cast<unsigned>(test::seed(1)));
  std::string garbage =
      "\x7f"
      "ELF\x01\x02";
  for (int i = 0; i < 1000; ++i) garbage += static_cast<char>(random() & 0xff);
  for (const auto& format : text_formats()) {
    const std::string found = problem(format.parse, garbage);
    EXPECT_NE(found, "read") << format.name;
    EXPECT_EQ(one_line(found), found) << format.name;  // printable, and UTF-8
  }
}

TEST(BadTextFiles, CutOffAnywhereTheyAreRefusedOrStillSayTheSame) {
  for (const auto& format : text_formats()) {
    // The last lines may be cut without loss: blanks, an end mark's tail, digits of the last index.
    for (std::size_t size = 0; size + 20 < format.text.size(); ++size) {
      const std::string found = problem(format.parse, format.text.substr(0, size));
      EXPECT_NE(found, "read") << format.name << " cut at " << size << " of " << format.text.size();
    }
  }
}

TEST(BadTextFiles, AnyFlippedByteIsReadOrRefusedInOneLine) {
  for (const auto& format : text_formats()) {
    for (std::size_t at = 0; at < format.text.size(); ++at) {
      for (const char c : {'\0', '-', '9', '\n', ' ', '<', '"', '\xff'}) {
        std::string text = format.text;
        text[at] = c;
        problem(format.parse, text);  // expects one line, and must not crash
      }
    }
  }
}

TEST(BadTextFiles, CoordinatesThatAreNoNumbersOrAbsurdAreNamedWithTheirLine) {
  for (const char* value : {"nan", "inf", "-inf", "1e300", "1e999"}) {
    for (const auto& format : text_formats()) {
      const std::string found = problem(format.parse, replaced(format.text, "2.066666666666667", value));
      EXPECT_NE(found, "read") << format.name << ' ' << value;
      EXPECT_TRUE(found.find("oordinate") != std::string::npos ||
                  found.find("a number expected") != std::string::npos)
          << format.name << found;
    }
  }
}

// ------------------------------------------------------------------------------------------------ SU2

const std::string su2 =
    "NDIME= 2\nNELEM= 1\n5 0 1 2 0\nNPOIN= 3\n0 0\n1 0\n0 1\nNMARK= 1\nMARKER_TAG= wall\nMARKER_ELEMS= 1\n3 "
    "0 1\n";

std::string su2_problem(const std::string& from, const std::string& to) {
  return problem(io::parse_su2, replaced(su2, from, to));
}

TEST(BadSu2Files, EachProblemNamesItsLineAndWhatWasExpected) {
  EXPECT_EQ(problem(io::parse_su2, su2), "read");
  EXPECT_EQ(su2_problem("NDIME= 2", "NDIME= 3"), ":1: 'NDIME= 3' found, NDIME= 2 expected");
  EXPECT_EQ(su2_problem("5 0 1 2 0", "12 0 1 2 2"),
            ":3: element of type 12 found, only triangles (type 5) and quadrilaterals (type 9) expected");
  EXPECT_EQ(su2_problem("5 0 1 2 0", "9 0 1 2 7"), ":3: point 7 found, an index below NPOIN= 3 expected");
  EXPECT_EQ(su2_problem("5 0 1 2 0", "9 0 1 2"), ":4: 'NPOIN=' found, the index of a point expected");
  EXPECT_EQ(su2_problem("3 0 1", "1 0"), ":11: marker element of type 1 found, only lines (type 3) expected");
  EXPECT_EQ(su2_problem("5 0 1 2", "5 0 1 7"), ":3: point 7 found, an index below NPOIN= 3 expected");
  EXPECT_EQ(su2_problem("3 0 1", "3 0 3"), ":11: point 3 found, an index below NPOIN= 3 expected");
  EXPECT_EQ(su2_problem("5 0 1 2", "5 0 1 -2"), ":3: '-2' found, the index of a point expected");
  EXPECT_EQ(su2_problem("5 0 1 2", "5 0 1 1.5"), ":3: '1.5' found, the index of a point expected");
  EXPECT_EQ(su2_problem("0 1\nNMARK", "0 x\nNMARK"), ":7: 'x' found, a coordinate expected");
  EXPECT_EQ(su2_problem("1 0\n", "1 1e300\n"),
            ":6: '1e300' found, a finite coordinate, at most 1e60 in size, expected");
  EXPECT_EQ(su2_problem("NPOIN= 3\n", ""), ":4: '0' found, a keyword and '=' expected");
  EXPECT_EQ(su2_problem("NELEM= 1\n5 0 1 2 0\n", ""), ":10: the end found, NELEM= expected");
  EXPECT_EQ(su2_problem("NDIME= 2\n", ""), ":11: the end found, NDIME= 2 expected");
  EXPECT_EQ(su2_problem("NMARK= 1\n", ""), ":11: the end found, NMARK= expected");
  EXPECT_EQ(su2_problem("NMARK= 1\n", "NMARK= 2\n"), ":12: 1 markers found, NMARK= 2 expected");
  EXPECT_EQ(su2_problem("NELEM= 1\n5 0 1 2 0\n", "NELEM= 0\n"), ": no triangle found, at least one expected");
}

TEST(BadSu2Files, NegativeAndAbsurdCountsAreRefusedBeforeAnythingIsAllocated) {
  EXPECT_EQ(su2_problem("NELEM= 1", "NELEM= -5").substr(0, 22), ":2: -5 found, a number");
  EXPECT_EQ(su2_problem("NPOIN= 3", "NPOIN= 4000000000").substr(0, 31), ":4: 4000000000 found, a number ");
  EXPECT_EQ(su2_problem("MARKER_ELEMS= 1", "MARKER_ELEMS= 99999999999999999999").substr(0, 5), ":10: ");
}

TEST(BadSu2Files, MarkersAndSectionsMayStandOnce) {
  const std::string marker = "MARKER_TAG= wall\nMARKER_ELEMS= 1\n3 1 2\n";
  EXPECT_EQ(problem(io::parse_su2, su2 + marker),
            ":12: a second marker 'wall' found, each name once expected");
  EXPECT_EQ(problem(io::parse_su2, su2 + "NDIME= 2\n"), ":12: a second NDIME= found, one expected");
  EXPECT_EQ(problem(io::parse_su2, su2 + "NPOIN= 0\n"), ":12: a second NPOIN= found, one expected");
}

// ----------------------------------------------------------------------------------------------- Gmsh

std::string msh_problem(int version, const std::string& from, const std::string& to) {
  return problem(io::parse_msh, replaced(io::msh_text(test::square_ring(), version, "f"), from, to));
}

TEST(BadMshFiles, VersionsThatAreNotReadAreNamed) {
  EXPECT_EQ(msh_problem(41, "4.1 0 8", "4.2 0 8"), ":2: version '4.2' found, 4.1, 4.0 or 2.2 expected");
  EXPECT_EQ(msh_problem(41, "4.1 0 8", "5.0 0 8"), ":2: version '5.0' found, 4.1, 4.0 or 2.2 expected");
  EXPECT_EQ(msh_problem(22, "2.2 0 8", "2.2 1 8"),
            ": byte 24: no binary number 1 found, one expected in a binary file");
  EXPECT_EQ(msh_problem(22, "$MeshFormat", "$NOD"), ":1: '$NOD' found, $MeshFormat expected");
}

TEST(BadMshFiles, EachProblemNamesItsLineAndWhatWasExpected) {
  const std::string expected =
      " found, only triangles (type 2), quadrilaterals (type 3) and lines (type 1) expected";
  EXPECT_EQ(msh_problem(22, "\n9 2 2", "\n9 9 2"), ":31: element of type 9" + expected + order_advice);
  EXPECT_EQ(msh_problem(22, "\n9 2 2", "\n9 4 2"), ":31: element of type 4" + expected);
  EXPECT_EQ(msh_problem(22, "\n9 2 2 3 1 1 2 5", "\n9 3 2 3 1 1 2 5 99"),
            ":31: node 99 found, the tag of one of the 8 nodes expected");
  EXPECT_EQ(msh_problem(22, "\n9 2 2 3 1 1 2 5", "\n9 2 2 3 1 1 2 99"),
            ":31: node 99 found, the tag of one of the 8 nodes expected");
  EXPECT_EQ(msh_problem(22, "\n2 3 0 0\n", "\n1 3 0 0\n"),
            ":13: node 1 found a second time, each tag once expected");
  EXPECT_EQ(msh_problem(22, "\n2 3 0 0\n", "\n2 3 0 1\n"),
            ": z = 1 found at point 1, z = 0 as at point 0 expected: a mesh in one plane");
  EXPECT_EQ(msh_problem(22, "1 2 \"hole\"", "1 2 \"outer\""),
            ":7: a second physical curve 'outer' found, each name once expected");
  EXPECT_EQ(msh_problem(22, "1 2 \"hole\"", "1 2 hole"),
            ":7: 'hole' found, a physical name in quotes expected");
  EXPECT_EQ(msh_problem(41, "$Nodes\n1 8", "$Nodes\n1 9"),
            ":34: 8 nodes found, 9 expected by the section's header");
  EXPECT_EQ(msh_problem(41, "$EndNodes", "$EndNode"), ":35: '$EndNode' found, $EndNodes expected");
}

TEST(BadMshFiles, NegativeAndAbsurdCountsAreRefused) {
  for (const char* count : {"-1", "123456789012", "99999999999999999999"}) {
    EXPECT_NE(msh_problem(22, "$Nodes\n8", std::string("$Nodes\n") + count), "read");
    EXPECT_NE(msh_problem(22, "$Elements\n16", std::string("$Elements\n") + count), "read");
    EXPECT_NE(msh_problem(41, "2 1 0 8", std::string("2 1 0 ") + count), "read");
    EXPECT_NE(msh_problem(41, "$Entities\n0", std::string("$Entities\n") + count), "read");
  }
}

// ------------------------------------------------------------------------------------------------ VTU

std::string vtu_problem(const std::string& from, const std::string& to) {
  return problem(io::parse_vtu, replaced(io::vtu_text(test::full_square_ring()), from, to));
}

TEST(BadVtuFiles, EachProblemNamesItsLineAndWhatWasExpected) {
  EXPECT_EQ(vtu_problem("type=\"UnstructuredGrid\"", "type=\"PolyData\""),
            ":2: type 'PolyData' found, 'UnstructuredGrid' expected");
  EXPECT_EQ(vtu_problem("version=\"1.0\" byte", "version=\"7.0\" byte"),
            ":2: version '7.0' found, 0.1 to 2.x expected");
  EXPECT_EQ(vtu_problem("LittleEndian", "BigEndian"),
            ":2: byte order 'BigEndian' found, 'LittleEndian' expected");
  EXPECT_EQ(vtu_problem("header_type", "compressor=\"vtkLZMADataCompressor\" header_type"),
            ":2: compressor 'vtkLZMADataCompressor' found, 'vtkZLibDataCompressor' or none expected");
  EXPECT_EQ(vtu_problem("NumberOfPoints=\"8\"", "NumberOfPoints=\"9\"").substr(4),
            ": 24 values found in 'Points/', 27 expected");
  EXPECT_EQ(vtu_problem("NumberOfPoints=\"8\"", "NumberOfPoints=\"-8\"").substr(0, 22),
            ":10: NumberOfPoints -8");
  EXPECT_EQ(vtu_problem("NumberOfCells=\"16\"", "NumberOfCells=\"99999999999\"").substr(0, 6), ":10: N");
  EXPECT_EQ(vtu_problem("\n0 1 4\n", "\n0 1 44\n").substr(4),
            ": point 44 found in cell 0, an index below 8 expected");
  EXPECT_EQ(vtu_problem("\n0 1 4\n", "\n0 1 -4\n").substr(4),
            ": point -4 found in cell 0, an index below 8 expected");
  const std::string expected =
      " found, only triangles (type 5), quadrilaterals (type 9) and lines (type 3) expected";
  EXPECT_EQ(vtu_problem("\n5\n5\n5\n", "\n5\n22\n5\n").substr(4),
            ": cell 1 of type 22" + expected + order_advice);
  EXPECT_EQ(vtu_problem("\n5\n5\n5\n", "\n5\n9\n5\n").substr(4),
            ": 3 to 6 found for cell 1, 4 values of connectivity expected");
  EXPECT_EQ(vtu_problem("\n3\n6\n9\n", "\n3\n-6\n9\n").substr(4),
            ": 3 to -6 found for cell 1, 3 values of connectivity expected");
  EXPECT_EQ(vtu_problem("format=\"ascii\"", "format=\"morse\"").substr(0, 32),
            ":5: format 'morse' found, 'ascii");
  EXPECT_EQ(vtu_problem("Name=\"types\"", "Name=\"kinds\"").substr(4),
            ": no array 'Cells/types' found, one expected");
}

TEST(BadVtuFiles, BinaryArraysThatAnnounceMoreThanTheyHoldAreRefused) {
  const std::string text =
      "<VTKFile type='UnstructuredGrid'><UnstructuredGrid><Piece NumberOfPoints='3' "
      "NumberOfCells='1'><Points>"
      "<DataArray type='Float32' format='binary'>";
  const std::string end = "</DataArray></Points></Piece></UnstructuredGrid></VTKFile>";
  EXPECT_NE(problem(io::parse_vtu, text + "////fwAA" + end), "read");  // 2 GB
  EXPECT_NE(problem(io::parse_vtu, text + "JAAAAAAAAAAA" + end), "read");
  EXPECT_NE(problem(io::parse_vtu, text + "JA" + end), "read");
  EXPECT_NE(problem(io::parse_vtu, text + end), "read");
}

// -------------------------------------------------------------------------------- any format, and VTKHDF

TEST(BadFiles, MissingOnesAndDirectoriesAreNamed) {
  const Scratch scratch;
  for (const char* name : {"m.su2", "m.msh", "m.vtu", "m.vtkhdf"}) {
    EXPECT_EQ(error_of([&] { read_frozen_mesh(scratch / name); }),
              (scratch / name).string() + ": cannot be read: No such file or directory");
    std::filesystem::create_directory(scratch / name);
    EXPECT_EQ(error_of([&] { read_frozen_mesh(scratch / name); }),
              (scratch / name).string() + ": cannot be read: Is a directory");
  }
}

TEST(BadVtkhdfFiles, EmptyTruncatedAndOtherFilesAreRefusedByName) {
  const Scratch scratch;
  const auto file = scratch / "m.vtkhdf";
  write_mesh(test::square_ring(), file);
  const std::string whole = read_text(file);
  const std::string expected = file.string() + ": no HDF5 file or a damaged one found, VTKHDF expected";
  for (const std::string& text :
       {std::string(), std::string("NDIME= 2\n"), whole.substr(0, whole.size() / 2)}) {
    write_text_atomically(file, text);
    EXPECT_EQ(error_of([&] { read_frozen_mesh(file); }), expected);
  }
}

TEST(BadVtkhdfFiles, AnyFlippedByteOfOursIsRefusedInOneLine) {
  const Scratch scratch;
  const auto file = scratch / "m.vtkhdf";
  write_mesh(test::full_square_ring(), file);
  const std::string whole = read_text(file);
  // The last sixteen bytes are the seal: without its mark, the file counts as another program's.
  for (std::size_t at = 0; at + 16 < whole.size(); at += 37) {
    std::string text = whole;
    text[at] = static_cast<char>(text[at] ^ 0x20);
    write_text_atomically(file, text);
    EXPECT_EQ(error_of([&] { read_frozen_mesh(file); }),
              file.string() + ": another checksum than that of the content found: the file is damaged");
  }
}

}  // namespace
}  // namespace remodel
