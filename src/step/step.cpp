#include "step/step.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "generate/discretise.h"
#include "generate/recovery_error.h"
#include "generate/refine.h"
#include "generate/require_option.h"
#include "mesh/option_ranges.h"
#include "mesh/renew_policy.h"
#include "remodel/error.h"
#include "step/coarsen.h"
#include "step/follow.h"
#include "step/methods.h"
#include "step/outcome.h"
#include "step/strategy.h"

namespace remodel {

namespace {

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

// Refinement of what the step touched. One that needs several times the old mesh is running away. Triangles
// that still join the same vertices, at their old places or others, are kept: they need only hold what the
// mesh promises.
Stopped refine_touched(MeshData& mesh, Step::Made made, StepObserver* observer) {
  const bool morphed = made != Step::Made::replaced;
  const Triangulation& triangulation = mesh.triangulation;
  Refiner refiner(mesh, observer);
  const std::size_t count = triangulation.vertex_count();
  const std::size_t runaway = morphed ? count + count / 2 + 1000 : 8 * count + 10000;
  refiner.limit_vertices(std::min<std::size_t>(mesh.options.max_vertices, runaway));
  if (morphed) {
    const auto consider = [&](TriangleId t) {
      made == Step::Made::reference ? refiner.consider_kept(t) : refiner.consider_morphed(t);
    };
    triangulation.for_each_touched([&](TriangleId t, bool) { consider(t); });
    mesh.seen_triangles.clear(triangulation.triangle_slots());
    triangulation.for_each_moved_only([&](TriangleId t) {
      if (mesh.seen_triangles.insert(t)) consider(t);  // once: it may have moved in parts
    });
    return refiner.run();
  }
  triangulation.for_each_touched(
      [&](TriangleId t, bool same) { same ? refiner.consider_kept(t) : refiner.consider(t); });
  // Adjusted triangles are as good as the mesh promises, which may be less than what refinement makes.
  if (QualityBounds::of_refinement(mesh.options).squared_radius_edge <
      mesh.promised_bounds().squared_radius_edge)
    triangulation.for_each_moved_only([&](TriangleId t) { refiner.consider_kept(t); });
  return refiner.run();
}

void note_adjustment(const MeshData& mesh, const AdjustCache& cache, ChangeRecord& record) {
  const bool first = record.vertices().empty();
  for (std::size_t i = 0; i < cache.moving.size(); ++i) {
    if (!cache.changes_place(i)) continue;
    const VertexId v = cache.moving[i].vertex;
    const std::uint32_t generation = mesh.triangulation.generation(v);
    if (first)
      record.note_first(v, generation, cache.old_points[i]);
    else
      record.note({v, true, generation, cache.old_points[i]});
  }
  record.note_loops(cache.loops);
}

// Before anything asks it for more.
const Mesh& require_mesh(const Mesh& mesh) {
  if (mesh.empty())
    throw Error(ErrorCode::argument, "mesh",
                "found an empty one, expected one that was generated, imported or read");
  return mesh;
}

}  // namespace

Step::Step(Mesh& mesh, const Domain& domain, const RemodelOptions& options, Journal journal)
    : mesh_(mesh),
      wanted_(domain),
      options_(options),
      journalling_(journal),
      keep_before_(require_mesh(mesh).keep()),
      outside_before_(mesh.data().outside_restored),
      marked_before_(mesh.data().marked.now()) {}

Step::~Step() {
  if (kept_) return;
  journal_.reset();
  if (before_) exchange_back(mesh_, *std::move(before_));
  take_back();
  if (renaming_) renaming_->undo(data());
}

void Step::take_back() {
  journal_.reset();
  if (plan_.structure_differs) data().cache.reset();  // it may be of the boundary that was taken back
  data().keep = keep_before_;
  data().outside_restored = outside_before_;
  data().marked.return_to(marked_before_);
}

void Step::keep() {
  if (journal_) journal_->commit();
  kept_ = true;
  journal_.reset();
  before_.reset();
}

void Step::require_options() const {
  require_option(std::isfinite(options_.distance) && options_.distance >= 0.0, "distance", options_.distance,
                 "0 or more");
  for (const auto& found :
       {slack_out_of_range(options_.delaunay_slack_deg),
        options_.keep == 0.0 ? std::nullopt : keep_out_of_range(options_.keep)})  // 0: the usual
    if (found) throw Error(ErrorCode::argument, found->option, found->problem);
  if (options_.designs_a_step == 0)
    throw Error(ErrorCode::argument, "designs_a_step", "found 0, expected 1 or more");
  if (mesh_.data().triangulation.journalling())
    throw Error(ErrorCode::argument, "mesh",
                "a trial of another design is under way, expected it to be kept or ended");
}

void Step::require_method() const {
  if (options_.method != Method::specialised || plan_.specialises()) return;
  throw Error(
      ErrorCode::argument, "method",
      "specialised needs two domains that correspond one to one, but for a few stations, and no chain that "
      "joins what moves");
}

RemodelResult Step::run() {
  const Arena::Scope scope(data().arena);
  require_options();
  compare_domains();
  require_method();
  RemodelResult result = remodel();
  const bool as_it_was = result.abandoned || result.stopped == Stopped::interrupted;
  if (renaming_ && as_it_was && !before_) {
    renaming_->undo(data());
    renaming_.reset();
  }
  plan_.moving.reset();
  places_before_.reset();
  return result;
}

RemodelResult Step::remodel() {
  if (wanted_.periodic != data().domain.periodic) {
    validate(domain());
    failure_ = "the domain has other periodic curves than the mesh";
    return options_.regenerate ? regenerate() : abandon();
  }
  if (plan_.moving && plan_.moving->empty()) {
    RemodelResult result = unchanged(data());
    result.full_adjustment = true;
    result.held = options_.strategy == Strategy::reference;
    result.method = Method::specialised;
    return result;
  }
  require_surfaces_apart(domain());
  choose_method();
  if (journalling_ == Journal::always) begin_journal();
  plan_.renews = renews(data(), options_);
  if (plan_.renews) data().keep = std::max(data().keep, resolved_keep(options_, data().options));
  open_hull_that_moves();
  std::optional<RemodelResult> followed = follow();
  RemodelResult result = followed ? *std::move(followed) : adjust_or_replace();
  result.method = attempt_.method;
  return result;
}

// Domains that are none are refused here. A mesh that has the wanted structure by other names gets these
// first.
void Step::compare_domains() {
  plan_.compare(data(), wanted_);
  if (!plan_.renames(data().domain)) return;
  renaming_.emplace(data(), *plan_.correspondence);
  data().marked.for_each([](ChangeRecord& record) { record.note_all_loops(); });
  plan_.compare_loops(data(), data().domain, wanted_);
}

void Step::choose_method() {
  plan_.choose_method(options_.method);
  attempt_ = {.method = plan_.method};
}

void Step::begin_journal() {
  // From a reference other loops than those of the step may change too.
  const bool these_alone = attempt_.method == Method::specialised && !data().reference;
  const std::optional<LoopIndices> any;
  journal_.emplace(data(), these_alone ? plan_.moving : any);
  if (places_before_ && data().reference) return_to_reference(data());
}

// So that vertices of the outer boundary can be moved in place. The paper's method does without.
void Step::open_hull_that_moves() {
  if (options_.strategy == Strategy::chain || attempt_.method != Method::specialised || !plan_.moving) return;
  if (!moves_outermost(data(), *plan_.moving) || hull_is_open(data())) return;
  if (!journal_) begin_journal();
  open_hull(data());
}

// As Strategy::reference has it. Nothing where the design's mesh is no morph of the reference: then the step
// starts from that.
std::optional<RemodelResult> Step::follow() {
  MeshData& mesh = data();
  if (mesh.reference) {
    plan_.compare_loops(mesh, mesh.reference->domain, wanted_);
    choose_method();
  }
  if (options_.strategy == Strategy::reference && plan_.moving) {
    RemodelResult result = follow_reference(mesh, domain(), *plan_.moving, options_.delaunay_slack_deg);
    if (result.held) {
      result.stopped = what_still_stops();
      return result;
    }
  }
  if (!mesh.reference) return std::nullopt;
  leave_reference();
  if (plan_.structure_differs) plan_.correspondence = correspond(mesh.domain, wanted_);
  return std::nullopt;
}

void Step::leave_reference() {
  const Triangulation& triangulation = data().triangulation;
  places_before_.emplace(&data().arena);
  for (std::uint32_t i = 0; i < triangulation.vertex_slots(); ++i)
    places_before_->push_back(triangulation.point(VertexId{i}));
  if (journal_)
    return_to_reference(data());
  else
    begin_journal();
}

// Where the step left a reference: the vertices that are the same at another place than before the step.
List<VertexId> Step::moved_since_before() const {
  const Triangulation& triangulation = mesh_.data().triangulation;
  List<VertexId> moved(&mesh_.data().arena);
  for (std::uint32_t i = 1; i < places_before_->size(); ++i)
    if (const VertexId v{i}; triangulation[v].alive() && !(triangulation.point(v) == (*places_before_)[i]))
      moved.push_back(v);
  return moved;
}

// The reference's own vertices were at their places, or could be moved there with its interior still.
RemodelResult Step::finish_return() {
  MeshData& mesh = data();
  for (const std::size_t loop : *plan_.moving) {
    mesh.domain.loops[loop] = domain().loops[loop];
    mesh.loop_moved(loop);
  }
  RemodelResult result = count_replacement(mesh, moved_since_before());
  result.full_adjustment = true;
  note_replacement();
  journal_->replaced();
  return result;
}

RemodelResult Step::adjust_or_replace() {
  if (adjust_in_place()) return places_before_ ? finish_return() : finish_adjustment();
  // A design that corresponds to the present one and cannot be meshed is found out by the replacement itself,
  // exactly: its loops cannot be recovered or do not nest. Then generation says where.
  if (cache_ == nullptr || !cache_->finite()) validate(domain());
  if (cancelled()) return take_back(), interrupted(data());
  if (attempt_in_turn()) return std::move(result_);
  take_back();
  if (result_.stopped == Stopped::interrupted) return interrupted(data());
  return options_.regenerate ? regenerate() : abandon();
}

bool Step::adjust_in_place() {
  if (plan_.method != Method::specialised) return false;
  MeshData& mesh = data();
  if (plan_.moving->empty()) return true;  // the design is the reference's
  cache_ = &adjust_cache(mesh, *plan_.moving);
  refresh_is_due_ = plan_.renews && !places_before_ && refresh_is_due(mesh, options_.designs_a_step);
  // Once vertices move nothing may throw, unless there is a journal: room is made before.
  mesh.renewal.pending_loops.reserve(mesh.domain.loops.size());
  mesh.marked.for_each([&](ChangeRecord& record) {
    record.reserve(cache_->moving.size(), mesh.triangulation.vertex_slots(), mesh.domain.loops.size());
  });
  if (refresh_is_due_ && !journal_) begin_journal();
  return adjust_all(mesh, *cache_, domain());
}

RemodelResult Step::finish_adjustment() {
  MeshData& mesh = data();
  note_moved(mesh, cache_->loops);
  mesh.marked.for_each([&](ChangeRecord& record) { note_adjustment(mesh, *cache_, record); });
  mesh.outside_restored = false;
  RemodelResult result = remodel::finish_adjustment(mesh, *cache_);
  result.stopped = what_still_stops();
  if (plan_.renews) ++mesh.renewal.full_adjustments;
  if (!refresh_is_due_) return result;
  std::optional<GenerateResult> fresh = nearer_to_fresh(mesh, options_.observer);
  if (!fresh) return result;
  result = exchange(std::move(*fresh));
  result.refreshed = true;
  return result;
}

// After a full adjustment was not possible or does not apply. False, with the reason in failure_, if no
// attempt can be completed. What has to shed does not morph: replaced, it is as dense along the walls as a
// fresh mesh, and sheds less often.
bool Step::attempt_in_turn() {
  const bool morphs = keeps_connectivity() && (cache_ == nullptr || cache_->finite()) &&
                      !has_surplus(data(), RenewPolicy::morph_surplus);
  for (const Attempt& attempt : plan_.attempts(data().arena, options_, morphs)) {
    attempt_ = attempt;
    if (attempt.method == Method::general) cache_ = nullptr;
    if (make_attempt()) return true;
    // A refinement that does not end after a replacement would not end after the other method's either.
    const bool hopeless = attempt.replaces_all_that_moves() && result_.stopped != Stopped::done;
    if (hopeless || result_.stopped == Stopped::interrupted) return false;
    forget_attempt();
  }
  return false;
}

void Step::forget_attempt() {
  journal_.reset();
  result_ = {};
  if (!plan_.structure_differs) return;
  cache_ = nullptr;
  data().cache.reset();
}

bool Step::make_attempt() {
  if (!journal_) begin_journal();
  try {
    if (!change_under_journal()) return false;
  } catch (const RecoveryError& error) {
    failure_ = error.what();
    return false;
  }
  note_replacement();
  data().outside_restored = leaves_outside_restored();
  journal_->replaced();
  return true;
}

// The specialised method ends with all of it Delaunay; the hull is as it was where the outermost loop rests.
bool Step::leaves_outside_restored() const {
  if (cache_ == nullptr || attempt_.interior || plan_.structure_differs) return false;
  return std::ranges::none_of(cache_->loops,
                              [&](std::size_t loop) { return domain().loops[loop].role == LoopRole::outer; });
}

bool Step::change_under_journal() {
  MeshData& mesh = data();
  const bool renewal = plan_.renews && renewal_is_due(mesh);
  const std::size_t budget = renewal ? prepare_renewal(mesh, options_.observer) : 0;
  if (attempt_.interior && !plan_.renews) count_imported(mesh);
  const bool surplus = keeps_connectivity() && has_surplus(mesh, RenewPolicy::morph_surplus);
  const std::optional<List<VertexId>> moved = change_boundary();
  if (!moved) return false;
  if (renewal) renew_replaced(mesh, *moved, budget);
  // Morphs take along the Steiner vertices of boundaries, which replacements make anew.
  if (renewal && attempt_.interior) dissolve_dense(mesh, RenewPolicy::dense_below);
  result_.stopped = cancelled() ? Stopped::interrupted : refine_touched(mesh, made(), options_.observer);
  if (plan_.renews && plan_.other_discretisation) discretisation_changed(mesh, options_.observer);
  if (surplus || (plan_.renews && mesh.renewal.until_shed > 0)) shed_and_refine();
  if (result_.stopped != Stopped::done) {
    failure_ = std::string("refinement stopped: ") + name_of(result_.stopped);
    if (result_.stopped == Stopped::vertex_budget &&
        mesh.triangulation.vertex_count() < mesh.options.max_vertices)
      failure_ = "refinement ran away: it needed several times as many vertices as the mesh had";
    return false;
  }
  require_points_in_domain(mesh);
  result_ = places_before_ ? count_replacement(mesh, moved_since_before()) : count_replacement(mesh, *moved);
  result_.morphed = attempt_.interior.has_value();
  result_.stopped = what_still_stops();
  if (plan_.renews)
    finish_replacement(mesh, renewal);
  else
    replaced_by_chain(mesh);
  return true;
}

// A boundary of fewer points than before leaves a mesh that is far too dense, and so may a row of morphs.
// Steiner vertices that the dense mesh put on boundaries go first: they would keep what lies around them
// dense.
void Step::shed_and_refine() {
  bool dissolved = dissolve_dense(data(), RenewPolicy::dense_below);
  for (int pass = 0; pass < RenewPolicy::shedding_passes; ++pass) {
    if (result_.stopped != Stopped::done) break;
    const bool shed = shed_surplus(data());
    if (!shed && !std::exchange(dissolved, false)) break;
    result_.stopped = refine_touched(data(), made(), options_.observer);
  }
  if (data().renewal.until_shed > 0) --data().renewal.until_shed;
}

// Where a limit ended an earlier refinement, the triangles that it left bad stay until a step happens to
// replace them all.
Stopped Step::what_still_stops() {
  Stopped& stopped = data().stopped;
  if (stopped != Stopped::done && mesh_.quick_check().empty()) stopped = Stopped::done;
  return stopped;
}

// Returns the vertices that are at other places, but are the same; nothing where a morph turns triangles
// over.
std::optional<List<VertexId>> Step::change_boundary() {
  MeshData& mesh = data();
  const ReplaceOptions options{.distance = options_.distance, .renewing = plan_.renews};
  if (attempt_.method == Method::general || plan_.structure_differs) return change_structure(options);
  note_moved(mesh, cache_->loops);
  return move_or_replace(options);
}

// Moves the loops of the cache, from where they are, as the attempt has it.
std::optional<List<VertexId>> Step::move_or_replace(const ReplaceOptions& options) {
  if (attempt_.interior) return morph_mesh(data(), *cache_, domain(), *attempt_.interior, bounds_of_morph());
  return replace_where_needed(data(), *cache_, domain(), options);
}

// The same where boundary vertices do not all correspond, or are all to be replaced.
std::optional<List<VertexId>> Step::change_structure(const ReplaceOptions& options) {
  MeshData& mesh = data();
  mesh.cache.reset();
  if (!plan_.correspondence) plan_.correspondence = correspond(mesh.domain, wanted_);
  note_changed(mesh, *plan_.correspondence);
  replace_loops(mesh, *plan_.correspondence, attempt_.places, options);
  List<VertexId> moved(&mesh.arena);
  const LoopIndices moving = settle(mesh, moved);
  if (moving.empty()) {
    attempt_.interior.reset();  // nothing moves: all that there is to do is to fill what loops have left
    return moved;
  }
  if (joined(mesh, moving)) throw RecoveryError("chains are joined to what moves");
  cache_ = &adjust_cache(mesh, moving);
  std::optional<List<VertexId>> others(&mesh.arena);
  if (adjust_all(mesh, *cache_, domain())) {
    for (std::size_t i = 0; i < cache_->moving.size(); ++i)
      if (cache_->changes_place(i)) others->push_back(cache_->moving[i].vertex);
  } else {
    others = move_or_replace(options);
  }
  if (!others) return std::nullopt;
  moved.insert(moved.end(), others->begin(), others->end());
  return moved;
}

// A new reference is as good as refinement makes it, so that designs around it are held.
QualityBounds Step::bounds_of_morph() const {
  const MeshData& mesh = mesh_.data();
  QualityBounds bounds = mesh.promised_bounds();
  if (options_.strategy == Strategy::reference)
    bounds.squared_radius_edge = QualityBounds::of_refinement(mesh.options).squared_radius_edge;
  return bounds;
}

void Step::note_replacement() {
  MeshData& mesh = data();
  mesh.marked.for_each([&](ChangeRecord& record) {
    note_journal(mesh.triangulation, record);
    if (cache_ != nullptr && !plan_.structure_differs)
      record.note_loops(cache_->loops);
    else
      record.note_all_loops();
  });
}

RemodelResult Step::abandon() {
  RemodelResult result = unchanged(data());
  result.abandoned = true;
  result.reason = std::move(failure_);
  return result;
}

// After a step that failed and was taken back.
RemodelResult Step::regenerate() {
  GenerateResult fresh = generate(domain(), mesh_.options(), options_.observer);
  if (fresh.stopped == Stopped::interrupted) return interrupted(data());
  fresh.mesh.data().keep = mesh_.keep();
  fresh.mesh.data().renewal.take_count_factor(data().renewal);
  RemodelResult result = exchange(std::move(fresh));
  result.regenerated = true;
  result.reason = std::move(failure_);
  return result;
}

RemodelResult Step::exchange(GenerateResult&& fresh) {
  take_back();
  fresh.mesh.data().imported.markers = data().imported.markers;
  return remodel::exchange(mesh_, std::move(fresh), before_);
}

}  // namespace remodel
