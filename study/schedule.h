#pragma once

// Hands out the unfinished jobs of a study in the order of the plan.

#include <vector>

#include "design/job_queue.h"
#include "study/plan.h"
#include "study/store.h"

namespace remodel {

class Schedule final : public JobQueue {
 public:
  // From now on the store is used only under this object's lock.
  Schedule(StudyStore& store, StudyObserver& observer);

  void finish(std::size_t number, const std::string& rows) override;

  const StudyProgress& progress() const { return progress_; }

 private:
  Schedule(StudyStore& store, StudyObserver& observer, std::vector<PlannedJob> jobs);
  bool can_begin(std::size_t number) const override;
  std::string work_of(std::size_t number) const override;
  StudyWork work_of(const JobKey& key) const;
  bool asks_to_cancel() const override { return observer_.cancelled(); }

  StudyStore& store_;
  StudyObserver& observer_;
  std::vector<PlannedJob> jobs_;
  StudyProgress progress_;
};

}  // namespace remodel
