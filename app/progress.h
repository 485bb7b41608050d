#pragma once

// Reports the progress of a run on standard error.

#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <utility>

#include "interrupt.h"
#include "remodel/flow.h"
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

// What says on standard error, now and then, how far a run is.
class StatusLine {
 public:
  // begun_at: seconds, from which the first pause counts.
  explicit StatusLine(ProgressStyle style, double begun_at = 0.0) : style_(style), shown_at_(begun_at) {}
  ProgressStyle style() const { return style_; }
  double seconds() const { return watch_.seconds(); }
  // Whether it is time for the next one: at the last one always.
  bool is_due(bool is_last);
  // part: from 0 to 1, of a bar. Returns true if it is one, which end() has to end.
  bool show(double part, const char* text) const;
  void end() const;  // of a bar

 private:
  ProgressStyle style_;
  Stopwatch watch_;
  double shown_at_;
};

class Progress : public OptimiseObserver {
 public:
  // heading: the first line, the resolved options.
  Progress(ProgressStyle style, std::size_t evaluations, std::string heading)
      : line_(style), evaluations_(evaluations), heading_(std::move(heading)) {}

  // What is to be said when the first evaluation shows that the run was not refused.
  void say_at_first(std::function<void()> say) { at_first_ = std::move(say); }
  void evaluated(const EvaluationRecord& record) override;
  // Says how far the flow under way is, where designs take long. From any thread.
  void flow_step(const FlowProgress& progress);
  bool cancelled() override { return interrupt_.cancelled(); }
  // The same question for steps and flows.
  StepObserver& step_observer() { return interrupt_; }
  // Ends the line of the progress bar.
  void finish();

 private:
  void begin();  // says the heading, once
  void show(const EvaluationRecord& record) const;

  std::mutex mutex_;
  StatusLine line_;
  std::size_t evaluations_;
  std::string heading_;
  std::function<void()> at_first_;
  InterruptObserver interrupt_;
  bool begun_ = false;
  std::size_t first_ = 0;  // the first evaluation of this session: not 1 in a resumed run
  std::size_t last_ = 0;
  double preserved_sum_ = 0.0;
};

}  // namespace remodel::app
