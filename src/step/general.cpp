// The general method (the paper's section 3): any loops and chains to any others. Segments that both domains
// have, with what refinement put on them, are not touched; nor, where the boundary changes its structure
// before it moves, those that correspond: they stay where they are.

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <nanoflann.hpp>
#include <utility>

#include "generate/discretise.h"
#include "generate/recovery_error.h"
#include "step/methods.h"
#include "step/replace.h"
#include "triangulation/coarse_to_fine.h"

namespace remodel {

namespace {

// The non-Steiner vertices of one model (the loops of one domain that the other does not have), with the two
// boundary neighbours of each.
struct Model {
  std::vector<Point> points, before, after;

  // What nanoflann asks of a point set.
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return axis == 0 ? points[i].x : points[i].y;
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

class Nearest {
 public:
  explicit Nearest(const Model& model) : tree_(2, model), empty_(model.points.empty()) {}
  // Infinity if the model has no points.
  double squared_distance_to(Point p) const {
    const double query[2] = {p.x, p.y};
    std::uint32_t index = 0;
    double distance = std::numeric_limits<double>::infinity();
    if (!empty_) tree_.knnSearch(query, 1, &index, &distance);
    return distance;
  }

 private:
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Model>, Model, 2> tree_;
  bool empty_;
};

class LoopReplacement {
 public:
  LoopReplacement(MeshData& mesh, const Correspondence& to, Places places, const ReplaceOptions& options)
      : mesh_(mesh),
        triangulation_(mesh.triangulation),
        old_domain_(mesh.domain),
        domain_(to.domain),
        places_(places),
        options_(options),
        links_(to.loops) {}

  void run() {
    list_old();
    list_new();
    if (places_ == Places::wanted) drop_links_that_move();
    find_places();
    if (places_ == Places::joined)
      for (std::size_t i = 0; i < new_.size(); ++i) blend_into_gaps(i);
    claim();
    const std::vector<VertexId> old_boundary = replaces() ? clear_old() : forget_old();
    rebuild_table();
    if (!replaces()) return;
    std::vector<VertexId> left = old_boundary;
    std::erase_if(left, [&](VertexId v) { return triangulation_[v].boundary != no_index; });
    triangulation_.remove(left);
    Refiner refiner(mesh_);
    for (const std::uint32_t k : new_edges_) refiner.recover_edge(k);
    relabel_touched(mesh_);
    for (const std::uint32_t k : new_stations_) set_length_scale(k);
    for (const VertexId v : old_boundary)  // other loops were joined to the old ones here
      if (triangulation_[v].alive() && triangulation_[v].boundary != no_index)
        set_length_scale(triangulation_[v].boundary);
  }

 private:
  using Entries = std::vector<std::uint32_t>;
  struct OldLoop {
    Entries stations;           // of the boundary table
    std::vector<bool> claimed;  // by segment: a new one is linked to it
    std::size_t next(std::size_t station) const { return (station + 1) % stations.size(); }
  };
  struct NewLoop {
    std::vector<BoundaryStation> stations;
    std::vector<Point> points;  // on the new domain
    std::vector<Point> places;  // where they come to lie
    std::size_t next(std::size_t station) const { return (station + 1) % stations.size(); }
    std::size_t before(std::size_t station) const {
      return (station + stations.size() - 1) % stations.size();
    }
  };

  void list_old() {
    for (std::size_t j = 0; j < old_domain_.loops.size(); ++j) {
      OldLoop& loop = old_.emplace_back();
      mesh_.walk(mesh_.loop_heads[j], [&](std::uint32_t k) {
        if (!mesh_.at(k).steiner) loop.stations.push_back(k);
      });
      const std::size_t n = loop.stations.size();
      loop.claimed.assign(old_domain_.loops[j].open ? n - 1 : n, false);
    }
  }

