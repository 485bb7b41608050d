#pragma once

#include <cmath>

namespace remodel {

// A point of the plane. Airfoil coordinates are in chords: the chord has length 1.
struct Point {
  double x = 0.0;
  double y = 0.0;

  friend bool operator==(const Point&, const Point&) = default;
};

inline Point operator+(Point a, Point b) {
  return {a.x + b.x, a.y + b.y};
}
inline Point operator-(Point a, Point b) {
  return {a.x - b.x, a.y - b.y};
}
inline Point operator*(double s, Point a) {
  return {s * a.x, s * a.y};
}
inline double dot(Point a, Point b) {
  return a.x * b.x + a.y * b.y;
}
inline double cross(Point a, Point b) {
  return a.x * b.y - a.y * b.x;
}
inline double squared_distance(Point a, Point b) {
  return dot(b - a, b - a);
}
inline double distance(Point a, Point b) {
  return std::sqrt(squared_distance(a, b));
}

}  // namespace remodel
