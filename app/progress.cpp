#include "progress.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "remodel/error.h"
#include "terminal.h"

namespace remodel::app {

ProgressStyle progress_style(bool quiet) {
  if (quiet) return ProgressStyle::none;
  return isatty(STDERR_FILENO) != 0 ? ProgressStyle::bar : ProgressStyle::lines;
}

std::string bar_of(double part) {
  constexpr std::size_t width = 20;
  const auto full = static_cast<std::size_t>(width * std::clamp(part, 0.0, 1.0) + 1e-9);
  std::string text(width, '.');
  text.replace(0, full, full, '#');
  return text;
}

bool StatusLine::is_due(bool is_last) {
  const double pause = style_ == ProgressStyle::bar ? 0.1 : 5.0, now = seconds();
  if (now - shown_at_ < pause && !is_last) return false;
  shown_at_ = now;
  return true;
}

bool StatusLine::show(double part, const char* text) const {
  if (style_ == ProgressStyle::bar) {
    draw_status_line("[" + bar_of(part) + "] " + text);
    return true;
  }
  std::fprintf(stderr, "%s\n", text);
  std::fflush(stderr);
  return false;
}

void StatusLine::end() const {
  if (style_ == ProgressStyle::bar) std::fputc('\n', stderr);
}

void Progress::evaluated(const EvaluationRecord& record) {
  const std::scoped_lock lock(mutex_);
  if (at_first_) std::exchange(at_first_, nullptr)();
  last_ = record.evaluation;
  if (line_.style() == ProgressStyle::none) return;
  begin();
  if (first_ == 0) first_ = record.evaluation;
  preserved_sum_ += record.preserved_percent;
  if (line_.is_due(record.evaluation == evaluations_)) show(record);
}

void Progress::flow_step(const FlowProgress& progress) {
  const std::scoped_lock lock(mutex_);
  if (line_.style() == ProgressStyle::none || !line_.is_due(false)) return;
  begin();
  std::array<char, 200> figures{};
  std::snprintf(figures.data(), figures.size(), "%zu/%zu  finding a flow: step %d, residual %.1e", last_,
                evaluations_, progress.newton_step, progress.residual);
  line_.show(static_cast<double>(last_) / static_cast<double>(evaluations_), figures.data());
}

// Nothing is printed before the first evaluation or flow: a refusal may still come, and it has to be the only
// line.
void Progress::begin() {
  if (std::exchange(begun_, true)) return;
  std::fprintf(stderr, "%s\n", one_line(heading_).c_str());
}

void Progress::show(const EvaluationRecord& record) const {
  const double done = static_cast<double>(record.evaluation - first_ + 1);
  const double left = static_cast<double>(evaluations_ - record.evaluation) * line_.seconds() / done;
  std::array<char, 200> figures{};
  std::snprintf(figures.data(), figures.size(),
                "%zu/%zu  objective %.3g  sigma %.2g  %zu triangles  preserved %.2f %%  %.0f s left",
                static_cast<std::size_t>(record.evaluation), evaluations_, record.best_objective,
                record.sigma, record.triangles, preserved_sum_ / done, left);
  line_.show(static_cast<double>(record.evaluation) / static_cast<double>(evaluations_), figures.data());
}

void Progress::finish() {
  if (begun_) line_.end();
}

}  // namespace remodel::app
