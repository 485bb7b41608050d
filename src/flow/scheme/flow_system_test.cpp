#include <complex>

namespace remodel::flow {
// Branches are decided by the real part.
inline double value_of(const std::complex<double>& x) {
  return x.real();
}
}  // namespace remodel::flow

#include "flow/scheme/flow_system.h"

#include <gtest/gtest.h>

#include <random>

#include "flow/search/newton_search.h"
#include "flow/test_flows.h"
#include "remodel/error.h"
#include "support.h"

namespace remodel::flow {
namespace {

using test::uniform;

// The stream with every value at random, a few percent.
State disturbed(const FlowSystem& system, std::mt19937_64& random) {
  State state = system.undisturbed();
  for (auto& q : state.q)
    for (double& value : q) value += uniform(random, -0.05, 0.05);
  state.augmented[0] = 0.4;
  return state;
}

double distance(const Vector& a, const Vector& b) {
  double sum = 0.0;
  for (std::size_t v = 0; v < a.size(); ++v)
    for (std::size_t k = 0; k < 4; ++k) sum += (a[v][k] - b[v][k]) * (a[v][k] - b[v][k]);
  return std::sqrt(sum);
}

TEST(FlowSystem, UniformFlowHasNoResidualOnAnyMesh) {
  std::vector<FrozenMesh> meshes;
  for (const char* name : {"naca:0012", "naca:4412", "rae2822"})
    meshes.push_back(test::airfoil_mesh(name, 60).freeze());
  meshes.push_back(
      generate(
          airfoils_domain({{.name = "main", .airfoil = named_airfoil("naca:2412", 5)},
                           {.name = "flap",
                            .airfoil = named_airfoil("naca:0012", 5),
                            .placement = {.chord = 0.3, .rotation_deg = -25.0, .position = {1.05, -0.05}}}},
                          {.points = 60}))
          .mesh.freeze());
  meshes.push_back(test::ring_mesh(6));
  for (FrozenMesh& mesh : meshes) {
    for (FrozenBoundary& boundary : mesh.boundaries) boundary.name = "farfield";
    const FlowMesh dual(mesh, "farfield", "mesh");
    const FlowSystem system(dual, {.mach = 0.7, .alpha = 0.3, .vortex = false});
    Vector residual;
    system.residual(system.undisturbed(), residual);
    for (const auto& block : residual)
      for (const double value : block) EXPECT_LT(std::fabs(value), 2e-13);
  }
}

TEST(FlowSystem, DerivativesOfTheFluxAreThoseOfAComplexStep) {
  const unsigned long long seed = test::seed(5);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  constexpr double step = 1e-30;
  for (int i = 0; i < 200; ++i) {
    double value[8];
    for (std::size_t k = 0; k < 8; ++k)
      value[k] = k % 4 == 1 || k % 4 == 2 ? uniform(random, -1.5, 1.5) : uniform(random, 0.3, 2.0);
    const Point normal = {uniform(random, -1, 1), uniform(random, -1, 1)};
    Unknowns<Dual<8>> l, r;
    for (std::size_t k = 0; k < 4; ++k)
      l[k] = Dual<8>::variable(value[k], k), r[k] = Dual<8>::variable(value[k + 4], k + 4);
    const auto flux = roe_flux<Dual<8>, double>(l, r, normal);
    for (std::size_t by = 0; by < 8; ++by) {
      using Complex = std::complex<double>;
      Unknowns<Complex> cl, cr;
      for (std::size_t k = 0; k < 4; ++k) cl[k] = value[k], cr[k] = value[k + 4];
      (by < 4 ? cl[by] : cr[by - 4]) += Complex(0.0, step);
      const auto complex = roe_flux<Complex, double>(cl, cr, normal);
      for (std::size_t k = 0; k < 4; ++k)
        EXPECT_NEAR(flux[k].slope[by], complex[k].imag() / step,
                    1e-12 * (1.0 + std::fabs(flux[k].slope[by])));
    }
  }
}

// How far the Jacobian times a random step is from the difference of residuals, over its own size.
double jacobian_error(const FlowSystem& system, const State& state, std::mt19937_64& random) {
  const FlowMesh& dual = system.mesh();
  BlockRows matrix = system.pattern();
  system.jacobian(state, matrix);
  const auto columns = system.augmented_columns(state);

  Increment step;
  step.q.resize(dual.size());
  for (auto& block : step.q)
    for (double& value : block) value = uniform(random, -1, 1);
  step.augmented = {0.7, 0.3};
  Vector product(dual.size(), {0, 0, 0, 0});
  for (std::size_t r = 0; r < matrix.rows.size(); ++r) {
    for (std::uint32_t i = matrix.start[r]; i < matrix.start[r + 1]; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t k = 0; k < 4; ++k)
          product[r][j] += matrix.block[i][4 * j + k] * step.q[matrix.column[i]][k];
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t z = 0; z < 2; ++z) product[r][j] += columns[z][r][j] * step.augmented[z];
  }
  // Central differences; their error falls with the square of the length until rounding sets in.
  double least = 1e9;
  for (const double length : {1e-4, 1e-5, 1e-6}) {
    Vector plus, less, difference(dual.size());
    system.residual(moved(state, step, length), plus);
    system.residual(moved(state, step, -length), less);
    for (std::size_t v = 0; v < dual.size(); ++v)
      for (std::size_t k = 0; k < 4; ++k) difference[v][k] = (plus[v][k] - less[v][k]) / (2.0 * length);
    least =
        std::min(least, distance(difference, product) / distance(product, Vector(dual.size(), {0, 0, 0, 0})));
  }
  return least;
}

// Of states a tenth apart, at ends of all kinds, with values that the limiters leave and ones that they do
// not.
TEST(FlowSystem, TheConvectiveFluxDerivativeByHandIsTheGeneralOne) {
  const unsigned long long seed = test::seed(10);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  constexpr EdgeEnd ends[][2] = {{EdgeEnd::inner, EdgeEnd::inner},
                                 {EdgeEnd::wall, EdgeEnd::beside_wall},
                                 {EdgeEnd::beside_wall, EdgeEnd::wall}};
  for (int i = 0; i < 300; ++i) {
    const double size = i % 2 == 0 ? 0.02 : 0.5;
    FaceInputs<double, double> in = {.end = {ends[i % 3][0], ends[i % 3][1]},
                                     .q = {},
                                     .along = {},
                                     .normal = {uniform(random, -1, 1), uniform(random, -1, 1)},
                                     .edge = {uniform(random, -0.1, 0.1), uniform(random, -0.1, 0.1)},
                                     .length = 1.0};
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t k = 0; k < unknown_count; ++k) {
        in.q[side][k] = (k == 0 || k == 3 ? 1.0 : 0.4) + uniform(random, -size, size);
        in.along[side][k] = uniform(random, -size, size);
      }
    const ConvectiveFlux term = {.limiter = 30.0, .slopes = i % 5 == 0 ? 0.5 : 1.0};
    const FaceDerivative by_hand = term.derivative(in), general = general_derivative(term, in);
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t z = 0; z < by_hand.by_state[side].size(); ++z) {
        EXPECT_NEAR(by_hand.by_state[side][z], general.by_state[side][z], 1e-12);
        EXPECT_NEAR(by_hand.by_along[side][z], general.by_along[side][z], 1e-12);
      }
  }
}

