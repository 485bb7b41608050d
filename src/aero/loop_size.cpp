#include "aero/loop_size.h"

#include <cmath>

#include "aero/stations_derivative.h"

namespace remodel {
namespace {

constexpr Limits any_loop_size = {0.0, 1e6};

// A value, and its derivatives by the stations of a loop.
struct OfStations {
  double value = 0.0;
  std::vector<Point> by;
};

OfStations area_of(const std::vector<Point>& points, double sign) {
  OfStations result{.by = std::vector<Point>(points.size())};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t j = i + 1 < points.size() ? i + 1 : 0;
    const Point a = points[i], b = points[j];
    result.value += 0.5 * sign * (a.x * b.y - a.y * b.x);
    result.by[i] = result.by[i] + 0.5 * sign * Point{b.y, -b.x};
    result.by[j] = result.by[j] + 0.5 * sign * Point{-a.y, a.x};
  }
  return result;
}

// Nothing where the loop does not reach to x.
OfStations thickness_of(const std::vector<Point>& points, double x) {
  struct Crossing {
    double y = 0.0;
    std::size_t a = 0, b = 0;
  };
  std::optional<Crossing> low, high;
  for (std::size_t a = 0; a < points.size(); ++a) {
    const std::size_t b = a + 1 < points.size() ? a + 1 : 0;
    if ((points[a].x <= x) == (points[b].x <= x)) continue;
    const double part = (x - points[a].x) / (points[b].x - points[a].x);
    const Crossing at = {points[a].y + part * (points[b].y - points[a].y), a, b};
    if (!low || at.y < low->y) low = at;
    if (!high || at.y > high->y) high = at;
  }
  OfStations result{.by = std::vector<Point>(points.size())};
  if (!low) return result;
  result.value = high->y - low->y;
  for (const auto& [of, sign] : {std::pair{*high, 1.0}, std::pair{*low, -1.0}}) {
    const Point a = points[of.a], d = points[of.b] - a;
    const double part = (x - a.x) / d.x, slope = d.y / d.x;
    result.by[of.a] = result.by[of.a] + (sign * (1.0 - part)) * Point{-slope, 1.0};
    result.by[of.b] = result.by[of.b] + (sign * part) * Point{-slope, 1.0};
  }
  return result;
}

// least - value is at most 0, of values of one loop.
template <class ValueOf>
class LoopLimit final : public DomainConstraint {
 public:
  LoopLimit(std::size_t loop, std::vector<ValueOf> values, std::vector<double> least)
      : loop_(loop), values_(std::move(values)), least_(std::move(least)) {}
  std::size_t count() const override { return values_.size(); }
  std::vector<DesignValue> at(const DesignView& of) const override {
    const std::vector<BoundaryStation> stations = of.domain.stations(loop_);
    const std::vector<Point> points = of.domain.points(loop_);
    std::vector<DesignValue> result;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      OfStations value = values_[i](points);
      for (Point& by : value.by) by = -1.0 * by;
      result.push_back({least_[i] - value.value,
                        of.space.gradient_of_domain(derivative_by_numbers(of.domain, stations, value.by))});
    }
    return result;
  }

 private:
  std::size_t loop_;
  std::vector<ValueOf> values_;
  std::vector<double> least_;
};

struct AreaOfPoints {
  double sign = 1.0;
  OfStations operator()(const std::vector<Point>& points) const { return area_of(points, sign); }
};
struct ThicknessOfPoints {
  double x = 0.0;
  OfStations operator()(const std::vector<Point>& points) const { return thickness_of(points, x); }
};

}  // namespace

DomainConstraintPtr area_of_loop(const DomainRequest& request) {
  const AreaOfPoints area{signed_area(request.start_domain, request.section) < 0.0 ? -1.0 : 1.0};
  const double start = area(request.start_domain.points(request.section)).value;
  return std::make_shared<LoopLimit<AreaOfPoints>>(request.section, std::vector{area},
                                                   std::vector{request.least(any_loop_size, start)});
}

DomainConstraintPtr thickness_of_loop(const DomainRequest& request) {
  const std::vector<double>& stations = station_list_of(request);
  const std::vector<Point> points = request.start_domain.points(request.section);
  std::vector<ThicknessOfPoints> values;
  std::vector<double> least;
  for (const double x : stations) {
    values.push_back({x});
    const double start = values.back()(points).value;
    if (!(start > 0.0)) request.place.fail("found " + shown(x) + " in 'x', where the loop has no thickness");
    least.push_back(request.least(any_loop_size, start));
  }
  return std::make_shared<LoopLimit<ThicknessOfPoints>>(request.section, std::move(values), std::move(least));
}

}  // namespace remodel
