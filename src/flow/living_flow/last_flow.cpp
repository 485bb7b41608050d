#include "flow/living_flow/last_flow.h"

#include <algorithm>

#include "flow/physics/state.h"
#include "flow/solution.h"
#include "remodel/error.h"

namespace remodel::flow {

Keys keys_of(const FrozenMesh& frozen) {
  if (frozen.vertex_keys.size() != frozen.points.size())
    throw Error(ErrorCode::argument, "mesh",
                "found " + std::to_string(frozen.vertex_keys.size()) +
                    " keys of vertices, expected one for each of " + std::to_string(frozen.points.size()) +
                    " points");
  Keys keys;
  keys.reserve(frozen.vertex_keys.size());
  for (const std::uint64_t key : frozen.vertex_keys) keys.push_back(VertexKey::of(key));
  return keys;
}

KeyTable::KeyTable(const Keys& keys) {
  for (std::uint32_t i = 0; i < keys.size(); ++i) {
    const std::uint32_t id = keys[i].id.index;
    std::vector<Place>& at = at_[is_of_layer(keys[i])];
    if (id >= at.size()) at.resize(id + 1, {no_index, 0});
    at[id] = {i, keys[i].generation};
  }
}

template <std::size_t N>
BlockState<N> LastFlow<N>::carried(const FlowMesh& now, const Keys& now_keys,
                                   const Stream& now_stream) const {
  BlockState<N> carried;
  carried.augmented = state.augmented;
  carried.augmented[0] *= stream.length / now_stream.length;
  if (!now_stream.lift) carried.augmented[1] = now_stream.alpha;
  const KeyTable table(keys);
  std::vector<std::uint32_t> fresh;
  std::vector<Point> places;
  carried.q.resize(now.size());
  for (std::uint32_t v = 0; v < now.size(); ++v) {
    const std::uint32_t old = table.find(now_keys[v]);
    if (old != no_index) {
      carried.q[v] = state.q[old];
    } else {
      fresh.push_back(v);
      places.push_back(now.points()[v]);
    }
  }
  if (fresh.empty()) return carried;
  const BlockVector<N> values = interpolated<N>(*mesh, state.q, places);
  for (std::size_t i = 0; i < fresh.size(); ++i) carried.q[fresh[i]] = values[i];
  return carried;
}

template <std::size_t N>
LastFlow<N> LastFlow<N>::changed(const LastFlow& from, const LastFlow& to) const {
  LastFlow result{
      .mesh = to.mesh, .keys = to.keys, .state = carried(*to.mesh, to.keys, stream), .stream = stream};
  const BlockState<N> before = from.carried(*to.mesh, to.keys, to.stream);
  for (std::size_t v = 0; v < result.state.q.size(); ++v) {
    auto q = result.state.q[v];
    for (std::size_t k = 0; k < N; ++k) q[k] += to.state.q[v][k] - before.q[v][k];
    if (std::all_of(positive_unknowns.begin(), positive_unknowns.end(),
                    [&](std::size_t k) { return q[k] > 0.0; }))
      result.state.q[v] = q;
  }
  for (std::size_t z = 0; z < augmented_count; ++z)
    result.state.augmented[z] += to.state.augmented[z] - before.augmented[z];
  return result;
}

template struct LastFlow<4>;
template struct LastFlow<5>;

}  // namespace remodel::flow
