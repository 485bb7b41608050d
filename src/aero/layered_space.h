#pragma once

// A design space around whose sections lie layers of flat cells, for flows with friction: the design's domain
// is what lies beyond the layers (LayerFrame), so that the living mesh of a run is their outer mesh.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "design/start_wake.h"
#include "layer/station_lists.h"
#include "remodel/flow_space.h"
#include "remodel/layers.h"

namespace remodel {

class LayeredSpace final : public FlowSpace {
 public:
  // Stations are those of the start, about `points` on each section and duct, as close to each other at noses
  // and corners as wall_stations() has them. All designs have stations at the same parameters, and the wake
  // of the start. Throws Error as LayerFrame and add_wake() do.
  LayeredSpace(std::unique_ptr<FlowSpace> bodies, const LayerOptions& layer, int points,
               const std::optional<WakeLine>& wake = {});

  // What description() has, around the bodies that it has. Throws Json's exceptions.
  static std::unique_ptr<FlowSpace> from_description(std::unique_ptr<FlowSpace> bodies,
                                                     const std::string& description);

  const LayerFrame* layers() const override { return &frame_; }
  Domain walls(std::span<const double> design) const override { return with_wake(bodies(design), wake_); }
  Domain bodies(std::span<const double> design) const override {
    return with_stations(bodies_->domain(design), stations_);
  }
  Domain domain(std::span<const double> design) const override { return frame_.outside(walls(design)); }
  // Of sections and walls that have a layer.
  bool feasible(std::span<const double> design) const override;
  // The bodies, with stations likewise.
  Domain domain_with(std::span<const double> design, int points) const override;

  DesignBounds bounds(double coefficients) const override { return bodies_->bounds(coefficients); }
  std::vector<double> metric() const override { return bodies_->metric(); }
  std::size_t sections() const override { return bodies_->sections(); }
  CstAirfoil section(std::span<const double> design, std::size_t index) const override {
    return bodies_->section(design, index);
  }
  Placement placement(std::span<const double> design, std::size_t index) const override {
    return bodies_->placement(design, index);
  }
  std::vector<NamedNumber> named(std::span<const double> design) const override {
    return bodies_->named(design);
  }
  std::vector<double> gradient_of_domain(std::span<const double> by_numbers) const override;
  std::vector<double> gradient_of_section(std::size_t index,
                                          std::span<const double> by_coefficients) const override {
    return bodies_->gradient_of_section(index, by_coefficients);
  }
  std::vector<double> start() const override { return bodies_->start(); }
  std::string text(std::span<const double> design) const override { return bodies_->text(design); }
  std::string description() const override;

  // About so many on each section and duct, as close to each other at noses and corners as wall_stations()
  // has them.
  static Stations stations_of(const Domain& walls, int points, const std::vector<std::string>& names = {});

 private:
  std::unique_ptr<FlowSpace> bodies_;
  int points_;
  Stations stations_;
  std::optional<StartWake> wake_;
  LayerFrame frame_;
};

}  // namespace remodel
