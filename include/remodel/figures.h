#pragma once

// Figures by name. Each record of figures has one list of them: the name (the key in JSON, the column in
// SQL), what people read, the unit, and the member. JSON, tables, checksums and printed reports are made of
// these lists, so that a figure is spelled where it is defined and where it is computed, and nowhere else.

#include <string_view>
#include <tuple>
#include <type_traits>

namespace remodel {

template <class Record, class Value>
struct Figure {
  const char* name;
  const char* label;
  const char* unit;  // "" where there is none, or where the label says it
  Value Record::*member;
};
template <class Record, class Value>
Figure(const char*, const char*, const char*, Value Record::*) -> Figure<Record, Value>;

// visit(figure, value) for each figure of a list, in its order; the record may be of a class derived from the
// figures' own, and const or not.
template <class Record, class Visit, class... Figures>
void for_each_figure(const std::tuple<Figures...>& figures, Record& record, Visit&& visit) {
  std::apply([&](const auto&... figure) { (visit(figure, record.*(figure.member)), ...); }, figures);
}

// Sets the figures of `to` that `from` has too: the same name, the same type.
template <class ToList, class To, class FromList, class From>
void copy_figures(const ToList& to_figures, To& to, const FromList& from_figures, const From& from) {
  for_each_figure(to_figures, to, [&]<class Value>(const auto& wanted, Value& value) {
    for_each_figure(from_figures, from, [&]<class Other>(const auto& figure, const Other& other) {
      if constexpr (std::is_same_v<Value, Other>) {
        if (std::string_view(figure.name) == wanted.name) value = other;
      }
    });
  });
}

}  // namespace remodel
