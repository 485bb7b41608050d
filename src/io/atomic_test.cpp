#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

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

TEST(WriteAtomically, ReplacesWhatALinkLeadsToAndLeavesTheLink) {
  const Scratch scratch;
  fs::create_directories(scratch / "far/away");
  write_text_atomically(scratch / "far/away/a.txt", "old");
  fs::create_symlink("far/away/a.txt", scratch / "one");
  fs::create_symlink(scratch / "one", scratch / "two");
  fs::create_symlink("far/away/new.txt", scratch / "dangling");
  write_text_atomically(scratch / "two", "text");
  write_text_atomically(scratch / "dangling", "new");
  for (const char* link : {"one", "two", "dangling"}) EXPECT_TRUE(fs::is_symlink(scratch / link)) << link;
  EXPECT_EQ(read_text(scratch / "far/away/a.txt"), "text");
  EXPECT_EQ(read_text(scratch / "far/away/new.txt"), "new");
  EXPECT_EQ(entries(scratch.path()), 4U);
  EXPECT_EQ(entries(scratch / "far/away"), 2U);
}

TEST(WriteAtomically, RefusesLinksThatLeadNowhere) {
  const Scratch scratch;
  fs::create_symlink("b", scratch / "a");
  fs::create_symlink("a", scratch / "b");
  fs::create_symlink("none/c", scratch / "c");
  EXPECT_EQ(error_of([&] { write_text_atomically(scratch / "a", "text"); }),
            (scratch / "a").string() + ": cannot be written: Too many levels of symbolic links");
  EXPECT_NE(error_of([&] { write_text_atomically(scratch / "c", "text"); }), "");
}

TEST(WriteAtomically, TakesNamesAsLongAsTheFileSystemDoes) {
  const Scratch scratch;
  const std::string longest(255, 'x');
  write_text_atomically(scratch / longest, "text");
  EXPECT_EQ(read_text(scratch / longest), "text");
  EXPECT_NE(error_of([&] { write_text_atomically(scratch / (longest + "x"), "text"); }), "");
  EXPECT_EQ(entries(scratch.path()), 1U);
}

// A pipe that holds a text, as the shell's <(...) gives it: a name that can be read once.
class TextPipe {
 public:
  explicit TextPipe(std::string_view text) {
    if (::pipe(ends_) != 0) throw std::runtime_error("no pipe");
    ::fcntl(ends_[1], F_SETPIPE_SZ, 1 << 20);  // nobody reads while this writes
    if (::write(ends_[1], text.data(), text.size()) != static_cast<ssize_t>(text.size()))
      throw std::runtime_error("the pipe takes no more");
    ::close(ends_[1]);
  }
  ~TextPipe() { ::close(ends_[0]); }
  TextPipe(const TextPipe&) = delete;
  TextPipe& operator=(const TextPipe&) = delete;
  std::string name() const { return "/dev/fd/" + std::to_string(ends_[0]); }

 private:
  int ends_[2];
};

TEST(ReadText, KeepsWhatCameThroughAPipeWhileSomebodyWantsIt) {
  const TextPipe pipe("text");
  EXPECT_TRUE(is_pipe(pipe.name()));
  {
    const KeptPipes once;
    EXPECT_EQ(read_text(pipe.name()), "text");
    EXPECT_EQ(read_text(pipe.name()), "text");
    EXPECT_EQ(error_of([&] { read_text(pipe.name(), 3); }),
              pipe.name() + ": larger than the 3 bytes allowed");
  }
  EXPECT_EQ(read_text(pipe.name()), "");
}

TEST(ReadText, TellsPipesFromFiles) {
  const Scratch scratch;
  write_text_atomically(scratch / "a.txt", "text");
  fs::create_symlink("a.txt", scratch / "link");
  for (const fs::path& path : {scratch / "a.txt", scratch / "link", scratch.path(), scratch / "none"})
    EXPECT_FALSE(is_pipe(path)) << path;
  EXPECT_TRUE(is_pipe(standard_input));
}

TEST(ReadMesh, KnowsTheFormatOfAPipeByItsContent) {
  const Scratch scratch;
  const FrozenMesh mesh = test::square_ring();
  for (const char* name : {"m.su2", "m.msh", "m.vtu", "m.vtkhdf"}) {
    write_mesh(mesh, scratch / name);
    const TextPipe pipe(read_text(scratch / name));
    EXPECT_EQ(read_frozen_mesh(pipe.name()).triangles, mesh.triangles) << name;
  }
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
