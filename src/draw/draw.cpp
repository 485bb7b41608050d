#include "remodel/draw.h"

#include <cairo-svg.h>
#include <cairo.h>

#include <memory>
#include <string>

#include "draw/picture.h"
#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel {

namespace {

using draw_detail::Layout;
using draw_detail::Picture;

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

Surface own(cairo_surface_t* surface) {
  return {surface, cairo_surface_destroy};
}
Context context_of(const Surface& surface) {
  return {cairo_create(surface.get()), cairo_destroy};
}

// Pictures are made in memory, so that a full disk is found where every other file finds it.
cairo_status_t append(void* text, const unsigned char* bytes, unsigned int size) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), size);
  return CAIRO_STATUS_SUCCESS;
}

void check(cairo_status_t status, const std::filesystem::path& file) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw Error(ErrorCode::file, file.string(),
              std::string("cannot be drawn: ") + cairo_status_to_string(status));
}

void paint_page(cairo_t* cairo) {
  cairo_set_source_rgb(cairo, 1, 1, 1);
  cairo_paint(cairo);
}

void clip_to_plot(cairo_t* cairo, const Layout& layout) {
  cairo_rectangle(cairo, 0, 0, layout.width, layout.plot_height);
  cairo_clip(cairo);
}

void draw_lines(cairo_t* cairo, const Picture& picture) {
  picture.stroke_edges(cairo);
  picture.stroke_boundaries(cairo);
}

// Smoothed polygons leave hairlines between neighbours. Fill unsmoothed at twice the size and scale that
// down.
void paint_fills(cairo_t* cairo, const Picture& picture, const Layout& layout) {
  const Surface fine =
      own(cairo_image_surface_create(CAIRO_FORMAT_RGB24, 2 * layout.width, 2 * layout.plot_height));
  const Context fine_cairo = context_of(fine);
  paint_page(fine_cairo.get());
  cairo_scale(fine_cairo.get(), 2, 2);
  cairo_set_antialias(fine_cairo.get(), CAIRO_ANTIALIAS_NONE);
  picture.fill_triangles(fine_cairo.get(), Picture::Seams::leave);
  cairo_save(cairo);
  cairo_scale(cairo, 0.5, 0.5);
  cairo_set_source_surface(cairo, fine.get(), 0, 0);
  cairo_pattern_set_filter(cairo_get_source(cairo), CAIRO_FILTER_GOOD);
  cairo_paint(cairo);
  cairo_restore(cairo);
}

std::string png(const Picture& picture, const Layout& layout, const std::filesystem::path& file) {
  const Surface surface = own(cairo_image_surface_create(CAIRO_FORMAT_RGB24, layout.width, layout.height));
  check(cairo_surface_status(surface.get()), file);
  const Context cairo = context_of(surface);
  paint_page(cairo.get());
  cairo_save(cairo.get());
  clip_to_plot(cairo.get(), layout);
  paint_fills(cairo.get(), picture, layout);
  draw_lines(cairo.get(), picture);
  cairo_restore(cairo.get());
  picture.legend(cairo.get());
  std::string bytes;
  check(cairo_status(cairo.get()), file);
  check(cairo_surface_write_to_png_stream(surface.get(), append, &bytes), file);
  return bytes;
}

// cairo numbers its surfaces over the life of the program; the same picture is to give the same bytes.
std::string without_surface_number(std::string svg) {
  const std::string mark = "id=\"surface";
  for (auto at = svg.find(mark); at != std::string::npos; at = svg.find(mark, at + 1)) {
    const auto digits = at + mark.size();
    svg.replace(digits, svg.find('"', digits) - digits, "");
  }
  return svg;
}

std::string svg(const Picture& picture, const Layout& layout, const std::filesystem::path& file) {
  std::string text;
  const Surface surface =
      own(cairo_svg_surface_create_for_stream(append, &text, layout.width, layout.height));
  check(cairo_surface_status(surface.get()), file);
  const Context cairo = context_of(surface);
  paint_page(cairo.get());
  cairo_save(cairo.get());
  clip_to_plot(cairo.get(), layout);
  picture.fill_triangles(cairo.get(), Picture::Seams::fill);
  draw_lines(cairo.get(), picture);
  cairo_restore(cairo.get());
  picture.legend(cairo.get());
  check(cairo_status(cairo.get()), file);
  cairo_surface_finish(surface.get());
  check(cairo_surface_status(surface.get()), file);
  return without_surface_number(std::move(text));
}

}  // namespace

void draw(const FrozenMesh& mesh, const std::filesystem::path& file, const DrawOptions& options) {
  const std::string extension = file.extension().string();
  if (extension != ".svg" && extension != ".png") {
    throw Error(ErrorCode::argument, file.string(),
                "extension '" + extension + "' found, .svg or .png expected");
  }
  const Layout layout = draw_detail::layout_for(mesh, options);
  const Picture picture(mesh, layout, options.color);
  write_text_atomically(file, extension == ".svg" ? svg(picture, layout, file) : png(picture, layout, file));
}

}  // namespace remodel
