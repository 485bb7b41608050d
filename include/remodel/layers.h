#pragma once

// Layers of flat quadrilaterals on walls, for flows with friction, that live with the shape.
//
// A layered mesh is two things. Around it lies a living mesh of triangles, Mesh, as any other, whose hole is
// not the wall but a polygon some hundredths of a chord off it. Between the two stand *columns* of cells, one
// on each station of the wall, all with the same number of *levels*. Columns are a function of the wall
// alone: a step computes them anew, and remodels the outer mesh to the polygon of their tops. So the
// connectivity of a layer is the same for a whole run, whatever the outer mesh has to do; only a top cell
// whose upper edge the outer mesh has split is divided into triangles, and no further cell below it.
//
// Lengths are in chords, as everywhere.

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "remodel/domain.h"
#include "remodel/frozen_mesh.h"
#include "remodel/mesh.h"
#include "remodel/mesh_derivative.h"
#include "remodel/mesh_state.h"
#include "remodel/remodel.h"

namespace remodel {

struct LayerOptions {
  double first_height = 0.0;  // of the cells at the wall: more than 0; first_height() has one for a y+
  double growth = 1.2;        // of a cell's height over that of the cell below it, at most: 1.02 to 2
  // The wanted thickness of the whole layer: at least first_height. In gaps, coves and concave corners
  // columns are thinner: they take half the radius of the ball that touches the wall there and has no other
  // wall inside.
  double thickness = 0.02;
  // The boundary names of the walls that get a layer. Empty: those of all holes, and of outer loops which
  // have curves called inlet, outlet, symmetry or farfield (inflow, outflow, axis; Inlet, outlet_2) or
  // are periodic the other ones.
  std::vector<std::string> walls = {};
  double fan_from_deg = 30.0;  // a convex corner that turns by more gets a fan of columns: 10 to 90
  friend bool operator==(const LayerOptions&, const LayerOptions&) = default;
};

// A wall with a layer: a whole closed loop, or a chain of its curves which ends, on both sides, at an
// opening.
struct LayeredWall {
  std::size_t loop = 0;
  std::size_t first = 0, curves = 0;      // the first curve, in the loop, and how many follow each other
  std::size_t station = 0, stations = 0;  // likewise; a chain's last station is the opening's first one
  bool closed = true;
  friend bool operator==(const LayeredWall&, const LayeredWall&) = default;
};

// The height in chords at which y+ is what is given, on a flat plate of the chord's length with a turbulent
// boundary layer: y+ / (Re sqrt(cf / 2)), cf = 0.026 Re^(-1/7). Source: F. M. White, "Viscous Fluid Flow",
// 1974. Around an airfoil y+ is up to three times as much where the flow is fast. Throws Error (argument)
// unless y+ is positive and Re is 1 to 1e12.
double first_height(double y_plus, double reynolds);
// 0.37 Re^(-1/5): the thickness of that boundary layer at the end of the plate (H. Schlichting,
// "Boundary-Layer Theory"). A layer needs a fifth more.
double boundary_layer_thickness(double reynolds);
// The thickness of `count` cells of which the first has this height and each is `growth` times the one below
// it.
double thickness_of(double first_height, double growth, int count);

// The distances between the stations of a wall in chords: at the nose, at the corners (of which the trailing
// edge is one), and the largest; they grow by `growth` for each unit of length that lies between.
struct WallSpacing {
  double leading_edge = 0.0015;
  double trailing_edge = 0.0015;
  double most = 0.008;
  double growth = 0.11;

