#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "generate/require_option.h"
#include "layer/walls.h"
#include "remodel/error.h"
#include "remodel/layers.h"

namespace remodel {

namespace {

// A ball between the wall and the line has half their distance as its radius, and a column takes half of
// that.
constexpr double thicknesses_to_the_wake = 4.2;
constexpr double most_spacings = 1e6;  // the line has no more stations

void require_wake(const WakeLine& wake) {
  require_option(wake.first > 0.0 && std::isfinite(wake.first), "first spacing of the wake", wake.first,
                 "more than 0");
  require_option(wake.length > 0.0 && wake.length <= most_spacings * wake.first, "wake", wake.length,
                 "more than 0 and at most a million times its first spacing");
  require_option(wake.most >= wake.first && std::isfinite(wake.most), "largest spacing of the wake",
                 wake.most, "at least the first one");
  require_option(wake.growth >= 1.0 && wake.growth <= 2.0, "growth of the wake", wake.growth, "1 to 2");
}

Parameters stations_of_wake(const WakeLine& wake) {
  std::vector<double> at{0.0};
  for (double step = wake.first; at.back() + 1.5 * step < wake.length;
       step = std::min(wake.growth * step, wake.most))
    at.push_back(at.back() + step);
  for (double& s : at) s /= wake.length;
  return at;
}

}  // namespace

void add_wake(Domain& domain, const WakeLine& wake, const LayerOptions& layers) {
  require_wake(wake);
  const double size = std::sqrt(dot(wake.direction, wake.direction));
  require_option(size > 0.0, "direction of the wake", size, "one of a length above 0");
  const Point along = (1.0 / size) * wake.direction;
  const Walls walls(domain);
  std::optional<Point> edge;
  for (const LayeredWall& wall : layered_walls(walls, layers)) {
    if (!wall.closed) continue;
    for (const Point p : walls.points_of(wall))
      if (!edge || dot(p, along) > dot(*edge, along)) edge = p;
  }
  if (!edge)
    throw Error(ErrorCode::argument, "wake",
                "found walls that all end at openings, expected a closed one, whose trailing edge it leaves");
  const Point from = *edge + thicknesses_to_the_wake * layers.thickness * along;
  domain.loops.push_back({.role = LoopRole::internal,
                          .curves = {{.name = "wake",
                                      .shape = Line{from, from + wake.length * along},
                                      .parameters = stations_of_wake(wake)}},
                          .open = true});
}

}  // namespace remodel
