#include "remodel/remodel.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "generate/recovery_error.h"
#include "generate/refine.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/methods.h"
#include "remodel/strategy.h"

namespace remodel {

const char* name_of(Method method) {
  switch (method) {
    case Method::automatic:
      return "auto";
    case Method::specialised:
      return "specialised";
    case Method::general:
      return "general";
  }
  return "unknown";
}

namespace {

using Loops = List<std::size_t>;  // of a domain

// All that a step changes besides the triangulation, which has its own journal. Taken back unless committed.
// The adjustment cache stays: it holds for the mesh as it was before the step.
class Transaction {
 public:
  // The step changes these loops at most: all, if not given.
  Transaction(MeshData& mesh, const std::optional<Loops>& loops)
      : mesh_(mesh),
        backup_(mesh.backup),
        structure_stays_(loops.has_value()),
        domain_triangles_(mesh.domain_triangles),
        step_(mesh.step) {
    backup_.renewal = mesh.renewal;
    backup_.loop_heads = mesh.loop_heads;
    backup_.sides = mesh.sides;
    if (loops) {
      backup_.changing.assign(loops->begin(), loops->end());
      backup_.loops.resize(loops->size());
      for (std::size_t i = 0; i < loops->size(); ++i) backup_.loops[i] = mesh.domain.loops[(*loops)[i]];
    } else {
      backup_.loops = mesh.domain.loops;
    }
    mesh.boundary.begin();
    mesh.triangulation.begin();
    mesh.triangulation.set_step(mesh.step + 1);
  }
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  ~Transaction() {
    if (committed_) return;
    mesh_.triangulation.rollback();
    mesh_.triangulation.set_step(step_);
    mesh_.boundary.rollback();
    mesh_.loop_heads.swap(backup_.loop_heads);
    mesh_.sides.swap(backup_.sides);
    if (structure_stays_)
      for (std::size_t i = 0; i < backup_.changing.size(); ++i)
        std::swap(mesh_.domain.loops[backup_.changing[i]], backup_.loops[i]);
    else
      mesh_.domain.loops.swap(backup_.loops);
    mesh_.index_curves();
    mesh_.forget_extent();
    mesh_.domain_triangles = domain_triangles_;
    mesh_.step = step_;
    std::swap(mesh_.renewal, backup_.renewal);
    if (mesh_.cache && replaced_) mesh_.cache->stale = stale_;
  }
  // A replacement is complete: the mesh is that of the new design, and can still be taken back.
  void replaced() {
    ++mesh_.step;
    replaced_ = true;
    if (!mesh_.cache) return;
    if (!same_rows())
      mesh_.cache.reset();
    else
      stale_ = std::exchange(mesh_.cache->stale, true);
  }
  void commit() {
    mesh_.triangulation.commit();
    mesh_.boundary.commit();
    committed_ = true;
  }

 private:
  // Whether what a stale cache keeps of the non-Steiner vertices holds for both domains.
  bool same_rows() const {
    if (!structure_stays_) return false;
    for (std::size_t i = 0; i < backup_.changing.size(); ++i) {
      const Loop &a = backup_.loops[i], &b = mesh_.domain.loops[backup_.changing[i]];
      for (std::size_t c = 0; c < a.curves.size(); ++c) {
        const auto* airfoil = std::get_if<CstAirfoil>(&a.curves[c].shape);
        if (airfoil != nullptr && !same_basis(*airfoil, std::get<CstAirfoil>(b.curves[c].shape)))
          return false;
      }
    }
    return true;
  }

