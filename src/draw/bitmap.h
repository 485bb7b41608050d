#pragma once

// A picture on a page, and as pixels: what PNG files and the frames of films are made of.

#include <cairo.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "draw/picture.h"

namespace remodel::draw_detail {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;
Surface own(cairo_surface_t* surface);
Context context_of(const Surface& surface);
// Throws Error (file) that says why the file cannot be drawn, std::bad_alloc where memory is what is missing.
void check(cairo_status_t status, const std::filesystem::path& file);

// The page, the fills, the lines over them and the legend.
void paint(cairo_t* cairo, const Picture& picture, const Layout& layout, const std::string& caption,
           const std::function<void()>& fill);

// An image surface of format RGB24.
Surface bitmap(const Picture& picture, const Layout& layout, const std::string& caption,
               const std::filesystem::path& file);

}  // namespace remodel::draw_detail
