#pragma once

#include <chrono>
#include <vector>

namespace remodel::app {

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// The mean of the two middle values where their number is even. values is not empty.
double median(std::vector<double> values);

}  // namespace remodel::app
