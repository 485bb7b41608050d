#pragma once

// Helpers that several tests share.

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <random>
#include <string>

namespace remodel::test {

// Test data that is not part of the repository (airfoil files, a foreign mesh) lies in "shared" beside the
// checkout. Cases that need it skip with a line that says so where it is missing.
inline std::optional<std::filesystem::path> shared_file(const std::string& name) {
  const auto file = std::filesystem::path(REMODEL_SOURCE_DIR) / ".." / "shared" / name;
  if (std::filesystem::exists(file)) return file;
  return std::nullopt;
}
#define REMODEL_SHARED_FILE(variable, name)                                                                  \
  const auto variable##_found = remodel::test::shared_file(name);                                            \
  if (!variable##_found) GTEST_SKIP() << "needs shared/" << (name) << ", which is not beside this checkout"; \
  const std::filesystem::path variable = *variable##_found

// The seed of a random test: REMODEL_TEST_SEED if set, otherwise the given one. Print it on failure.
inline unsigned long long seed(unsigned long long fallback) {
  const char* given = std::getenv("REMODEL_TEST_SEED");
  return given != nullptr ? std::strtoull(given, nullptr, 10) : fallback;
}

// The same number with every standard library, unlike std::uniform_real_distribution.
inline double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

// The factor by which random tests are longer than in an ordinary run: REMODEL_TEST_EFFORT, 1 if not set.
inline int effort() {
  const char* given = std::getenv("REMODEL_TEST_EFFORT");
  const int value = given != nullptr ? std::atoi(given) : 1;
  return value < 1 ? 1 : value;
}

// Prints a count of a test, such as "counted 120 faults", for scripts/long-tests to add up.
inline void counted(long long number, const char* what) {
  std::printf("counted %lld %s\n", number, what);
}

}  // namespace remodel::test
