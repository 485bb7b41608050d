#include "study/report/svg.h"

#include <cstdio>

#include "study/report/names.h"

namespace remodel::report {

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        if (static_cast<unsigned char>(c) >= 0x20) result += c;
    }
  }
  return result;
}

std::string pixels(double value, int decimals) {
  std::string digits = fixed(value, decimals);
  if (digits.find('.') != std::string::npos) {
    while (digits.back() == '0') digits.pop_back();
    if (digits.back() == '.') digits.pop_back();
  }
  return digits == "-0" ? "0" : digits;
}

std::string pixels(Point p, int decimals) {
  return pixels(p.x, decimals) + ',' + pixels(p.y, decimals);
}

Svg::Svg(double width, double height, std::string_view title) {
  const std::string size = pixels(width) + "' height='" + pixels(height);
  text_ = "<svg xmlns='http://www.w3.org/2000/svg' width='" + size + "' viewBox='0 0 " + pixels(width) + ' ' +
          pixels(height) +
          "' role='img' font-family='system-ui,sans-serif' font-size='12' fill='currentColor'>\n<title>" +
          escaped(title) + "</title>\n";
}

void Svg::line(Point from, Point to, std::string_view attributes) {
  text_ += "<line x1='" + pixels(from.x) + "' y1='" + pixels(from.y) + "' x2='" + pixels(to.x) + "' y2='" +
           pixels(to.y) + "' " + std::string(attributes) + "/>\n";
}

void Svg::polyline(const std::vector<Point>& points, std::string_view attributes) {
  text_ += "<polyline points='";
  for (const Point p : points) text_ += pixels(p, 2) + ' ';
  text_ += "' " + std::string(attributes) + "/>\n";
}

void Svg::circle(Point centre, double radius, std::string_view attributes) {
  text_ += "<circle cx='" + pixels(centre.x, 2) + "' cy='" + pixels(centre.y, 2) + "' r='" +
           pixels(radius, 2) + "' " + std::string(attributes) + "/>\n";
}

void Svg::rectangle(Point corner, double width, double height, std::string_view attributes) {
  text_ += "<rect x='" + pixels(corner.x) + "' y='" + pixels(corner.y) + "' width='" + pixels(width) +
           "' height='" + pixels(height) + "' " + std::string(attributes) + "/>\n";
}

void Svg::text(Point at, std::string_view words, std::string_view attributes) {
  text_ += "<text x='" + pixels(at.x) + "' y='" + pixels(at.y) + "' " + std::string(attributes) + ">" +
           escaped(words) + "</text>\n";
}

void Svg::path(std::string_view d, std::string_view attributes) {
  text_ += "<path d='" + std::string(d) + "' " + std::string(attributes) + "/>\n";
}

}  // namespace remodel::report
