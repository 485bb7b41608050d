#pragma once

// Writes SVG for charts, outlines and meshes. Lines and text without a colour inherit the colour of the
// surrounding page, so that pictures suit light and dark pages.

#include <string>
#include <string_view>
#include <vector>

#include "remodel/point.h"

namespace remodel::report {

// Escapes &, <, > and quotes; characters that XML does not allow are omitted.
std::string escaped(std::string_view text);

class Svg {
 public:
  Svg(double width, double height, std::string_view title);

  // attributes: XML text, e.g. "stroke='red' fill='none'".
  void line(Point from, Point to, std::string_view attributes);
  void polyline(const std::vector<Point>& points, std::string_view attributes);
  void circle(Point centre, double radius, std::string_view attributes);
  void rectangle(Point corner, double width, double height, std::string_view attributes);
  void text(Point at, std::string_view words, std::string_view attributes = {});
  void path(std::string_view d, std::string_view attributes);
  void raw(std::string_view xml) { text_ += xml; }
  std::string finish() const { return text_ + "</svg>\n"; }

 private:
  std::string text_;
};

// A point such as "12.3,4", for paths and lists of points.
std::string pixels(Point p, int decimals = 1);
std::string pixels(double value, int decimals = 1);

}  // namespace remodel::report
