#pragma once

// Picture files, made in memory, so that a full disk is found where every other file finds it.

#include <cairo.h>

#include <filesystem>
#include <functional>
#include <string>

#include "draw/bitmap.h"

namespace remodel::draw_detail {

// True for .svg, false for .png; throws Error (argument) for another extension.
bool is_svg(const std::filesystem::path& file);

// The bytes of an SVG file; the same calls give the same bytes.
std::string svg_bytes(const std::filesystem::path& file, int width, int height,
                      const std::function<void(cairo_t*)>& paint);
std::string png_bytes(const std::filesystem::path& file, const Surface& surface);
std::string png_bytes(const std::filesystem::path& file, int width, int height,
                      const std::function<void(cairo_t*)>& paint);

}  // namespace remodel::draw_detail
