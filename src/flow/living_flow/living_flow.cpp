// The solver that outlives its mesh.

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/stopwatch.h"
#include "flow/living_flow/adjoint.h"
#include "flow/search/chord.h"
#include "flow/search/coarse_start.h"
#include "flow/solution.h"
#include "remodel/error.h"
#include "remodel/flow.h"

namespace remodel {

namespace flow {

namespace {

// Vertices found by their keys.
class KeyTable {
 public:
  KeyTable() = default;
  explicit KeyTable(const std::vector<VertexKey>& keys) {
    for (std::uint32_t i = 0; i < keys.size(); ++i) {
      const std::uint32_t id = keys[i].id.index;
      if (id >= at_.size()) at_.resize(id + 1, {no_index, 0});
      at_[id] = {i, keys[i].generation};
    }
  }
  std::uint32_t find(VertexKey key) const {
    if (key.id.index >= at_.size() || at_[key.id.index].generation != key.generation) return no_index;
    return at_[key.id.index].position;
  }

 private:
  struct Place {
    std::uint32_t position, generation;
  };
  std::vector<Place> at_;
};

std::vector<VertexKey> keys_of(const FrozenMesh& frozen) {
  if (frozen.vertex_keys.size() != frozen.points.size())
    throw Error(ErrorCode::argument, "mesh",
                "found " + std::to_string(frozen.vertex_keys.size()) +
                    " keys of vertices, expected one for each of " + std::to_string(frozen.points.size()) +
                    " points");
  std::vector<VertexKey> keys;
  keys.reserve(frozen.vertex_keys.size());
  for (const std::uint64_t key : frozen.vertex_keys) keys.push_back(VertexKey::of(key));
  return keys;
}

// Vertices that a step changed beyond this part of the mesh are not worth a correction.
constexpr double largest_zone = 0.2;
// A flow or a function's gradient takes about this many solves with factors of its own.
constexpr int own_solves = 4;

// Whether new factors are worth their time: those made before have served other flows than their own. Where
// they have not, flows go by without, more each time (1, 3, 7, ...), before it is tried again.
class Worth {
 public:
  bool pays() {
    if (gone_by_ >= pause_) return true;
    ++gone_by_;
    return false;
  }
  void made() { served_ = false; }
  void served() { served_ = true, pause_ = gone_by_ = 0; }
  void given_up() {
    constexpr int longest = 31;
    if (!served_) pause_ = std::min(2 * pause_ + 1, longest), gone_by_ = 0;
  }

 private:
  bool served_ = false;
  int pause_ = 0, gone_by_ = 0;
};

}  // namespace

}  // namespace flow

struct KeptFlow::Flow {
  std::shared_ptr<const flow::FlowMesh> mesh;
  std::vector<VertexKey> keys;
  flow::State state;
  flow::Stream stream;
};

struct LivingFlow::Impl {
  using Keys = std::vector<VertexKey>;

  explicit Impl(const FlowOptions& given) : options(given) {}

  FlowOptions options;
  // The last flow: by position, and whose positions these are.
  std::shared_ptr<const flow::FlowMesh> mesh;
  Keys keys;
  flow::State state;
  bool solved = false;
  flow::Stream last_stream;  // of the last flow
  // The factors, and what they belong to: rows by key, with the keys of each row's neighbours.
  flow::Factors factors;
  bool factored = false;
  Keys factored_keys;
  std::vector<std::vector<VertexKey>> factored_rings;
  double rent = 0.0;  // what older factors have cost beyond new ones
  flow::Worth worth;
  // Of flows that are looked for by steps of which each has a matrix of its own.
  flow::Factors passing;
  // The pattern of the whole matrix, for the triangles it was made of.
  flow::BlockRows matrix;
  std::vector<std::array<std::uint32_t, 3>> matrix_triangles;
  // What the last gradients were found by, and whose positions these are.
  std::vector<flow::Increment> multipliers;
  Keys multiplier_keys;

  // living: the mesh that was frozen, if its domain is to be used.
  FlowResult solve(const FrozenMesh& frozen, const Mesh* living, const FlowConditions& conditions);
  FlowGradients gradients(const std::vector<FlowFunctional>& functions, const WantedGradients& wanted);

