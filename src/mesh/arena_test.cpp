#include "mesh/arena.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>

#include "support.h"

namespace remodel {
namespace {

// Lists that grow in turn keep what they hold: no two are given the same memory.
TEST(Arena, KeepsListsApart) {
  Arena arena;
  const auto seed = test::seed(7);
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  const Arena::Scope scope(arena);
  std::vector<List<std::uint64_t>> lists;
  for (std::size_t i = 0; i < 8; ++i) lists.emplace_back(&arena);
  for (std::uint64_t n = 0; n < 20000; ++n) lists[random() % lists.size()].push_back(n);
  std::uint64_t sum = 0;
  for (const auto& list : lists) {
    EXPECT_TRUE(std::is_sorted(list.begin(), list.end()));
    sum = std::accumulate(list.begin(), list.end(), sum);
  }
  EXPECT_EQ(sum, 20000ULL * 19999ULL / 2);
}

TEST(Arena, GivesTheSameMemoryAgainAfterAScopeAndNoneOfThatBeforeIt) {
  Arena arena;
  const Arena::Scope outer(arena);
  List<int> before({1, 2, 3}, &arena);
  const int* first = nullptr;
  for (int round = 0; round < 3; ++round) {
    const Arena::Scope inner(arena);
    List<int> list(&arena);
    for (int i = 0; i < 5000; ++i) list.push_back(i);
    if (round > 1) {
      EXPECT_EQ(list.data(), first);
    }
    first = list.data();
  }
  EXPECT_EQ(before, (List<int>{1, 2, 3}));
}

TEST(Arena, KeepsAlignment) {
  struct alignas(64) Line {
    char c;
  };
  Arena arena;
  const Arena::Scope scope(arena);
  for (std::size_t i = 1; i < 200; ++i) {
    List<char> shift(i, &arena);
    List<Line> lines(i % 7 + 1, &arena);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(lines.data()) % 64, 0U);
  }
}

}  // namespace
}  // namespace remodel
