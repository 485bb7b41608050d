// Values at vertices, as a function that is linear on triangles.
//
// The integral of such a function is the sum of C_v u_v, C_v a third of the area around vertex v. Steps:
//  Step 1: the old function at the new vertices, w. It is exact for linear functions, and conserves nothing.
//  Step 2: its defect on each new triangle T, r_T: the integral of (old function - w) over T, from the
//          intersections of T with old triangles. A third of it goes to each corner: u_v = w_v + sum r_T / (3
//          C_v). That conserves, and is of second order, as r_T is an interpolation error.
//  Step 3: the limiter. The low-order values l_v = sum over T of (|T| / 3 C_v) (mean of the old function on
//  T)
//          conserve as well and are means of old values, so that they keep every bound that old values keep.
//          The difference u - l is a sum over triangles whose three shares add up to 0: each triangle's is
//          taken by a factor, smaller where a vertex breaks a bound, until none does. Each component has
//          factors of its own, but for those that RemapOptions::conserved couples.

#include <algorithm>
#include <cmath>

#include "transfer/remap.h"

namespace remodel {

bool positive(const double* state, const std::array<int, 4>& conserved) {
  const double density = state[conserved[0]], x = state[conserved[1]], y = state[conserved[2]];
  return density > 0.0 && state[conserved[3]] * density > 0.5 * (x * x + y * y);
}

namespace {

class VertexRemap {
 public:
  VertexRemap(const RemapInput& input, std::size_t width, const std::vector<double>& values)
      : input_(input), before_(input.patches.before), after_(input.patches.after), width_(width) {
    for (const std::uint32_t number : before_.numbers)
      for (std::size_t k = 0; k < width; ++k) old_.push_back(values[number * width + k]);
  }

  Balance run() {
    interpolate();
    intersect_all();
    made_.resize(interpolated_.size());
    limited_.assign(after_.triangles.size(), false);
    for (const std::vector<std::size_t>& group : groups()) {
      factors_.assign(after_.triangles.size(), 1.0);
      combine(group);
      if (input_.options.limited) limit(group);
    }
    balance_.limited = static_cast<std::size_t>(std::count(limited_.begin(), limited_.end(), true));
    finish_balance();
    return std::move(balance_);
  }
  // Of those vertices that have changed.
  template <class Visit>
  void for_each_value(Visit visit) const {
    for (std::size_t v = 0; v < after_.points.size(); ++v)
      if (cell_[v] > input_.patches.area_at_rest[v]) visit(after_.numbers[v], &made_[v * width_]);
  }

 private:
  // Step 1.
  void interpolate() {
    const Patches& patches = input_.patches;
    interpolated_.resize(after_.points.size() * width_);
    for (std::size_t v = 0; v < after_.points.size(); ++v) {
      double* to = &interpolated_[v * width_];
      if (patches.at_rest[v]) {
        std::copy_n(&old_[patches.same_vertex[v] * width_], width_, to);
        continue;
      }
      const Place place = input_.locator.locate(after_.points[v], input_.outside);
      const auto& corners = before_.triangles[place.triangle].corners;
      for (std::size_t k = 0; k < width_; ++k) to[k] = at(old_, corners, place.weights, k);
    }
  }

  double at(const std::vector<double>& values, const std::array<std::uint32_t, 3>& corners,
            const std::array<double, 3>& weights, std::size_t k) const {
    return weights[0] * values[corners[0] * width_ + k] + weights[1] * values[corners[1] * width_ + k] +
           weights[2] * values[corners[2] * width_ + k];
  }

