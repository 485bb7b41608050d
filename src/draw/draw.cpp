#include "remodel/draw.h"

#include <cairo.h>

#include <string>

#include "draw/bitmap.h"
#include "draw/canvas.h"
#include "draw/picture.h"
#include "remodel/io.h"

namespace remodel {

void draw(const FrozenMesh& mesh, const std::filesystem::path& file, const DrawOptions& options) {
  const bool svg = draw_detail::is_svg(file);
  const draw_detail::Layout layout = draw_detail::layout_for(mesh, options);
  const draw_detail::Picture picture(mesh, layout, options);
  if (!svg) {
    const draw_detail::Surface surface = draw_detail::bitmap(picture, layout, options.caption, file);
    return write_text_atomically(file, draw_detail::png_bytes(file, surface));
  }
  const auto paint = [&](cairo_t* cairo) {
    draw_detail::paint(cairo, picture, layout, options.caption,
                       [&] { picture.fill_cells(cairo, draw_detail::Seams::fill); });
  };
  write_text_atomically(file, draw_detail::svg_bytes(file, layout.width, layout.height, paint));
}

}  // namespace remodel
