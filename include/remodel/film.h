#pragma once

// Moving pictures of a mesh, as animated WebP (libwebp).

#include <filesystem>
#include <memory>
#include <string>

#include "remodel/draw.h"

namespace remodel {

struct FilmOptions {
  // The options of draw(), without captions. Without a window all frames show what the first mesh fills.
  DrawOptions picture{.color = DrawColor::fate, .width = 960, .line = 1.6};
  int frame_ms = 100;        // how long a frame is seen, milliseconds: 10 to 60000
  int last_frame_ms = 2500;  // the last one, before the film begins anew
};

// Frame by frame: memory holds the compressed frames alone. The same frames give the same bytes.
class Film {
 public:
  // Throws Error (argument).
  explicit Film(const FilmOptions& options);
  ~Film();
  Film(Film&&) noexcept;
  Film& operator=(Film&&) noexcept;

  // Throws as draw() does where the mesh lacks what the colouring shows, and Error (argument) where pictures
  // are more than 16,383 pixels high, which WebP has no place for. caption: a line under the legend.
  void add(const FrozenMesh& mesh, const std::string& caption = {});
  std::size_t frames() const;

  // Writes a .webp file atomically, ends the film and returns its size in bytes. Error (argument) for another
  // extension or a film without frames.
  std::size_t write(const std::filesystem::path& file);

 private:
  struct Encoder;
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace remodel
