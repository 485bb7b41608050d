#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
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

TEST(WriteAtomically, KeepsTheModeOfWhatItReplaces) {
  const Scratch scratch;
  write_text_atomically(scratch / "a.txt", "old");
  fs::permissions(scratch / "a.txt", fs::perms{0640});
  write_text_atomically(scratch / "a.txt", "new");
  EXPECT_EQ(fs::status(scratch / "a.txt").permissions(), fs::perms{0640});
  EXPECT_EQ(read_text(scratch / "a.txt"), "new");
}

TEST(WriteAtomically, LeavesOtherHardLinksAsTheyAre) {
  const Scratch scratch;
  write_text_atomically(scratch / "a.txt", "old");
  fs::create_hard_link(scratch / "a.txt", scratch / "b.txt");
  write_text_atomically(scratch / "a.txt", "new");
  EXPECT_EQ(read_text(scratch / "a.txt"), "new");
  EXPECT_EQ(read_text(scratch / "b.txt"), "old");
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
            scratch.path().string() + ": is a directory, expected a file to write");
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

// What is at its other end is read here once it is written, so it has to fit into the pipe.
std::string written_to(const fs::path& fifo, std::string_view text) {
  const int reader = ::open(fifo.c_str(), O_RDONLY | O_NONBLOCK);
  write_text_atomically(fifo, text);
  std::string read(text.size() + 1, ' ');
  const auto got = ::read(reader, read.data(), read.size());
  ::close(reader);
  return read.substr(0, got < 0 ? 0 : static_cast<std::size_t>(got));
}

TEST(WriteAtomically, WritesAFifoInPlace) {
  const Scratch scratch;
  ASSERT_EQ(::mkfifo((scratch / "fifo").c_str(), 0600), 0);
  EXPECT_EQ(written_to(scratch / "fifo", "text"), "text");
  EXPECT_TRUE(fs::is_fifo(scratch / "fifo"));
  EXPECT_EQ(entries(scratch.path()), 1U);
}

TEST(WriteAtomically, RefusesLinksToWhatIsNoFileAndLeavesTheTarget) {
  const Scratch scratch;
  ASSERT_EQ(::mkfifo((scratch / "fifo").c_str(), 0600), 0);
  fs::create_directory(scratch / "directory");
  fs::create_symlink("fifo", scratch / "one");
  fs::create_symlink("one", scratch / "two");
  fs::create_symlink("directory", scratch / "three");
  const auto refusal = [&](const char* link) {
    return error_of([&] { write_text_atomically(scratch / link, "text"); });
  };
  const auto expected = [&](const char* link, const char* kind) {
    return (scratch / link).string() + ": is a link to something that is " + kind +
           ", expected a file to write";
  };
  EXPECT_EQ(refusal("one"), expected("one", "a FIFO"));
  EXPECT_EQ(refusal("two"), expected("two", "a FIFO"));
  EXPECT_EQ(refusal("three"), expected("three", "a directory"));
  EXPECT_TRUE(fs::is_fifo(scratch / "fifo"));
  EXPECT_EQ(entries(scratch.path()), 5U);
}

TEST(WriteAtomically, WritesStreamsOfThisProcessWhereTheyAre) {
  const Scratch scratch;
  const int stream = ::open((scratch / "a.txt").c_str(), O_WRONLY | O_CREAT, 0600);
  ASSERT_EQ(::write(stream, "before ", 7), 7);
  for (const char* directory : {"/dev/fd/", "/proc/self/fd/"})
    write_text_atomically(directory + std::to_string(stream), "text ");
  ::close(stream);
  EXPECT_EQ(read_text(scratch / "a.txt"), "before text text ");
  EXPECT_NE(error_of([&] { write_text_atomically("/dev/fd/" + std::to_string(stream), "text"); }), "");
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
