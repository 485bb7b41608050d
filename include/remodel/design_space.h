#pragma once

// A design space gives a vector of numbers its meaning as a shape. It is the third part of a run, beside its
// designer and its evaluator.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "remodel/airfoil.h"
#include "remodel/airfoil_degree.h"
#include "remodel/domain.h"
#include "remodel/import.h"

namespace remodel {

class LayerFrame;  // remodel/layers.h

// Designs are points of this space. Called from several threads at once.
class DesignSpace {
 public:
  virtual ~DesignSpace() = default;

  virtual std::vector<double> start() const = 0;  // the design whose mesh a run begins with
  virtual Domain domain(std::span<const double> design) const = 0;
  // Layers of flat cells lie on the walls where this is not null: domain() is that of the mesh beyond them
  // then, walls() that of the bodies. Otherwise both are the same.
  virtual const LayerFrame* layers() const { return nullptr; }
  virtual Domain walls(std::span<const double> design) const { return domain(design); }
  // True if the design can be meshed. By default: its domain passes validate(), and so do its walls.
  virtual bool feasible(std::span<const double> design) const;
  // Vertices that move with the design, as many for each: how far apart two designs are for a mesh is told by
  // these. Unless it says less, all stations of the domain.
  virtual std::vector<Point> outline(std::span<const double> design) const;
  // A design as a run writes it (best.json): unless it says more, a JSON array.
  virtual std::string text(std::span<const double> design) const;
  // A JSON object says what all of these depend on: a run can be resumed with the same alone.
  virtual std::string description() const = 0;
};

// Airfoils that differ in the shape coefficients of both surfaces: upper surface first, then lower. Class
// exponents and trailing edges are the start's. Designs are written as by airfoil_to_json().
class AirfoilSpace final : public DesignSpace {
 public:
  // Alone in a farfield. A design is feasible where its surfaces are apart, the upper vertices of its polygon
  // lie above the lower ones, and it stays inside the farfield. Throws Error (argument) as airfoil_domain()
  // does.
  explicit AirfoilSpace(const CstAirfoil& start, const AirfoilDomainOptions& options = {});
  // The airfoil stands in the place of one in another domain. A design is feasible where its surfaces are
  // apart and the domain is valid with it. Designs are in chords, the domain is in its own coordinates.
  AirfoilSpace(const CstAirfoil& start, const Domain& others, const AirfoilPlace& place);
  ~AirfoilSpace() override;

  CstAirfoil airfoil(std::span<const double> design) const;

  std::vector<double> start() const override;
  Domain domain(std::span<const double> design) const override;
  bool feasible(std::span<const double> design) const override;
  std::vector<Point> outline(
      std::span<const double> design) const override;  // the airfoil's vertices, in chords
  std::string text(std::span<const double> design) const override;
  std::string description() const override;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace remodel
