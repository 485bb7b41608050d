// Values on triangles, as means. On each old triangle a slope from those around it, limited after Barth and
// Jespersen at its corners by the values of all triangles that share one; the new mean is that of this
// function over the intersections.

#include <algorithm>
#include <cmath>

#include "transfer/remap.h"
#include "transfer/slopes.h"

namespace remodel {

namespace {

class TriangleRemap {
 public:
  TriangleRemap(const RemapInput& input, std::size_t width, const std::vector<double>& values)
      : input_(input), before_(input.patches.before), after_(input.patches.after), width_(width) {
    for (const PatchSide::Triangle& t : before_.triangles)
      for (std::size_t k = 0; k < width; ++k) old_.push_back(values[t.number * width + k]);
  }

  Balance run() {
    make_slopes();
    balance_.before.assign(width_, 0.0);
    for (std::size_t t = 0; t < input_.patches.changed; ++t) {
      const double area = area_of(before_.corners(t));
      balance_.area_lost += area;
      for (std::size_t k = 0; k < width_; ++k) balance_.before[k] += area * old_[t * width_ + k];
    }
    balance_.lost = balance_.before;
    balance_.after.assign(width_, 0.0), balance_.gained = balance_.after;
    made_.resize(after_.triangles.size() * width_);
    for (std::uint32_t t = 0; t < after_.triangles.size(); ++t) average(t);
    return std::move(balance_);
  }
  template <class Visit>
  void for_each_value(Visit visit) const {
    for (std::size_t t = 0; t < after_.triangles.size(); ++t)
      visit(after_.triangles[t].number, &made_[t * width_]);
  }

 private:
  void make_slopes() {
    const Neighbours neighbours(before_);
    slopes_.resize(input_.patches.changed * width_);
    for (std::uint32_t t = 0; t < input_.patches.changed; ++t) {
      const std::vector<std::uint32_t>& around = neighbours.around(t);
      const std::vector<Point> weights = slope_weights(before_, t, around);
      bool limited = false;
      for (std::size_t k = 0; k < width_; ++k) {
        Point slope;
        const double here = old_[t * width_ + k];
        double low = here, high = here;
        for (std::size_t i = 0; i < around.size(); ++i) {
          const double there = old_[around[i] * width_ + k];
          slope = slope + (there - here) * weights[i];
          low = std::min(low, there), high = std::max(high, there);
        }
        const double factor = input_.options.limited ? factor_within(t, slope, low - here, high - here) : 1.0;
        limited = limited || factor < 1.0;
        slopes_[t * width_ + k] = factor * slope;
      }
      if (input_.options.limited && input_.options.conserved) limited = keep_positive(t) || limited;
      if (limited) ++balance_.limited;
    }
  }

  // The part of a slope that leaves differences from the mean at all corners between these two.
  double factor_within(std::uint32_t t, Point slope, double low, double high) const {
    const Corners corners = before_.corners(t);
    const Point centre = centroid_of(corners);
    double factor = 1.0;
    for (const Point corner : corners) {
      const double difference = dot(slope, corner - centre);
      if (difference > high) factor = std::min(factor, high / difference);
      if (difference < low) factor = std::min(factor, low / difference);
    }
    return factor;
  }

  // States with positive density and pressure are a convex set: with those of the corners, all of the
  // triangle's are positive. Whether slopes had to be reduced.
  bool keep_positive(std::uint32_t t) {
    constexpr int halvings = 40;
    const auto& conserved = *input_.options.conserved;
    if (!positive(&old_[t * width_], conserved)) return false;
    for (int i = 0; i <= halvings; ++i) {
      if (corners_positive(t)) return i > 0;
      for (const int component : conserved) {
        Point& slope = slopes_[t * width_ + static_cast<std::size_t>(component)];
        slope = (i < halvings ? 0.5 : 0.0) * slope;
      }
    }
    return true;
  }

  bool corners_positive(std::uint32_t t) const {
    const Corners corners = before_.corners(t);
    std::vector<double> state(width_);
    return std::all_of(corners.begin(), corners.end(), [&](Point corner) {
      for (std::size_t k = 0; k < width_; ++k) state[k] = at(t, corner, k);
      return positive(state.data(), *input_.options.conserved);
    });
  }

  double at(std::uint32_t t, Point p, std::size_t k) const {
    return old_[t * width_ + k] + dot(slopes_[t * width_ + k], p - centroid_of(before_.corners(t)));
  }

  // Where the old domain does not reach, a new triangle has the mean of where it does, or the nearest value.
  void average(std::uint32_t t) {
    const Corners here = after_.corners(t);
    const double area = area_of(here);
    double covered = 0.0;
    double* made = &made_[t * width_];
    std::fill_n(made, width_, 0.0);
    input_.locator.find(here, candidates_);
    for (const std::uint32_t other : candidates_) {
      const Intersection piece = intersect(here, before_.corners(other));
      if (piece.area == 0.0) continue;
      covered += piece.area;
      for (std::size_t k = 0; k < width_; ++k) {
        const double integral = piece.area * at(other, piece.centroid, k);
        made[k] += integral;
        balance_.lost[k] -= integral;
      }
    }
    balance_.area_gained += area - covered, balance_.area_lost -= covered;
    if (covered > 0.0) {
      for (std::size_t k = 0; k < width_; ++k) made[k] /= covered;
    } else {
      const Place place = input_.locator.locate(centroid_of(here), input_.outside);
      std::copy_n(&old_[place.triangle * width_], width_, made);
    }
    for (std::size_t k = 0; k < width_; ++k) {
      balance_.gained[k] += (area - covered) * made[k];
      balance_.after[k] += area * made[k];
    }
  }

  const RemapInput& input_;
  const PatchSide &before_, &after_;
  const std::size_t width_;
  std::vector<double> old_;    // by old triangle of the patch
  std::vector<Point> slopes_;  // of those that have changed
  std::vector<double> made_;   // by new triangle
  std::vector<std::uint32_t> candidates_;
  Balance balance_;
};

}  // namespace

Balance remap_triangles(const RemapInput& input, const ValueMap& map, int components,
                        std::vector<double>& values) {
  const std::size_t width = require_values(values, map.size_before, components);
  return remap_by(TriangleRemap(input, width, values), map, components, values);
}

}  // namespace remodel