  void list_new() {
    for (std::size_t i = 0; i < domain_.loops.size(); ++i)
      new_.push_back({domain_.stations(i), domain_.points(i), {}});
    claim();
  }
  void claim() {
    unlinked_ = unclaimed_ = 0;
    for (OldLoop& loop : old_) std::fill(loop.claimed.begin(), loop.claimed.end(), false);
    for (const LoopLinks& links : links_) {
      for (const SegmentLink& link : links.segments)
        link.there() ? old_[link.loop].claimed[link.segment] = true : ++unlinked_ != 0;
      if (links.segments.empty() && !links.stations[0].there()) ++unlinked_;  // a single point
    }
    std::size_t points = 0;
    for (const LoopLinks& links : links_) points += links.segments.empty() && links.stations[0].there();
    for (const OldLoop& loop : old_) {
      unclaimed_ += static_cast<std::size_t>(std::count(loop.claimed.begin(), loop.claimed.end(), false));
      unclaimed_ += loop.claimed.empty();
    }
    unclaimed_ -= points;
  }
  // Whether there is more to do than to name all that there is anew.
  bool replaces() const { return unlinked_ + unclaimed_ > 0; }

  // Links are kept where nothing has to move, but for what refinement put between two stations and rounding
  // places elsewhere: settle() moves it.
  void drop_links_that_move() {
    for (std::size_t i = 0; i < new_.size(); ++i) {
      LoopLinks& links = links_[i];
      for (std::size_t s = 0; s < links.stations.size(); ++s)
        if (const StationLink& link = links.stations[s];
            link.there() && !(mesh_.point(entry(link)) == new_[i].points[s]))
          links.stations[s] = {};
      for (std::size_t s = 0; s < links.segments.size(); ++s)
        if (SegmentLink& link = links.segments[s]; link.there() && !rests(i, s, link)) link = {};
    }
    claim();
  }
  bool rests(std::size_t i, std::size_t s, const SegmentLink& link) const {
    if (!links_[i].stations[s].there() || !links_[i].stations[new_[i].next(s)].there()) return false;
    bool all = true;
    for_each_between(i, s, link, [&](const BoundaryVertex& vertex) {
      const Point p = on_new_curve(i, vertex.t, s);
      all &= squared_distance(p, triangulation_.point(vertex.vertex)) <= squared_rounding(p);
    });
    return all;
  }
  static double squared_rounding(Point p) {
    constexpr double spacings = 0x1p-40;
    const double near = spacings * std::max(std::abs(p.x), std::abs(p.y));
    return near * near;
  }
  Point on_new_curve(std::size_t loop, double t, std::size_t station) const {
    return Frame(domain_.loops[loop].placement)(
        point_at(domain_.curve(new_[loop].stations[station].curve).shape, t));
  }

  std::uint32_t entry(const StationLink& link) const { return old_[link.loop].stations[link.station]; }

  // What refinement put on an old segment, as entries of the new one, in its direction: visit(vertex).
  template <class Visit>
  void for_each_between(std::size_t i, std::size_t s, const SegmentLink& link, Visit visit) const {
    const OldLoop& old = old_[link.loop];
    const std::uint32_t from = old.stations[link.segment], to = old.stations[old.next(link.segment)];
    Entries between;
    for (std::uint32_t k = mesh_.at(from).next; k != to; k = mesh_.at(k).next) between.push_back(k);
    if (between.empty()) return;
    if (link.reversed) std::reverse(between.begin(), between.end());
    const double old_from = mesh_.at(from).t, old_to = end_of(mesh_.at(from), mesh_.at(to));
    const BoundaryStation &here = new_[i].stations[s], &there = new_[i].stations[new_[i].next(s)];
    const double new_from = here.t, new_to = there.curve == here.curve && there.t > here.t ? there.t : 1.0;
    const bool same = !link.reversed && old_from == new_from && old_to == new_to;
    for (const std::uint32_t k : between) {
      BoundaryVertex vertex = mesh_.at(k);
      const double part = (vertex.t - old_from) / (old_to - old_from);
      vertex.curve = static_cast<std::uint32_t>(here.curve);
      if (!same) vertex.t = new_from + (link.reversed ? 1.0 - part : part) * (new_to - new_from);
      visit(vertex);
    }
  }
  static double end_of(const BoundaryVertex& from, const BoundaryVertex& to) {
    return to.curve == from.curve && to.t > from.t ? to.t : 1.0;
  }

