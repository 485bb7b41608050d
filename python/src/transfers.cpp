// Transfer: values carried over from one frozen mesh to another.

#include "remodel/transfer.h"

#include "bindings.h"
#include "records.h"

namespace remodel::python {
namespace {

// A transfer and what it was made of, for pickles.
struct Carrier {
  Carrier(Snapshot from, Snapshot to, std::string beyond)
      : before(std::move(from)),
        after(std::move(to)),
        outside(std::move(beyond)),
        transfer(*before, *after, {.outside = outside_named(outside)}) {}
  Snapshot before, after;
  std::string outside;
  Transfer transfer;

  static Outside outside_named(const std::string& name) {
    if (name == "nearest") return Outside::nearest;
    if (name == "extrapolate") return Outside::extrapolate;
    if (name == "refuse") return Outside::refuse;
    throw Error(ErrorCode::argument, "outside",
                "found '" + name + "', expected nearest, extrapolate or refuse");
  }
};

FieldPlace place_named(const std::string& name) {
  if (name == "vertices") return FieldPlace::vertices;
  if (name == "triangles") return FieldPlace::triangles;
  throw Error(ErrorCode::argument, "place", "found '" + name + "', expected vertices or triangles");
}

int components_of(const Reals& values) {
  if (values.ndim() != 1 && values.ndim() != 2)
    throw Error(ErrorCode::argument, "values", "expected an array of shape (n,) or (n, components)");
  const py::ssize_t components = values.ndim() == 2 ? values.shape(1) : 1;
  if (components < 1 || components > 1000)
    throw Error(ErrorCode::argument, "values", "expected 1 to 1000 components");
  return static_cast<int>(components);
}

py::array_t<double> shaped_as(const Reals& before, const std::vector<double>& values) {
  py::array_t<double> result = copied(values);
  if (before.ndim() == 2) result = result.reshape({py::ssize_t{-1}, before.shape(1)});
  return result;
}

py::array_t<double> rode(const Carrier& carrier, const Reals& values, const std::string& place) {
  const int components = components_of(values);
  const FieldPlace where = place_named(place);
  std::vector<double> all(values.data(), values.data() + values.size());
  {
    py::gil_scoped_release released;
    carrier.transfer.ride(where, components, all);
  }
  return shaped_as(values, all);
}

py::tuple remapped(const Carrier& carrier, const Reals& values, const std::string& place, bool limited,
                   const std::optional<std::array<int, 4>>& conserved) {
  const int components = components_of(values);
  const FieldPlace where = place_named(place);
  std::vector<double> all(values.data(), values.data() + values.size());
  Balance balance;
  {
    py::gil_scoped_release released;
    balance = carrier.transfer.remap(where, components, all, {.limited = limited, .conserved = conserved});
  }
  py::dict figures("area_gained"_a = balance.area_gained, "area_lost"_a = balance.area_lost,
                   "before"_a = copied(balance.before), "after"_a = copied(balance.after),
                   "gained"_a = copied(balance.gained), "lost"_a = copied(balance.lost),
                   "limited"_a = balance.limited);
  return py::make_tuple(shaped_as(values, all), figures);
}

// Row, column and weight of every entry.
py::tuple entries_of(const ValueMap& map) {
  std::vector<std::uint32_t> rows, columns;
  std::vector<double> weights;
  for (std::uint32_t i = 0; i < map.same.size(); ++i)
    if (map.same[i] != no_index) rows.push_back(i), columns.push_back(map.same[i]), weights.push_back(1.0);
  for (std::size_t i = 0; i < map.rows.size(); ++i)
    for (std::uint32_t j = map.starts[i]; j < map.starts[i + 1]; ++j)
      rows.push_back(map.rows[i]), columns.push_back(map.parts[j].from),
          weights.push_back(map.parts[j].weight);
  return py::make_tuple(copied(rows), copied(columns), copied(weights), map.size_after, map.size_before);
}

}  // namespace

void add_transfers(py::module_& module) {
  py::class_<Carrier> type(
      module, "Transfer",
      R"(Values carried over from one mesh to what steps made of it: Transfer(before, after), each a Mesh
or FrozenMesh; Step.transfer is one. Values are in the order of points (place='vertices') or cells (place='triangles'), of
shape (n,) or (n, components).

outside: the value of a new vertex beyond the old domain: 'nearest', 'extrapolate' or 'refuse'. Sources:
P. E. Farrell and J. R. Maddison, 2011; F. Alauzet and M. Mehrenberger, 2010; docs/transfer.md.)");
  type.def(py::init([](const py::object& before, const py::object& after, const std::string& outside) {
             const Snapshot first = snapshot_of(before), second = snapshot_of(after);
             py::gil_scoped_release released;
             return std::make_unique<Carrier>(first, second, outside);
           }),
           "before"_a, "after"_a, py::kw_only(), "outside"_a = "nearest");
  type.def("ride", &rode, "values"_a, "place"_a = "vertices",
           "Linear: what is still there keeps its value, what is new is interpolated.");
  type.def("remap", &remapped, "values"_a, "place"_a = "vertices", py::kw_only(), "limited"_a = true,
           "conserved"_a = py::none(),
           "Conservative, of second order, without new extrema; returns the values and their balance, a "
           "dict. conserved: the columns that are density, momentum in x and y, and energy.");
  type.def(
      "_entries",
      [](const Carrier& c, const std::string& place) {
        const bool vertices = place_named(place) == FieldPlace::vertices;
        return entries_of(vertices ? c.transfer.vertices() : c.transfer.triangles());
      },
      "place"_a);
  type.def_property_readonly(
      "outside", [](const Carrier& c) { return c.transfer.outside(); },
      "How many new vertices lie beyond the old domain.");
  type.def_property_readonly(
      "farthest_outside", [](const Carrier& c) { return c.transfer.farthest_outside(); },
      "How far, at most, in chords.");
  type.def(py::pickle(
      [](const Carrier& c) { return py::make_tuple(packed_mesh(c.before), packed_mesh(c.after), c.outside); },
      [](const py::tuple& state) {
        require_pickle(state.size() == 3 && !state[0].is_none() && !state[1].is_none(), "a Transfer");
        return std::make_unique<Carrier>(unpacked_mesh(state[0]), unpacked_mesh(state[1]),
                                         state[2].cast<std::string>());
      }));
}

}  // namespace remodel::python
