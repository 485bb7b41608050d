#include "step/rename.h"

#include <algorithm>
#include <utility>

namespace remodel {

namespace {

std::vector<std::uint32_t> first_curves(const Domain& domain) {
  std::vector<std::uint32_t> first{0};
  for (const Loop& loop : domain.loops)
    first.push_back(first.back() + static_cast<std::uint32_t>(loop.curves.size()));
  return first;
}

bool same_names(const Loop& a, const Loop& b) {
  return a.role == b.role && a.region == b.region && a.right_region == b.right_region &&
         std::equal(a.curves.begin(), a.curves.end(), b.curves.begin(), b.curves.end(),
                    [](const Curve& c, const Curve& d) { return c.name == d.name; });
}

// The loops of a domain in the order of another one, with the other's names.
Domain renamed(const Domain& domain, const Correspondence& to) {
  Domain result;
  for (std::size_t i = 0; i < to.loops.size(); ++i) {
    Loop loop = domain.loops[to.loops[i].from];
    const Loop& names = to.domain.loops[i];
    loop.role = names.role;
    loop.region = names.region;
    loop.right_region = names.right_region;
    for (std::size_t c = 0; c < loop.curves.size(); ++c) loop.curves[c].name = names.curves[c].name;
    result.loops.push_back(std::move(loop));
  }
  result.periodic = to.domain.periodic;
  return result;
}

}  // namespace

bool only_renames(const Domain& own, const Correspondence& to) {
  return own.loops.size() == to.loops.size() &&
         std::all_of(to.loops.begin(), to.loops.end(),
                     [](const LoopLinks& links) { return links.from != no_link && links.in_order; });
}

bool same_names(const Domain& own, const Correspondence& to) {
  for (std::size_t i = 0; i < to.loops.size(); ++i)
    if (to.loops[i].from != i || !same_names(own.loops[i], to.domain.loops[i])) return false;
  return true;
}

Renaming::Renaming(MeshData& mesh, const Correspondence& to)
    : domain_(renamed(mesh.domain, to)), reference_(mesh.reference), sides_(to.loops.size()) {
  if (mesh.reference) {
    auto reference = std::make_shared<MeshReference>(*mesh.reference);
    reference->domain = renamed(mesh.reference->domain, to);
    reference_ = std::move(reference);
  }
  const std::vector<std::uint32_t> first = first_curves(domain_), old_first = first_curves(mesh.domain);
  std::vector<std::uint32_t> shift(to.loops.size());  // of the curves of each old loop, modulo 2^32
  for (std::size_t i = 0; i < to.loops.size(); ++i) {
    const std::size_t from = to.loops[i].from;
    loop_heads_.push_back(mesh.loop_heads[from]);
    sides_[i] = mesh.sides[from];
    shift[from] = first[i] - old_first[from];
    if (std::binary_search(mesh.renewal.pending_loops.begin(), mesh.renewal.pending_loops.end(), from))
      pending_loops_.push_back(static_cast<std::uint32_t>(i));
  }
  for (std::uint32_t k = 0; k < mesh.boundary.size(); ++k) {
    const BoundaryVertex& entry = mesh.at(k);
    curves_.push_back(entry.vertex ? entry.curve + shift[mesh.loop_of(entry.curve)] : entry.curve);
  }
  exchange(mesh);
}

void Renaming::undo(MeshData& mesh) noexcept {
  exchange(mesh);
}

void Renaming::exchange(MeshData& mesh) noexcept {
  std::swap(mesh.domain, domain_);
  std::swap(mesh.reference, reference_);
  mesh.loop_heads.swap(loop_heads_);
  mesh.sides.swap(sides_);
  mesh.renewal.pending_loops.swap(pending_loops_);
  for (std::uint32_t k = 0; k < mesh.boundary.size(); ++k) std::swap(mesh.boundary.edit(k).curve, curves_[k]);
  mesh.index_curves();
  mesh.forget_extent();
  mesh.cache.reset();
  mesh.follow_cache.reset();
}

}  // namespace remodel
