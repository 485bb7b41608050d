#include "import/design.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace remodel {

namespace {

// Where the points of a side lie on it matters when a design moves: each goes to the same share of the new
// side.
constexpr double share_tolerance = 0.02;
constexpr std::size_t most_pieces = 64;  // of a side

double length(Point a, Point b) {
  return std::sqrt(squared_distance(a, b));
}

// A curve through points of which some are stations, the first among them; the last is its end.
class SidesOfCurve {
 public:
  SidesOfCurve(const std::vector<Point>& points, const std::vector<bool>& station) : points_(points) {
    for (std::size_t i = 0; i < station.size(); ++i)
      if (station[i]) stations_.push_back(i);
    stations_.push_back(station.size());
  }

  std::size_t sides() const { return stations_.size() - 1; }

  // The fewest pieces a side, a power of two, that have a corner near every point; none if there is no such
  // number.
  std::optional<std::size_t> pieces() const {
    for (std::size_t m = 1; m <= most_pieces; m *= 2)
      if (fits(m, m < most_pieces ? share_tolerance : 1.0)) return m;
    return std::nullopt;
  }

  // The corners with m pieces a side; t gets the parameters of all points but the last.
  std::vector<Point> corners(std::size_t m, std::vector<double>& t) const {
    std::vector<Point> result;
    for (std::size_t side = 0; side < sides(); ++side) {
      const std::vector<std::size_t> places = places_on(side, m);
      for (std::size_t k = 0; k + 1 < places.size(); ++k) {
        t.push_back(static_cast<double>(side * m + places[k]) / static_cast<double>(sides() * m));
        const Point from = points_[stations_[side] + k], to = points_[stations_[side] + k + 1];
        const std::size_t pieces = places[k + 1] - places[k];
        for (std::size_t i = 0; i < pieces; ++i)
          result.push_back(
              i == 0 ? from : from + (static_cast<double>(i) / static_cast<double>(pieces)) * (to - from));
      }
    }
    result.push_back(points_.back());
    return result;
  }

 private:
  // The corner, 0 to m, that each point of a side takes, its ends included: the nearest that leaves one for
  // each of the others. A side has at most m pieces.
  std::vector<std::size_t> places_on(std::size_t side, std::size_t m) const {
    const std::size_t begin = stations_[side], end = stations_[side + 1];
    std::vector<std::size_t> places{0};
    const std::vector<double> shares = shares_on(side);
    for (std::size_t k = 1; k < end - begin; ++k) {
      const auto nearest = static_cast<std::size_t>(std::lround(shares[k] * static_cast<double>(m)));
      places.push_back(std::clamp(nearest, places.back() + 1, m - (end - begin - k)));
    }
    places.push_back(m);
    return places;
  }

  std::vector<double> shares_on(std::size_t side) const {
    const std::size_t begin = stations_[side], end = stations_[side + 1];
    std::vector<double> shares{0.0};
    for (std::size_t i = begin; i < end; ++i)
      shares.push_back(shares.back() + length(points_[i], points_[i + 1]));
    const double whole = shares.back();
    for (double& share : shares) share /= whole;
    return shares;
  }

  bool fits(std::size_t m, double tolerance) const {
    for (std::size_t side = 0; side < sides(); ++side) {
      if (stations_[side + 1] - stations_[side] > m) return false;
      const std::vector<std::size_t> places = places_on(side, m);
      const std::vector<double> shares = shares_on(side);
      for (std::size_t k = 0; k < shares.size(); ++k)
        if (std::abs(static_cast<double>(places[k]) / static_cast<double>(m) - shares[k]) > tolerance)
          return false;
    }
    return true;
  }

  const std::vector<Point>& points_;
  std::vector<std::size_t> stations_;  // and the end
};

// One loop, whose stations are not all to stay.
void thin_out(Loop& loop, const std::vector<std::vector<bool>>& station, std::vector<double>& parameters) {
  for (std::size_t c = 0; c < loop.curves.size(); ++c) {
    Curve& curve = loop.curves[c];
    const SidesOfCurve sides(std::get<Polyline>(curve.shape).points, station[c]);
    const std::optional<std::size_t> pieces = sides.pieces();
    if (!pieces) {
      parameters.insert(parameters.end(), curve.parameters.begin(), curve.parameters.end());
      continue;
    }
    curve.shape = Polyline{sides.corners(*pieces, parameters)};
    curve.parameters = Parameters::uniform(sides.sides());
  }
}

}  // namespace

DesignOfMesh design_of(const SoundMesh& mesh, const LoopsOfMesh& loops) {
  DesignOfMesh design{.domain = loops.domain, .parameters = {}};
  for (std::size_t i = 0; i < loops.points.size(); ++i) {
    Loop& loop = design.domain.loops[i];
    std::vector<double>& parameters = design.parameters.emplace_back();
    std::vector<std::vector<bool>> station;
    std::size_t stations = 0, all = 0;
    auto point = loops.points[i].begin();
    for (const Curve& curve : loop.curves) {
      station.emplace_back();
      for (std::size_t k = 0; k < curve.parameters.size(); ++k, ++point)
        station.back().push_back(k == 0 || loops.joint[*point] || !mesh.is_steiner(*point));
      stations += static_cast<std::size_t>(std::count(station.back().begin(), station.back().end(), true));
      all += curve.parameters.size();
    }
    if (stations < all && (loop.open || stations >= 3)) {
      thin_out(loop, station, parameters);
    } else {
      for (const Curve& curve : loop.curves)
        parameters.insert(parameters.end(), curve.parameters.begin(), curve.parameters.end());
    }
    if (loop.open) parameters.push_back(1.0);
  }
  return design;
}

}  // namespace remodel