  // Linked stations stay where they are. Others come to lie as they do on the new domain, as seen from the
  // nearest ones before and behind them that are linked to the loop's predecessor.
  void find_places() {
    for (std::size_t i = 0; i < new_.size(); ++i) {
      NewLoop& loop = new_[i];
      loop.places = loop.points;
      const std::vector<StationLink>& stations = links_[i].stations;
      std::vector<std::size_t> linked;
      for (std::size_t s = 0; s < stations.size(); ++s) {
        if (!stations[s].there()) continue;
        loop.places[s] = mesh_.point(entry(stations[s]));
        if (stations[s].loop == links_[i].from) linked.push_back(s);
      }
      if (places_ == Places::wanted || linked.empty()) continue;
      for (std::size_t l = 0; l < linked.size(); ++l)
        place_between(loop, stations, linked[l], linked[(l + 1) % linked.size()], domain_.loops[i].open);
    }
  }
  void place_between(NewLoop& loop, const std::vector<StationLink>& stations, std::size_t a, std::size_t b,
                     bool open) const {
    const auto distance = [](Point p, Point q) { return std::sqrt(squared_distance(p, q)); };
    const Point by_a = loop.places[a] - loop.points[a], by_b = loop.places[b] - loop.points[b];
    const bool wraps = open && b <= a;  // the chain's ends lie between
    double all = 0.0, way = 0.0;
    for (std::size_t s = a; s != b || all == 0.0; s = loop.next(s)) {
      all += distance(loop.points[s], loop.points[loop.next(s)]);
      if (loop.next(s) == b) break;
    }
    for (std::size_t s = a; loop.next(s) != b; s = loop.next(s)) {
      const std::size_t here = loop.next(s);
      way += distance(loop.points[s], loop.points[here]);
      if (stations[here].there()) continue;
      const double share = wraps ? (here > a ? 0.0 : 1.0) : way / all;
      loop.places[here] = loop.points[here] + ((1.0 - share) * by_a + share * by_b);
    }
  }

  // Where stations of the old loop are gone, and what they held apart comes together, as where an open
  // trailing edge closes: what is linked before the gap follows what is linked behind it, so that the two lie
  // to each other as they do on the new domain. That goes over into old places along the loop; stations that
  // it moves by more than a part of the way to their neighbours are replaced. Left apart, they would squeeze
  // what is between when the rest moves.
  void blend_into_gaps(std::size_t i) {
    NewLoop& loop = new_[i];
    LoopLinks& links = links_[i];
    if (domain_.loops[i].open || links.from == no_link) return;
    const OldLoop& old = old_[links.from];
    for (std::size_t s = 0; s < links.segments.size(); ++s) {
      const StationLink here = links.stations[s], there = links.stations[loop.next(s)];
      if (links.segments[s].there() || here.loop != links.from || there.loop != links.from) continue;
      blend(loop, links, s, loop.next(s), old.stations.size());
    }
  }
  void blend(NewLoop& loop, LoopLinks& links, std::size_t a, std::size_t b, std::size_t most) {
    constexpr double reach = 4.0, little = 0.25;
    const auto distance = [](Point p, Point q) { return std::sqrt(squared_distance(p, q)); };
    const Point moves = loop.points[b] - loop.places[b];
    const double jump = distance(loop.points[a] - moves, loop.places[a]);
    double way = 0.0;
    for (std::size_t s = a, n = 0; n < most && way < reach * jump && s != b; s = loop.before(s), ++n) {
      const double next = distance(loop.points[s], loop.points[loop.next(s)]);
      const double previous = distance(loop.points[s], loop.points[loop.before(s)]);
      const double share = way / (reach * jump), weight = (1.0 - share) * (1.0 - share) * (1.0 + 2.0 * share);
      const Point offset = weight * ((loop.points[s] - moves) - loop.places[s]);
      way += previous;
      if (distance(offset, {}) <= little * std::min(next, previous)) continue;
      loop.places[s] = loop.places[s] + offset;
      links.stations[s] = {};
      links.segments[s] = links.segments[loop.before(s)] = {};
    }
  }

