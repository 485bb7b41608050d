#pragma once

// The last flow that was found, by the keys of vertices, and what another mesh takes over of it.

#include <array>
#include <memory>

#include "flow/scheme/block_system.h"
#include "remodel/frozen_mesh.h"
#include "remodel/ids.h"

namespace remodel::flow {

using Keys = std::vector<VertexKey>;

// Throws Error (argument) where points have no keys.
Keys keys_of(const FrozenMesh& frozen);

// Vertices found by their keys.
class KeyTable {
 public:
  KeyTable() = default;
  explicit KeyTable(const Keys& keys);
  // The position among the keys; no_index if it is none of them.
  std::uint32_t find(VertexKey key) const {
    const std::vector<Place>& at = at_[is_of_layer(key)];
    if (key.id.index >= at.size() || at[key.id.index].generation != key.generation) return no_index;
    return at[key.id.index].position;
  }

 private:
  struct Place {
    std::uint32_t position, generation;
  };
  // Of layers, which count their vertices by themselves (LayeredMesh::freeze()).
  static bool is_of_layer(VertexKey key) { return key.generation >= std::uint32_t{1} << 31; }
  std::array<std::vector<Place>, 2> at_;
};

template <std::size_t N>
struct LastFlow {
  std::shared_ptr<const FlowMesh> mesh;  // none: no flow was found yet
  Keys keys;
  BlockState<N> state;
  Stream stream;

  bool found() const { return mesh != nullptr; }
  // The state on another mesh: values at vertices that are there still are kept, those at new ones
  // interpolated.
  BlockState<N> carried(const FlowMesh& now, const Keys& now_keys, const Stream& now_stream) const;
  // This flow on to's mesh, changed by what `to` has beyond `from` at each vertex; unchanged where that would
  // leave no density or pressure.
  LastFlow changed(const LastFlow& from, const LastFlow& to) const;
};

}  // namespace remodel::flow
