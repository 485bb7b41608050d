#include "remodel/remodel.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "generate/recovery_error.h"
#include "generate/refine.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/methods.h"

namespace remodel {

const char* name_of(Method method) {
  switch (method) {
    case Method::automatic: return "auto";
    case Method::specialised: return "specialised";
    case Method::general: return "general";
  }
  return "unknown";
}

namespace {

// All that a step changes besides the triangulation, which has its own journal. Taken back unless committed.
class Transaction {
 public:
  explicit Transaction(MeshData& mesh)
      : mesh_(mesh),
        boundary_(mesh.boundary),
        free_boundary_(mesh.free_boundary),
        loop_heads_(mesh.loop_heads),
        domain_on_left_(mesh.domain_on_left),
        domain_(mesh.domain) {
    mesh.triangulation.begin();
    mesh.triangulation.set_step(mesh.step + 1);
  }
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  ~Transaction() {
    if (committed_) return;
    mesh_.triangulation.rollback();
    mesh_.triangulation.forget_badness();
    mesh_.boundary = std::move(boundary_);
    mesh_.free_boundary = std::move(free_boundary_);
    mesh_.loop_heads = std::move(loop_heads_);
    mesh_.domain_on_left = std::move(domain_on_left_);
    mesh_.domain = std::move(domain_);
    mesh_.cache.reset();
  }
  void commit() {
    mesh_.triangulation.commit();
    ++mesh_.step;
    if (mesh_.cache) mesh_.cache->stale = true;
    committed_ = true;
  }

