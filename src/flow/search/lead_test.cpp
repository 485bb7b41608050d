#include "flow/search/lead.h"

#include <gtest/gtest.h>

namespace remodel::flow {
namespace {

constexpr double full_cfl = 1e6;

// Notes steps of full CFL at one residual until it says that they do not lead on; how many they were.
int steps_that_lead(Lead& lead, double residual) {
  for (int step = 1; step < 100; ++step) {
    lead.note(residual, full_cfl, 0.5);
    if (lead.falls_no_more()) return step;
  }
  return 100;
}

TEST(Lead, FallsNoMoreAfterStepsOfFullCflAlone) {
  Lead lead(1.0);
  for (int step = 0; step < 50; ++step) lead.note(1.0, FrictionPolicy::return_cfl, 0.5);
  EXPECT_FALSE(lead.falls_no_more());
  EXPECT_EQ(lead.since_least_of_all(), 50);
  EXPECT_EQ(steps_that_lead(lead, 1.0), FrictionPolicy::patience + 1);
  lead.note(0.5 * FrictionPolicy::fall, full_cfl, 0.5);
  EXPECT_FALSE(lead.falls_no_more());
  EXPECT_EQ(lead.since_least_of_all(), 0);
}

TEST(Lead, ReturnsToStepsInTimeSoOften) {
  Lead lead(1.0);
  EXPECT_EQ(lead.limited(full_cfl), full_cfl);
  for (int i = 0; i < FrictionPolicy::most_returns; ++i) {
    EXPECT_TRUE(lead.returns());
    EXPECT_FALSE(lead.falls_no_more());
    for (int step = 1; step < FrictionPolicy::steps_of_return; ++step)
      EXPECT_EQ(lead.limited(full_cfl), FrictionPolicy::return_cfl);
    EXPECT_EQ(lead.limited(full_cfl), full_cfl);
    EXPECT_LT(steps_that_lead(lead, 1.0), 100);
  }
  EXPECT_FALSE(lead.returns());
}

TEST(Lead, SaysBetweenWhichLiftsItHasBeenSinceItCycled) {
  Lead lead(1.0);
  lead.note(1.0, full_cfl, -7.0);  // before it cycled
  EXPECT_EQ(lead.reason(), "the residual falls no more");
  ASSERT_TRUE(lead.returns());
  lead.note(1.0, full_cfl, 1.25);
  lead.note(1.0, full_cfl, 1.25005);
  EXPECT_EQ(lead.reason(), "the residual falls no more");
  lead.note(1.0, full_cfl, 1.125);
  EXPECT_EQ(lead.reason(),
            "the residual falls no more, and the lift coefficient has been from 1.1250 to 1.2501");
}

}  // namespace
}  // namespace remodel::flow
