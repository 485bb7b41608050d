#pragma once

// What a run says while it goes on, on standard error.

#include <cstddef>
#include <string>
#include <utility>

#include "interrupt.h"
#include "remodel/optimise.h"
#include "timing.h"

namespace remodel::app {

enum class ProgressStyle {
  none,
  bar,   // one line, redrawn ten times a second: for a terminal
  lines  // one line every few seconds: for a log
};

// For a file that is no terminal lines, which stay readable in a log.
ProgressStyle progress_style(bool quiet);
// part of 1 as a bar of 20 characters.
std::string bar_of(double part);

class Progress : public OptimiseObserver {
 public:
  // heading is the first line: what was resolved.
  Progress(ProgressStyle style, std::size_t evaluations, std::string heading)
      : style_(style), evaluations_(evaluations), heading_(std::move(heading)) {}

  void evaluated(const EvaluationRecord& record) override;
  bool cancelled() override { return interrupt_.raised(); }
  // Ends the bar's line.
  void finish();

 private:
  void show(const EvaluationRecord& record, double seconds);

  ProgressStyle style_;
  std::size_t evaluations_;
  std::string heading_;
  InterruptFlag interrupt_;
  Stopwatch watch_;
  double shown_at_ = 0.0;  // seconds
  std::size_t first_ = 0;  // evaluation seen first: not 1 in a resumed run
  double preserved_sum_ = 0.0;
};

}  // namespace remodel::app
