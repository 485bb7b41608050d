#include <gtest/gtest.h>

#include <cmath>

#include "remodel/generate.h"

namespace remodel {
namespace {

Mesh airfoil_mesh() {
  const Domain domain = airfoil_domain(named_airfoil("rae2822", 5), {.points = 200});
  return generate(domain, {.gradation = 40.0}).mesh;
}

// That function asks for each vertex by itself, without what its neighbours say.
TEST(GradationError, IsTheMeanOfThoseOfTheTriangles) {
  const Mesh mesh = airfoil_mesh();
  const std::vector<double> each = mesh.gradation_errors(mesh.freeze());
  double mean = 0.0, square = 0.0;
  for (const double e : each) mean += e / static_cast<double>(each.size());
  for (const double e : each) square += (e - mean) * (e - mean) / static_cast<double>(each.size());
  ASSERT_GT(each.size(), 10'000U);
  EXPECT_NEAR(mesh.gradation_error().bias, mean, 1e-9);
  EXPECT_NEAR(mesh.gradation_error().deviation, std::sqrt(square), 1e-9);
}

TEST(GradationError, IsNoNumberWhereNobodyWaitsForIt) {
  struct Cancelled : StepObserver {
    bool cancelled() override { return true; }
  } observer;
  StepObserver patient;
  const Mesh mesh = airfoil_mesh();
  EXPECT_TRUE(std::isnan(mesh.gradation_error(&observer).bias));
  EXPECT_EQ(mesh.gradation_error(&patient).bias, mesh.gradation_error().bias);
}

}  // namespace
}  // namespace remodel
