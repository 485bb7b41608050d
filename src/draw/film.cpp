#include "remodel/film.h"

#include <webp/encode.h>
#include <webp/mux.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <optional>
#include <stdexcept>

#include "draw/bitmap.h"
#include "draw/picture.h"
#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel {

namespace {

using draw_detail::Layout;
using draw_detail::Picture;

// Sizes and times are checked before libwebp sees them: what it cannot do then, it has no memory for.
void require_memory(int good) {
  if (good == 0) throw std::bad_alloc();
}

// The headers that this was compiled with and the library are of different kinds.
void require_version(int good) {
  if (good == 0) throw std::runtime_error("libwebp: another version");
}

struct FreePicture {
  void operator()(WebPPicture* picture) const {
    WebPPictureFree(picture);
    delete picture;
  }
};

// cairo's RGB24 and libwebp's ARGB are the same words but for the first byte.
std::unique_ptr<WebPPicture, FreePicture> webp_picture(cairo_surface_t* surface) {
  auto blank = std::make_unique<WebPPicture>();
  require_version(WebPPictureInit(blank.get()));
  std::unique_ptr<WebPPicture, FreePicture> picture(blank.release());
  picture->use_argb = 1;
  picture->width = cairo_image_surface_get_width(surface);
  picture->height = cairo_image_surface_get_height(surface);
  require_memory(WebPPictureAlloc(picture.get()));
  const unsigned char* row = cairo_image_surface_get_data(surface);
  for (int y = 0; y < picture->height; ++y, row += cairo_image_surface_get_stride(surface)) {
    std::uint32_t* pixels = picture->argb + static_cast<std::ptrdiff_t>(y) * picture->argb_stride;
    std::memcpy(pixels, row, sizeof(std::uint32_t) * static_cast<std::size_t>(picture->width));
    for (int x = 0; x < picture->width; ++x) pixels[x] |= 0xff000000U;
  }
  return picture;
}

// Meshes are flat colours and thin lines: without loss they are smaller than with it, and sharp.
WebPConfig lossless() {
  WebPConfig config;
  require_version(WebPConfigInit(&config) && WebPConfigLosslessPreset(&config, 6));
  return config;
}

void check_milliseconds(int value, const char* name) {
  if (value < 10 || value > 60000)
    throw Error(ErrorCode::argument, name,
                std::to_string(value) + " found, 10 to 60000 milliseconds expected");
}

}  // namespace

struct Film::Encoder {
  using Animation = std::unique_ptr<WebPAnimEncoder, decltype(&WebPAnimEncoderDelete)>;

  void begin(const FrozenMesh& mesh);
  std::string finish();

  FilmOptions options;
  std::optional<Layout> layout;  // of all frames
  WebPConfig config = lossless();
  Animation animation{nullptr, WebPAnimEncoderDelete};
  std::size_t frames = 0;
  int time_ms = 0;  // at which the next frame is to be seen
};

void Film::Encoder::begin(const FrozenMesh& mesh) {
  layout = draw_detail::layout_for(mesh, options.picture);
  const int longest = std::max(layout->width, layout->height);
  if (longest > WEBP_MAX_DIMENSION)
    throw Error(ErrorCode::argument, "width",
                std::to_string(options.picture.width) + " found, which makes pictures of " +
                    std::to_string(longest) + " pixels, at most " + std::to_string(WEBP_MAX_DIMENSION) +
                    " expected");
  WebPAnimEncoderOptions usual;
  require_version(WebPAnimEncoderOptionsInit(&usual));
  usual.anim_params.loop_count = 0;  // for ever
  usual.kmax = 0;                    // every frame but the first holds what changed alone
  animation.reset(WebPAnimEncoderNew(layout->width, layout->height, &usual));
  require_memory(animation != nullptr);
}

std::string Film::Encoder::finish() {
  time_ms += options.last_frame_ms - options.frame_ms;
  require_memory(WebPAnimEncoderAdd(animation.get(), nullptr, time_ms, nullptr));
  WebPData data;
  WebPDataInit(&data);
  const int assembled = WebPAnimEncoderAssemble(animation.get(), &data);
  const std::unique_ptr<WebPData, decltype(&WebPDataClear)> clear(&data, WebPDataClear);
  require_memory(assembled);
  return {reinterpret_cast<const char*>(data.bytes), data.size};
}

Film::Film(const FilmOptions& options) : encoder_(std::make_unique<Encoder>()) {
  check_milliseconds(options.frame_ms, "frame_ms");
  check_milliseconds(options.last_frame_ms, "last_frame_ms");
  encoder_->options = options;
}
Film::~Film() = default;
Film::Film(Film&&) noexcept = default;
Film& Film::operator=(Film&&) noexcept = default;

std::size_t Film::frames() const {
  return encoder_->frames;
}

void Film::add(const FrozenMesh& mesh, const std::string& caption) {
  Encoder& e = *encoder_;
  if (!e.animation) e.begin(mesh);
  const Picture picture(mesh, *e.layout, e.options.picture);
  const draw_detail::Surface surface = draw_detail::bitmap(picture, *e.layout, caption, "film");
  const auto frame = webp_picture(surface.get());
  require_memory(WebPAnimEncoderAdd(e.animation.get(), frame.get(), e.time_ms, &e.config));
  e.time_ms += e.options.frame_ms;
  ++e.frames;
}

std::size_t Film::write(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  if (extension != ".webp")
    throw Error(ErrorCode::argument, file.string(), "extension '" + extension + "' found, .webp expected");
  if (frames() == 0) throw Error(ErrorCode::argument, "film", "no frames found, at least one expected");
  const std::string bytes = encoder_->finish();
  encoder_->animation.reset();
  write_text_atomically(file, bytes);
  return bytes.size();
}

}  // namespace remodel
