#include "remodel/airfoil_degree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "remodel/error.h"

namespace remodel {
namespace {

double farthest(const CstAirfoil& a, const CstAirfoil& b) {
  double result = 0.0;
  for (int i = 0; i <= 300; ++i) result = std::max(result, std::abs(a.at(i / 300.0).y - b.at(i / 300.0).y));
  return result;
}

TEST(WithDegree, IsTheSameSectionOfAHigherDegreeAndTheNearestOfALowerOne) {
  for (const CatalogueEntry& entry : airfoil_catalogue()) {
    const CstAirfoil own = entry.airfoil(), higher = with_degree(own, 8);
    EXPECT_EQ(higher.degree(), 8);
    EXPECT_LT(farthest(own, higher), 1e-15) << entry.name;
    EXPECT_LT(farthest(own, with_degree(higher, 5)), 1e-13) << entry.name;
    const CstAirfoil lower = with_degree(own, 4);
    EXPECT_EQ(lower.degree(), 4);
    EXPECT_LT(farthest(own, lower), 3e-3) << entry.name;
    EXPECT_EQ(with_degree(own, 5), own);
  }
}

TEST(WithDegree, KeepsExponentsAndTrailingEdges) {
  const CstAirfoil own{.upper = {0.2, 0.1, 0.3, 0.15},
                       .lower = {-0.1, 0.05, -0.04, 0.01},
                       .e1 = 0.7,
                       .e2 = 1.2,
                       .te_upper = 0.004,
                       .te_lower = -0.002};
  const CstAirfoil there_and_back = with_degree(with_degree(own, 6), 3);
  EXPECT_LT(farthest(own, there_and_back), 1e-13);
  EXPECT_EQ(there_and_back.e1, own.e1);
  EXPECT_EQ(there_and_back.te_upper, own.te_upper);
  EXPECT_EQ(with_degree(own, 1).upper.size(), 2U);
}

TEST(WithDegree, RefusesWhatIsNone) {
  for (const int degree : {0, -3, 51}) EXPECT_THROW(with_degree(CstAirfoil{}, degree), Error);
}

TEST(NamedAirfoil, HasTheDegreeThatIsAskedFor) {
  for (const char* name : {"rae2822", "naca:2412"})
    for (const int degree : {2, 5, 8, 12}) EXPECT_EQ(named_airfoil(name, degree).degree(), degree) << name;
  for (const char* name : {"rae2822", "naca:2412"}) EXPECT_THROW(named_airfoil(name, 13), Error);
}

}  // namespace
}  // namespace remodel
