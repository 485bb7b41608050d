#pragma once

// Numbers of the files of runs, which anybody may have written: a checksum tells damage, not forgery. All
// throw std::invalid_argument that names the key, what was found and what was expected.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace remodel {

// A whole number: the library's own conversion takes -1 for 2^64 - 1.
template <class Json>
std::uint64_t count_at(const Json& json, const char* key, std::uint64_t low = 0,
                       std::uint64_t high = std::uint64_t{1} << 53) {
  const Json& found = json.at(key);
  if (found.is_number_unsigned())
    if (const auto value = found.template get<std::uint64_t>(); value >= low && value <= high) return value;
  throw std::invalid_argument(std::string(key) + ": found " + found.dump() +
                              ", expected a whole number from " + std::to_string(low) + " to " +
                              std::to_string(high));
}

template <class Json>
double number_at(const Json& json, const char* key, double low, double high) {
  const Json& found = json.at(key);
  if (found.is_number())
    if (const double value = found.template get<double>(); value >= low && value <= high) return value;
  throw std::invalid_argument(std::string(key) + ": found " + found.dump() + ", expected a number from " +
                              Json(low).dump() + " to " + Json(high).dump());
}

inline constexpr double most_seconds = 1e12;

}  // namespace remodel
