#pragma once

// Reports a study's progress on standard error, and ends the study early at an interrupt or a time limit.

#include <string>

#include "interrupt.h"
#include "progress.h"
#include "study/study.h"

namespace remodel::app {

class StudyProgressLine : public StudyObserver {
 public:
  // heading: the first line, the resolved options. time_limit: in seconds; 0 for none.
  StudyProgressLine(ProgressStyle style, std::string heading, double time_limit)
      : line_(style, -1e9), heading_(std::move(heading)), time_limit_(time_limit) {}

  void finished(const StudyProgress& progress) override;
  bool cancelled() override {
    return interrupt_.raised() || (time_limit_ > 0.0 && line_.seconds() > time_limit_);
  }
  // Ends the line of the progress bar.
  void finish();

 private:
  StatusLine line_;
  std::string heading_;
  double time_limit_;
  InterruptFlag interrupt_;
  bool begun_ = false;
};

}  // namespace remodel::app