  // Takes the old boundary out, but for what stays, and what lies in the regions of removal.
  std::vector<VertexId> clear_old() {
    mesh_.seen_vertices.clear(triangulation_.vertex_slots());
    restore_outside(mesh_);
    const List<VertexId> inside = vertices_inside(mesh_, regions());
    release_old();
    triangulation_.remove(inside);
    return forget_old();
  }

  bool stays(const OldLoop& loop, std::size_t station) const {
    return !loop.claimed.empty() && loop.claimed[std::min(station, loop.claimed.size() - 1)];
  }
  bool stays(const LoopLinks& links, std::size_t station) const {
    if (links.segments.empty()) return links.stations[0].there();
    return links.segments[std::min(station, links.segments.size() - 1)].there();
  }

  // All stations of a loop, but for those at which a segment begins that stays.
  template <class Links, class PointOf>
  void add_model(Model& model, const Links& links, std::size_t n, bool open, PointOf point) const {
    for (std::size_t i = 0; i < n; ++i) {
      if (stays(links, i)) continue;
      // The end of a chain has one neighbour, a single point none: then they are the same.
      const bool first = open && i == 0, last = open && i + 1 == n;
      const Point before = first ? point(last ? i : i + 1) : point((i + n - 1) % n);
      model.points.push_back(point(i));
      model.before.push_back(before);
      model.after.push_back(last ? before : point((i + 1) % n));
    }
  }

  // A loop's vertices pair with those of its predecessor: what has appeared or is gone pairs with nothing.
  std::vector<RemovalRegion> regions() const {
    std::vector<Model> olds(old_.size()), news(new_.size());
    for (std::size_t j = 0; j < old_.size(); ++j) {
      if (is_single_point_that_stays(j)) continue;
      add_model(olds[j], old_[j], old_[j].stations.size(), old_domain_.loops[j].open,
                [&](std::size_t s) { return mesh_.point(old_[j].stations[s]); });
    }
    for (std::size_t i = 0; i < new_.size(); ++i)
      add_model(news[i], links_[i], new_[i].stations.size(), domain_.loops[i].open,
                [&](std::size_t s) { return new_[i].places[s]; });
    std::vector<RemovalRegion> result;
    const Model none;
    std::vector<std::size_t> successor(old_.size(), no_link);
    for (std::size_t i = 0; i < new_.size(); ++i)
      if (links_[i].from != no_link) successor[links_[i].from] = i;
    for (std::size_t j = 0; j < old_.size(); ++j)
      add_regions(olds[j], successor[j] == no_link ? none : news[successor[j]], result);
    for (std::size_t i = 0; i < new_.size(); ++i)
      add_regions(news[i], links_[i].from == no_link ? none : olds[links_[i].from], result);
    return result;
  }
  bool is_single_point_that_stays(std::size_t j) const {
    return old_[j].claimed.empty() && std::any_of(links_.begin(), links_.end(), [&](const LoopLinks& links) {
             return links.segments.empty() && links.stations[0].loop == j;
           });
  }
  void add_regions(const Model& model, const Model& other, std::vector<RemovalRegion>& result) const {
    if (model.points.empty()) return;
    const Nearest nearest_other(other);
    TriangleId hint = any_triangle();
    for (std::size_t i = 0; i < model.points.size(); ++i) {
      const double nearest = std::sqrt(nearest_other.squared_distance_to(model.points[i]));
      const double pair = std::isfinite(nearest) && places_ == Places::wanted ? nearest : 0.0;
      const double least = least_radius(options_, model.points[i], model.before[i], model.after[i]);
      result.push_back({model.points[i], std::max(options_.distance * pair, least), hint});
      hint = triangulation_.locate(model.points[i], hint).triangle;
    }
  }

  TriangleId any_triangle() const { return triangulation_.star(triangulation_.first_vertex()).triangle; }

