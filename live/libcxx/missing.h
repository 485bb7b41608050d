// What Debian's libc++ for WebAssembly (of LLVM 13) lacks of C++20, as far as the core uses it. Included before
// every source.
#pragma once

#include <algorithm>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <system_error>

namespace std {

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}

template <class T>
  requires is_unbounded_array_v<T>
unique_ptr<T> make_unique_for_overwrite(size_t n) {
  return unique_ptr<T>(new remove_extent_t<T>[n]);
}

// In the "C" locale, the only one there is.
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
  if (first == last || *first == ' ' || *first == '+') return {first, errc::invalid_argument};
  const string text(first, last);
  char* end = nullptr;
  errno = 0;
  const double found = strtod(text.c_str(), &end);
  if (end == text.c_str()) return {first, errc::invalid_argument};
  if (errno == ERANGE) return {first + (end - text.c_str()), errc::result_out_of_range};
  value = found;
  return {first + (end - text.c_str()), errc{}};
}

namespace ranges {

template <class A, class B>
constexpr bool equal(const A& a, const B& b) {
  return std::equal(std::begin(a), std::end(a), std::begin(b), std::end(b));
}
template <class Range, class Predicate>
constexpr auto count_if(const Range& range, Predicate predicate) {
  return std::count_if(std::begin(range), std::end(range),
                       [&](const auto& value) { return std::invoke(predicate, value); });
}
template <class Range, class Predicate>
constexpr bool none_of(const Range& range, Predicate predicate) {
  return ranges::count_if(range, predicate) == 0;
}
template <class Range, class Predicate>
constexpr bool any_of(const Range& range, Predicate predicate) {
  return ranges::count_if(range, predicate) != 0;
}
template <class Range, class T>
constexpr auto find(const Range& range, const T& value) {
  return std::find(std::begin(range), std::end(range), value);
}
template <class Range, class T>
constexpr bool binary_search(const Range& range, const T& value) {
  return std::binary_search(std::begin(range), std::end(range), value);
}

}  // namespace ranges
}  // namespace std
