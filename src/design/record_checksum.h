#pragma once

// The checksum of a history's rows, figure by figure.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/checksum.h"
#include "remodel/history.h"

namespace remodel {

inline void add_value(Checksum& sum, double value) {
  sum.add(value);
}
inline void add_value(Checksum& sum, std::uint64_t value) {
  sum.add(value);
}  // std::size_t too
inline void add_value(Checksum& sum, bool value) {
  sum.add(std::uint64_t{value});
}
inline void add_value(Checksum& sum, const std::string& value) {
  sum.add(std::uint64_t{value.size()}), sum.add(value);
}
inline void add_value(Checksum& sum, Checked value) {
  add_value(sum, std::string(name_of(value)));
}
template <class Value>
void add_value(Checksum& sum, const std::optional<Value>& value) {
  add_value(sum, value.has_value());
  if (value) add_value(sum, *value);
}
inline void add_value(Checksum& sum, const std::vector<double>& values) {
  add_value(sum, std::uint64_t{values.size()});
  for (const double value : values) add_value(sum, value);
}
template <class Value>
void add_value(Checksum& sum, const std::map<std::string, Value>& values) {
  add_value(sum, std::uint64_t{values.size()});
  for (const auto& [name, value] : values) add_value(sum, name), add_value(sum, value);
}

inline void add(Checksum& sum, const std::map<std::string, std::string>& run) {
  add_value(sum, run);
}
inline void add(Checksum& sum, const EvaluationRecord& record) {
  for_each_figure(evaluation_figures, record, [&](const auto&, const auto& value) { add_value(sum, value); });
}

}  // namespace remodel