  void release_old() {
    for (const OldLoop& loop : old_)
      for (std::size_t s = 0; s < loop.claimed.size(); ++s) {
        if (loop.claimed[s]) continue;
        const std::uint32_t last = loop.stations[loop.next(s)];
        std::uint32_t k = loop.stations[s];
        do {
          const std::uint32_t next = mesh_.at(k).next;
          triangulation_.release(mesh_.at(k).vertex, mesh_.at(next).vertex);
          k = next;
        } while (k != last);
      }
  }

  // The vertices of the boundary that does not stay, which are free vertices now, but for those that what
  // stays joins. No vertex has a record any more: the table is made anew.
  std::vector<VertexId> forget_old() {
    std::vector<VertexId> vertices;
    for (const OldLoop& loop : old_)
      for (std::size_t s = 0; s < loop.stations.size(); ++s) {
        const bool last = s >= loop.claimed.size();
        if (!last && loop.claimed[s] && loop.claimed[(s + loop.claimed.size() - 1) % loop.claimed.size()])
          continue;
        vertices.push_back(mesh_.at(loop.stations[s]).vertex);
        if (last || loop.claimed[s]) continue;
        for (std::uint32_t k = mesh_.at(loop.stations[s]).next; mesh_.at(k).steiner; k = mesh_.at(k).next)
          vertices.push_back(mesh_.at(k).vertex);
      }
    for (const std::uint32_t head : mesh_.loop_heads)
      mesh_.walk(head, [&](std::uint32_t k) {
        if (triangulation_[mesh_.at(k).vertex].boundary != no_index)
          triangulation_.set_boundary(mesh_.at(k).vertex, no_index);
      });
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
  }

  // The boundary table of the new domain: what stays as it is, the rest inserted. A vertex that is already at
  // a station (the trailing edge, often) becomes the boundary vertex.
  void rebuild_table() {
    std::vector<std::vector<Draft>> drafts;
    for (std::size_t loop = 0; loop < domain_.loops.size(); ++loop) drafts.push_back(draft(loop));
    mesh_.boundary.take_all();
    mesh_.loop_heads.clear();
    mesh_.domain = domain_;
    mesh_.index_curves();
    for (std::size_t loop = 0; loop < domain_.loops.size(); ++loop) insert_loop(loop, drafts[loop]);
    mesh_.orient_loops();
    for (const std::uint32_t k : new_stations_)  // until the neighbours are known
      mesh_.set_boundary_length_scale(k, mesh_.base_length_scale(k));
  }

  // An entry to be: of a station, or of what refinement put behind it. It has no vertex yet where the station
  // is new.
  struct Draft {
    BoundaryVertex vertex;
    std::size_t station;
    bool is_new;      // the station or a segment at it
    bool begins_new;  // the segment from it
  };
  std::vector<Draft> draft(std::size_t i) const {
    const LoopLinks& links = links_[i];
    std::vector<Draft> drafts;
    for (std::size_t s = 0; s < new_[i].stations.size(); ++s) {
      const BoundaryStation& station = new_[i].stations[s];
      BoundaryVertex vertex{.vertex = {}, .curve = static_cast<std::uint32_t>(station.curve), .t = station.t};
      if (links.stations[s].there()) {
        const BoundaryVertex& old = mesh_.at(entry(links.stations[s]));
        vertex.vertex = old.vertex;
        vertex.scale_factor = old.scale_factor;
      }
      const bool has_next = s<links.segments.size(), has_previous = s> 0 || !domain_.loops[i].open;
      const bool next_new = has_next && !links.segments[s].there();
      const bool previous_new =
          has_previous && !links.segments.empty() && !links.segments[new_[i].before(s)].there();
      drafts.push_back({vertex, s, !vertex.vertex || next_new || previous_new, next_new});
      if (has_next && !next_new)
        for_each_between(i, s, links.segments[s], [&](const BoundaryVertex& between) {
          drafts.push_back({between, s, false, false});
        });
    }
    return drafts;
  }