 private:
  MeshData& mesh_;
  std::vector<BoundaryVertex> boundary_;
  std::vector<std::uint32_t> free_boundary_, loop_heads_;
  std::vector<bool> domain_on_left_;
  Domain domain_;
  bool committed_ = false;
};

std::vector<std::size_t> moving_loops(const Domain& from, const Domain& to) {
  std::vector<std::size_t> loops;
  for (std::size_t i = 0; i < from.loops.size(); ++i)
    if (!(from.loops[i] == to.loops[i])) loops.push_back(i);
  return loops;
}

// Airfoils whose surfaces cross are refused here, before anything is touched: this is cheap enough for every step.
// That no other curves cross follows for a full adjustment from its triangles, otherwise from validate().
void require_surfaces_apart(const Domain& domain) {
  for (std::size_t i = 0; i < domain.curve_count(); ++i)
    if (const auto* airfoil = std::get_if<CstAirfoil>(&domain.curve(i).shape))
      if (!surfaces_apart(*airfoil))
        throw Error(ErrorCode::geometry, domain.curve(i).name, "the airfoil's surfaces touch or cross; expected upper above lower");
}

RemodelResult full_adjustment(MeshData& mesh, const AdjustCache& cache, const Domain& domain) {
  RemodelResult result;
  result.triangles_before = result.triangles = mesh.domain_triangles;
  result.full_adjustment = true;
  result.preserved = mesh.domain_triangles;
  for (const AdjustCache::Affected& a : cache.affected)
    if (a.domain && a.moved) --result.preserved;
  for (std::size_t i = 0; i < cache.moving.size(); ++i)
    if (!(cache.new_points[i] == cache.old_points[i])) ++result.moved;
  bool basis_kept = true;
  for (const std::size_t loop : cache.loops)
    for (std::size_t c = 0; c < domain.loops[loop].curves.size(); ++c) {
      Shape& shape = mesh.domain.loops[loop].curves[c].shape;
      const Shape& now = domain.loops[loop].curves[c].shape;
      if (const auto* airfoil = std::get_if<CstAirfoil>(&now))
        basis_kept &= same_basis(std::get<CstAirfoil>(shape), *airfoil);
      shape = now;
    }
  ++mesh.step;
  if (!basis_kept) mesh.cache.reset();
  return result;
}

// Counts what the journal's step left of the old domain triangles, and keeps the mesh's own count.
void count(MeshData& mesh, const std::vector<VertexId>& moved, RemodelResult& result) {
  const Triangulation& triangulation = mesh.triangulation;
  mesh.vertex_marks.clear(triangulation.vertex_slots());
  for (const VertexId v : moved) mesh.vertex_marks.visit(v.index);
  const auto survives = [&](const Triangle& t) {
    for (const VertexId v : t.vertex)
      if (!triangulation[v].alive() || mesh.vertex_marks.visited(v.index)) return false;
    const auto corner = triangulation.find_edge(t.vertex[0], t.vertex[1]);
    return corner && triangulation.vertex(*corner) == t.vertex[2] &&
           triangulation[corner->triangle].region == Region::domain;
  };
  std::size_t before = 0, lost = 0, after = 0;
  for (const Triangulation::Earlier& earlier : triangulation.earlier()) {
    if (!earlier.triangle.alive() || earlier.triangle.region != Region::domain) continue;
    ++before;
    if (!survives(earlier.triangle)) ++lost;
  }
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

// Refinement of what was touched. A refinement that needs several times the old mesh is running away.
Stopped refine_touched(MeshData& mesh) {
  Refiner refiner(mesh);
  const std::size_t runaway = 4 * mesh.triangulation.vertex_count() + 10000;
  refiner.limit_vertices(std::min<std::size_t>(mesh.options.max_vertices, runaway));
  for (const TriangleId t : mesh.triangulation.touched()) refiner.consider(t);
  return refiner.run();
}

// The paper's remodelling after a full adjustment was not possible (cache) or does not apply (no cache). Returns why
// it could not be completed; the mesh is as it was then.
std::optional<std::string> replace(MeshData& mesh, AdjustCache* cache, const Domain& domain, double distance,
                                   RemodelResult& result) {
  Transaction transaction(mesh);
  try {
    std::vector<VertexId> moved;
    if (cache != nullptr) moved = replace_where_needed(mesh, *cache, domain, distance);
    else replace_loops(mesh, domain, distance);
    const Stopped stopped = refine_touched(mesh);
    if (stopped != Stopped::done) return std::string("refinement stopped: ") + name_of(stopped);
    count(mesh, moved, result);
  } catch (const RecoveryError& error) {
    return error.what();
  }
  transaction.commit();
  return std::nullopt;
}

void regenerate(Mesh& mesh, const Domain& domain, RemodelResult& result) {
  GenerateResult fresh = generate(domain, mesh.options());
  MeshData& data = fresh.mesh.data();
  data.step = mesh.step() + 1;
  for (std::uint32_t i = 0; i < data.triangulation.triangle_slots(); ++i)
    data.triangulation.set_birth(TriangleId{i}, data.step);
  result.removed = mesh.data().triangulation.vertex_count();
  result.inserted = data.triangulation.vertex_count();
  result.triangles_before = mesh.triangle_count();
  result.triangles = fresh.mesh.triangle_count();
  result.preserved = result.moved = 0;
  result.regenerated = true;
  result.stopped = fresh.stopped;
  mesh = std::move(fresh.mesh);
}

}  // namespace

RemodelResult remodel(Mesh& mesh, const Domain& domain, const RemodelOptions& options) {
  if (!std::isfinite(options.distance) || options.distance < 0.0)
    throw Error(ErrorCode::argument, "distance", "found " + std::to_string(options.distance) + ", expected 0 or more");
  MeshData& data = mesh.data();
  const bool corresponds = one_to_one(data.domain, domain);
  if (options.method == Method::specialised && !corresponds)
    throw Error(ErrorCode::argument, "method", "specialised needs two domains that correspond one to one");
  const bool specialised = corresponds && options.method != Method::general;
  RemodelResult result;
  if (data.domain == domain) {
    result.triangles_before = result.triangles = result.preserved = data.domain_triangles;
    result.full_adjustment = true;
    return result;
  }
  require_surfaces_apart(domain);
  AdjustCache* cache = nullptr;
  if (specialised) {
    cache = &adjust_cache(data, moving_loops(data.domain, domain));
    if (adjust_all(data, *cache, domain)) return full_adjustment(data, *cache, domain);
  }
  // A design that corresponds to the present one and cannot be meshed is found out by the replacement itself, exactly:
  // its loops cannot be recovered or do not nest. Then regenerate() below says where.
  if (cache == nullptr || !cache->finite()) validate(domain);
  if (const auto failure = replace(data, cache, domain, options.distance, result)) {
    result = {};
    result.reason = *failure;
    regenerate(mesh, domain, result);
  }
  result.method = specialised ? Method::specialised : Method::general;
  return result;
}

}  // namespace remodel
