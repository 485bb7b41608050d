#include "aero/flow_march.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace remodel::aero {
namespace {

// Flows exist between two values, and are found within a reach of the last one; the first one from 0.
struct Stand {
  double low = -100.0, high = 100.0, reach = 100.0;
  double last = 0.0, first = 0.0;
  bool any = false;
  std::vector<double> searches = {};
  FlowStatus beyond = FlowStatus::stalled;
  double missing = 1000.0;  // a value without a flow

  FlowResult find(double value) {
    searches.push_back(value);
    FlowResult flow;
    flow.alpha_deg = value;
    const bool exists = value >= low && value <= high && value != missing;
    flow.status = !exists                            ? beyond
                  : std::fabs(value - last) <= reach ? FlowStatus::converged
                                                     : FlowStatus::stalled;
    if (!flow.converged()) flow.reason = "nothing leads on";
    if (flow.converged()) {
      if (!any) first = value;
      any = true, last = value;
    }
    return flow;
  }
  March march(const std::vector<double>& values, std::size_t start = 0, const MarchOptions& options = {}) {
    return aero::march(
        values, start,
        {.find = [this](double value) { return find(value); }, .return_to_first = [this] { last = first; }},
        options);
  }
};

std::vector<double> found(const March& march) {
  std::vector<double> values;
  for (const MarchedFlow& flow : march.flows)
    if (flow.flow.converged()) values.push_back(flow.value);
  return values;
}

using Values = std::vector<double>;

TEST(March, FindsEachFlowFromTheLastOne) {
  Stand stand{.reach = 1.0};
  const March march = stand.march({0, 1, 2, 3});
  EXPECT_EQ(found(march), (Values{0, 1, 2, 3}));
  EXPECT_EQ(stand.searches, (Values{0, 1, 2, 3}));
  EXPECT_FALSE(march.interrupted);
}

TEST(March, GoesUpFromItsStartAndThenDownFromTheFirstFlow) {
  Stand stand{.reach = 2.0};
  EXPECT_EQ(found(stand.march({-4, -2, 0, 2, 4}, 2)), (Values{-4, -2, 0, 2, 4}));
  EXPECT_EQ(stand.searches, (Values{0, 2, 4, -2, -4}));
}

TEST(March, HalvesTheStepUntilFlowsLeadOnAndKeepsThoseInBetween) {
  Stand stand{.reach = 1.0};
  const March march = stand.march({0, 4});
  EXPECT_EQ(found(march), (Values{0, 1, 2, 3, 4}));
  EXPECT_EQ(stand.searches, (Values{0, 4, 2, 1, 2, 3, 4}));
  for (const MarchedFlow& flow : march.flows) {
    EXPECT_EQ(flow.asked, flow.value == 0 || flow.value == 4);
    EXPECT_EQ(flow.reason, "");
  }
}

TEST(March, GivesUpWhereFlowsEndAndSaysSo) {
  Stand stand{.high = 5.3};
  const March march = stand.march({0, 4, 8, 12, 16, 20});
  // The step of 4 is halved three times: 6 has no flow, 5 has one, 6 again has none, nor has 5.5.
  EXPECT_EQ(stand.searches, (Values{0, 4, 8, 6, 5, 6, 5.5, 12}));
  EXPECT_EQ(found(march), (Values{0, 4, 5}));
  ASSERT_EQ(march.flows.size(), 7U);
  const MarchedFlow &eight = march.flows[3], &twelve = march.flows[4], &sixteen = march.flows[5];
  EXPECT_EQ(eight.value, 8);
  EXPECT_TRUE(eight.asked && eight.tried);
  EXPECT_EQ(eight.reason, "nothing leads on; steps were halved back to 5");
  EXPECT_EQ(twelve.reason, "nothing leads on");
  EXPECT_FALSE(sixteen.tried);
  EXPECT_EQ(sixteen.reason, "not looked for: no flow was found at 8 and 12");
  EXPECT_EQ(march.flows[6].reason, sixteen.reason);
}

TEST(March, GivesUpAtOnceWithoutHalvings) {
  Stand stand{.high = 5.3};
  const March march = stand.march({0, 4, 8, 12}, 0, {.halvings = 0, .misses = 1});
  EXPECT_EQ(stand.searches, (Values{0, 4, 8}));
  EXPECT_EQ(march.flows[2].reason, "nothing leads on");
  EXPECT_FALSE(march.flows[3].tried);
}

TEST(March, GoesOnBeyondASingleValueWithoutAFlow) {
  Stand stand{.missing = 2.0};
  const March march = stand.march({0, 1, 2, 3, 4});
  EXPECT_EQ(found(march), (Values{0, 1, 1.5, 1.75, 1.875, 3, 4}));
  EXPECT_EQ(march.flows[5].value, 2);
  EXPECT_FALSE(march.flows[5].reason.empty());
}

TEST(March, LooksOnceMoreForValuesBeforeTheFirstFlow) {
  Stand stand{.reach = 1.0, .last = 2.0};  // from nothing 2 is in reach, and 0 is not
  const March march = stand.march({0, 1, 2}, 0);
  EXPECT_EQ(found(march), (Values{0, 1, 2}));
  EXPECT_EQ(march.flows.size(), 3U);
  EXPECT_EQ(stand.searches, (Values{0, 1, 2, 0}));
}

TEST(March, SaysThatNothingWasFound) {
  Stand stand{.low = 50.0};
  const March march = stand.march({-1, 0, 1, 2, 3}, 1);
  EXPECT_EQ(found(march), Values{});
  EXPECT_EQ(stand.searches, (Values{0, 1, -1}));
  ASSERT_EQ(march.flows.size(), 5U);
  for (const MarchedFlow& flow : march.flows) EXPECT_FALSE(flow.reason.empty());
}

TEST(March, EndsAtAnInterruptWithTheFlowsSoFar) {
  Stand stand{.high = 1.5, .beyond = FlowStatus::interrupted};
  const March march = stand.march({-1, 0, 1, 2, 3}, 1);
  EXPECT_TRUE(march.interrupted);
  EXPECT_EQ(stand.searches, (Values{0, 1, 2}));
  EXPECT_EQ(found(march), (Values{0, 1}));
  EXPECT_EQ(march.flows.size(), 2U);
}

TEST(March, EndsWhereMemoryDoesNotSuffice) {
  Stand stand{.high = 0.5, .beyond = FlowStatus::memory};
  const March march = stand.march({0, 1, 2});
  EXPECT_FALSE(march.interrupted);
  EXPECT_EQ(stand.searches, (Values{0, 1}));
  ASSERT_EQ(march.flows.size(), 3U);
  EXPECT_EQ(march.flows[1].reason, "nothing leads on");
  EXPECT_EQ(march.flows[2].reason, "not looked for: the search had ended before");
}

}  // namespace
}  // namespace remodel::aero