TEST(FlowSystem, TheJacobianTimesAStepIsTheDifferenceOfResiduals) {
  const unsigned long long seed = test::seed(6);
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const FrozenMesh mesh = test::airfoil_mesh("naca:2412", 40).freeze();
  const FlowMesh dual(mesh, "farfield", "mesh");
  const FlowSystem system(dual, {.mach = 0.6, .alpha = 0.02});
  State state = disturbed(system, random);
  EXPECT_LT(jacobian_error(system, state, random), 1e-7);
  // Nearly a vacuum here and there, so that what is reconstructed is bent.
  for (std::size_t v = 0; v < state.q.size(); v += 7) state.q[v][v % 2 == 0 ? 0 : 3] *= 0.1;
  EXPECT_LT(jacobian_error(system, state, random), 1e-7);
}

TEST(FlowSystem, TheAugmentedRowsAreTheDerivativesOfItsEquations) {
  std::mt19937_64 random(7);
  const FrozenMesh mesh = test::airfoil_mesh("naca:2412", 40).freeze();
  const FlowMesh dual(mesh, "farfield", "mesh");
  for (const std::optional<double> lift : {std::optional<double>(), std::optional<double>(0.5)}) {
    const FlowSystem system(dual, {.mach = 0.6, .alpha = 0.02, .lift = lift});
    const State state = disturbed(system, random);
    Increment step;
    step.q.resize(dual.size());
    for (auto& block : step.q)
      for (double& value : block) value = uniform(random, -1, 1);
    step.augmented = {0.7, 0.3};
    const AugmentedRows rows = system.augmented_rows(state);
    Augmented product = {};
    product[0] = rows.times(step.q);
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t z = 0; z < 2; ++z) product[i] += rows.corner[i][z] * step.augmented[z];
    const Augmented plus = system.augmented_residual(moved(state, step, 1e-5));
    const Augmented less = system.augmented_residual(moved(state, step, -1e-5));
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(product[i], (plus[i] - less[i]) / 2e-5, 1e-7);
  }
}

