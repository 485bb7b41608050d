#include "aero/gap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "aero/kinds.h"
#include "aero/stations_derivative.h"

namespace remodel {

namespace {

// A corner of one polygon, and the place on a side of the other that is nearest to it.
struct Nearest {
  double distance = std::numeric_limits<double>::infinity();
  std::size_t corner = 0, side = 0;  // the side begins at this corner of its polygon
  double along = 0.0;                // 0 to 1
  Point apart;                       // from the place to the corner
};

Nearest nearest(const std::vector<Point>& corners, const std::vector<Point>& sides) {
  Nearest best;
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = 0; j < sides.size(); ++j) {
      const Point from = sides[j], d = sides[(j + 1) % sides.size()] - from, to = corners[i] - from;
      const double along = std::clamp(dot(to, d) / dot(d, d), 0.0, 1.0);
      const Point apart = to - along * d;
      const double distance = std::sqrt(dot(apart, apart));
      if (distance < best.distance) best = {distance, i, j, along, apart};
    }
  return best;
}

class GapConstraint final : public DomainConstraint {
 public:
  GapConstraint(std::size_t loop, std::size_t other, double at_least)
      : loop_(loop), other_(other), at_least_(at_least) {}
  std::size_t count() const override { return 1; }
  std::vector<DesignValue> at(const DesignView& of) const override {
    Gap gap = gap_between(of.domain, loop_, other_);
    for (double& x : gap.by_numbers) x = -x;
    return {{at_least_ - gap.distance, of.space.gradient_of_domain(gap.by_numbers)}};
  }

 private:
  std::size_t loop_, other_;
  double at_least_;
};

DomainConstraintPtr gap_at_least(const DomainRequest& request) {
  if (request.problem.elements.empty()) request.place.fail("found 'gap', expected it with 'elements' alone");
  const std::vector<std::string>& names = request.place.given(request.given.between, "between");
  if (names.size() != 2 || names[0] == names[1])
    request.place.fail("found " + shown(names) + " as 'between', expected the names of two elements");
  return std::make_shared<GapConstraint>(request.element(names[0]), request.element(names[1]),
                                         request.least({1e-6, 10.0}, 0.0));
}

}  // namespace

extern constinit const DomainKind gap_kind = {
    .name = "gap", .of_section = false, .takes_start = false, .takes_between = true, .make = gap_at_least};

Gap gap_between(const Domain& domain, std::size_t loop, std::size_t other) {
  const std::vector<Point> first = domain.points(loop), second = domain.points(other);
  Nearest best = nearest(first, second);
  const Nearest reverse = nearest(second, first);
  if (reverse.distance < best.distance) {
    best = reverse;
    std::swap(loop, other);
  }
  const std::vector<BoundaryStation> at = domain.stations(loop), along = domain.stations(other);
  const BoundaryStation three[] = {at[best.corner], along[best.side], along[(best.side + 1) % along.size()]};
  const Point by_corner = (1.0 / best.distance) * best.apart;
  const Point by_points[] = {by_corner, (best.along - 1.0) * by_corner, -best.along * by_corner};
  return {best.distance, derivative_by_numbers(domain, three, by_points)};
}

}  // namespace remodel
