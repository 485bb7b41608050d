#include "draw/bitmap.h"

#include <new>

#include "remodel/error.h"

namespace remodel::draw_detail {

namespace {

void paint_page(cairo_t* cairo) {
  cairo_set_source_rgb(cairo, 1, 1, 1);
  cairo_paint(cairo);
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
  picture.fill_cells(fine_cairo.get(), Seams::leave);
  cairo_save(cairo);
  cairo_scale(cairo, 0.5, 0.5);
  cairo_set_source_surface(cairo, fine.get(), 0, 0);
  cairo_pattern_set_filter(cairo_get_source(cairo), CAIRO_FILTER_GOOD);
  cairo_paint(cairo);
  cairo_restore(cairo);
}

}  // namespace

Surface own(cairo_surface_t* surface) {
  return {surface, cairo_surface_destroy};
}

Context context_of(const Surface& surface) {
  return {cairo_create(surface.get()), cairo_destroy};
}

void check(cairo_status_t status, const std::filesystem::path& file) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  if (status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
  throw Error(ErrorCode::file, file.string(),
              std::string("cannot be drawn: ") + cairo_status_to_string(status));
}

void paint(cairo_t* cairo, const Picture& picture, const Layout& layout, const std::string& caption,
           const std::function<void()>& fill) {
  paint_page(cairo);
  cairo_save(cairo);
  cairo_rectangle(cairo, 0, 0, layout.width, layout.plot_height);
  cairo_clip(cairo);
  fill();
  picture.stroke_edges(cairo);
  picture.stroke_boundaries(cairo);
  cairo_restore(cairo);
  picture.legend(cairo, caption);
}

Surface bitmap(const Picture& picture, const Layout& layout, const std::string& caption,
               const std::filesystem::path& file) {
  Surface surface = own(cairo_image_surface_create(CAIRO_FORMAT_RGB24, layout.width, layout.height));
  check(cairo_surface_status(surface.get()), file);
  const Context cairo = context_of(surface);
  paint(cairo.get(), picture, layout, caption, [&] { paint_fills(cairo.get(), picture, layout); });
  check(cairo_status(cairo.get()), file);
  cairo_surface_flush(surface.get());
  return surface;
}

}  // namespace remodel::draw_detail