TEST(FlowSystem, SomeRowsOfTheJacobianAreThoseOfAll) {
  std::mt19937_64 random(8);
  const FrozenMesh mesh = test::airfoil_mesh("naca:0012", 40).freeze();
  const FlowMesh dual(mesh, "farfield", "mesh");
  const FlowSystem system(dual, {.mach = 0.6, .alpha = 0.02});
  const State state = disturbed(system, random);
  BlockRows all = system.pattern(), some = system.pattern({0, 3, 17, 40, 90});
  system.jacobian(state, all);
  system.jacobian(state, some);
  for (std::size_t r = 0; r < some.rows.size(); ++r) {
    const std::uint32_t first = all.start[some.rows[r]];
    ASSERT_EQ(some.start[r + 1] - some.start[r], all.start[some.rows[r] + 1] - first);
    for (std::uint32_t i = some.start[r]; i < some.start[r + 1]; ++i) {
      EXPECT_EQ(some.column[i], all.column[first + i - some.start[r]]);
      EXPECT_EQ(some.block[i], all.block[first + i - some.start[r]]);
    }
  }
}

std::array<double, 2> errors_of_vortex(std::uint32_t cells) {
  const FrozenMesh mesh = test::ring_mesh(cells);
  const FlowMesh dual(mesh, "farfield", "ring");
  return test::errors_of(
      FlowSystem(dual, {.mach = test::inner_mach, .vortex = false, .prescribed = test::supersonic_vortex}),
      test::supersonic_vortex);
}

TEST(FlowSystem, TheErrorOfTheSupersonicVortexFallsFasterThanTheSquare) {
  const std::array<double, 2> coarse = errors_of_vortex(8), fine = errors_of_vortex(16),
                              finest = errors_of_vortex(32);
  for (std::size_t i = 0; i < 2; ++i) {
    RecordProperty(i == 0 ? "density" : "entropy", std::to_string(finest[i]));
    EXPECT_GT(std::log2(coarse[i] / fine[i]), 2.2) << coarse[i] << " " << fine[i];
    EXPECT_GT(std::log2(fine[i] / finest[i]), 2.2) << fine[i] << " " << finest[i];
  }
}

}  // namespace
}  // namespace remodel::flow
