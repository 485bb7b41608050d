#include "base/threads.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>

namespace remodel {
namespace {

TEST(Threads, DoEveryTaskOnceHoweverOftenTheyAreAsked) {
  for (const std::size_t threads : {1, 2, 4}) {
    ThreadTeam team(threads);
    for (std::size_t count = 0; count < 60; ++count) {
      std::vector<int> done(count, 0);
      team.run(count, [&](std::size_t i) { ++done[i]; });
      EXPECT_EQ(done, std::vector<int>(count, 1)) << threads << " threads";
    }
  }
}

TEST(Threads, ThrowTheFirstTasksExceptionAfterAllHaveEnded) {
  for (const std::size_t threads : {1, 3}) {
    ThreadTeam team(threads);
    for (int round = 0; round < 50; ++round) {
      std::atomic<int> ended = 0;
      try {
        team.run(8, [&](std::size_t i) {
          ++ended;
          if (i % 3 == 2) throw std::runtime_error(std::to_string(i));
        });
        FAIL() << "no exception";
      } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "2");
      }
      EXPECT_EQ(ended, 8);
    }
  }
}

}  // namespace
}  // namespace remodel