  WallSpacing times(double factor) const {  // the distances; the growth has no unit
    return {factor * leading_edge, factor * trailing_edge, factor * most, growth};
  }
};
// The stations of a closed loop by these distances, a list for each of its curves, for Curve::parameters. The
// nose is a station, of curves that are no airfoil the point farthest from where the loop begins. Polylines
// keep their corners. With several elements (bends = true) curves with a small radius have distances of an
// eighth of it, where that is not below a quarter of the nose's. Throws Error (argument) for distances that
// are not positive, or below 1e-6, and a growth that is not 0.01 to 1.
std::vector<Parameters> wall_stations(const Loop& loop, const WallSpacing& spacing, bool bends = false);
// These stations on all walls that get a layer, of those names (LayerOptions::walls). Chains have the
// corners' distances at both ends, and those of a nose nowhere. Lines on which a layer goes on beyond a wall
// (see generate_layered()) have distances that grow without a bound.
void space_walls(Domain& domain, const WallSpacing& spacing, const std::vector<std::string>& walls = {});

// A line of fine triangles in the wake, from behind the point of the walls that lies farthest downstream.
struct WakeLine {
  double length = 1.0;        // more than 0
  Point direction{1.0, 0.0};  // downstream; of any length but 0
  double first = 0.005;       // of its edges, which grow by `growth` to `most`; all as WallSpacing has them
  double growth = 1.1;
  double most = 0.05;
};
// Adds it as an internal chain "wake", which every step keeps. It begins a little more than four thicknesses
// of the layer behind that point: columns are as thick as they are without it. Throws Error (argument) for
// values out of range and names that no closed loop has.
void add_wake(Domain& domain, const WakeLine& wake, const LayerOptions& layers);

// The cells of the frozen view: quadrilaterals with triangles where fans meet the wall and where top cells
// are divided; or all of them triangles, by the diagonal that begins at the wall.
enum class LayerCells : std::uint8_t { quadrilaterals, triangles };

// The points of a layer stand in the frozen view before all others, column by column, from the wall upwards.
// They never change their places as long as columns neither come nor go.
struct LayerTopology {
  std::uint32_t levels = 0;          // cells of a column
  std::vector<std::uint32_t> wall;   // per column: its point on the wall; columns of one fan share it
  std::vector<std::uint32_t> first;  // per column: its point at level 1; that of level j is first + j - 1
  std::vector<std::uint32_t>
      next;  // per column: the next one along the wall; the last one of a chain: itself
  std::vector<std::uint32_t> column;  // per point of the layer: its column, the first one that it is in
  std::vector<std::uint32_t> level;   // per point of the layer: 0 on the wall
  std::uint32_t point(std::uint32_t of_column, std::uint32_t at_level) const {
    return at_level == 0 ? wall[of_column] : first[of_column] + at_level - 1;
  }
};

struct LeastAndMost {
  double least = 0.0, most = 0.0;
};
struct LayerStatistics {
  std::size_t columns = 0;
  std::size_t cells = 0;        // of the layer, triangles included
  double first_height = 0.0;    // as asked; where columns are too thin for it, cells are lower
  LeastAndMost thickness;       // of columns
  LeastAndMost growth;          // of columns; 1: uniform
  double aspect_max = 0.0;      // the longest edge at the wall over the height of its cell
  double corner_min_deg = 0.0;  // the smallest corner of quadrilaterals
  // A triangle over a top cell, and the cell: the larger area over the smaller one.
  double area_jump_median = 0.0, area_jump_max = 0.0;
  std::size_t split_tops = 0;  // top cells that are divided into triangles
  std::size_t shrunk = 0;  // columns that had to give way so that all cells are convex and tops keep apart
};

// A native file holds this of a layered mesh: the rest is computed from it, to the bit.
struct LayeredState {
  MeshState outer;
  Domain walls;
  LayerOptions options;
  std::uint32_t levels = 0;
  std::vector<std::vector<std::uint32_t>>
      fans{};  // per layered wall and station: the sectors of its fan, or 0
  // Each column of a layered wall has a number, which is never given out again in the life of a mesh. All are
  // below next_column.
  std::vector<std::vector<std::uint32_t>> columns{};
  std::uint32_t next_column = 0;
  friend bool operator==(const LayeredState&, const LayeredState&) = default;
};

// The changes of a layered mesh since a mark. Vertices are those of the whole, by the keys that the
// frozen view has; triangles by id are those of the outer mesh. So same_connectivity() speaks of the whole:
// where cells of the layer come or go, vertices do.
struct LayeredChanges : Changes {
  std::size_t layer_born = 0, layer_gone = 0;  // cells of the layer that join other vertices than before
};
// A moment in the life of a layered mesh, as Mark is one in that of a mesh.
class LayerMark {
 public:
  LayerMark() = default;  // of no mesh

