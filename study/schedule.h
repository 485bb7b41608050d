#pragma once

// Hands out the unfinished jobs of a study in the order of the plan.

#include <atomic>
#include <mutex>
#include <vector>

#include "study/plan.h"
#include "study/store.h"

namespace remodel {

class Schedule : public CrewJobs {
 public:
  // From now on the store is used only under this object's lock.
  Schedule(StudyStore& store, StudyObserver& observer);

  std::optional<Job> next() override;
  void finish(std::size_t number, const std::string& rows) override;
  void give_back(std::size_t number) override;
  bool ended() const override;
  bool cancelled() const override;

  const StudyProgress& progress() const { return progress_; }

 private:
  enum class State { waiting, out, done };
  bool ready(std::size_t number) const;
  StudyWork work_of(const JobKey& key) const;

  mutable std::mutex mutex_;
  StudyStore& store_;
  StudyObserver& observer_;
  std::vector<PlannedJob> jobs_;
  std::vector<State> states_;
  std::size_t first_waiting_ = 0;  // jobs before this index are not waiting
  StudyProgress progress_;
  mutable std::atomic<bool> cancelled_ = false;
};

}  // namespace remodel