 private:
  struct Task;
  flow::State carry(const flow::FlowMesh& now, const Keys& now_keys, const flow::Stream& stream) const;
  flow::BlockRows& whole_matrix(const flow::FlowSystem& system);
  void belong(const flow::FlowMesh& dual, const Keys& now);
  flow::Overlap overlap(const flow::FlowMesh& dual, const Keys& now) const;
  bool try_older_factors(Task& task);
  bool try_own_factors(Task& task);
  void forget_factors();
  void search(Task& task);
  std::optional<std::vector<flow::Total>> try_gradients(const flow::FlowSystem& system,
                                                        std::span<const flow::ForceSlope> functions,
                                                        int& iterations);
};

// One flow that is looked for.
struct LivingFlow::Impl::Task {
  const flow::FlowSystem& system;
  const flow::Measure& measure;
  const Keys& keys;
  const FlowConditions& conditions;
  const Mesh* living;
  flow::State state;
  flow::Search search = {}, spent = {};
  FlowStart start = FlowStart::cold;
  std::size_t corrected = 0;
};

LivingFlow::LivingFlow(const FlowOptions& options) : impl_(std::make_unique<Impl>(options)) {}
LivingFlow::~LivingFlow() = default;
LivingFlow::LivingFlow(LivingFlow&&) noexcept = default;
LivingFlow& LivingFlow::operator=(LivingFlow&&) noexcept = default;

FlowResult LivingFlow::solve(const Mesh& mesh, const FlowConditions& conditions) {
  return impl_->solve(mesh.freeze(), &mesh, conditions);
}

FlowResult LivingFlow::solve(const FrozenMesh& mesh, const FlowConditions& conditions) {
  return impl_->solve(mesh, nullptr, conditions);
}

void LivingFlow::forget() {
  impl_ = std::make_unique<Impl>(impl_->options);
}

KeptFlow LivingFlow::keep() const {
  KeptFlow kept;
  if (impl_->solved)
    kept.flow_ = std::make_shared<const KeptFlow::Flow>(
        KeptFlow::Flow{impl_->mesh, impl_->keys, impl_->state, impl_->last_stream});
  return kept;
}

void LivingFlow::go_on_from(const KeptFlow& kept) {
  if (kept.empty()) return;
  impl_->mesh = kept.flow_->mesh;
  impl_->keys = kept.flow_->keys;
  impl_->state = kept.flow_->state;
  impl_->last_stream = kept.flow_->stream;
  impl_->solved = true;
}

flow::BlockRows& LivingFlow::Impl::whole_matrix(const flow::FlowSystem& system) {
  if (matrix_triangles != system.mesh().triangles()) {
    matrix = system.pattern();
    matrix_triangles = system.mesh().triangles();
  }
  return matrix;
}

// Values at vertices that are there still are kept, those at new ones interpolated.
flow::State LivingFlow::Impl::carry(const flow::FlowMesh& now, const Keys& now_keys,
                                    const flow::Stream& stream) const {
  flow::State carried;
  carried.augmented = state.augmented;
  carried.augmented[0] *= last_stream.length / stream.length;
  if (!stream.lift) carried.augmented[1] = stream.alpha;
  const flow::KeyTable table(keys);
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
  const auto values = flow::interpolated(*mesh, state.q, places);
  for (std::size_t i = 0; i < fresh.size(); ++i) carried.q[fresh[i]] = values[i];
  return carried;
}

// The factors that find_flow() or factor_at() left belong to this mesh.
void LivingFlow::Impl::belong(const flow::FlowMesh& dual, const Keys& now) {
  factored = factors.ready();
  rent = 0.0;
  worth.made();
  factored_keys = now;
  factored_rings.resize(now.size());
  for (std::size_t v = 0; v < now.size(); ++v) {
    factored_rings[v].clear();
    for (const flow::RingEntry& entry : dual.ring(v)) factored_rings[v].push_back(now[entry.vertex]);
    std::sort(factored_rings[v].begin(), factored_rings[v].end());
  }
}

// Where the mesh is not the one that the factors belong to.
flow::Overlap LivingFlow::Impl::overlap(const flow::FlowMesh& dual, const Keys& now) const {
  const flow::KeyTable table(factored_keys);
  flow::Overlap result{
      .row_of = std::vector<std::uint32_t>(dual.size()), .rows = factored_keys.size(), .zone = {}};
  std::vector<std::uint32_t>& zone = result.zone;
  std::vector<bool> in_zone(dual.size(), false);
  std::vector<VertexKey> ring;
  const auto note = [&](std::uint32_t v) {
    if (in_zone[v]) return;
    in_zone[v] = true;
    zone.push_back(v);
  };
  for (std::uint32_t v = 0; v < dual.size(); ++v) {
    const std::uint32_t row = result.row_of[v] = table.find(now[v]);
    ring.clear();
    for (const flow::RingEntry& entry : dual.ring(v)) ring.push_back(now[entry.vertex]);
    std::sort(ring.begin(), ring.end());
    if (row == no_index || ring != factored_rings[row]) note(v);
  }
  for (int rings = 0; rings < 2; ++rings)
    for (std::size_t i = 0, n = zone.size(); i < n; ++i)
      for (const flow::RingEntry& entry : dual.ring(zone[i])) note(entry.vertex);
  std::sort(zone.begin(), zone.end());
  return result;
}

// The chord method with the factors that there are. False where they are of no use (any more).
bool LivingFlow::Impl::try_older_factors(Task& task) {
  if (!factored || !factors.whole() || rent > factors.factor_work()) return false;
  const flow::FlowMesh& dual = task.system.mesh();
  flow::Overlap shared = overlap(dual, task.keys);
  const std::vector<std::uint32_t>& zone = shared.zone;
  task.corrected = zone.size();
  if (static_cast<double>(zone.size()) > flow::largest_zone * static_cast<double>(dual.size())) return false;

  flow::Preconditioner inverse(task.system, task.state, factors, std::move(shared.row_of), shared.rows, zone,
                               options);
  if (!inverse.ready()) return false;
  const int before = task.search.iterations;
  const flow::ChordEnd end =
      flow::chord_steps(task.measure, inverse, factors, options, task.state, task.search);
  rent += std::max(0, task.search.iterations - before - flow::own_solves) * factors.solve_work() +
          inverse.zone_work();
  if (end == flow::ChordEnd::interrupted) {
    task.search.status = FlowStatus::interrupted, task.search.reason = "interrupted";
    return true;
  }
  task.start = FlowStart::carried;
  if (end == flow::ChordEnd::converged) task.search.status = FlowStatus::converged;
  return end == flow::ChordEnd::converged;
}

bool LivingFlow::Impl::try_own_factors(Task& task) {
  if (flow::lasting_kind(options) != flow::FactorKind::whole || factors.too_large(task.keys.size()) ||
      !worth.pays())
    return false;
  task.start = FlowStart::refactored;
  const int before = task.search.factorisations;
  const flow::ChordEnd end = flow::steps_with_own_factors(
      task.system, task.measure, options, whole_matrix(task.system), factors, task.state, task.search);
  if (task.search.factorisations > before) belong(task.system.mesh(), task.keys);
  if (end == flow::ChordEnd::slow) forget_factors();
  return end != flow::ChordEnd::slow;
}

// Where they do not lead on.
void LivingFlow::Impl::forget_factors() {
  if (std::exchange(factored, false)) worth.given_up();
}

// Cheapest first: older factors, new ones, Newton's method from the last flow, undisturbed flow.
void LivingFlow::Impl::search(Task& task) {
  if (solved) {
    if (try_older_factors(task)) return worth.served();
    forget_factors();
    if (try_own_factors(task)) return;
    task.start = FlowStart::refactored;
    flow::find_flow_near(task.system, task.measure, options, whole_matrix(task.system), passing, task.state,
                         task.search);
    const FlowStatus status = task.search.status;
    if (status == FlowStatus::converged || status == FlowStatus::interrupted || status == FlowStatus::memory)
      return;
  }
  task.start = FlowStart::cold;
  flow::BlockRows& whole = whole_matrix(task.system);
  if (task.living != nullptr)
    flow::find_flow_by_meshes(task.living->domain(), task.living->options(), task.system, task.measure,
                              task.conditions, options, whole, passing, task.state, task.search, task.spent);
  else
    flow::find_flow_cold(task.system, task.measure, options, whole, passing, task.state, task.search);
}

FlowResult LivingFlow::Impl::solve(const FrozenMesh& frozen, const Mesh* living,
                                   const FlowConditions& conditions) {
  const Stopwatch watch;
  flow::require_possible(conditions, options);
  std::shared_ptr<flow::FlowMesh> dual;
  const Keys now = flow::keys_of(frozen);
  if (mesh && mesh->triangles() == frozen.triangles && now == keys) {
    dual = std::make_shared<flow::FlowMesh>(*mesh);
    dual->move(frozen.points);
    dual->require_triangles("mesh");
    flow::require_ways(*dual, conditions, options, "mesh");
  } else {
    dual = std::make_shared<flow::FlowMesh>(flow::dual_of(frozen, conditions, options, "mesh"));
  }
  const flow::Stream stream = flow::stream_of(conditions, options, *dual);
  const flow::FlowSystem system(*dual, stream);
  const flow::Measure measure(system);
  Task task{.system = system,
            .measure = measure,
            .keys = now,
            .conditions = conditions,
            .living = living,
            .state = {}};
  if (solved) task.state = carry(*dual, now, stream);
  search(task);
  FlowResult result = flow::result_of(system, task.state, task.search, task.start);
  flow::add_coarse(task.spent, result);
  result.corrected_vertices = task.corrected;
  // Asked to stop during its last step: whoever asked does not know this flow, gradients() must not have it.
  if (result.converged() && options.observer != nullptr && options.observer->cancelled())
    result.status = FlowStatus::interrupted, result.reason = "interrupted";
  // A flow that was not found is not carried on: the last one that was found is.
  if (result.converged()) {
    state = std::move(task.state);
    keys = now;
    mesh = std::move(dual);
    last_stream = stream;
    solved = true;
  }
  result.seconds = watch.seconds();
  return result;
}

namespace flow {

namespace {

// scale: the function that is reported, over the one that these are of.
FlowGradient gradient_of(Total total, double scale, const Stream& stream) {
  for (Point& point : total.shape.points) point = scale * point;
  const double by_condition = scale * total.condition;
  return {.points = std::move(total.shape.points),
          .mach = scale * total.shape.mach,
          .alpha_deg = stream.lift ? 0.0 : by_condition * M_PI / 180.0,
          .cl = stream.lift ? by_condition / reported_length(stream) : 0.0};
}

ForceSlope slope_of(const FlowFunctional& function) {
  ForceSlope result;
  result.shape.points = function.points;
  result.shape.mach = function.mach;
  result.pressure = function.pressure;
  return result;
}

// The angle of attack itself, in degrees.
ForceSlope angle(std::size_t size) {
  ForceSlope result;
  result.shape.points.assign(size, {});
  result.pressure.assign(size, 0.0);
  result.alpha = 180.0 / M_PI;
  return result;
}

}  // namespace

}  // namespace flow

FlowGradients LivingFlow::gradients(const std::vector<FlowFunctional>& functions,
                                    const WantedGradients& wanted) {
  return impl_->gradients(functions, wanted);
}

// None where the factors that there are do not serve.
std::optional<std::vector<flow::Total>> LivingFlow::Impl::try_gradients(
    const flow::FlowSystem& system, std::span<const flow::ForceSlope> functions, int& iterations) {
  if (!factored) return std::nullopt;
  const flow::Overlap shared = overlap(*mesh, keys);
  if (static_cast<double>(shared.zone.size()) > flow::largest_zone * static_cast<double>(mesh->size()))
    return std::nullopt;
  // The multipliers of the last gradients are the guess for these.
  if (multipliers.size() != functions.size()) multipliers.assign(functions.size(), {});
  const flow::KeyTable table(multiplier_keys);
  for (flow::Increment& multiplier : multipliers) {
    if (multiplier.q.size() != multiplier_keys.size()) continue;
    flow::Vector guess(keys.size(), {0, 0, 0, 0});
    for (std::size_t v = 0; v < keys.size(); ++v)
      if (const std::uint32_t old = table.find(keys[v]); old != no_index) guess[v] = multiplier.q[old];
    multiplier.q = std::move(guess);
  }
  multiplier_keys = keys;
  // Older factors serve until they have cost as much as new ones.
  const bool are_own = shared.zone.empty() && rent == 0.0;
  const double solve_work = factors.solve_work();
  const double most_solves = are_own ? std::numeric_limits<double>::infinity()
                                     : std::max(0.0, factors.factor_work() - rent) / solve_work;
  const int before = iterations;
  auto totals = flow::totals(system, state, matrix, factors, shared, options, functions, multipliers,
                             most_solves, iterations);
  const int own = flow::own_solves * static_cast<int>(functions.size());
  rent += std::max(0, iterations - before - own) * solve_work;
  return totals;
}

FlowGradients LivingFlow::Impl::gradients(const std::vector<FlowFunctional>& functions,
                                          const WantedGradients& wanted) {
  const Stopwatch watch;
  if (!solved) throw Error(ErrorCode::argument, "gradients", "no flow was found yet, expected one");
  if (!options.inlets.empty() || !options.outlets.empty())
    throw Error(ErrorCode::argument, "gradients", "found inlets or outlets, expected a far field alone");
  for (const FlowFunctional& function : functions)
    if (function.pressure.size() != mesh->size() || function.points.size() != mesh->size())
      throw Error(ErrorCode::argument, "functional",
                  "found derivatives by " + std::to_string(function.pressure.size()) +
                      " pressures, expected the mesh's " + std::to_string(mesh->size()) + " points");
  const flow::FlowSystem system(*mesh, last_stream);
  FlowGradients result;
  result.functions.assign(functions.size(), {});
  std::vector<flow::ForceSlope> slopes;
  std::vector<std::pair<FlowGradient*, double>> places;
  const auto add = [&](flow::ForceSlope slope, FlowGradient& place, double scale = 1.0) {
    slopes.push_back(std::move(slope)), places.push_back({&place, scale});
  };
  const double scale = flow::reported_length(last_stream);
  if (wanted.lift) add(system.force_slope(state, {.lift = 1.0}), result.cl, scale);
  if (wanted.drag) add(system.force_slope(state, {.drag = 1.0}), result.cd, scale);
  if (wanted.moment) add(system.force_slope(state, {.moment = 1.0}), result.cm, scale * scale);
  if (wanted.angle) add(flow::angle(mesh->size()), result.alpha_deg);
  for (std::size_t i = 0; i < functions.size(); ++i) add(flow::slope_of(functions[i]), result.functions[i]);

  system.jacobian(state, whole_matrix(system));
  const auto told_to_end = [&] {
    result.interrupted = options.observer != nullptr && options.observer->cancelled();
    return result.interrupted;
  };
  auto totals = try_gradients(system, slopes, result.krylov_iterations);
  if (told_to_end()) return result;
  if (!totals) {
    flow::Search made;
    factored = false;
    const flow::Factored outcome = flow::factor_at(
        system, state, flow::no_pseudo_time, flow::lasting_kind(options), options, matrix, factors, made);
    belong(*mesh, keys);
    if (outcome == flow::Factored::done) {
      result.factorisations = 1;
      totals = try_gradients(system, slopes, result.krylov_iterations);
    }
    if (told_to_end()) return result;
    if (!totals)
      throw Error(ErrorCode::argument, "gradients",
                  "the adjoint was not found: the Jacobian is singular, or the factors need more than the "
                  "memory that they may take, or GMRES takes too long with them");
  }
  for (std::size_t i = 0; i < places.size(); ++i)
    *places[i].first = flow::gradient_of(std::move((*totals)[i]), places[i].second, last_stream);
  result.seconds = watch.seconds();
  return result;
}

FlowResult solve_flow_from(const FrozenMesh& before, const FlowResult& known, const FrozenMesh& mesh,
                           const FlowConditions& conditions, const FlowOptions& options,
                           const std::string& source) {
  const Stopwatch watch;
  flow::require_possible(conditions, options);
  const flow::FlowMesh old = flow::dual_of(before, conditions, options, source);
  const flow::FlowMesh dual = flow::dual_of(mesh, conditions, options, source);
  if (known.density.size() != old.size())
    throw Error(ErrorCode::argument, source,
                "found a flow at " + std::to_string(known.density.size()) + " points, expected one at the " +
                    std::to_string(old.size()) + " of its mesh");
  const flow::FlowSystem system(dual, flow::stream_of(conditions, options, dual));
  const flow::Measure measure(system);
  std::vector<flow::Unknowns<double>> q(old.size());
  for (std::size_t v = 0; v < q.size(); ++v)
    q[v] = {known.density[v], known.velocity_x[v], known.velocity_y[v], known.pressure[v]};
  flow::State state;
  state.q = flow::interpolated(old, q, dual.points());
  state.augmented = {known.cl / flow::reported_length(system.stream()),
                     conditions.cl ? known.alpha_deg * M_PI / 180.0 : system.stream().alpha};

  flow::BlockRows matrix = system.pattern();
  flow::Factors factors;
  flow::Search search;
  FlowStart start = FlowStart::refactored;
  if (options.solver != FlowSolver::lu ||
      flow::steps_with_own_factors(system, measure, options, matrix, factors, state, search) ==
          flow::ChordEnd::slow)
    flow::find_flow_near(system, measure, options, matrix, factors, state, search);
  if (search.status == FlowStatus::stalled || search.status == FlowStatus::step_limit) {
    start = FlowStart::cold;
    flow::find_flow_cold(system, measure, options, matrix, factors, state, search);
  }
  FlowResult result = flow::result_of(system, state, search, start);
  result.seconds = watch.seconds();
  return result;
}

}  // namespace remodel