 private:
  friend class LayeredMesh;
  struct Moment;
  std::shared_ptr<const Moment> moment_;
};

class LayeredMeshDerivative;
struct LayeredGenerateResult;
struct LayeredRemodelResult;

// The living layered mesh: a value, as Mesh is.
class LayeredMesh {
 public:
  LayeredMesh();
  ~LayeredMesh();
  LayeredMesh(LayeredMesh&&) noexcept;
  LayeredMesh& operator=(LayeredMesh&&) noexcept;
  LayeredMesh(const LayeredMesh&);
  LayeredMesh& operator=(const LayeredMesh&);

  bool empty() const { return outer_.empty(); }
  const Mesh& outer() const { return outer_; }     // of what lies beyond the tops
  const Domain& domain() const { return walls_; }  // the walls, not the tops
  // The walls with the stations of openings where they are in the mesh: CheckOptions::design.
  Domain meshed_domain() const;
  const LayerOptions& options() const { return options_; }
  std::uint32_t levels() const;
  std::size_t columns() const;
  std::size_t layer_cells() const;  // of LayerCells::quadrilaterals, divided top cells by their triangles
  std::size_t cells() const { return layer_cells() + outer_.triangle_count(); }
  std::size_t shrunk() const;

  // Points: those of LayerTopology, then those of the outer mesh that are not tops. Cells: triangles of the
  // layer, triangles of the outer mesh; quadrilaterals column by column, from the wall upwards. Vertices have
  // keys: those of the layer, by column and level, are of generations from 2^31 on.
  FrozenMesh freeze(LayerCells cells = LayerCells::quadrilaterals) const;
  LayerTopology topology() const;
  LayerStatistics statistics() const;

  // These are as those of Mesh.
  LayerMark mark();
  LayeredChanges changes_since(const LayerMark& mark) const;

  // The outer mesh's quick_check(); all cells strictly convex, by exact predicates; the tops are the outer
  // mesh's.
  std::string quick_check() const;
  LayeredState state() const;
  // Throws Error (format) where the state is none, or its outer mesh does not fit the walls' columns.
  static LayeredMesh restore(const LayeredState& state, const std::string& source);

 private:
  struct Columns;
  class Step;
  friend LayeredRemodelResult remodel(LayeredMesh&, const Domain&, const RemodelOptions&);
  friend LayeredMesh mesh_at(const LayeredMesh&, const Domain&, Strategy);
  friend LayeredGenerateResult generate_layered(const Domain&, const LayerOptions&, const QualityOptions&,
                                                StepObserver*);
  friend class LayeredTrial;
  friend LayeredMeshDerivative;
  friend class LayerFrame;

  Mesh outer_;
  Domain walls_;
  LayerOptions options_;
  std::shared_ptr<const Columns> columns_;
};

struct LayeredGenerateResult {
  LayeredMesh mesh;
  Stopped stopped = Stopped::done;
  std::size_t small_angles = 0;  // of the outer mesh's domain: see GenerateResult
  std::size_t exempt_triangles = 0;
};

// Walls that end at openings, as those of ducts do, have columns on the openings' lines at their ends: lines,
// polylines or arcs at 60 to 120 degrees, of whose length a layer takes 0.3 at most. Stations of openings
// move a little, to make room for it. Where an opening goes straight on from the wall, within 30 degrees, it
// has columns too. Throws Error (argument) for options out of range and names that no closed loop has; Error
// (geometry) for what validate() refuses, for internal chains that end on a wall or its openings, for
// openings at other angles, and where no layer fits, with the place.
LayeredGenerateResult generate_layered(const Domain& domain, const LayerOptions& layers,
                                       const QualityOptions& quality = {}, StepObserver* observer = nullptr);

// The figures of a step. Those that RemodelResult counts as triangles are cells of the whole: layer and
// outside. Its moved, inserted and removed vertices are those of the whole too.
struct LayeredRemodelResult : RemodelResult {
  std::size_t layer_cells = 0;  // now
  std::size_t shrunk = 0;       // see LayerStatistics
  bool same_columns = true;     // false: columns have come or gone, as stations have, or fans have other
                                // sectors; where stations are the same, all other columns stay
};

// The derivative of a layered mesh by its design, at fixed connectivity: walls by their curves at fixed
// parameters, the layer by its columns, the outer mesh as MeshDerivative has it: its interior still, or along
// with the tops of these loops. Columns are differenced to fourth order, which is exact to 1e-9 where no
// column gives way in another manner beside the design.
class LayeredMeshDerivative {
 public:
  explicit LayeredMeshDerivative(const LayeredMesh& mesh);
  LayeredMeshDerivative(const LayeredMesh& mesh, std::span<const std::size_t> moving);

