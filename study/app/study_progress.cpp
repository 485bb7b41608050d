#include "study_progress.h"

#include <array>
#include <cstdio>
#include <string>

#include "terminal.h"

namespace remodel::app {

void StudyProgressLine::finished(const StudyProgress& progress) {
  if (style_ == ProgressStyle::none) return;
  // Nothing is printed before the first job ends: a refusal may still come, and it has to be the only line.
  if (!begun_) std::fprintf(stderr, "%s\n", heading_.c_str());
  begun_ = true;
  const double seconds = watch_.seconds();
  const double pause = style_ == ProgressStyle::bar ? 0.1 : 5.0;
  if (seconds - shown_at_ < pause && progress.done != progress.jobs) return;
  shown_at_ = seconds;

  const double here = progress.core_seconds_done - progress.core_seconds_before;
  const double left = (progress.core_seconds - progress.core_seconds_done) * seconds / here;
  std::array<char, 240> text{};
  std::snprintf(text.data(), text.size(), "%zu/%zu jobs  about %.0f s left  %s: %.1f s", progress.done,
                progress.jobs, left, progress.job.c_str(), progress.job_seconds);
  if (style_ == ProgressStyle::bar) {
    draw_status_line("[" + bar_of(progress.core_seconds_done / progress.core_seconds) + "] " + text.data());
  } else {
    std::fprintf(stderr, "%s\n", text.data());
    std::fflush(stderr);
  }
}

void StudyProgressLine::finish() {
  if (style_ == ProgressStyle::bar && begun_) std::fputc('\n', stderr);
}

}  // namespace remodel::app