  MeshData& mesh_;
  Backup& backup_;
  bool structure_stays_;
  std::size_t domain_triangles_;
  std::uint32_t step_;
  bool replaced_ = false, stale_ = false;  // stale_: of the cache, before replaced()
  bool committed_ = false;
};

// How a step is taken back: unless kept, when this goes.
class Undo {
 public:
  explicit Undo(Mesh& mesh) : mesh_(mesh), keep_(mesh.options().keep) {}
  Undo(const Undo&) = delete;
  Undo& operator=(const Undo&) = delete;
  ~Undo() {
    if (kept_) return;
    transaction_.reset();
    if (before_) mesh_ = std::move(*before_);
    mesh_.data().options.keep = keep_;
  }
  bool journalling() const { return transaction_.has_value(); }
  void begin(const std::optional<Loops>& loops) { transaction_.emplace(mesh_.data(), loops); }
  Transaction& transaction() { return *transaction_; }
  void roll_back() {
    transaction_.reset();
    mesh_.data().options.keep = keep_;
  }
  void replace_mesh(Mesh&& fresh) {
    roll_back();
    before_ = std::move(mesh_);
    mesh_ = std::move(fresh);
  }
  void keep() {
    if (transaction_) transaction_->commit();
    kept_ = true;
    transaction_.reset();
    before_.reset();
  }

