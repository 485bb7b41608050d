#include "batch_mesh.h"

#include <algorithm>
#include <utility>

#include "layered_update.h"
#include "new_airfoil.h"
#include "remodel/error.h"
#include "remodel/layers.h"

namespace remodel::app {
namespace {

class PlainBatchMesh final : public BatchMesh {
 public:
  PlainBatchMesh(StartMesh start, StartMeshOptions options)
      : start_(std::move(start)), options_(std::move(options)), mesh_(start_.mesh) {}

  Domain with_airfoil(const CstAirfoil& airfoil) const override {
    return with_new_airfoil(start_, options_, airfoil);
  }
  CstAirfoil airfoil(int degree) const override { return present_airfoil(start_, options_, degree); }
  int points() const override { return discretisation_of(start_.mesh.domain()).points; }
  RemodelResult step(const Domain& domain, const RemodelOptions& options) override {
    return remodel(mesh_, domain, options);
  }
  std::string quick_check() const override { return mesh_.quick_check(); }
  double smallest_angle() const override { return app::smallest_angle(mesh_); }
  FrozenMesh freeze() const override { return mesh_.freeze(); }
  void write(const std::filesystem::path& file, const WriteOptions& options) const override {
    write_mesh(mesh_, file, options);
  }
  const std::string& su2_boxes() const override { return start_.su2_boxes; }
  bool layered() const override { return false; }
  bool imported() const override { return mesh_.imported(); }
  void add_figures(Report& report) const override { static_cast<void>(report); }

 private:
  StartMesh start_;
  StartMeshOptions options_;
  Mesh mesh_;
};

class LayeredBatchMesh final : public BatchMesh {
 public:
  LayeredBatchMesh(LayeredMesh mesh, std::string source, std::string su2_boxes, LayerCells cells)
      : mesh_(std::move(mesh)),
        start_(mesh_.domain()),
        source_(std::move(source)),
        su2_boxes_(std::move(su2_boxes)),
        cells_(cells) {
    own_airfoil();  // refuses a mesh without one
  }

  Domain with_airfoil(const CstAirfoil& airfoil) const override {
    Domain walls = walls_with_airfoil(start_, airfoil, source_);
    validate(walls);
    LayerFrame(walls, mesh_.options()).outside(walls);  // refuses walls on which no layer fits
    return walls;
  }
  CstAirfoil airfoil(int) const override { return std::get<CstAirfoil>(own_airfoil().shape); }
  int points() const override {
    const auto points = static_cast<int>(own_airfoil().parameters.size());
    return std::max(8, points + points % 2);
  }
  RemodelResult step(const Domain& domain, const RemodelOptions& options) override {
    return remodel(mesh_, domain, options);
  }
  std::string quick_check() const override { return mesh_.quick_check(); }
  double smallest_angle() const override { return mesh_.outer().statistics().min_angle_deg; }
  FrozenMesh freeze() const override { return mesh_.freeze(cells_); }
  void write(const std::filesystem::path& file, const WriteOptions& options) const override {
    write_mesh(mesh_, file, options, cells_);
  }
  const std::string& su2_boxes() const override { return su2_boxes_; }
  bool layered() const override { return true; }
  bool imported() const override { return false; }
  void add_figures(Report& report) const override { add_layer_figures(report, mesh_); }

 private:
  const Curve& own_airfoil() const { return airfoil_of(start_, source_); }

  LayeredMesh mesh_;
  Domain start_;  // the walls that the batch begins with
  std::string source_, su2_boxes_;
  LayerCells cells_;
};

void refuse_options_of_imports(const std::string& file, const StartMeshOptions& options) {
  const auto refuse = [&](bool given, const char* option) {
    if (given)
      throw Error(ErrorCode::argument, option,
                  "given for '" + file + "', a mesh with layers, expected a mesh without");
  };
  refuse(!options.boundary.empty(), "--boundary");
  refuse(options.refine_angle_deg.has_value(), "--refine-angle");
  refuse(options.non_delaunay.has_value(), "--non-delaunay");
  refuse(options.dissolve_layers, "--dissolve-layers");
}

// The mesh that the same domain has with layers on its walls.
std::unique_ptr<BatchMesh> with_new_layers(const StartMesh& start, const LayerChoice& layers) {
  if (start.imported || start.mesh.imported())
    throw Error(ErrorCode::argument, "--layers",
                "given for '" + start.source +
                    "', a mesh of another program's, expected one that `remodel mesh` made");
  Domain walls = start.mesh.domain();
  space_walls(walls, layers.spacing);
  const LayerOptions layer = resolved(layers, 1.0);
  add_wake_line(layers, 1.0, layer, walls);
  LayeredGenerateResult made = generate_layered(walls, layer, start.mesh.options());
  if (made.stopped != Stopped::done)
    throw Error(ErrorCode::argument, start.source,
                std::string("its mesh with layers ended at its limit, ") + name_of(made.stopped));
  return std::make_unique<LayeredBatchMesh>(std::move(made.mesh), start.source, start.su2_boxes,
                                            layers.cells);
}

}  // namespace

std::unique_ptr<BatchMesh> read_batch_mesh(const std::string& file, const StartMeshOptions& options,
                                           const LayerChoice& layers) {
  const KeptPipes once;
  require_consistent(layers);
  if (holds_layers(file)) {
    if (layers.layers)
      throw Error(ErrorCode::argument, "--layers",
                  "given for '" + file + "', a mesh with layers, expected a mesh without");
    refuse_options_of_imports(file, options);
    return std::make_unique<LayeredBatchMesh>(read_layered_mesh(file), file, boxes_of_layered(file),
                                              layers.cells);
  }
  StartMesh start = read_start_mesh(file, options);
  if (layers.layers) return with_new_layers(start, layers);
  return std::make_unique<PlainBatchMesh>(std::move(start), options);
}

}  // namespace remodel::app