  std::size_t coefficients() const {
    return moved_.size();
  }                                               // coefficients_of(mesh.domain()), mesh_derivative.h
  std::size_t points() const { return points_; }  // of mesh.freeze()
  // How points move with the coefficients in this direction. Throws Error (argument) for another size, as
  // vjp() does.
  std::vector<Point> jvp(std::span<const double> direction) const;
  // Transposed: derivatives by points to derivatives by coefficients.
  std::vector<double> vjp(std::span<const Point> by_points) const;

 private:
  LayeredMeshDerivative(const LayeredMesh& mesh, const MeshDerivative& outer);

  std::size_t points_ = 0;
  std::vector<std::vector<Point>> moved_;  // by each coefficient: how every point moves
};

// The layers of a row of designs as a function of the design alone: levels and fans are those of the first
// walls. So an outer mesh can be led from design to design as any mesh is, to outside(walls), and around()
// says what mesh that makes with its layer. Columns have the same numbers in all of them.
class LayerFrame {
 public:
  // Throws as generate_layered() does.
  LayerFrame(const Domain& walls, const LayerOptions& options);
  const LayerOptions& options() const { return options_; }
  // The domain of the outer mesh: the tops of columns in place of walls. Throws Error (geometry) where the
  // walls have no layer, with the place, and Error (argument) for walls with other loops or stations.
  Domain outside(const Domain& walls) const;
  // Precondition: `outer` is a mesh of outside(walls). Throws likewise.
  LayeredMesh around(const Mesh& outer, const Domain& walls) const;

 private:
  friend LayeredGenerateResult generate_layered(const Domain&, const LayerOptions&, const QualityOptions&,
                                                StepObserver*);
  std::shared_ptr<const LayeredMesh::Columns> columns_at(const Domain& walls) const;

  LayerOptions options_;
  std::vector<LayeredWall> layered_;
  std::vector<std::vector<std::uint32_t>>
      fans_;  // per layered wall and station: the sectors of its fan, or 0
  std::uint32_t levels_ = 0;
};

// Remodels a layered mesh, in place: the walls become those of the new domain, with the options that the mesh
// has. Columns stay as they are where the walls' stations do; fans keep their sectors until a corner turns by
// more than two sectors beyond them. Otherwise as remodel() of Mesh: where anything is refused, given up or
// thrown, the mesh is as it was.
LayeredRemodelResult remodel(LayeredMesh& mesh, const Domain& domain, const RemodelOptions& options = {});

// Tries a design, as Trial does: the layered mesh returns to what it was, to the last bit, keys and marks
// included, when the trial ends, unless it is kept. While it lasts the mesh stays where it is and may be read
// and copied, but not remodelled.
class LayeredTrial {
 public:
  // Throws as remodel() does.
  LayeredTrial(LayeredMesh& mesh, const Domain& domain, const RemodelOptions& options = {});
  LayeredTrial(const LayeredTrial&) = delete;
  LayeredTrial& operator=(const LayeredTrial&) = delete;
  ~LayeredTrial();

  const LayeredRemodelResult& result() const;
  void keep();  // the trial is over, the mesh stays as it is now

 private:
  std::unique_ptr<LayeredMesh::Step> step_;
};

// A copy of the layered mesh at another design, its connectivity and keys the same. Throws TopologyChanged
// where there is no such mesh, and Error (geometry) as remodel() does. The outer mesh goes as those of
// mesh_derivative.h.
LayeredMesh mesh_at(const LayeredMesh& mesh, const Domain& design);
LayeredMesh mesh_at(const LayeredMesh& mesh, const Domain& design, Strategy strategy);

}  // namespace remodel
