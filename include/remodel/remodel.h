#pragma once

// Replaces the domain inside a living mesh by another. Source: the paper's sections 3 (general method)
// and 4.2 (specialised method); where we depart is said at each function of src/step.

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "remodel/mesh.h"

namespace remodel {

// QualityOptions::refine_angle_deg of meshes that Strategy::reference is to hold: as given, but at least so
// many degrees more than the angle that they promise. Two degrees hold most designs, and cost a third more
// triangles at I = 200, four times as many at I = 100; one degree costs 2 and 57 per cent.
double angle_with_slack(const QualityOptions& quality, double slack_deg = 2.0);

// How a mesh follows its domain. It is one choice, by the same names everywhere: remodel() and Trial, the
// program's `update`, `batch` and `optimise`, Python. docs/strategies.md argues for the default with figures.
//
//   strategy    what a step keeps           when to choose it
//   renew       most triangles, in place    the default: the cheapest steps
//   morph       connectivity                a flow follows the mesh: its state, its factors
//   reference   connectivity, and one       gradients, finite differences: meshes are a smooth function
//               mesh for each design        of designs
//   chain       as the paper has it         comparisons with the paper
//
// Three other words say more of the same choice. Method: which of the paper's two methods a step may use.
// MeshStrategy (remodel/living_mesh.h): the choice of a run, one of these or one of the paper's improvements.
// `update --reference MESH`: Strategy::reference, with the reference named.
enum class Strategy {
  // The paper's method, to the letter. Length scales inside the mesh are never renewed, and nothing is
  // coarsened: triangles accumulate.
  chain,
  // At every fifteenth replacement length scales are renewed from the boundary. Kept triangles need only hold
  // keep H. Steiner vertices are removed while the mesh has more triangles than a fresh one would. Around
  // boundary vertices that cannot be moved in place although they hardly move, more is removed. After 25 full
  // adjustments in a row a mesh whose count is off is generated afresh. The angle bound never relaxes.
  // Imported meshes, whose length scales are measured, are remodelled as by chain.
  renew,
  // This is renew, but where not all boundary vertices can be moved in place with the interior still, single
  // vertices beside them move too, and where that is not enough the whole interior moves along
  // (remodel/displacement.h): almost all triangles go on joining the same vertices. Vertices around what
  // misses a bound then are moved until it is met; edges that are not Delaunay after that are flipped, and
  // triangles refined. A large change is made in several parts. Where triangles turn over all the same, or
  // the mesh has a fifth more triangles than a fresh one, the step is that of renew. Vertices of imported
  // meshes move too; their length scales are not renewed.
  morph,
  // The mesh of a design is the morph of one reference mesh, whatever designs came in between: the same
  // design has the same mesh, to the last bit, and what is computed on meshes is a smooth function of
  // designs. The first reference is the mesh itself. All vertices move by the field of
  // remodel/displacement.h, at the reference's places. Connectivity is held as long as no triangle turns
  // over or misses its angle or the kept gradation bound, although edges are no longer Delaunay: the angles
  // opposite to them sum up to at most 180 degrees and RemodelOptions::delaunay_slack_deg. Where that is
  // not possible the reference is morphed to the design, and the mesh is the new reference. Meshes with
  // slack in their angles are held longer (QualityOptions::refine_angle_deg).
  reference,
};
struct StrategyInfo {
  Strategy strategy;
  const char* name;         // "chain", "renew", "morph", "reference"
  const char* description;  // half a sentence
};
std::span<const StrategyInfo> strategies();  // in the order of the enumeration
const char* name_of(Strategy strategy);
// Throws Error (argument) listing the names.
Strategy strategy_named(const std::string& name);
// The strategy of steps about which nothing else is said, and that of meshes that a flow follows: `flow
// --series`, `noise`. Designs have design_strategy (remodel/design_problem.h).
inline constexpr Strategy default_strategy = Strategy::renew, strategy_with_flows = Strategy::morph;

// Which of the paper's two methods a step may use: the specialised one (section 4.2) moves and replaces
// single boundary vertices, the general one (section 3) replaces whole loops. `automatic`: specialised where
// the domains correspond, general otherwise.
enum class Method { automatic, specialised, general };
const char* name_of(Method method);            // "auto", "specialised", "general"
Method method_named(const std::string& name);  // likewise

struct RemodelOptions {
  double distance = 1.0;  // D: removal radius over the distance of a pair of old and new vertices; >= 0
  Method method = Method::automatic;
  Strategy strategy = default_strategy;
  double keep = 0.0;  // renew: QualityOptions::keep of the mesh is at least this from now on; 1 or more, or
                      // 0: 1.1 for gradations up to 1, 1.2 up to 2, otherwise 1.25
  // renew: of how many designs, tried on other meshes too, a step of this mesh is one; 1 or more. Its
  // triangle count is looked at so much earlier.
  std::uint32_t designs_a_step = 1;
  // reference: how far beyond 180 degrees the angles opposite an inner edge may sum up; 0 to 60.
  double delaunay_slack_deg = 20.0;
  // A step that cannot be completed ends with a mesh that is generated afresh if this is true. If not, the
  // mesh stays as it was, and the result is abandoned.
  bool regenerate = true;
  StepObserver* observer = nullptr;  // if cancelled, the mesh stays as it was and the result says interrupted
};

struct RemodelResult {
  std::size_t triangles_before = 0;
  std::size_t triangles = 0;
  std::size_t preserved = 0;  // old domain triangles still there with all three vertices unmoved
  std::size_t connected = 0;  // old domain triangles whose vertices a triangle still joins, moved or not
  std::size_t moved = 0;     // vertices at another place than before, but the same: boundary vertices, unless
                             // the step morphed the mesh
  std::size_t inserted = 0;  // vertices
  std::size_t removed = 0;
  std::size_t flipped = 0;       // flips of edges
  bool full_adjustment = false;  // every vertex that moved did so in place, connectivity unchanged
  bool morphed = false;          // Strategy::morph: the interior moved too, all or beside the boundary
  bool held = false;             // Strategy::reference: a morph of the reference; if not, it is a new one
  Method method = Method::specialised;  // the one that ran
  bool refreshed = false;               // the strategy generated the mesh afresh: its triangle count was off
  bool regenerated = false;             // remodelling could not be completed: the mesh was generated afresh
  bool abandoned = false;               // the same without RemodelOptions::regenerate: the mesh is as it was
  std::string reason;                   // why it was regenerated or abandoned
  Stopped stopped = Stopped::done;
  double preserved_percent() const { return percent(preserved); }
  double connectivity_percent() const { return percent(connected); }
  std::size_t born() const { return triangles - connected; }         // triangles that joined nothing before
  std::size_t gone() const { return triangles_before - connected; }  // and those that join nothing now