  void insert_loop(std::size_t loop, std::vector<Draft>& drafts) {
    insert_stations(loop, drafts);
    std::uint32_t previous = no_index;
    for (const Draft& draft : drafts) {
      const std::uint32_t other = triangulation_[draft.vertex.vertex].boundary;
      if (other != no_index && (draft.vertex.steiner || mesh_.at(other).steiner))
        throw RecoveryError(on_another_curve);
      const bool first = previous == no_index;
      previous = mesh_.add_boundary_vertex(draft.vertex, previous);
      if (first) mesh_.loop_heads.push_back(previous);
      if (draft.is_new) new_stations_.push_back(previous);
      if (draft.begins_new) new_edges_.push_back(previous);
    }
    if (!domain_.loops[loop].open) mesh_.close_loop(mesh_.loop_heads.back(), previous);
    last_ = mesh_.at(previous).vertex;
  }

  // The vertices of a loop's new stations. Long loops are inserted from coarse to fine: one point after the
  // other along a curve, each would have to cut the triangles of all before it.
  void insert_stations(std::size_t loop, std::vector<Draft>& drafts) {
    constexpr std::size_t long_loop = 1024;
    TriangleId hint = last_ ? triangulation_.star(last_).triangle : any_triangle();
    const auto insert = [&](Draft& draft) {
      if (draft.vertex.vertex) return;
      const auto [v, is_new] = triangulation_.insert(new_[loop].places[draft.station], hint);
      if (is_new && triangulation_.at_constraint(v)) throw RecoveryError(on_another_curve);
      draft.vertex.vertex = v;
      hint = triangulation_.star(v).triangle;
    };
    if (drafts.size() < long_loop) {
      for (Draft& draft : drafts) insert(draft);
      return;
    }
    for (const std::size_t i : coarse_to_fine(drafts.size())) {
      if (const std::size_t before = i & (i - 1); i > 0 && drafts[before].vertex.vertex)
        hint = triangulation_.star(drafts[before].vertex.vertex).triangle;
      insert(drafts[i]);
    }
  }

  // A vertex that both models share (the trailing edge, often) keeps triangles from before the step, but not
  // its length scale: they count as touched, so that refinement judges them anew.
  void set_length_scale(std::uint32_t k) {
    if (mesh_.at(k).steiner) return;
    const Neighbours neighbours = options_.renewing ? Neighbours::stations : Neighbours::all;
    mesh_.set_boundary_length_scale(k, neighbour_length_scale(mesh_, k, neighbours));
    keep_scales_beside(k);
    triangulation_.for_each_corner(mesh_.at(k).vertex,
                                   [&](Corner c) { triangulation_.refresh_circle(c.triangle); });
  }

  // Steiner vertices up to the next stations keep their length scales. What their factors refer to follows
  // the station's.
  void keep_scales_beside(std::uint32_t k) {
    const auto keep = [&](std::uint32_t s, std::uint32_t BoundaryVertex::*step) {
      for (; s != no_index && mesh_.at(s).steiner; s = mesh_.at(s).*step)
        mesh_.set_boundary_length_scale(s, mesh_.length_scale(s));
    };
    mesh_.at_vertex(k, [&](std::uint32_t e) {
      keep(mesh_.at(e).next, &BoundaryVertex::next);
      keep(mesh_.at(e).previous, &BoundaryVertex::previous);
    });
  }

  static constexpr const char* on_another_curve =
      "a boundary vertex of the new design lies on a curve of another loop";
  MeshData& mesh_;
  Triangulation& triangulation_;
  const Domain old_domain_;
  const Domain& domain_;
  const Places places_;
  ReplaceOptions options_;
  std::vector<LoopLinks> links_;
  std::vector<OldLoop> old_;
  std::vector<NewLoop> new_;
  std::size_t unlinked_ = 0, unclaimed_ = 0;  // segments, new and old, and single points
  Entries new_stations_;                      // that are new, or at which a new segment ends
  Entries new_edges_;                         // from where they run
  VertexId last_;                             // inserted: where the search for the next loop begins
};

}  // namespace

void replace_loops(MeshData& mesh, const Correspondence& to, Places places, const ReplaceOptions& options) {
  LoopReplacement(mesh, to, places, options).run();
}

}  // namespace remodel
