#pragma once

// The living meshes of a run: how they follow its designs, and the record of one step.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <tuple>

#include "remodel/figures.h"
#include "remodel/remodel.h"

namespace remodel {

// How the meshes of a run follow its designs: how a step is made, which mesh it starts from, and how many
// meshes there are unless the run says so.
enum class MeshStrategy {
  chain,  // Strategy::chain, from the mesh that the same worker had for its design before
  renew,  // Strategy::renew, likewise
  pool,   // as renew, with as many workers as a generation has designs
  // Strategy::renew. One mesh, the hub, is kept near the centre of the designer's distribution. Each design
  // is tried on a copy of it, which then returns to it. Losses are counted against the mesh that the same
  // worker had before: a triangle is preserved where the same three vertices, by id, at the same coordinates,
  // are joined in both. Meshes, unlike losses, do not depend on the number of workers.
  hub,
  // A chain, but the mesh is generated for the designs that a criterion chooses: the paper's section 5,
  // "Improvements". It chooses those where a vertex of the last design and its place on this one are more
  // than 8 local length scales apart, and once after ten full adjustments in a row.
  regenerate,
  morph,  // Strategy::morph, as renew
  // Strategy::reference, as renew: each worker has a reference of its own. Meshes that are generated have
  // angle_with_slack(), so that it is held longer.
  reference,
};

struct MeshStrategyInfo {
  MeshStrategy strategy;
  const char* name;
  const char* description;  // half a sentence
  Strategy step;
};
std::span<const MeshStrategyInfo> mesh_strategies();  // in the order of the enumeration
const MeshStrategyInfo& info_of(MeshStrategy strategy);
inline const char* name_of(MeshStrategy strategy) {
  return info_of(strategy).name;
}
// Throws Error (argument) listing the names.
MeshStrategy mesh_strategy(const std::string& name);

// How a remodelled mesh was validated: by the rules of Mesh::quick_check() where the step changed it, which
// is enough if the mesh before was valid; by quick_check(); by check() of check.h as well.
enum class Checked { changes, quick, full };
const char* name_of(Checked checked);
Checked checked_named(const std::string& name);  // throws std::invalid_argument

// The result of a step of a living mesh.
struct MeshStep {
  std::size_t triangles_before = 0;  // of the mesh that the same worker had for its evaluation before
  std::size_t triangles = 0;
  std::size_t preserved = 0;
  double preserved_percent = 0.0;
  std::size_t connected = 0;  // triangles of before whose three vertices are joined still, moved or not
  double connectivity_percent = 0.0;
  std::size_t moved = 0;
  std::size_t inserted = 0;
  std::size_t removed = 0;
  std::size_t flipped = 0;  // flips of edges
  bool full_adjustment = false;
  bool morphed = false;        // the interior moved along with the boundary
  bool refreshed = false;      // the strategy generated the mesh afresh
  bool regenerated = false;    // the mesh had to be regenerated: a recovery
  double min_angle_deg = 0.0;  // of the mesh; where its changes were checked, of these
  // Making the domain and remodel(), the recovery too if there was one: processor time of the thread.
  double remodel_seconds = 0.0;

  std::optional<std::size_t>
      generated_triangles{};  // compared evaluations only: a fresh mesh of the same design
  std::optional<double> gradation_bias{}, gradation_deviation{};  // of the remodelled mesh: GradationError
  std::optional<double> generated_gradation_bias{}, generated_gradation_deviation{};  // of the fresh one
  std::optional<double> generate_seconds{};  // making the domain and generate(): likewise

  Checked checked = Checked::quick;
  bool valid = true;  // what the remodelled mesh was before any recovery
  std::string
      detail{};  // the broken rule, why the mesh was regenerated or the evaluation failed; mostly empty

  // Triangles born and gone: 0 where connectivity was kept whole.
  std::size_t changed() const { return triangles_before + triangles - 2 * connected; }
};

inline constexpr std::tuple mesh_step_figures{
    Figure{"triangles_before", "triangles before", "", &MeshStep::triangles_before},
    Figure{"triangles", "triangles", "", &MeshStep::triangles},
    Figure{"preserved", "preserved", "triangles", &MeshStep::preserved},
    Figure{"preserved_percent", "preserved", "%", &MeshStep::preserved_percent},
    Figure{"connected", "joined as before", "triangles", &MeshStep::connected},
    Figure{"connectivity_percent", "joined as before", "%", &MeshStep::connectivity_percent},
    Figure{"moved", "moved", "vertices", &MeshStep::moved},
    Figure{"inserted", "inserted", "vertices", &MeshStep::inserted},
    Figure{"removed", "removed", "vertices", &MeshStep::removed},
    Figure{"flipped", "flipped", "edges", &MeshStep::flipped},
    Figure{"morphed", "morphed", "", &MeshStep::morphed},
    Figure{"full_adjustment", "full adjustment", "", &MeshStep::full_adjustment},
    Figure{"refreshed", "generated afresh by the strategy", "", &MeshStep::refreshed},
    Figure{"regenerated", "regenerated", "", &MeshStep::regenerated},
    Figure{"min_angle_deg", "smallest angle", "degrees", &MeshStep::min_angle_deg},
    Figure{"remodel_seconds", "remodelling", "seconds", &MeshStep::remodel_seconds},
    Figure{"generated_triangles", "of a fresh mesh", "triangles", &MeshStep::generated_triangles},
    Figure{"gradation_bias", "gradation error, bias", "", &MeshStep::gradation_bias},
    Figure{"gradation_deviation", "gradation error, deviation", "", &MeshStep::gradation_deviation},
    Figure{"generated_gradation_bias", "of a fresh mesh, bias", "", &MeshStep::generated_gradation_bias},
    Figure{"generated_gradation_deviation", "of a fresh mesh, deviation", "",
           &MeshStep::generated_gradation_deviation},
    Figure{"generate_seconds", "generation", "seconds", &MeshStep::generate_seconds},
    Figure{"checked", "checked", "", &MeshStep::checked},
    Figure{"valid", "valid", "", &MeshStep::valid},
    Figure{"detail", "detail", "", &MeshStep::detail}};

}  // namespace remodel
