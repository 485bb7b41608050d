#pragma once

// Processor times and medians. On a shared machine wall time depends on other users; and even of processor
// times only ratios of alternating measurements in one run are meaningful.

#include <algorithm>
#include <ctime>
#include <vector>

namespace remodel::bench {

class CpuClock {
 public:
  double seconds() const { return now() - start_; }

 private:
  static double now() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  }
  double start_ = now();
};

// The median of an empty list is 0.
inline double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace remodel::bench
