#include "base/slot_map.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "support.h"

namespace remodel {
namespace {

struct Id {
  std::uint32_t index;
};

// Random operations, beside a std::map of the same contents.
TEST(SlotMap, HasWhatAMapHas) {
  const auto seed = test::seed(11);
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  SlotMap<Id, int> map;
  for (int round = 0; round < 50; ++round) {
    const std::size_t slots = 1 + random() % 200;
    map.clear(slots);
    std::map<std::uint32_t, int> expected;
    for (int i = 0; i < 300; ++i) {
      const Id id{static_cast<std::uint32_t>(random() % slots)};
      const int value = static_cast<int>(random() % 1000);
      if (random() % 3 == 0 && expected.contains(id.index)) expected[id.index] = map[id] = value;
      ASSERT_EQ(map.insert(id, value), expected.emplace(id.index, value).second);
    }
    for (std::uint32_t i = 0; i < slots; ++i) {
      ASSERT_EQ(map.contains(Id{i}), expected.contains(i));
      ASSERT_EQ(map.value_or(Id{i}, -1), expected.contains(i) ? expected[i] : -1);
    }
  }
}

TEST(SlotSet, TakesAnIdAgainOnceItWasErased) {
  SlotSet<Id> set;
  set.clear(3);
  EXPECT_TRUE(set.insert(Id{2}));
  EXPECT_FALSE(set.insert(Id{2}));
  set.erase(Id{2});
  EXPECT_FALSE(set.contains(Id{2}));
  EXPECT_TRUE(set.insert(Id{2}));
}

TEST(SlotSet, IsEmptyWhereItIsACopy) {
  SlotSet<Id> set;
  set.clear(1);
  set.insert(Id{0});
  SlotSet<Id> copy = set;
  copy.clear(1);
  EXPECT_FALSE(copy.contains(Id{0}));
  EXPECT_TRUE(set.contains(Id{0}));
}

}  // namespace
}  // namespace remodel
