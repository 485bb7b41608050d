#include "remodel/mesh_derivative.h"

#include <cmath>

#include "remodel/remodel.h"
#include "shape/shape_derivative.h"
#include "shape/turn.h"

namespace remodel {

namespace {

constexpr std::size_t placement_numbers = 4;

void require_count(std::size_t found, std::size_t expected, const char* what) {
  if (found == expected) return;
  throw Error(ErrorCode::argument, what,
              "found " + std::to_string(found) + ", expected " + std::to_string(expected));
}

// The chord's vector on the turned x axis, for a chord of 1.
Point turned_axis(const Placement& placement) {
  return direction(placement.rotation_deg / 360.0);
}

Point turned(Point axis, Point p) {
  return {axis.x * p.x - axis.y * p.y, axis.y * p.x + axis.x * p.y};
}

constexpr double degree = M_PI / 180.0;

}  // namespace

std::vector<double> coefficients_of(const Domain& domain) {
  std::vector<double> all;
  for (const Loop& loop : domain.loops) {
    for (const Curve& curve : loop.curves) {
      const std::vector<double> numbers = numbers_of(curve.shape);
      all.insert(all.end(), numbers.begin(), numbers.end());
    }
    const Placement& at = loop.placement;
    all.insert(all.end(), {at.chord, at.rotation_deg, at.position.x, at.position.y});
  }
  return all;
}

Domain with_coefficients(const Domain& domain, std::span<const double> coefficients) {
  require_count(coefficients.size(), coefficients_of(domain).size(), "coefficients of a domain");
  Domain result = domain;
  std::size_t i = 0;
  for (Loop& loop : result.loops) {
    for (Curve& curve : loop.curves) {
      const std::size_t count = numbers_of(curve.shape).size();
      curve.shape = with_numbers(curve.shape, coefficients.subspan(i, count));
      i += count;
    }
    loop.placement = {coefficients[i], coefficients[i + 1], {coefficients[i + 2], coefficients[i + 3]}};
    i += placement_numbers;
  }
  return result;
}

MeshDerivative::MeshDerivative(const Mesh& mesh) : MeshDerivative(mesh.freeze(), mesh.domain()) {}

MeshDerivative::MeshDerivative(const Mesh& mesh, std::span<const std::size_t> moving) : MeshDerivative(mesh) {
  interior_.emplace(mesh, moving);
}

MeshDerivative::MeshDerivative(const FrozenMesh& frozen, const Domain& domain)
    : domain_(domain), points_(frozen.points.size()) {
  for (std::size_t l = 0; l < domain.loops.size(); ++l) {
    const std::size_t first_piece = pieces_.size();
    for (const Curve& curve : domain.loops[l].curves) {
      pieces_.emplace_back();
      pieces_.back().loop = l;
      pieces_.back().first = count_;
      count_ += numbers_of(curve.shape).size();
    }
    for (std::size_t i = first_piece; i < pieces_.size(); ++i) pieces_[i].placement = count_;
    count_ += placement_numbers;
  }
  for (std::uint32_t p = 0; p < points_; ++p) {
    if (frozen.curve[p] < 0) continue;
    Piece& piece = pieces_[static_cast<std::size_t>(frozen.curve[p])];
    piece.t.push_back(frozen.parameter[p]);
    piece.point.push_back(p);
  }
}

std::vector<Point> MeshDerivative::jvp(std::span<const double> direction) const {
  require_count(direction.size(), count_, "direction");
  const std::vector<Point> walls = walls_jvp(direction);
  return interior_ ? interior_->jvp(walls) : walls;
}

std::vector<Point> MeshDerivative::walls_jvp(std::span<const double> direction) const {
  std::vector<Point> result(points_);
  for (std::size_t c = 0; c < pieces_.size(); ++c) {
    const Piece& piece = pieces_[c];
    const Shape& shape = domain_.curve(c).shape;
    const Placement& at = domain_.loops[piece.loop].placement;
    const Point axis = turned_axis(at);
    const auto by = direction.subspan(piece.placement, placement_numbers);
    const std::vector<Point> moved =
        shape_jvp(shape, piece.t, direction.subspan(piece.first, numbers_of(shape).size()));
    for (std::size_t k = 0; k < moved.size(); ++k) {
      const Point p = turned(axis, point_at(shape, piece.t[k]));
      result[piece.point[k]] = at.chord * turned(axis, moved[k]) + by[0] * p +
                               (by[1] * degree * at.chord) * Point{-p.y, p.x} + Point{by[2], by[3]};
    }
  }
  return result;
}

std::vector<double> MeshDerivative::vjp(std::span<const Point> by_points) const {
  require_count(by_points.size(), points_, "derivatives by points");
  std::vector<Point> along;
  if (interior_) {
    along = interior_->vjp(by_points);
    by_points = along;
  }
  std::vector<double> result(count_, 0.0);
  for (std::size_t c = 0; c < pieces_.size(); ++c) {
    const Piece& piece = pieces_[c];
    const Shape& shape = domain_.curve(c).shape;
    const Placement& at = domain_.loops[piece.loop].placement;
    const Point axis = turned_axis(at), back = {axis.x, -axis.y};
    std::vector<Point> by_moved;
    double* by = result.data() + piece.placement;
    for (std::size_t k = 0; k < piece.t.size(); ++k) {
      const Point bar = by_points[piece.point[k]];
      const Point p = turned(axis, point_at(shape, piece.t[k]));
      by_moved.push_back(at.chord * turned(back, bar));
      by[0] += dot(bar, p);
      by[1] += degree * at.chord * dot(bar, Point{-p.y, p.x});
      by[2] += bar.x, by[3] += bar.y;
    }
    shape_vjp(shape, piece.t, by_moved, {result.data() + piece.first, numbers_of(shape).size()});
  }
  return result;
}

Mesh mesh_at(const Mesh& mesh, const Domain& design, Strategy strategy) {
  Mesh result = mesh;
  const bool along = strategy == Strategy::reference;
  RemodelOptions options{.method = Method::specialised,
                         .strategy = along ? Strategy::reference : Strategy::chain,
                         .regenerate = !along};
  if (mesh.held()) options.delaunay_slack_deg = mesh.delaunay_slack_deg();
  const auto follows = [&] {
    const RemodelResult step = remodel(result, design, options);
    return along ? step.held : step.full_adjustment;
  };
  if (!one_to_one(mesh.domain(), design) || !follows())
    throw TopologyChanged(
        ErrorCode::geometry, "design",
        "the mesh cannot follow with the connectivity that it has, expected a design nearer "
        "to the mesh's own");
  return result;
}

Mesh mesh_at(const Mesh& mesh, const Domain& design) {
  return mesh_at(mesh, design, mesh.held() ? Strategy::reference : Strategy::chain);
}

}  // namespace remodel
