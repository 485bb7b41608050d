// Stations of walls by distances that grow from the nose and the corners.
//
// A loop is sampled densely. Each sample gets a distance: the given one at the nose and where curves join, in
// between at most as much more as the growth allows. Stations then lie so that each piece, from one of these
// places to the next, is divided into pieces of equal parts of the integral of 1 / distance.

#include <algorithm>
#include <cmath>

#include "generate/require_option.h"
#include "layer/walls.h"
#include "remodel/layers.h"

namespace remodel {

namespace {

constexpr int samples_of_curve = 4096, samples_of_piece = 8;

struct WallSample {
  std::size_t curve;
  double t;
  Point p;
  double s = 0.0;       // length from the loop's beginning
  double size = 0.0;    // the distance of stations there
  bool fixed = false;   // a station
  bool corner = false;  // with the spacing of corners
};

// Curves of a loop that follow each other, and which of them have a largest distance.
struct CurveRow {
  std::vector<const Curve*> curves;
  std::vector<bool> bounded;
  Placement placement = {};
  bool closed = true;
};

void require_spacing(const WallSpacing& spacing) {
  const auto require = [](double value, const char* option) {
    require_option(value >= 1e-6 && value <= 1e3, option, value, "1e-6 to 1000 chords");
  };
  require(spacing.leading_edge, "spacing at the leading edge");
  require(spacing.trailing_edge, "spacing at the trailing edge");
  require(spacing.most, "largest spacing");
  require_option(spacing.growth >= 0.01 && spacing.growth <= 1.0, "growth of spacings", spacing.growth,
                 "0.01 to 1");
}

std::vector<double> sampled_parameters(const Shape& shape) {
  if (const auto* polyline = std::get_if<Polyline>(&shape))
    return Parameters::uniform((polyline->points.size() - 1) * samples_of_piece);
  const auto* spline = std::get_if<Spline>(&shape);
  if (spline == nullptr) return Parameters::uniform(samples_of_curve);
  std::vector<double> t;
  const std::size_t pieces = spline->knots.size() - 1;
  const int each = std::max(samples_of_piece, samples_of_curve / static_cast<int>(pieces));
  for (std::size_t i = 0; i < pieces; ++i)
    for (int k = 0; k < each; ++k)
      t.push_back(spline->knots[i] + (spline->knots[i + 1] - spline->knots[i]) * k / each);
  return t;
}

// All samples of a row in order; of a closed one the first one again at the end.
std::vector<WallSample> sampled(const CurveRow& row) {
  std::vector<WallSample> samples;
  for (std::size_t c = 0; c < row.curves.size(); ++c) {
    const Shape& shape = row.curves[c]->shape;
    const bool joins_wall = row.bounded[c] || (c > 0 && row.bounded[c - 1]);
    const bool corners = std::holds_alternative<Polyline>(shape);
    const std::vector<double> parameters = sampled_parameters(shape);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const bool fixed = i == 0 || (corners && i % samples_of_piece == 0);
      const Point p = row.placement.chord * point_at(shape, parameters[i]);
      samples.push_back({c, parameters[i], p, 0.0, 0.0, fixed, i == 0 && joins_wall});
    }
  }
  for (std::size_t i = 1; i + 1 < samples.size(); ++i)
    if (samples[i].fixed && bends_by_30_degrees(samples[i - 1].p, samples[i].p, samples[i + 1].p))
      samples[i].corner = true;
  samples.push_back(samples.front());
  samples.back().curve = row.curves.size();
  if (!row.closed) {
    samples.back().p = row.placement.chord * point_at(row.curves.back()->shape, 1.0);
    samples.back().corner = row.bounded.back();
  }
  for (std::size_t i = 1; i < samples.size(); ++i)
    samples[i].s = samples[i - 1].s + distance(samples[i - 1].p, samples[i].p);
  return samples;
}

// The nose: of an airfoil its middle, otherwise the point farthest from the loop's beginning.
std::size_t nose_of(const CurveRow& row, const std::vector<WallSample>& samples) {
  std::size_t nose = 0;
  const bool airfoil = std::holds_alternative<CstAirfoil>(row.curves.front()->shape);
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    if (airfoil && samples[i].curve == 0 && samples[i].t == 0.5) return i;
    if (squared_distance(samples[i].p, samples[0].p) > squared_distance(samples[nose].p, samples[0].p))
      nose = i;
  }
  return nose;
}

// An eighth of the radius of the circle through a sample and those at its sides, at some distance.
void limit_by_bends(std::vector<WallSample>& samples, const WallSpacing& spacing) {
  constexpr double part = 0.12;
  const double least = 0.25 * spacing.leading_edge;
  const std::size_t n = samples.size() - 1;
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t a = i, b = i;
    while (a > 0 && samples[i].s - samples[a].s < 0.5 * least && !samples[a].fixed) --a;
    while (b < n && samples[b].s - samples[i].s < 0.5 * least && !samples[b].fixed) ++b;
    const Point u = samples[i].p - samples[a].p, v = samples[b].p - samples[i].p;
    const double twice = std::abs(cross(u, v));
    const double sides = std::sqrt(dot(u, u) * dot(v, v) * squared_distance(samples[a].p, samples[b].p));
    if (2.0 * twice * samples[i].size > part * sides)
      samples[i].size = std::max(least, part * sides / (2.0 * twice));
  }
}

