// The driver that differentiates all terms by the places of vertices: reverse by hand across sums, forward
// dual numbers within one term.

#include "flow/scheme/flow_system.h"

namespace remodel::flow {

namespace {

// Its variables are the normal of the face, the edge and the limiter's length.
using OfFace = Dual<5>;

Fluxes<OfFace> face_flux(const FaceTerms& terms, const FaceInputs<double, double>& face) {
  FaceInputs<double, OfFace> in = {
      .end = {face.end[0], face.end[1]},
      .q = {face.q[0], face.q[1]},
      .along = {face.along[0], face.along[1]},
      .normal = {OfFace::variable(face.normal.x, 0), OfFace::variable(face.normal.y, 1)},
      .edge = {OfFace::variable(face.edge.x, 2), OfFace::variable(face.edge.y, 3)},
      .length = OfFace::variable(face.length, 4)};
  return flux_of(terms, in);
}

// The weighted sum of fluxes' derivatives by all variables.
template <std::size_t V>
std::array<double, V> weighted(const Fluxes<double>& weight, const Fluxes<Dual<V>>& flux) {
  std::array<double, V> by = {};
  for (std::size_t i = 0; i < unknown_count; ++i)
    for (std::size_t z = 0; z < V; ++z) by[z] += weight[i] * flux[i].slope[z];
  return by;
}

}  // namespace

std::vector<ShapeSlope> FlowSystem::residual_slopes(const State& state, std::span<const Vector> weights,
                                                    std::span<const FaceDerivative> faces) const {
  const std::vector<Unknowns<Point>> gradient = gradients(state);
  const std::size_t size = mesh_.size(), edges = mesh_.edges().size();
  std::vector<ShapeSlope> results(weights.size(), {.points = std::vector<Point>(size)});
  std::vector<FlowMesh::Slopes> slopes(
      weights.size(), {.normal = std::vector<Point>(edges),
                       .weight = std::vector<Point>(2 * edges),
                       .boundary = std::vector<FlowMesh::Slopes::OfBoundary>(mesh_.boundary().size())});
  std::vector<std::vector<Unknowns<Point>>> by_gradient(weights.size(), std::vector<Unknowns<Point>>(size));
  for (std::size_t e = 0; e < edges; ++e) {
    const DualEdge& edge = mesh_.edges()[e];
    const FaceInputs<double, double> in = face_inputs(state, edge, gradient);
    const Point d = {in.edge.x, in.edge.y};
    const Fluxes<OfFace> flux = face_flux(terms_, in);
    // Products with gradients are among the unknowns.
    const FaceDerivative by_unknowns = faces.empty() ? derivative_of(terms_, in) : faces[e];
    const std::array<std::uint32_t, 2> source = gradient_sources(mesh_, edge);
    for (std::size_t j = 0; j < weights.size(); ++j) {
      Fluxes<double> w;
      for (std::size_t k = 0; k < unknown_count; ++k) w[k] = weights[j][edge.a][k] - weights[j][edge.b][k];
      const auto by = weighted(w, flux);
      slopes[j].normal[e] = {by[0], by[1]};
      Point by_d = {by[2], by[3]};
      results[j].length += by[4];
      for (std::size_t side = 0; side < 2; ++side)
        for (std::size_t k = 0; k < unknown_count; ++k) {
          double by_along = 0.0;
          for (std::size_t i = 0; i < unknown_count; ++i)
            by_along += w[i] * by_unknowns.by_along[side][unknown_count * i + k];
          Point& sum = by_gradient[j][source[side]][k];
          sum = sum + by_along * d;
          by_d = by_d + by_along * gradient[source[side]][k];
        }
      std::vector<Point>& points = results[j].points;
      Point &from = points[edge.place[0]], &to = points[edge.place[1]];
      from = from - by_d, to = to + by_d;
    }
  }
  for (std::size_t j = 0; j < weights.size(); ++j) {
    for (std::size_t v = 0; v < size; ++v) {
      std::size_t i = mesh_.ring_begin(v);
      for (const RingEntry& entry : mesh_.ring(v)) {
        Point& by_weight = slopes[j].weight[i++];
        for (std::size_t k = 0; k < unknown_count; ++k)
          by_weight = by_weight + (state.q[entry.vertex][k] - state.q[v][k]) * by_gradient[j][v][k];
      }
    }
    add_boundary_slopes(state, weights[j], slopes[j], results[j]);
    mesh_.add_slopes(slopes[j], results[j].points);
  }
  return results;
}

// Adds the derivatives of fluxes through the boundary.
void FlowSystem::add_boundary_slopes(const State& state, const Vector& weight, FlowMesh::Slopes& slopes,
                                     ShapeSlope& result) const {
  using Nine = Dual<9>;
  for (std::size_t e = 0; e < mesh_.boundary().size(); ++e) {
    const BoundaryEdge& edge = mesh_.boundary()[e];
    const std::uint32_t end[2] = {edge.a, edge.b};
    for (std::size_t i = 0; i < 2; ++i) {
      BoundaryInputs<Nine> in = boundary_inputs<Nine>(state, edge, i);
      std::size_t variable = 0;
      for (PlaneVector<Nine>* of : {&in.half, &in.normal, &in.place_here, &in.place_there})
        of->x.slope[variable++] = 1.0, of->y.slope[variable++] = 1.0;
      in.mach.slope[variable] = 1.0;
      const auto by = weighted(weight[end[i]], mesh_.patch(edge).flux(in, stream_));
      FlowMesh::Slopes::OfBoundary& of_edge = slopes.boundary[e];
      of_edge.half[i] = {by[0], by[1]};
      of_edge.normal = of_edge.normal + Point{by[2], by[3]};
      for (std::size_t k = 0; k < 2; ++k) {
        Point& place = result.points[edge.place[k == 0 ? i : 1 - i]];
        place = place + Point{by[4 + 2 * k], by[5 + 2 * k]};
      }
      result.mach += by[8];
    }
  }
}

}  // namespace remodel::flow
