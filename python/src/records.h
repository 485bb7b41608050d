#pragma once

// Pickles of plain records: numbers, strings, lists and structs of them, as tuples; arrays as bytes.

#include <algorithm>
#include <concepts>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "bindings.h"

namespace remodel::python {

// Throws Error (format): the bytes of a pickle are not what they should be.
[[noreturn]] inline void refuse_pickle(const char* expected) {
  throw Error(ErrorCode::format, "pickle", std::string("is damaged, expected ") + expected);
}
inline void require_pickle(bool sound, const char* expected) {
  if (!sound) refuse_pickle(expected);
}

// T is R or const R.
template <class T, class R>
concept Is = std::same_as<std::remove_const_t<T>, R>;

// members(record) -> std::tie of all of them, found in the record's namespace. Each file that pickles a
// record has it: template <python::Is<R> T> auto members(T& record).
template <class T>
concept Record = requires(T& record) {
  members(record);
};
template <class T>
concept Raw = std::is_trivially_copyable_v<T> && !Record<T>;

template <class T>
py::object packed(const T& value);
template <class T>
void unpack(const py::handle& from, T& value);

template <class T>
struct Packing {  // numbers, enumerations, strings, maps: pybind11 knows them
  static py::object pack(const T& value) {
    if constexpr (std::is_enum_v<T>)
      return py::int_(static_cast<int>(value));
    else if constexpr (Record<T>)
      return std::apply([](const auto&... member) { return py::make_tuple(packed(member)...); },
                        members(value));
    else
      return py::cast(value);
  }
  static void unpack_to(const py::handle& from, T& value) {
    if constexpr (std::is_enum_v<T>) {
      value = static_cast<T>(from.cast<int>());  // its range is the record's to look after
    } else if constexpr (Record<T>) {
      const auto tuple = from.cast<py::tuple>();
      std::apply(
          [&](auto&... member) {
            require_pickle(tuple.size() == sizeof...(member), "a record");
            std::size_t i = 0;
            (unpack(tuple[i++], member), ...);
          },
          members(value));
    } else {
      value = from.cast<T>();
    }
  }
};

template <class T>
struct Packing<std::optional<T>> {
  static py::object pack(const std::optional<T>& value) { return value ? packed(*value) : py::none(); }
  static void unpack_to(const py::handle& from, std::optional<T>& value) {
    value.reset();
    if (!from.is_none()) unpack(from, value.emplace());
  }
};

template <class T>
struct Packing<std::vector<T>> {
  static py::object pack(const std::vector<T>& values) {
    if constexpr (Raw<T>) {
      return py::bytes(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    } else {
      py::list result;
      for (const T& value : values) result.append(packed(value));
      return result;
    }
  }
  static void unpack_to(const py::handle& from, std::vector<T>& values) {
    if constexpr (Raw<T>) {
      const std::string bytes = from.cast<py::bytes>();
      require_pickle(bytes.size() % sizeof(T) == 0, "an array");
      values.resize(bytes.size() / sizeof(T));
      std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(values.data()));
    } else {
      for (const py::handle item : from.cast<py::list>()) unpack(item, values.emplace_back());
    }
  }
};

template <class T>
py::object packed(const T& value) {
  return Packing<T>::pack(value);
}
template <class T>
void unpack(const py::handle& from, T& value) {
  Packing<T>::unpack_to(from, value);
}

// A record from the state that packed() gave.
template <class T>
T unpacked(const py::handle& from) {
  T result;
  try {
    unpack(from, result);
  } catch (const py::cast_error&) {
    refuse_pickle("the members of a record");
  }
  return result;
}

// Of a class whose objects are such records and nothing else.
template <Record T>
auto record_pickle() {
  return py::pickle([](const T& record) { return py::tuple(packed(record)); },
                    [](const py::tuple& state) { return unpacked<T>(state); });
}

// Frozen meshes, wherever records hold them: null is None.
py::object packed_mesh(const Snapshot& mesh);
Snapshot unpacked_mesh(const py::handle& from);

}  // namespace remodel::python
