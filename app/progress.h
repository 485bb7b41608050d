#pragma once

// Reports the progress of a run on standard error.

#include <cstddef>
#include <functional>
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

// A bar if standard error is a terminal; otherwise lines, which stay readable in a log.
ProgressStyle progress_style(bool quiet);
// A bar of 20 characters; `part` is from 0 to 1.
std::string bar_of(double part);

class Progress : public OptimiseObserver {
 public:
  // heading: the first line, the resolved options.
  Progress(ProgressStyle style, std::size_t evaluations, std::string heading)
      : style_(style), evaluations_(evaluations), heading_(std::move(heading)) {}

  // What is to be said when the first evaluation shows that the run was not refused.
  void say_at_first(std::function<void()> say) { at_first_ = std::move(say); }
  void evaluated(const EvaluationRecord& record) override;
  bool cancelled() override { return interrupt_.cancelled(); }
  // The same question for steps and flows.
  StepObserver& step_observer() { return interrupt_; }
  // Ends the line of the progress bar.
  void finish();

 private:
  void show(const EvaluationRecord& record, double seconds);

  ProgressStyle style_;
  std::size_t evaluations_;
  std::string heading_;
  std::function<void()> at_first_;
  InterruptObserver interrupt_;
  Stopwatch watch_;
  double shown_at_ = 0.0;  // seconds
  std::size_t first_ = 0;  // the first evaluation of this session: not 1 in a resumed run
  double preserved_sum_ = 0.0;
};

}  // namespace remodel::app