 private:
  Mesh& mesh_;
  double keep_;  // of the mesh's options
  bool kept_ = false;
  std::optional<Transaction> transaction_;
  std::optional<Mesh> before_;  // a mesh that was generated afresh takes its place
};

// The loops that are not the same in the mesh's own domain and in the other: where the vertices of the two
// correspond one to one, and no other chain is joined to one that moves.
std::optional<Loops> moving_loops(const MeshData& mesh, const Domain& domain, Arena& arena) {
  const std::vector<Loop>&from = mesh.domain.loops, &to = domain.loops;
  if (from.size() != to.size()) return std::nullopt;
  Loops moving(&arena);
  bool open = false, joined = false;
  for (std::size_t i = 0; i < from.size(); ++i) {
    open |= to[i].open;
    if (from[i] == to[i]) continue;
    if (!one_to_one(from[i], to[i])) return std::nullopt;
    moving.push_back(i);
  }
  for (std::size_t i = 0; open && i < moving.size(); ++i)
    mesh.walk(mesh.loop_heads[moving[i]], [&](std::uint32_t k) { joined |= mesh.at(k).twin != k; });
  return joined ? std::nullopt : std::optional(std::move(moving));
}

// Airfoils whose surfaces cross are refused here, before anything is touched: this is cheap enough for every
// step. That no other curves cross follows for a full adjustment from its triangles, otherwise from
// validate().
void require_surfaces_apart(const Domain& domain) {
  for (std::size_t i = 0; i < domain.curve_count(); ++i)
    if (const auto* airfoil = std::get_if<CstAirfoil>(&domain.curve(i).shape))
      if (!surfaces_apart(*airfoil))
        throw Error(ErrorCode::geometry, domain.curve(i).name,
                    "the airfoil's surfaces touch or cross; expected upper above lower");
}

// The end of a full adjustment. Throws nothing.
RemodelResult full_adjustment(MeshData& mesh, AdjustCache& cache) {
  RemodelResult result;
  result.triangles_before = result.triangles = mesh.domain_triangles;
  result.full_adjustment = true;
  result.preserved = mesh.domain_triangles - cache.changed;
  for (std::size_t i = 0; i < cache.moving.size(); ++i)
    if (cache.changes_place(i)) ++result.moved;
  bool basis_kept = true;
  std::size_t n = 0;
  for (std::size_t i = 0; i < cache.loops.size(); ++i) {
    Loop& loop = mesh.domain.loops[cache.loops[i]];
    std::swap(loop.placement, cache.placements[i]);
    mesh.loop_moved(cache.loops[i]);
    for (Curve& curve : loop.curves) {
      curve.shape.swap(cache.shapes[n]);
      if (const auto* airfoil = std::get_if<CstAirfoil>(&curve.shape))
        basis_kept &= same_basis(std::get<CstAirfoil>(cache.shapes[n]), *airfoil);
      ++n;
    }
  }
  ++mesh.step;
  if (!basis_kept) mesh.cache.reset();
  return result;
}

// Counts what the journal's step left of the old domain triangles, and keeps the mesh's own count.
void count(MeshData& mesh, std::span<const VertexId> moved, RemodelResult& result) {
  const Triangulation& triangulation = mesh.triangulation;
  mesh.vertex_marks.clear(triangulation.vertex_slots());
  for (const VertexId v : moved) mesh.vertex_marks.visit(v.index);
  const auto survives = [&](TriangleId id, const Triangle& t) {
    for (const VertexId v : t.vertex)
      if (!triangulation[v].alive() || mesh.vertex_marks.visited(v.index)) return false;
    if (const Triangle& now = triangulation[id];
        now.alive() && now.region == Region::domain && Triangulation::same_edges(t, now))
      return true;
    const auto corner = triangulation.find_edge(t.vertex[0], t.vertex[1]);
    return corner && triangulation.vertex(*corner) == t.vertex[2] &&
           triangulation[corner->triangle].region == Region::domain;
  };
  std::size_t before = 0, lost = 0, after = 0;
  for (const Triangulation::Earlier& earlier : triangulation.earlier()) {
    if (!earlier.triangle.alive() || earlier.triangle.region != Region::domain) continue;
    ++before;
    if (!survives(earlier.id, earlier.triangle)) ++lost;
  }
  triangulation.for_each_moved_only([&](TriangleId t) {  // a vertex of it moved
    if (triangulation[t].region == Region::domain) ++lost;
  });
  for (const TriangleId t : triangulation.touched())
    if (triangulation[t].alive() && triangulation[t].region == Region::domain) ++after;
  result.triangles_before = mesh.domain_triangles;
  result.preserved = mesh.domain_triangles - lost;
  mesh.domain_triangles = mesh.domain_triangles - before + after;
  result.triangles = mesh.domain_triangles;
  result.moved = moved.size();
  result.inserted = triangulation.vertices_inserted();
  result.removed = triangulation.vertices_removed();
}

bool cancelled(StepObserver* observer) {
  return observer != nullptr && observer->cancelled();
}

// Refinement of what was touched. A refinement that needs several times the old mesh is running away.
// Triangles that still join the same vertices, at their old places or others, are kept: they need only hold
// what the mesh promises.
Stopped refine_touched(MeshData& mesh, StepObserver* observer) {
  const Triangulation& triangulation = mesh.triangulation;
  Refiner refiner(mesh, observer);
  const std::size_t runaway = 4 * triangulation.vertex_count() + 10000;
  refiner.limit_vertices(std::min<std::size_t>(mesh.options.max_vertices, runaway));
  triangulation.for_each_touched(
      [&](TriangleId t, bool same) { same ? refiner.consider_kept(t) : refiner.consider(t); });
  // Adjusted triangles are as good as the mesh promises, which may be less than what refinement makes.
  if (QualityBounds::of_refinement(mesh.options).squared_radius_edge <
      QualityBounds(mesh.options).squared_radius_edge)
    triangulation.for_each_moved_only([&](TriangleId t) { refiner.consider_kept(t); });
  return refiner.run();
}

// The vertices that are at other places, but are the same.
List<VertexId> replace_boundary(MeshData& mesh, AdjustCache* cache, const Domain& domain,
                                const ReplaceOptions& options) {
  if (cache != nullptr) {
    note_moved(mesh, cache->loops);
    return replace_where_needed(mesh, *cache, domain, options);
  }
  replace_loops(mesh, domain, options);
  note_all_moved(mesh);
  return List<VertexId>(&mesh.arena);
}

// The paper's remodelling after a full adjustment was not possible (cache) or does not apply (no cache),
// under the transaction. Returns why it could not be completed; then the caller takes the mesh back.
std::optional<std::string> replace(Transaction& transaction, MeshData& mesh, AdjustCache* cache,
                                   const Domain& domain, const RemodelOptions& options,
                                   RemodelResult& result) {
  const bool renewing = renews(mesh, options);
  try {
    const bool due = renewing && renewal_is_due(mesh);
    const std::size_t budget = due ? prepare_renewal(mesh, options.observer) : 0;
    const List<VertexId> moved =
        replace_boundary(mesh, cache, domain, {.distance = options.distance, .renewing = renewing});
    std::optional<RenewedSize> renewed;
    if (due) renewed = renew_replaced(mesh, moved, budget);
    result.stopped =
        cancelled(options.observer) ? Stopped::interrupted : refine_touched(mesh, options.observer);
    if (result.stopped != Stopped::done) return std::string("refinement stopped: ") + name_of(result.stopped);
    count(mesh, moved, result);
    if (renewing)
      finish_replacement(mesh, renewed);
    else
      forget_size(mesh);
  } catch (const RecoveryError& error) {
    return error.what();
  }
  transaction.replaced();
  return std::nullopt;
}

// Nothing changes: the design is the mesh's own already, or the step was cancelled.
RemodelResult unchanged(const MeshData& mesh, Stopped stopped) {
  RemodelResult result;
  result.triangles_before = result.triangles = result.preserved = mesh.domain_triangles;
  result.stopped = stopped;
  return result;
}

// A fresh mesh takes the place of the one from before the step.
RemodelResult exchange(Mesh& mesh, GenerateResult&& fresh, Undo& undo) {
  undo.roll_back();
  MeshData& data = fresh.mesh.data();
  data.step = mesh.step() + 1;
  data.imported.markers = mesh.data().imported.markers;
  for (std::uint32_t i = 0; i < data.triangulation.triangle_slots(); ++i)
    data.triangulation.set_birth(TriangleId{i}, data.step);
  RemodelResult result;
  result.removed = mesh.data().triangulation.vertex_count();
  result.inserted = data.triangulation.vertex_count();
  result.triangles_before = mesh.triangle_count();
  result.triangles = fresh.mesh.triangle_count();
  result.preserved = result.moved = 0;
  result.stopped = fresh.stopped;
  undo.replace_mesh(std::move(fresh.mesh));
  return result;
}

// After a step that failed and was taken back.
RemodelResult regenerate(Mesh& mesh, const Domain& domain, StepObserver* observer, std::string&& reason,
                         Undo& undo) {
  GenerateResult fresh = generate(domain, mesh.options(), observer);
  if (fresh.stopped == Stopped::interrupted) return unchanged(mesh.data(), Stopped::interrupted);
  fresh.mesh.data().renewal.take_count_factor(mesh.data().renewal);
  RemodelResult result = exchange(mesh, std::move(fresh), undo);
  result.regenerated = true;
  result.reason = std::move(reason);
  return result;
}

// After a full adjustment under a journal.
RemodelResult refresh(Mesh& mesh, RemodelResult&& adjusted, StepObserver* observer, Undo& undo) {
  std::optional<GenerateResult> fresh = nearer_to_fresh(mesh.data(), observer);
  if (!fresh) return std::move(adjusted);
  RemodelResult result = exchange(mesh, std::move(*fresh), undo);
  result.refreshed = true;
  return result;
}

void require_possible(const Mesh& mesh, const RemodelOptions& options, bool one_to_one) {
  if (!std::isfinite(options.distance) || options.distance < 0.0)
    throw Error(ErrorCode::argument, "distance",
                "found " + std::to_string(options.distance) + ", expected 0 or more");
  if (!(options.keep == 0.0 || (std::isfinite(options.keep) && options.keep >= 1.0)))
    throw Error(ErrorCode::argument, "keep",
                "found " + std::to_string(options.keep) + ", expected 1 or more, or 0 for the usual");
  if (options.designs_a_step == 0)
    throw Error(ErrorCode::argument, "designs_a_step", "found 0, expected 1 or more");
  if (options.method == Method::specialised && !one_to_one)
    throw Error(
        ErrorCode::argument, "method",
        "specialised needs two domains that correspond one to one, and no chain that joins what moves");
  if (mesh.data().triangulation.journalling())
    throw Error(ErrorCode::argument, "mesh",
                "a trial of another design is under way, expected it to be kept or ended");
}

// The specialised method removes stuck vertices before it inserts them anew: a loop that stays has to hold
// the mesh meanwhile.
bool keeps_a_loop(const MeshData& mesh, const AdjustCache& cache) {
  std::size_t closed = 0;
  for (const Loop& loop : mesh.domain.loops) closed += loop.open ? 0 : 1;
  for (const std::size_t loop : cache.loops) closed -= mesh.domain.loops[loop].open ? 0 : 1;
  return closed > 0;
}

// One step, which `undo` can take back. A full adjustment is the exception: it is journalled if undo is when
// the step begins (trials), otherwise it cannot be taken back, and does not need to be.
RemodelResult remodel_step(Mesh& mesh, const Domain& domain, const std::optional<Loops>& moving,
                           const RemodelOptions& options, Method& method, Undo& undo) {
  MeshData& data = mesh.data();
  AdjustCache* cache = nullptr;
  const bool renewing = renews(data, options);
  if (renewing) data.options.keep = std::max(data.options.keep, resolved_keep(options, data.options));
  if (method == Method::specialised) {
    cache = &adjust_cache(data, *moving);
    const bool due = renewing && refresh_is_due(data, data.renewal.full_adjustments, options.designs_a_step);
    data.renewal.pending_loops.reserve(data.domain.loops.size());  // below nothing may throw
    if (due && !undo.journalling()) undo.begin(moving);
    if (adjust_all(data, *cache, domain)) {
      note_moved(data, cache->loops);
      RemodelResult result = full_adjustment(data, *cache);  // the cache may be gone after it
      if (renewing) ++data.renewal.full_adjustments;
      return due ? refresh(mesh, std::move(result), options.observer, undo) : result;
    }
    if (!keeps_a_loop(data, *cache)) {
      cache = nullptr;
      method = Method::general;
    }
  }
  // A design that corresponds to the present one and cannot be meshed is found out by the replacement itself,
  // exactly: its loops cannot be recovered or do not nest. Then generation says where.
  if (cache == nullptr || !cache->finite()) validate(domain);
  if (cancelled(options.observer)) return undo.roll_back(), unchanged(data, Stopped::interrupted);
  if (!undo.journalling()) undo.begin(moving);
  RemodelResult result;
  auto failure = replace(undo.transaction(), data, cache, domain, options, result);
  if (!failure) return result;
  undo.roll_back();
  if (result.stopped == Stopped::interrupted) return unchanged(data, Stopped::interrupted);
  return regenerate(mesh, domain, options.observer, std::move(*failure), undo);
}

// Whether a full adjustment is journalled too.
enum class Journal { when_needed, always };

RemodelResult remodel(Mesh& mesh, const Domain& domain, const RemodelOptions& options, Journal journal,
                      Undo& undo) {
  const Arena::Scope scope(mesh.data().arena);
  std::optional<Loops> moving = moving_loops(mesh.data(), domain, mesh.data().arena);
  require_possible(mesh, options, moving.has_value());
  if (moving && moving->empty()) {
    RemodelResult result = unchanged(mesh.data(), Stopped::done);
    result.full_adjustment = true;
    return result;
  }
  require_surfaces_apart(domain);
  if (options.method == Method::general) moving.reset();
  Method method = moving ? Method::specialised : Method::general;
  if (journal == Journal::always) undo.begin(moving);
  RemodelResult result = remodel_step(mesh, domain, moving, options, method, undo);
  result.method = method;
  return result;
}

}  // namespace

RemodelResult remodel(Mesh& mesh, const Domain& domain, const RemodelOptions& options) {
  Undo undo(mesh);
  RemodelResult result = remodel(mesh, domain, options, Journal::when_needed, undo);
  undo.keep();
  return result;
}

struct Trial::Impl {
  explicit Impl(Mesh& mesh) : undo(mesh) {}
  Undo undo;
  RemodelResult result;
};

Trial::Trial(Mesh& mesh, const Domain& domain, const RemodelOptions& options)
    : impl_(std::make_unique<Impl>(mesh)) {
  impl_->result = remodel(mesh, domain, options, Journal::always, impl_->undo);
}
Trial::~Trial() = default;
const RemodelResult& Trial::result() const {
  return impl_->result;
}
void Trial::keep() {
  impl_->undo.keep();
}

}  // namespace remodel
