#include "draw/canvas.h"

#include <cairo-svg.h>

#include "remodel/error.h"

namespace remodel::draw_detail {

namespace {

cairo_status_t append(void* text, const unsigned char* bytes, unsigned int size) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), size);
  return CAIRO_STATUS_SUCCESS;
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

}  // namespace

bool is_svg(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  if (extension != ".svg" && extension != ".png") {
    throw Error(ErrorCode::argument, file.string(),
                "extension '" + extension + "' found, .svg or .png expected");
  }
  return extension == ".svg";
}

std::string svg_bytes(const std::filesystem::path& file, int width, int height,
                      const std::function<void(cairo_t*)>& paint) {
  std::string text;
  const Surface surface = own(cairo_svg_surface_create_for_stream(append, &text, width, height));
  check(cairo_surface_status(surface.get()), file);
  const Context cairo = context_of(surface);
  paint(cairo.get());
  check(cairo_status(cairo.get()), file);
  cairo_surface_finish(surface.get());
  check(cairo_surface_status(surface.get()), file);
  return without_surface_number(std::move(text));
}

std::string png_bytes(const std::filesystem::path& file, const Surface& surface) {
  std::string bytes;
  check(cairo_surface_write_to_png_stream(surface.get(), append, &bytes), file);
  return bytes;
}

std::string png_bytes(const std::filesystem::path& file, int width, int height,
                      const std::function<void(cairo_t*)>& paint) {
  const Surface surface = own(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
  check(cairo_surface_status(surface.get()), file);
  const Context cairo = context_of(surface);
  paint(cairo.get());
  check(cairo_status(cairo.get()), file);
  cairo_surface_flush(surface.get());
  return png_bytes(file, surface);
}

}  // namespace remodel::draw_detail
