#include "remodel/film.h"

#include <gtest/gtest.h>
#include <webp/demux.h>

#include "io/test_meshes.h"
#include "remodel/io.h"

namespace remodel {
namespace {

using test::error_of;
using test::Scratch;

FrozenMesh ring_with_fates(Fate fate) {
  FrozenMesh mesh = test::full_square_ring();
  mesh.fate.assign(mesh.triangles.size(), Fate::kept);
  mesh.fate[3] = fate;
  return mesh;
}

std::string filmed(const FilmOptions& options, std::initializer_list<Fate> fates) {
  Film film(options);
  for (const Fate fate : fates) film.add(ring_with_fates(fate), "a caption");
  EXPECT_EQ(film.frames(), fates.size());
  const Scratch scratch;
  film.write(scratch / "a.webp");
  return read_text(scratch / "a.webp");
}

// Each frame's pixels, as 0xAABBGGRR words, and until when it is seen.
struct Frame {
  std::vector<std::uint32_t> pixels;
  int until_ms = 0;
};
std::vector<Frame> frames_of(const std::string& bytes, int& width) {
  const WebPData data{reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
  WebPAnimDecoder* decoder = WebPAnimDecoderNew(&data, nullptr);
  std::vector<Frame> frames;
  if (decoder == nullptr) return frames;
  WebPAnimInfo info;
  WebPAnimDecoderGetInfo(decoder, &info);
  width = static_cast<int>(info.canvas_width);
  std::uint8_t* pixels = nullptr;
  Frame frame;
  while (WebPAnimDecoderGetNext(decoder, &pixels, &frame.until_ms) != 0) {
    const auto* words = reinterpret_cast<const std::uint32_t*>(pixels);
    frame.pixels.assign(words, words + info.canvas_width * info.canvas_height);
    frames.push_back(frame);
  }
  WebPAnimDecoderDelete(decoder);
  return frames;
}

const FilmOptions small{
    .picture = {.color = DrawColor::fate, .width = 200}, .frame_ms = 40, .last_frame_ms = 500};

TEST(Film, HasItsFramesForAsLongAsTheyAreToBeSeen) {
  int width = 0;
  const auto frames = frames_of(filmed(small, {Fate::kept, Fate::made, Fate::moved}), width);
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(width, 200);
  EXPECT_EQ(frames[0].until_ms, 40);
  EXPECT_EQ(frames[1].until_ms, 80);
  EXPECT_EQ(frames[2].until_ms, 580);
}

TEST(Film, FramesAreThePicturesThatDrawMakes) {
  int width = 0;
  const auto together = frames_of(filmed(small, {Fate::kept, Fate::made, Fate::kept}), width);
  ASSERT_EQ(together.size(), 3U);
  for (const auto& [index, fate] : {std::pair{0, Fate::kept}, {1, Fate::made}}) {
    const auto alone = frames_of(filmed(small, {fate}), width);
    ASSERT_EQ(alone.size(), 1U);
    EXPECT_EQ(together[static_cast<std::size_t>(index)].pixels, alone[0].pixels);
  }
  EXPECT_NE(together[1].pixels, together[0].pixels);
  EXPECT_EQ(together[2].pixels, together[0].pixels);
}

TEST(Film, TheSameFramesGiveTheSameBytes) {
  EXPECT_EQ(filmed(small, {Fate::kept, Fate::made}), filmed(small, {Fate::kept, Fate::made}));
}

TEST(Film, RefusesOtherExtensionsNoFramesAndOddTimes) {
  Film film(small);
  EXPECT_EQ(error_of([&] { film.write("a.webp"); }), "film: no frames found, at least one expected");
  EXPECT_EQ(error_of([&] { film.write("a.gif"); }), "a.gif: extension '.gif' found, .webp expected");
  EXPECT_EQ(error_of([&] { film.add(test::square_ring()); }),
            "color fate: a mesh without fates found, one with them expected");
  FilmOptions odd = small;
  odd.frame_ms = 0;
  EXPECT_EQ(error_of([&] { Film refused(odd); }), "frame_ms: 0 found, 10 to 60000 milliseconds expected");
}

}  // namespace
}  // namespace remodel
