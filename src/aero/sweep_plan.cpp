// Which chains a sweep is cut into.

#include <algorithm>
#include <numeric>

#include "aero/sweep_directory.h"
#include "design/portable_math.h"
#include "remodel/batch.h"

namespace remodel {
namespace {

using Rows = std::vector<SweepRow>;

void take_off(Rows& rows, const Rows& others) {
  for (const SweepRow& other : others)
    for (SweepRow& row : rows)
      if (row.mach == other.mach && row.reynolds == other.reynolds)
        std::erase_if(row.values, [&](double value) { return std::ranges::count(other.values, value) != 0; });
  std::erase_if(rows, [](const SweepRow& row) { return row.values.empty(); });
}

// Sections that there are in the order of the sweep, then those that there are not.
std::vector<std::size_t> ordered(const SweepProblem& problem, const std::vector<std::size_t>& sections) {
  std::vector<std::size_t> good, refused;
  for (const std::size_t i : sections) (problem.sections[i].problem.empty() ? good : refused).push_back(i);
  if (problem.order == SweepOrder::random) {
    portable::Generator random(problem.seed);
    portable::shuffle(good, random);
  }
  if (problem.order == SweepOrder::nearest && !good.empty()) {
    std::vector<CstAirfoil> airfoils;
    for (const std::size_t i : good) airfoils.push_back(problem.sections[i].airfoil);
    std::vector<std::size_t> in_order;
    for (const std::size_t i : order_designs(airfoils.front(), airfoils, {.points = problem.domain.points}))
      in_order.push_back(good[i]);
    good = std::move(in_order);
  }
  good.insert(good.end(), refused.begin(), refused.end());
  return good;
}

// Pieces of nearly the same length, of at most so many.
std::vector<std::vector<std::size_t>> cut(const std::vector<std::size_t>& order, std::size_t most) {
  const std::size_t count = (order.size() + most - 1) / most;
  std::vector<std::vector<std::size_t>> chains;
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = [&](std::size_t n) {
      return order.begin() + static_cast<std::ptrdiff_t>(n * order.size() / count);
    };
    chains.emplace_back(at(i), at(i + 1));
  }
  return chains;
}

}  // namespace

std::vector<SweepPlan> plans_of_missing(const SweepProblem& problem, const std::vector<SweepPlan>& planned) {
  std::vector<Rows> missing(problem.sections.size(), problem.rows);
  for (const SweepPlan& plan : planned)
    for (const std::vector<std::size_t>& chain : plan.chains)
      for (const std::size_t section : chain) take_off(missing[section], plan.rows);
  std::vector<std::pair<Rows, std::vector<std::size_t>>> alike;  // sections by what they miss
  for (std::size_t i = 0; i < missing.size(); ++i) {
    if (missing[i].empty()) continue;
    auto group =
        std::find_if(alike.begin(), alike.end(), [&](const auto& g) { return g.first == missing[i]; });
    if (group == alike.end()) group = alike.insert(alike.end(), {missing[i], {}});
    group->second.push_back(i);
  }
  std::vector<SweepPlan> plans;
  for (const auto& [rows, sections] : alike)
    plans.push_back({.rows = rows, .chains = cut(ordered(problem, sections), problem.chain)});
  return plans;
}

}  // namespace remodel
