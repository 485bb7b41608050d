#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "io/test_meshes.h"
#include "remodel/io.h"

namespace remodel {
namespace {

namespace fs = std::filesystem;
using test::error_of;
using test::Scratch;

std::size_t entries(const fs::path& directory) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(directory), fs::directory_iterator()));
}

TEST(WriteAtomically, PutsTheTextInPlaceAndLeavesNothingElse) {
  const Scratch scratch;
  write_text_atomically(scratch / "a.txt", "first");
  write_text_atomically(scratch / "a.txt", "second");
  EXPECT_EQ(read_text(scratch / "a.txt"), "second");
  EXPECT_EQ(entries(scratch.path()), 1U);
}

TEST(WriteAtomically, WritesTheTemporaryInTheSameDirectory) {
  const Scratch scratch;
  write_atomically(scratch / "a.txt", [&](const fs::path& temporary) {
    EXPECT_EQ(temporary.parent_path(), scratch.path());
    EXPECT_NE(temporary, scratch / "a.txt");
    std::ofstream(temporary) << "text";
  });
  EXPECT_EQ(read_text(scratch / "a.txt"), "text");
}

TEST(WriteAtomically, AFailingWriterLeavesTheOldFileAndNoTemporary) {
  const Scratch scratch;
  write_text_atomically(scratch / "a.txt", "old");
  EXPECT_THROW(write_atomically(scratch / "a.txt",
                                [](const fs::path& temporary) {
                                  std::ofstream(temporary) << "half";
                                  throw std::runtime_error("no more");
                                }),
               std::runtime_error);
  EXPECT_EQ(read_text(scratch / "a.txt"), "old");
  EXPECT_EQ(entries(scratch.path()), 1U);
}

TEST(WriteAtomically, AWriterThatWritesNothingIsAnError) {
  const Scratch scratch;
  EXPECT_NE(error_of([&] { write_atomically(scratch / "a.txt", [](const fs::path&) {}); }), "");
  EXPECT_EQ(entries(scratch.path()), 0U);
}

TEST(WriteAtomically, NamesTheFileAndTheReasonWhereTheDirectoryIsMissing) {
  const Scratch scratch;
  const fs::path file = scratch / "none/a.txt";
  EXPECT_EQ(error_of([&] { write_text_atomically(file, "text"); }),
            file.string() + ": cannot be written: No such file or directory");
}

TEST(WriteAtomically, RefusesADirectoryAsItsTarget) {
  const Scratch scratch;
  EXPECT_EQ(error_of([&] { write_text_atomically(scratch.path(), "text"); }),
            scratch.path().string() + ": cannot be written: Is a directory");
}

TEST(WriteAtomically, ADiskThatTakesNoMoreLeavesTheOldFileAndSaysWhy) {
  const Scratch scratch;
  write_text_atomically(scratch / "a.txt", "old");
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{4096, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string error =
      error_of([&] { write_text_atomically(scratch / "a.txt", std::string(100000, 'x')); });
  const std::string mesh_error =
      error_of([&] { write_mesh(test::graded_ring(50, 10), scratch / "m.vtkhdf"); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(error, (scratch / "a.txt").string() + ": cannot be written: File too large");
  EXPECT_EQ(mesh_error, (scratch / "m.vtkhdf").string() + ": cannot be written: File too large");
  EXPECT_EQ(read_text(scratch / "a.txt"), "old");
  EXPECT_EQ(entries(scratch.path()), 1U);
}

TEST(ReadText, NamesMissingFilesAndDirectoriesAndTooLargeOnes) {
  const Scratch scratch;
  EXPECT_EQ(error_of([&] { read_text(scratch / "none"); }),
            (scratch / "none").string() + ": cannot be read: No such file or directory");
  EXPECT_EQ(error_of([&] { read_text(scratch.path()); }),
            scratch.path().string() + ": cannot be read: Is a directory");
  write_text_atomically(scratch / "a.txt", "12345");
  EXPECT_EQ(read_text(scratch / "a.txt", 5), "12345");
  EXPECT_EQ(error_of([&] { read_text(scratch / "a.txt", 4); }),
            (scratch / "a.txt").string() + ": larger than the 4 bytes allowed");
}

}  // namespace
}  // namespace remodel
