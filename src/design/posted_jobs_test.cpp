#include <gtest/gtest.h>

#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

#include "remodel/crew.h"

namespace remodel {
namespace {

const std::function<bool()> never = [] { return false; };

TEST(PostedJobs, ReturnWhatACrewMakesOfThem) {
  ThreadCrew crew(2);
  const CrewWork work = [](const std::string& bytes, const std::function<bool()>&) { return bytes + "!"; };
  std::string first, second;
  PostedJobs::lead(crew, work, [&](PostedJobs& jobs) {
    std::jthread other([&] { second = jobs.result_of(2, "b", never).value(); });
    first = jobs.result_of(1, "a", never).value();
  });
  EXPECT_EQ(first + second, "a!b!");
}

// Of one key, until its worker is lost or gives it back.
TEST(PostedJobs, StayWithTheirWorker) {
  PostedJobs jobs;
  const auto post = [&](std::uint64_t key, const std::string& work) {
    return std::jthread([&jobs, key, work] { jobs.result_of(key, work, never); });
  };
  const auto next = [&](std::size_t worker) {
    for (int tries = 0; tries < 2000; ++tries) {
      if (const auto job = jobs.next(worker)) return *job;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    throw std::runtime_error("no job");
  };
  {
    const std::jthread one = post(7, "first");
    const auto job = next(1);
    EXPECT_EQ(job.work, "first");
    jobs.finish(job.number, "");
  }
  const std::jthread two = post(7, "second");
  const std::jthread other = post(8, "other");
  const auto of_two = next(2);
  EXPECT_EQ(of_two.work, "other");
  EXPECT_FALSE(jobs.next(2).has_value());
  const auto of_one = next(1);
  EXPECT_EQ(of_one.work, "second");
  jobs.give_back(of_one.number);
  jobs.lose(1);
  const auto again = next(2);
  EXPECT_EQ(again.number, of_one.number);
  jobs.finish(again.number, "");
  jobs.finish(again.number, "twice");
  jobs.finish(of_two.number, "");
}

TEST(PostedJobs, EndWhereTheRunIsCancelledAndWhereTheCrewFails) {
  ThreadCrew crew(2);
  const CrewWork waits = [](const std::string&, const std::function<bool()>& cancelled) {
    while (!cancelled()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return std::optional<std::string>();
  };
  bool has_result = true;
  PostedJobs::lead(crew, waits, [&](PostedJobs& jobs) {
    has_result = jobs.result_of(1, "a", [] { return true; }).has_value();
  });
  EXPECT_FALSE(has_result);
  const CrewWork fails = [](const std::string&, const std::function<bool()>&) -> std::optional<std::string> {
    throw std::runtime_error("a bug");
  };
  bool is_known = false;
  const auto run = [&](PostedJobs& jobs) {
    has_result = jobs.result_of(1, "a", never).has_value();
    is_known = jobs.failed();
  };
  EXPECT_THROW(PostedJobs::lead(crew, fails, run), std::runtime_error);
  EXPECT_FALSE(has_result);
  EXPECT_TRUE(is_known);
}

}  // namespace
}  // namespace remodel
