#pragma once

// What a study says while it goes on, on standard error, and what ends it early.

#include <string>

#include "interrupt.h"
#include "progress.h"
#include "remodel/study.h"
#include "timing.h"

namespace remodel::app {

class StudyProgressLine : public StudyObserver {
 public:
  // heading is the first line: what was resolved. time_limit: seconds, 0: none.
  StudyProgressLine(ProgressStyle style, std::string heading, double time_limit)
      : style_(style), heading_(std::move(heading)), time_limit_(time_limit) {}

  void finished(const StudyProgress& progress) override;
  bool cancelled() override {
    return interrupt_.raised() || (time_limit_ > 0.0 && watch_.seconds() > time_limit_);
  }
  // Ends the bar's line.
  void finish();

 private:
  ProgressStyle style_;
  std::string heading_;
  double time_limit_;
  InterruptFlag interrupt_;
  Stopwatch watch_;
  double shown_at_ = -1e9;  // seconds
  bool begun_ = false;
};

}  // namespace remodel::app
