// One remodelling of a layered mesh, which can be taken back.

#include <algorithm>
#include <utility>

#include "layer/layer_count.h"
#include "layer/layer_parts.h"
#include "layer/outer_step.h"
#include "layer/outside.h"
#include "mesh/mesh_data.h"
#include "remodel/error.h"
#include "step/correspondence.h"
#include "step/station_links.h"

namespace remodel {

namespace {

// The new walls in the terms of the mesh's own: its curves where loops are the same places, written
// otherwise.
struct NewWalls {
  Domain domain;
  std::vector<std::size_t> from;  // per loop: the old one that it is station for station, or no_link
};

// Whether a loop is another one by no more than the rounding of its points. The outer mesh keeps its own
// then, and the walls have to, or the columns would not end at its tops.
bool differs_by_rounding(const Domain& own, const Domain& wanted) {
  for (std::size_t l = 0; l < wanted.loops.size(); ++l)
    if (!(own.loops[l] == wanted.loops[l]) &&
        !same_stations(outline_of_loop(own, l), outline_of_loop(wanted, l)).station.empty())
      return true;
  return false;
}

NewWalls in_own_terms(const Domain& own, const Domain& wanted) {
  NewWalls walls{wanted, {}};
  if (follows_by_index(own, wanted) && !differs_by_rounding(own, wanted)) {
    for (std::size_t l = 0; l < wanted.loops.size(); ++l) walls.from.push_back(l);
    return walls;
  }
  Correspondence to = correspond(own, wanted);
  walls.domain = std::move(to.domain);
  for (std::size_t l = 0; l < to.loops.size(); ++l) {
    const std::size_t from = to.loops[l].from;
    const bool same = from != no_link && in_order(own.loops[from], walls.domain.loops[l]);
    walls.from.push_back(same ? from : no_link);
  }
  return walls;
}

// Per ring: the one of the same stations of its old loop, or no_column.
std::vector<std::size_t> old_rings(const std::vector<LayeredWall>& walls,
                                   const std::vector<std::size_t>& from,
                                   const std::vector<LayeredWall>& old_walls) {
  std::vector<std::size_t> rings;
  for (const LayeredWall& wall : walls) {
    const auto old = std::find_if(old_walls.begin(), old_walls.end(), [&](const LayeredWall& before) {
      return before.loop == from[wall.loop] && before.closed == wall.closed &&
             before.station == wall.station && (wall.closed || before.stations == wall.stations);
    });
    rings.push_back(old == old_walls.end() ? ColumnPlace::no_column
                                           : static_cast<std::size_t>(old - old_walls.begin()));
  }
  return rings;
}

LayeredRemodelResult of_the_whole(const RemodelResult& outer, const LayerCounts& layer) {
  LayeredRemodelResult result;
  static_cast<RemodelResult&>(result) = outer;
  result.triangles_before += layer.before;
  result.triangles += layer.now;
  result.preserved += layer.preserved;
  result.connected += layer.connected;
  result.moved += layer.moved;
  result.inserted += layer.inserted;
  result.removed += layer.removed;
  result.layer_cells = layer.now;
  return result;
}

}  // namespace

class LayeredMesh::Step {
 public:
  Step(LayeredMesh& mesh, const Domain& domain, const RemodelOptions& options, OuterStep::TakeBack take_back);
  Step(const Step&) = delete;
  Step& operator=(const Step&) = delete;
  ~Step();
  void keep();
  const LayeredRemodelResult& result() const { return result_; }

 private:
  std::shared_ptr<Columns> columns_on(const Domain& walls, const std::vector<std::size_t>& from);
  void take(std::shared_ptr<const Columns> columns, Domain walls, const std::vector<RingTops>& tops_before);
  void stay();

