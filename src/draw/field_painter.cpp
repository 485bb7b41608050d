#include "draw/field_painter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "remodel/error.h"

namespace remodel::draw_detail {

namespace {

constexpr std::size_t bands = 128;  // more cannot be told apart; one path a band keeps files small

// Where a line between two corners has the value, to the last bit the same from both sides.
ValuedPoint crossing(ValuedPoint a, ValuedPoint b, double value) {
  if (b.value < a.value) std::swap(a, b);
  const double t = (value - a.value) / (b.value - a.value);
  return {a.point + t * (b.point - a.point), value};
}

// Keeps the side where sign * (corner's value - value) >= 0.
std::vector<ValuedPoint> cut_at(const std::vector<ValuedPoint>& polygon, double value, double sign) {
  std::vector<ValuedPoint> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ValuedPoint& a = polygon[i];
    const ValuedPoint& b = polygon[(i + 1) % polygon.size()];
    const bool a_in = sign * (a.value - value) >= 0, b_in = sign * (b.value - value) >= 0;
    if (a_in) kept.push_back(a);
    if (a_in != b_in) kept.push_back(crossing(a, b, value));
  }
  return kept;
}

std::vector<double> lengths_of(const Field& field) {
  if (field.components == 1) return field.values;
  const auto components = static_cast<std::size_t>(field.components);
  std::vector<double> lengths;
  for (std::size_t i = 0; i < field.values.size(); i += components) {
    double sum = 0.0;
    for (std::size_t k = 0; k < components; ++k) sum += field.values[i + k] * field.values[i + k];
    lengths.push_back(std::sqrt(sum));
  }
  return lengths;
}

// A constant field, up to round-off, lies in the middle of its range.
std::array<double, 2> opened(double low, double high) {
  const double size = std::max(std::abs(low), std::abs(high));
  if (high - low > 1e-12 * size) return {low, high};
  const double margin = std::max(1e-3 * size, 1e-30);
  return {low - margin, high + margin};
}

}  // namespace

std::vector<ValuedPoint> between_values(std::vector<ValuedPoint> polygon, double low, double high) {
  polygon = cut_at(polygon, low, 1.0);
  return cut_at(polygon, high, -1.0);
}

std::vector<double> ticks_within(double low, double high) {
  const double raw = (high - low) / 10.0;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  double step = 10.0 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * power >= raw) step = factor * power;
  std::vector<double> ticks;
  const double slack = 1e-9 * (high - low);
  constexpr int most = 20;
  const double first = std::ceil((low - slack) / step);
  for (int i = 0; i < most && (first + i) * step <= high + slack; ++i) {
    const double tick = (first + i) * step;
    ticks.push_back(std::abs(tick) < slack ? 0.0 : tick);
  }
  return ticks;
}

FieldPainter::FieldPainter(const FrozenMesh& mesh, const Layout& layout, const Box& seen,
                           std::span<const std::uint32_t> cells, const DrawField& options)
    : mesh_(mesh),
      layout_(layout),
      seen_(seen),
      place_(options.field.place),
      label_(options.label.empty() ? options.field.name : options.label),
      iso_lines_(options.iso_lines) {
  constexpr int most_lines = 200;
  require_fit(options.field, mesh);
  if (iso_lines_ < 0 || iso_lines_ > most_lines)
    throw Error(ErrorCode::argument, "iso-lines", std::to_string(iso_lines_) + " found, 0 to 200 expected");
  if (iso_lines_ > 0 && place_ == FieldPlace::triangles) {
    throw Error(ErrorCode::argument, "iso-lines",
                "a field on triangles found, '" + options.field.name + "', one on vertices expected");
  }
  values_ = lengths_of(options.field);
  if (options.range) {
    low_ = (*options.range)[0];
    high_ = (*options.range)[1];
    if (!std::isfinite(low_) || !std::isfinite(high_) || !(low_ < high_)) {
      throw Error(ErrorCode::argument, "range",
                  label_of(low_) + ":" + label_of(high_) + " found, two numbers A:B with A < B expected");
    }
  } else if (!cells.empty()) {
    low_ = std::numeric_limits<double>::infinity();
    high_ = -low_;
    const auto take = [&](double value) {
      low_ = std::min(low_, value);
      high_ = std::max(high_, value);
    };
    for (const std::uint32_t cell : cells) {
      if (place_ == FieldPlace::triangles)
        take(values_[cell]);
      else
        for (const std::uint32_t vertex : mesh.cell(cell)) take(values_[vertex]);
    }
    const auto [low, high] = opened(low_, high_);
    low_ = low;
    high_ = high;
  }
}

std::vector<ValuedPoint> FieldPainter::corners(std::uint32_t cell) const {
  std::vector<ValuedPoint> result;
  for (const std::uint32_t v : mesh_.cell(cell)) {
    const double value = values_[place_ == FieldPlace::triangles ? cell : v];
    result.push_back({mesh_.points[v], (value - low_) / (high_ - low_)});
  }
  return result;
}

