#pragma once

// The design space of a run of airfoils, with layers on their walls where the run has some.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "design/start_wake.h"
#include "layer/station_lists.h"
#include "remodel/design_space.h"
#include "remodel/layers.h"
#include "remodel/optimise.h"

namespace remodel {

// Around the airfoils lie layers: the design's domain is what lies beyond them.
class LayeredAirfoils final : public DesignSpace {
 public:
  // All designs have the fans of the start's walls. Where the layers have a spacing, they have the stations
  // of the start's walls by that, at the same parameters, and where these have a wake the line behind them.
  // Throws Error as LayerFrame and add_wake() do.
  LayeredAirfoils(std::unique_ptr<AirfoilSpace> airfoils, const RunLayers& layers);

  const LayerFrame* layers() const override { return &*frame_; }
  Domain walls(std::span<const double> design) const override;
  Domain domain(std::span<const double> design) const override { return frame_->outside(walls(design)); }
  bool feasible(std::span<const double> design) const override;
  std::vector<double> start() const override { return airfoils_->start(); }
  std::vector<Point> outline(std::span<const double> design) const override {
    return airfoils_->outline(design);
  }
  std::string text(std::span<const double> design) const override { return airfoils_->text(design); }
  std::string description() const override;

 private:
  std::unique_ptr<AirfoilSpace> airfoils_;
  std::optional<WallSpacing> spacing_;
  Stations stations_;  // of the start's walls, where there is a spacing
  std::optional<StartWake> wake_;
  std::optional<LayerFrame> frame_;
};

// The airfoils alone, or with layers around them.
class RunSpace {
 public:
  RunSpace(std::unique_ptr<AirfoilSpace> airfoils, const std::optional<RunLayers>& layers);
  // That of optimise() from this airfoil.
  RunSpace(const CstAirfoil& from, const OptimiseOptions& options);
  // By description(), which `options` has. Throws nlohmann's exceptions.
  static std::optional<RunLayers> layers_in(const std::string& options);

  const DesignSpace& space() const { return *space_; }
  std::unique_ptr<DesignSpace> release() { return std::move(space_); }
  const AirfoilSpace& airfoils() const { return *airfoils_; }

 private:
  const AirfoilSpace* airfoils_;  // the space itself, or what it has its layers around
  std::unique_ptr<DesignSpace> space_;
};

}  // namespace remodel