  // Step 2.
  void intersect_all() {
    const std::size_t triangles = after_.triangles.size();
    defects_.assign(triangles * width_, 0.0), means_ = defects_;
    balance_.before.assign(width_, 0.0), balance_.gained = balance_.before, balance_.lost = balance_.before;
    cell_ = input_.patches.area_at_rest;
    low_ = interpolated_, high_ = interpolated_;  // bounds
    for (std::size_t t = 0; t < input_.patches.changed; ++t) {
      const double area = area_of(before_.corners(t));
      balance_.area_lost += area;
      for (std::size_t k = 0; k < width_; ++k) {
        const double integral = area * at(old_, before_.triangles[t].corners, thirds, k);
        balance_.before[k] += integral, balance_.lost[k] += integral;
      }
    }
    for (std::uint32_t t = 0; t < triangles; ++t) intersect_one(t);
  }

  void intersect_one(std::uint32_t t) {
    const Corners here = after_.corners(t);
    const auto& corners = after_.triangles[t].corners;
    const double area = area_of(here);
    double covered = 0.0;
    std::vector<double> of_new(width_, 0.0);  // integrals of w where the old domain is
    input_.locator.find(here, candidates_);
    for (const std::uint32_t other : candidates_) {
      const Corners there = before_.corners(other);
      const Intersection piece = intersect(here, there);
      if (piece.area == 0.0) continue;
      covered += piece.area;
      const auto new_weights = weights_at(here, piece.centroid),
                 old_weights = weights_at(there, piece.centroid);
      const auto& old_corners = before_.triangles[other].corners;
      for (std::size_t k = 0; k < width_; ++k) {
        const double now = piece.area * at(interpolated_, corners, new_weights, k);
        const double then = piece.area * at(old_, old_corners, old_weights, k);
        of_new[k] += now;
        defects_[t * width_ + k] += then - now;
        balance_.lost[k] -= then;
      }
      widen(corners, old_corners);
    }
    balance_.area_gained += area - covered, balance_.area_lost -= covered;
    for (std::size_t k = 0; k < width_; ++k) {
      const double whole = area * at(interpolated_, corners, thirds, k);
      balance_.gained[k] += whole - of_new[k];
      means_[t * width_ + k] = (whole + defects_[t * width_ + k]) / area;
    }
    for (const std::uint32_t v : corners) cell_[v] += area / 3.0;
    widen(corners);
  }

  // The bounds of new corners take in old values.
  void widen(const std::array<std::uint32_t, 3>& corners, const std::array<std::uint32_t, 3>& old_corners) {
    for (std::size_t k = 0; k < width_; ++k) {
      const auto [low, high] =
          std::minmax({old_[old_corners[0] * width_ + k], old_[old_corners[1] * width_ + k],
                       old_[old_corners[2] * width_ + k]});
      widen(corners, k, low, high);
    }
  }
  // And what new corners have from them.
  void widen(const std::array<std::uint32_t, 3>& corners) {
    for (std::size_t k = 0; k < width_; ++k) {
      const auto [low, high] =
          std::minmax({interpolated_[corners[0] * width_ + k], interpolated_[corners[1] * width_ + k],
                       interpolated_[corners[2] * width_ + k]});
      widen(corners, k, low, high);
    }
  }
  void widen(const std::array<std::uint32_t, 3>& corners, std::size_t k, double low, double high) {
    for (const std::uint32_t v : corners) {
      low_[v * width_ + k] = std::min(low_[v * width_ + k], low);
      high_[v * width_ + k] = std::max(high_[v * width_ + k], high);
    }
  }

  // Components that share factors; those of RemapOptions::conserved come first.
  std::vector<std::vector<std::size_t>> groups() const {
    std::vector<std::vector<std::size_t>> result;
    std::vector<bool> coupled(width_, false);
    if (input_.options.conserved) {
      result.emplace_back();
      for (const int component : *input_.options.conserved) {
        const auto k = static_cast<std::size_t>(component);
        if (!coupled[k]) result.back().push_back(k);
        coupled[k] = true;
      }
    }
    for (std::size_t k = 0; k < width_; ++k)
      if (!coupled[k]) result.push_back({k});
    return result;
  }

  bool is_conserved(std::size_t k) const {
    const auto& conserved = input_.options.conserved;
    return conserved &&
           std::find(conserved->begin(), conserved->end(), static_cast<int>(k)) != conserved->end();
  }