std::vector<std::vector<ValuedPoint>> FieldPainter::polygons(std::uint32_t cell) const {
  const std::vector<ValuedPoint> all = corners(cell);
  if (all.size() == 3 || place_ == FieldPlace::triangles) return {all};
  return {{all[0], all[1], all[2]}, {all[0], all[2], all[3]}};
}

void FieldPainter::fill(cairo_t* cairo, std::span<const std::uint32_t> cells, Seams seams) const {
  const auto band_of = [](double position) {
    return static_cast<std::size_t>(std::clamp(position * bands, 0.0, bands - 1.0));
  };
  std::array<std::vector<std::uint32_t>, bands> members;
  for (const std::uint32_t cell : cells) {
    const auto at = corners(cell);
    const auto [low, high] = std::ranges::minmax_element(at, {}, &ValuedPoint::value);
    for (std::size_t band = band_of(low->value); band <= band_of(high->value); ++band)
      members[band].push_back(cell);
  }
  constexpr double everything = std::numeric_limits<double>::infinity();
  cairo_set_line_width(cairo, 0.5 * layout_.unit);
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_BEVEL);
  for (std::size_t band = 0; band < bands; ++band) {
    const double low = band == 0 ? -everything : static_cast<double>(band) / bands;
    const double high = band == bands - 1 ? everything : static_cast<double>(band + 1) / bands;
    for (const std::uint32_t cell : members[band])
      for (const std::vector<ValuedPoint>& polygon : polygons(cell)) {
        std::vector<Point> part;
        for (const ValuedPoint& corner : between_values(polygon, low, high)) part.push_back(corner.point);
        add_polygon(cairo, layout_, clip_polygon(std::move(part), seen_));
      }
    set_color(cairo, color_at(ColorMap::sequential, static_cast<double>(band) / (bands - 1)));
    fill_path(cairo, seams);
  }
}

void FieldPainter::stroke_iso_lines(cairo_t* cairo, std::span<const std::uint32_t> cells) const {
  cairo_set_line_width(cairo, 0.9 * layout_.unit);
  cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
  for (int line = 1; line <= iso_lines_; ++line) {
    const double value = static_cast<double>(line) / (iso_lines_ + 1);
    for (const std::uint32_t cell : cells)
      for (const std::vector<ValuedPoint>& triangle : polygons(cell)) {
        std::vector<Point> ends;
        for (std::size_t k = 0; k < 3; ++k) {
          const ValuedPoint &a = triangle[k], &b = triangle[(k + 1) % 3];
          if ((a.value < value) != (b.value < value)) ends.push_back(crossing(a, b, value).point);
        }
        if (ends.size() == 2) add_segment(cairo, layout_, ends[0], ends[1], seen_);
      }
    if (value < dark_end(ColorMap::sequential) + 0.2) {
      set_color(cairo, {0.95, 0.95, 1.0}, 0.55);
    } else {
      set_color(cairo, {0.05, 0.05, 0.10}, 0.65);
    }
    cairo_stroke(cairo);
  }
}

void FieldPainter::color_bar(cairo_t* cairo, double left, double baseline) const {
  const double unit = layout_.unit;
  const double from = put_text(cairo, left, baseline, label_) + 24.0 * unit;
  const double to = std::max(from + 200.0 * unit, std::min(from + 640.0 * unit, layout_.width - 60.0 * unit));
  const double top = baseline - 17.0 * unit, bottom = baseline + 5.0 * unit;
  for (std::size_t i = 0; i < bands; ++i) {
    const double x = from + (to - from) * static_cast<double>(i) / bands;
    set_color(cairo, color_at(ColorMap::sequential, static_cast<double>(i) / (bands - 1)));
    cairo_rectangle(cairo, x, top, to - x, bottom - top);
    cairo_fill(cairo);
  }
  set_color(cairo, {0.2, 0.2, 0.2});
  cairo_set_line_width(cairo, 0.8 * unit);
  cairo_rectangle(cairo, from, top, to - from, bottom - top);
  cairo_stroke(cairo);
  for (const double tick : ticks_within(low_, high_)) {
    const double x = from + (to - from) * (tick - low_) / (high_ - low_);
    set_color(cairo, {0.2, 0.2, 0.2});
    cairo_move_to(cairo, x, bottom);
    cairo_line_to(cairo, x, bottom + 5.0 * unit);
    cairo_stroke(cairo);
    const std::string text = label_of(tick);
    put_text(cairo, x - 0.5 * text_width(cairo, text), bottom + 22.0 * unit, text);
  }
}

std::string FieldPainter::iso_lines_in_words() const {
  if (iso_lines_ == 0) return "";
  return "; " + std::to_string(iso_lines_) + " lines, " + label_of((high_ - low_) / (iso_lines_ + 1)) +
         " apart";
}

}  // namespace remodel::draw_detail
