#include "warnings.h"

#include <algorithm>
#include <cstdio>

namespace remodel::app {
namespace {

std::vector<std::string>& kept() {
  static std::vector<std::string> sentences;
  return sentences;
}

}  // namespace

void warn(const std::string& sentence) {
  std::vector<std::string>& all = kept();
  if (std::find(all.begin(), all.end(), sentence) != all.end()) return;
  std::fprintf(stderr, "remodel: %s\n", sentence.c_str());
  all.push_back(sentence);
}

void warn(const std::vector<std::string>& sentences) {
  for (const std::string& sentence : sentences) warn(sentence);
}

const std::vector<std::string>& warnings() {
  return kept();
}

}  // namespace remodel::app
