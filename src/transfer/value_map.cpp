#include <algorithm>
#include <string>

#include "remodel/error.h"
#include "remodel/transfer.h"
#include "transfer/remap.h"

namespace remodel {

std::size_t require_values(const std::vector<double>& values, std::size_t numbers, int components) {
  if (components < 1)
    throw Error(ErrorCode::argument, "components",
                "found " + std::to_string(components) + ", expected 1 or more");
  const auto width = static_cast<std::size_t>(components);
  if (values.size() != numbers * width)
    throw Error(ErrorCode::argument, "values",
                "found " + std::to_string(values.size()) + ", expected " + std::to_string(components) +
                    " for each of " + std::to_string(numbers) + " numbers");
  return width;
}

void ValueMap::add_row(std::uint32_t to, const std::array<std::uint32_t, 3>& from,
                       const std::array<double, 3>& weights, double distance) {
  rows.push_back(to);
  for (std::size_t k = 0; k < 3; ++k)
    if (weights[k] != 0.0) parts.push_back({from[k], weights[k]});
  starts.push_back(static_cast<std::uint32_t>(parts.size()));
  if (distance > 0.0) ++outside, farthest_outside = std::max(farthest_outside, distance);
}

void ValueMap::apply(std::vector<double>& values, int components) const {
  const std::size_t width = require_values(values, size_before, components);
  std::vector<double> made(rows.size() * width, 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::uint32_t j = starts[i]; j < starts[i + 1]; ++j)
      for (std::size_t k = 0; k < width; ++k)
        made[i * width + k] += parts[j].weight * values[parts[j].from * width + k];
  if (!same.empty()) {
    std::vector<double> after(size_after * width, 0.0);
    for (std::size_t v = 0; v < size_after; ++v)
      if (same[v] != no_index)
        for (std::size_t k = 0; k < width; ++k) after[v * width + k] = values[same[v] * width + k];
    values = std::move(after);
  } else {
    for (const std::uint32_t v : gone)
      for (std::size_t k = 0; k < width; ++k) values[v * width + k] = 0.0;
    values.resize(size_after * width, 0.0);
  }
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = 0; k < width; ++k) values[rows[i] * width + k] = made[i * width + k];
}

void ValueMap::apply_transposed(std::vector<double>& values, int components) const {
  const std::size_t width = require_values(values, size_after, components);
  std::vector<double> taken(rows.size() * width, 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = 0; k < width; ++k) taken[i * width + k] = values[rows[i] * width + k];
  if (!same.empty()) {
    std::vector<double> before(size_before * width, 0.0);
    for (std::size_t v = 0; v < size_after; ++v)
      if (same[v] != no_index)
        for (std::size_t k = 0; k < width; ++k) before[same[v] * width + k] += values[v * width + k];
    values = std::move(before);
  } else {
    for (const std::uint32_t v : rows)
      for (std::size_t k = 0; k < width; ++k) values[v * width + k] = 0.0;
    values.resize(size_before * width, 0.0);
    for (const std::uint32_t v : gone)
      for (std::size_t k = 0; k < width; ++k) values[v * width + k] = 0.0;
  }
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::uint32_t j = starts[i]; j < starts[i + 1]; ++j)
      for (std::size_t k = 0; k < width; ++k)
        values[parts[j].from * width + k] += parts[j].weight * taken[i * width + k];
}

}  // namespace remodel
