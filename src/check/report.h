#pragma once

// Where the rules put what they find.

#include <cstdint>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "remodel/check.h"

namespace remodel::checker {

class Report {
 public:
  explicit Report(std::size_t limit) : limit_(limit) {}

  void add(std::string rule, std::vector<std::uint32_t> ids, std::string detail) {
    ++found_;
    if (violations_.size() < limit_)
      violations_.push_back({std::move(rule), std::move(ids), std::move(detail)});
  }
  // Also those beyond the limit: a rule that asks before and after knows whether it held.
  std::size_t found() const { return found_; }
  std::vector<Violation> take() { return std::move(violations_); }

 private:
  std::size_t limit_;
  std::size_t found_ = 0;
  std::vector<Violation> violations_;
};

// The parts as one text, numbers with all their digits.
template <class... Parts>
std::string sentence(const Parts&... parts) {
  std::ostringstream text;
  text.precision(17);
  (text << ... << parts);
  return text.str();
}

}  // namespace remodel::checker