  // The values for the present factors.
  void combine(const std::vector<std::size_t>& group) {
    for (std::size_t v = 0; v < after_.points.size(); ++v)
      for (const std::size_t k : group) made_[v * width_ + k] = interpolated_[v * width_ + k];
    for (std::size_t t = 0; t < after_.triangles.size(); ++t) {
      const double third = area_of(after_.corners(t)) / 3.0, rest = 1.0 - factors_[t];
      for (const std::size_t k : group) {
        const double share = defects_[t * width_ + k] / 3.0, mean = means_[t * width_ + k];
        for (const std::uint32_t v : after_.triangles[t].corners) {
          const double flux = third * (interpolated_[v * width_ + k] - mean) + share;
          made_[v * width_ + k] += (share - rest * flux) / cell_[v];
        }
      }
    }
  }

  bool keeps_bounds(std::size_t v, const std::vector<std::size_t>& group) const {
    for (const std::size_t k : group) {
      const std::size_t i = v * width_ + k;
      const double rounding = 1e-14 * (std::abs(low_[i]) + std::abs(high_[i]));
      if (!(made_[i] >= low_[i] - rounding && made_[i] <= high_[i] + rounding)) return false;
    }
    return !is_conserved(group.front()) || positive(&made_[v * width_], *input_.options.conserved);
  }

  // Step 3. Each round halves the factors around vertices that break a bound; the last ones take all.
  void limit(const std::vector<std::size_t>& group) {
    constexpr int halvings = 6, rounds = 40;
    for (int round = 0; round < rounds; ++round) {
      std::vector<bool> broken(after_.points.size());
      bool any = false;
      for (std::size_t v = 0; v < after_.points.size(); ++v) {
        broken[v] = !keeps_bounds(v, group);
        any = any || broken[v];
      }
      if (!any) break;
      bool changed = false;
      for (std::size_t t = 0; t < after_.triangles.size(); ++t) {
        const auto& [a, b, c] = after_.triangles[t].corners;
        if (round < rounds - 1 && !broken[a] && !broken[b] && !broken[c]) continue;
        changed = changed || factors_[t] > 0.0;
        factors_[t] = round < halvings ? 0.5 * factors_[t] : 0.0;
      }
      if (!changed) break;
      combine(group);
    }
    for (std::size_t t = 0; t < factors_.size(); ++t) limited_[t] = limited_[t] || factors_[t] < 1.0;
  }

  // Vertices at the rim of the patch have a part of their cells beyond it.
  void finish_balance() {
    balance_.after.assign(width_, 0.0);
    for (std::size_t v = 0; v < after_.points.size(); ++v) {
      const double beyond = input_.patches.area_at_rest[v];
      for (std::size_t k = 0; k < width_; ++k) {
        const std::size_t i = v * width_ + k;
        balance_.after[k] += (cell_[v] - beyond) * made_[i] + beyond * (made_[i] - interpolated_[i]);
      }
    }
  }

  static constexpr std::array<double, 3> thirds = {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};

  const RemapInput& input_;
  const PatchSide &before_, &after_;
  const std::size_t width_;
  std::vector<double> old_;                        // by old vertex of the patch
  std::vector<double> interpolated_, made_;        // by new vertex
  std::vector<double> low_, high_;                 // bounds of each
  std::vector<double> cell_;                       // C_v
  std::vector<double> defects_, means_, factors_;  // by new triangle; the factors are those of one group
  std::vector<bool> limited_;                      // by new triangle: whether any factor is below 1
  std::vector<std::uint32_t> candidates_;
  Balance balance_;
};

}  // namespace

Balance remap_vertices(const RemapInput& input, const ValueMap& map, int components,
                       std::vector<double>& values) {
  const std::size_t width = require_values(values, map.size_before, components);
  return remap_by(VertexRemap(input, width, values), map, components, values);
}

}  // namespace remodel
