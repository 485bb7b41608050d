#pragma once

// The living mesh of `batch`, without layers on its walls or with some.

#include <filesystem>
#include <memory>
#include <string>

#include "layer_options.h"
#include "remodel/airfoil.h"
#include "remodel/io.h"
#include "remodel/remodel.h"
#include "start_mesh.h"

namespace remodel::app {

class BatchMesh {
 public:
  virtual ~BatchMesh() = default;
  // The domain that it began with, with another airfoil. Throws Error (geometry) where no layer fits on it.
  virtual Domain with_airfoil(const CstAirfoil& airfoil) const = 0;
  virtual CstAirfoil airfoil(int degree) const = 0;  // its first, or a fit of this degree to its boundary
  virtual int points() const = 0;                    // on its airfoil, to compare designs by
  virtual RemodelResult step(const Domain& domain, const RemodelOptions& options) = 0;
  virtual std::string quick_check() const = 0;
  virtual double smallest_angle() const = 0;  // outside layers
  virtual FrozenMesh freeze() const = 0;
  virtual void write(const std::filesystem::path& file, const WriteOptions& options) const = 0;
  virtual const std::string& su2_boxes() const = 0;
  virtual bool layered() const = 0;
  virtual bool imported() const = 0;
  virtual void add_figures(Report& report) const = 0;  // of layers
};

// The file's mesh; with layers where it has some, or gets them by `layers`. Throws Error as read_start_mesh()
// does, and for options that a mesh with layers has no use for.
std::unique_ptr<BatchMesh> read_batch_mesh(const std::string& file, const StartMeshOptions& options,
                                           const LayerChoice& layers);

}  // namespace remodel::app
