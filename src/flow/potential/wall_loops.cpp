#include "flow/potential/wall_loops.h"

#include <algorithm>

#include "remodel/error.h"

namespace remodel::flow {

namespace {

class LoopFinder {
 public:
  LoopFinder(const FrozenMesh& mesh, const std::vector<std::string>& farfield, const std::string& source)
      : mesh_(mesh), farfield_(farfield), source_(source) {}

  WallLoops find() {
    find_edges();
    name_edges();
    WallLoops loops;
    bool far_found = false;
    for (const std::uint32_t start : starts_) {
      if (visited_[start]) continue;
      bool far = false;
      WallLoop loop = loop_from(start, far);
      const double area = area_of(loop);
      if (far && far_found) fail("a second loop of " + farfield_names() + " found, one expected");
      if (far && !(area > 0.0)) fail("'" + loop.name + "' found inside the domain, around it expected");
      if (!far && area > 0.0)
        fail("'" + loop.name + "' found around the domain, " + farfield_names() + " expected there");
      far_found = far_found || far;
      if (far) {
        loops.farfield = std::move(loop);
      } else {
        loops.bodies.push_back(std::move(loop));
      }
    }
    for (const std::string& name : farfield_)
      if (!far_found || !is_boundary(name))
        fail(names_found() + " found, a far field of the name '" + name + "' expected");
    return loops;
  }

 private:
  std::string farfield_names() const {
    std::string names;
    for (const std::string& name : farfield_) names += (names.empty() ? "'" : " or '") + name + "'";
    return names;
  }

  bool is_boundary(const std::string& name) const {
    return std::any_of(mesh_.boundaries.begin(), mesh_.boundaries.end(),
                       [&](const FrozenBoundary& boundary) { return boundary.name == name; });
  }

  static constexpr std::uint32_t none = 0xffffffff;

  [[noreturn]] void fail(const std::string& problem) const {
    throw Error(ErrorCode::argument, source_, problem);
  }

  std::string names_found() const {
    std::string names;
    for (const auto& boundary : mesh_.boundaries)
      names += (names.empty() ? "boundaries '" : ", '") + boundary.name + "'";
    return names.empty() ? "no boundary" : names;
  }

  // next_: the edges that have one triangle.
  void find_edges() {
    struct Side {
      std::uint32_t low, high;
      bool forwards;
    };
    std::vector<Side> sides;
    sides.reserve(3 * mesh_.triangles.size());
    for (const auto& corners : mesh_.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = corners[k], b = corners[(k + 1) % 3];
        sides.push_back({std::min(a, b), std::max(a, b), a < b});
      }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
      if (x.low != y.low) return x.low < y.low;
      return x.high != y.high ? x.high < y.high : x.forwards < y.forwards;
    });
    next_.assign(mesh_.points.size(), none);
    for (std::size_t i = 0; i < sides.size();) {
      const auto& [low, high, forwards] = sides[i];
      std::size_t end = i;
      while (end < sides.size() && sides[end].low == low && sides[end].high == high) ++end;
      if (end - i > 2 || (end - i == 2 && sides[i].forwards == sides[i + 1].forwards)) {
        fail("triangles that overlap found at the edge of points " + std::to_string(low) + " and " +
             std::to_string(high) + ", one on each side expected");
      }
      if (end - i == 1) add_edge(forwards ? low : high, forwards ? high : low);
      i = end;
    }
  }

  void add_edge(std::uint32_t a, std::uint32_t b) {
    if (next_[a] != none)
      fail("boundaries that touch found at point " + std::to_string(a) + ", closed loops apart expected");
    next_[a] = b;
  }

  // Loops begin where the boundaries' edges do, in their order.
  void name_edges() {
    boundary_.assign(mesh_.points.size(), none);
    visited_.assign(mesh_.points.size(), false);
    for (std::uint32_t k = 0; k < mesh_.boundaries.size(); ++k) {
      for (const auto& [a, b] : mesh_.boundaries[k].edges) {
        const std::uint32_t from = next_[a] == b ? a : next_[b] == a ? b : none;
        if (from == none) continue;  // an edge inside the domain
        boundary_[from] = k;
        starts_.push_back(from);
      }
    }
    for (std::uint32_t v = 0; v < next_.size(); ++v) {
      if (next_[v] == none || boundary_[v] != none) continue;
      fail("the edge from point " + std::to_string(v) + " to " + std::to_string(next_[v]) +
           " bounds the domain and has no name, a named boundary expected");
    }
  }

  WallLoop loop_from(std::uint32_t start, bool& far) {
    WallLoop loop;
    std::vector<std::uint32_t> names;
    for (std::uint32_t v = start; !visited_[v]; v = next_[v]) {
      if (next_[v] == none) fail("a wall that is not closed found at point " + std::to_string(v));
      visited_[v] = true;
      loop.vertices.push_back(v);
      if (std::find(names.begin(), names.end(), boundary_[v]) == names.end()) names.push_back(boundary_[v]);
    }
    const auto is_far = [&](std::uint32_t k) {
      return std::find(farfield_.begin(), farfield_.end(), mesh_.boundaries[k].name) != farfield_.end();
    };
    far = std::any_of(names.begin(), names.end(), is_far);
    for (const std::uint32_t k : names)
      loop.name += (loop.name.empty() ? "" : "+") + mesh_.boundaries[k].name;
    if (far && !std::all_of(names.begin(), names.end(), is_far))
      fail("'" + loop.name + "' found as one loop, a far field apart from all walls expected");
    return loop;
  }

  double area_of(const WallLoop& loop) const {
    double twice = 0.0;
    for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
      twice +=
          cross(mesh_.points[loop.vertices[i]], mesh_.points[loop.vertices[(i + 1) % loop.vertices.size()]]);
    }
    return 0.5 * twice;
  }

  const FrozenMesh& mesh_;
  const std::vector<std::string>& farfield_;
  const std::string& source_;
  std::vector<std::uint32_t> next_;      // per point: the other end of the boundary edge that begins there
  std::vector<std::uint32_t> boundary_;  // per point: of that edge
  std::vector<bool> visited_;
  std::vector<std::uint32_t> starts_;
};

}  // namespace

WallLoops find_wall_loops(const FrozenMesh& mesh, const std::vector<std::string>& farfield,
                          const std::string& source) {
  return LoopFinder(mesh, farfield, source).find();
}

}  // namespace remodel::flow