void set_sizes(std::vector<WallSample>& samples, const CurveRow& row, const WallSpacing& spacing,
               bool bends) {
  const std::size_t n = samples.size() - 1;
  for (std::size_t i = 0; i <= n; ++i) {
    const std::size_t curve = i < n ? samples[i].curve : samples[n - 1].curve;
    const double most = row.bounded[curve] ? spacing.most : HUGE_VAL;
    samples[i].size = samples[i].corner ? std::min(spacing.trailing_edge, spacing.most) : most;
  }
  if (row.closed) {
    const std::size_t nose = nose_of(row, samples);
    samples[nose].size = std::min(samples[nose].size, spacing.leading_edge);
    samples[nose].fixed = true;
  }
  if (bends) limit_by_bends(samples, spacing);
  const auto limit = [&](std::size_t from, std::size_t to) {
    const double apart = std::abs(samples[to].s - samples[from].s);
    samples[to].size = std::min(samples[to].size, samples[from].size + spacing.growth * apart);
  };
  const auto close = [&] {
    if (row.closed) samples[0].size = samples[n].size = std::min(samples[0].size, samples[n].size);
  };
  for (int round = 0; round < 2; ++round) {
    for (std::size_t i = 0; i < n; ++i) limit(i, i + 1);
    close();
    for (std::size_t i = n; i > 0; --i) limit(i, i - 1);
    close();
  }
}

// Adds the stations from one fixed sample, included, to the next, not included.
void divide(const std::vector<WallSample>& samples, std::size_t from, std::size_t to,
            std::vector<double>& stations) {
  std::vector<double> sum{0.0};
  for (std::size_t i = from + 1; i <= to; ++i) {
    const double mean = 0.5 * (1.0 / samples[i - 1].size + 1.0 / samples[i].size);
    sum.push_back(sum.back() + mean * (samples[i].s - samples[i - 1].s));
  }
  stations.push_back(samples[from].t);
  const double pieces = std::max(1.0, std::floor(sum.back() + 0.5));
  std::size_t i = 0;
  for (double k = 1.0; k < pieces; k += 1.0) {
    const double wanted = sum.back() * (k / pieces);
    while (i + 2 < sum.size() && sum[i + 1] < wanted) ++i;
    const double part = (wanted - sum[i]) / (sum[i + 1] - sum[i]);
    const bool ends =
        from + i + 1 == samples.size() - 1 || samples[from + i + 1].curve != samples[from].curve;
    const double end = ends ? 1.0 : samples[from + i + 1].t;
    const double t = samples[from + i].t + part * (end - samples[from + i].t);
    if (t > stations.back() && t < 1.0) stations.push_back(t);
  }
}

// A list for each of the curves.
std::vector<Parameters> row_stations(const CurveRow& row, const WallSpacing& spacing, bool bends) {
  std::vector<WallSample> samples = sampled(row);
  set_sizes(samples, row, spacing, bends);
  std::vector<std::vector<double>> stations(row.curves.size());
  for (std::size_t from = 0; from + 1 < samples.size();) {
    std::size_t to = from + 1;
    while (to + 1 < samples.size() && !samples[to].fixed) ++to;
    divide(samples, from, to, stations[samples[from].curve]);
    from = to;
  }
  return {stations.begin(), stations.end()};
}

}  // namespace

std::vector<Parameters> wall_stations(const Loop& loop, const WallSpacing& spacing, bool bends) {
  require_spacing(spacing);
  require_option(!loop.open && !loop.curves.empty(), "loop", 0.0, "a closed loop of at least one curve");
  CurveRow row{
      .curves = {}, .bounded = std::vector<bool>(loop.curves.size(), true), .placement = loop.placement};
  for (const Curve& curve : loop.curves) row.curves.push_back(&curve);
  return row_stations(row, spacing, bends);
}

void space_walls(Domain& domain, const WallSpacing& spacing, const std::vector<std::string>& walls) {
  require_spacing(spacing);
  const std::vector<LayeredWall> layered = layered_walls(domain, {.walls = walls});
  for (const LayeredWall& wall : layered) {
    Loop& loop = domain.loops[wall.loop];
    CurveRow row{.curves = {}, .bounded = {}, .placement = loop.placement, .closed = wall.closed};
    for (std::size_t k = 0; k < wall.curves; ++k) {
      const std::size_t curve = (wall.first + k) % loop.curves.size();
      row.curves.push_back(&loop.curves[curve]);
      row.bounded.push_back(is_wall(domain, wall.loop, curve, walls));
    }
    const std::vector<Parameters> stations = row_stations(row, spacing, !wall.closed || layered.size() > 1);
    for (std::size_t k = 0; k < wall.curves; ++k)
      loop.curves[(wall.first + k) % loop.curves.size()].parameters = stations[k];
  }
}

}  // namespace remodel
