#include "study/strategies.h"

#include <array>

#include "remodel/error.h"
#include "study/study.h"

namespace remodel {
namespace {

constexpr std::array replayed{MeshStrategy::chain, MeshStrategy::renew};

}  // namespace

std::vector<std::string> study_strategies() {
  std::vector<std::string> names;
  for (const MeshStrategy strategy : replayed) names.emplace_back(name_of(strategy));
  return names;
}

void set_strategy(const std::string& name, OptimiseOptions& options) {
  std::string expected;
  for (const MeshStrategy strategy : replayed) {
    if (name_of(strategy) == name) {
      options.strategy = strategy;
      return;
    }
    expected += (expected.empty() ? "" : ", ") + std::string(name_of(strategy));
  }
  throw Error(ErrorCode::argument, "strategies", "found '" + name + "', expected one of " + expected);
}

}  // namespace remodel