 private:
  double percent(std::size_t count) const {
    return triangles_before == 0 ? 100.0
                                 : 100.0 * static_cast<double>(count) / static_cast<double>(triangles_before);
  }
};

// Remodels mesh, in place, to the new domain. The loops of the two are paired by geometry: what is at the
// same places in both is kept to the last bit, whatever the order of the loops, their direction and where
// they begin; of the rest, loops of one name, or that lie where an old one lay, follow that one. Where the
// stations of two loops differ in parts (an edge that opens, a corner more), the others still correspond and
// move.
//
// Mesh::domain() then has the loops in the new domain's order, with its names, roles and regions. A loop that
// is at the same places as before, to the last rounding, but written otherwise (backwards, from another
// corner) keeps the curves that the mesh has: coefficients_of() and MeshDerivative go by Mesh::domain().
//
// The mesh is valid before and after: if the new domain is no domain (validate() throws Error), the observer
// cancels, or anything else throws (std::bad_alloc, an observer of its own), it is as it was, to the last
// bit. Invalidates: triangles and vertices near the change; ids of what survives do not change.
RemodelResult remodel(Mesh& mesh, const Domain& domain, const RemodelOptions& options = {});

// Tries a design: the mesh is remodelled, as by remodel(), and returns to what it was, to the last bit and
// ids included, when the trial ends, unless it is kept. The cost of returning is proportional to what
// changed, plus a copy of the boundary table.
//
//   Trial trial(mesh, design);
//   if (score(mesh.freeze()) < best) trial.keep();
//
// While the trial lasts the mesh stays where it is and may be read and copied, but not remodelled (that
// throws Error).
class Trial {
 public:
  // Throws as remodel() does.
  Trial(Mesh& mesh, const Domain& domain, const RemodelOptions& options = {});
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;
  ~Trial();

  const RemodelResult& result() const;
  void keep();  // the trial is over, the mesh stays as it is now

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace remodel
