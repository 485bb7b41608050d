#include "study_progress.h"

#include <array>
#include <cstdio>

namespace remodel::app {

void StudyProgressLine::finished(const StudyProgress& progress) {
  if (line_.style() == ProgressStyle::none) return;
  // Nothing is printed before the first job ends: a refusal may still come, and it has to be the only line.
  if (!begun_) std::fprintf(stderr, "%s\n", heading_.c_str());
  begun_ = true;
  if (!line_.is_due(progress.done == progress.jobs)) return;

  const double here = progress.core_seconds_done - progress.core_seconds_before;
  const double left = (progress.core_seconds - progress.core_seconds_done) * line_.seconds() / here;
  std::array<char, 240> text{};
  std::snprintf(text.data(), text.size(), "%zu/%zu jobs  about %.0f s left  %s: %.1f s", progress.done,
                progress.jobs, left, progress.job.c_str(), progress.job_seconds);
  line_.show(progress.core_seconds_done / progress.core_seconds, text.data());
}

void StudyProgressLine::finish() {
  if (begun_) line_.end();
}

}  // namespace remodel::app