  LayeredMesh& mesh_;
  ColumnMatches matches_;
  std::optional<OuterStep> outer_;
  LayeredRemodelResult result_;
  // What was there before, once it has changed.
  std::shared_ptr<const Columns> columns_before_;
  Domain walls_before_;
};

LayeredMesh::Step::Step(LayeredMesh& mesh, const Domain& domain, const RemodelOptions& options,
                        OuterStep::TakeBack take_back)
    : mesh_(mesh) {
  if (mesh.empty())
    throw Error(ErrorCode::argument, "mesh", "found an empty one, expected one that was generated or read");
  validate(domain);
  NewWalls wanted = in_own_terms(mesh.walls_, domain);
  std::shared_ptr<Columns> columns = columns_on(wanted.domain, wanted.from);
  const std::vector<RingTops> tops_before = tops_of(mesh.outer_, *mesh.columns_);
  const Domain outside = outside_of(wanted.domain, *columns, columns->levels);
  outer_.emplace(mesh.outer_, outside, *columns, options, take_back);
  if (outer_->as_it_was())
    stay();
  else
    take(std::move(columns), std::move(wanted.domain), tops_before);
}

// The columns of these walls, with the numbers that the same ones have now. from: NewWalls::from.
std::shared_ptr<LayeredMesh::Columns> LayeredMesh::Step::columns_on(const Domain& of,
                                                                    const std::vector<std::size_t>& from) {
  const Columns& own = *mesh_.columns_;
  const Walls walls(of);
  auto columns = std::make_shared<Columns>();
  columns->layered = layered_walls(walls, mesh_.options_);
  columns->levels = own.levels;
  const std::vector<std::size_t> old_ring = old_rings(columns->layered, from, own.layered);
  std::vector<const std::vector<std::uint32_t>*> kept;
  for (const std::size_t ring : old_ring)
    kept.push_back(ring == ColumnPlace::no_column ? nullptr : &own.fans[ring]);
  columns->fans = fans_of(walls, columns->layered, mesh_.options_, kept);
  static_cast<LayerColumns&>(*columns) =
      columns_of(walls, columns->layered, columns->fans, mesh_.options_, columns->levels);
  matches_ = match_columns(own.fans, columns->fans, old_ring);
  columns->next_id = own.next_id;
  for (const std::vector<ColumnPlace>& ring : matches_) {
    std::vector<std::uint32_t>& ids = columns->ids.emplace_back();
    for (const ColumnPlace old : ring)
      ids.push_back(old.there() ? own.ids[old.ring][old.column] : columns->next_id++);
  }
  return columns;
}

void LayeredMesh::Step::stay() {
  result_ = of_the_whole(outer_->result(), {});
  const std::size_t cells = mesh_.layer_cells();
  for (std::size_t* count :
       {&result_.triangles_before, &result_.triangles, &result_.preserved, &result_.connected})
    *count += cells;
  result_.layer_cells = cells;
  result_.shrunk = mesh_.shrunk();
}

void LayeredMesh::Step::take(std::shared_ptr<const Columns> columns, Domain walls,
                             const std::vector<RingTops>& tops_before) {
  const Columns& own = *mesh_.columns_;
  result_ = of_the_whole(
      outer_->result(),
      count_layer(own, tops_before, *columns, tops_of(mesh_.outer_, *columns), matches_, own.levels));
  result_.shrunk = columns->shrunk;
  std::size_t same = 0;
  for (const std::vector<ColumnPlace>& ring : matches_)
    same += static_cast<std::size_t>(
        std::count_if(ring.begin(), ring.end(), [](ColumnPlace old) { return old.there(); }));
  result_.same_columns = same == own.count() && same == columns->count();
  columns_before_ = std::exchange(mesh_.columns_, std::move(columns));
  walls_before_ = std::exchange(mesh_.walls_, std::move(walls));
}

LayeredMesh::Step::~Step() {
  if (columns_before_) {
    mesh_.columns_ = std::move(columns_before_);
    mesh_.walls_ = std::move(walls_before_);
  }
}

void LayeredMesh::Step::keep() {
  columns_before_.reset();
  outer_->keep();
}

LayeredRemodelResult remodel(LayeredMesh& mesh, const Domain& domain, const RemodelOptions& options) {
  LayeredMesh::Step step(mesh, domain, options, OuterStep::TakeBack::never);
  step.keep();
  return step.result();
}

LayeredTrial::LayeredTrial(LayeredMesh& mesh, const Domain& domain, const RemodelOptions& options)
    : step_(std::make_unique<LayeredMesh::Step>(mesh, domain, options, OuterStep::TakeBack::possible)) {}
LayeredTrial::~LayeredTrial() = default;
const LayeredRemodelResult& LayeredTrial::result() const {
  return step_->result();
}
void LayeredTrial::keep() {
  step_->keep();
}

LayeredMesh mesh_at(const LayeredMesh& mesh, const Domain& design) {
  return mesh_at(mesh, design, mesh.outer().held() ? Strategy::reference : Strategy::chain);
}

LayeredMesh mesh_at(const LayeredMesh& mesh, const Domain& design, Strategy strategy) {
  if (mesh.empty())
    throw Error(ErrorCode::argument, "mesh", "found an empty one, expected one that was generated or read");
  validate(design);
  const LayeredMesh::Columns& own = *mesh.columns_;
  const Walls walls(design);
  if (!follows_by_index(mesh.walls_, design) || layered_walls(walls, mesh.options_) != own.layered)
    throw TopologyChanged(ErrorCode::argument, "design",
                          "found other loops or stations, expected those of the mesh");
  auto columns = std::make_shared<LayeredMesh::Columns>(own);
  static_cast<LayerColumns&>(*columns) = columns_of(walls, own.layered, own.fans, mesh.options_, own.levels);
  LayeredMesh result;
  result.outer_ = mesh_at(mesh.outer_, outside_of(design, *columns, own.levels), strategy);
  result.walls_ = design, result.options_ = mesh.options_, result.columns_ = std::move(columns);
  return result;
}

}  // namespace remodel
