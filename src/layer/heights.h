#pragma once

// Heights of the levels of a column: a geometric row, found by additions, multiplications and divisions alone, so
// that the bits are the same everywhere.

#include <cstdint>
#include <span>

namespace remodel {

// 1 + r + ... + r^(count - 1).
double geometric_sum(double ratio, std::uint32_t count);
// The cells that it takes to fill `thickness`, of which the first is `first` high and each is `growth` times the
// one below it. At most 1000.
std::uint32_t level_count(double first, double growth, double thickness);
// The ratio by which `count` cells, the first one `first` high, fill `thickness`; 1 where they would be too many.
// Precondition: they fill it with `growth`, and count >= 1.
double growth_of(double first, double growth, double thickness, std::uint32_t count);
// The heights of levels 1 to heights.size(), of which the last is `thickness`.
void level_heights(double first, double ratio, double thickness, std::span<double> heights);

}  // namespace remodel
