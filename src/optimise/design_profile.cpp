#include "optimise/design_profile.h"

#include <algorithm>
#include <utility>

namespace remodel {

DesignProfile::DesignProfile(std::vector<Point> outline) : points(std::move(outline)) {
  const std::size_t n = points.size();
  squared_scales.resize(n);
  for (std::size_t i = 0; i < n; ++i)
    squared_scales[i] = std::min(squared_distance(points[i], points[(i + 1) % n]),
                                 squared_distance(points[i], points[(i + n - 1) % n]));
}

double squared_displacement(const DesignProfile& from, const DesignProfile& to) {
  double largest = 0.0;
  for (std::size_t i = 0; i < from.points.size(); ++i)
    largest = std::max(largest, squared_distance(from.points[i], to.points[i]) / from.squared_scales[i]);
  return largest;
}

ProfileMaker::ProfileMaker(const std::vector<double>& parameters, const CstAirfoil& like) {
  for (const double t : parameters) stations_.emplace_back(t, like);
}

DesignProfile ProfileMaker::operator()(const CstAirfoil& design) const {
  std::vector<Point> outline;
  outline.reserve(stations_.size());
  for (const CachedStation& station : stations_) outline.push_back({station.x(), station.height(design)});
  return DesignProfile(std::move(outline));
}

}  // namespace remodel
