#include "design/soak_cases.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "remodel/airfoil.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/import.h"

namespace remodel {
namespace {

using portable::Generator;

template <class Value, std::size_t n>
Value pick(Generator& random, const std::array<Value, n>& values) {
  return values[random.next() % n];
}

double between(Generator& random, double low, double high) {
  return low + (high - low) * random.uniform();
}

CstAirfoil any_airfoil(Generator& random) {
  return airfoil_catalogue()[random.next() % airfoil_catalogue().size()].airfoil();
}

CstAirfoil mean(const CstAirfoil& a, const CstAirfoil& b) {
  CstAirfoil m = a;
  for (std::size_t i = 0; i < m.upper.size(); ++i) {
    m.upper[i] = 0.5 * (a.upper[i] + b.upper[i]);
    m.lower[i] = 0.5 * (a.lower[i] + b.lower[i]);
  }
  return surfaces_apart(m) ? m : a;
}

// Random walks about an airfoil that drifts; one design in twenty is another airfoil of the catalogue, one in
// twenty crosses itself.
class AirfoilWalk {
 public:
  explicit AirfoilWalk(Generator& random)
      : random_(random),
        sigma_(0.25 * portable::exp(-6.0 * random.uniform())),  // 0.0006 to 0.25
        centre_(any_airfoil(random)) {}

  const CstAirfoil& centre() const { return centre_; }

  CstAirfoil next() {
    const double kind = random_.uniform();
    if (kind < 0.05) return centre_ = any_airfoil(random_);
    CstAirfoil design = centre_;
    for (auto* surface : {&design.upper, &design.lower})
      for (double& coefficient : *surface) coefficient += sigma_ * random_.normal();
    if (kind < 0.10)
      std::swap(design.upper, design.lower);
    else if (kind < 0.40 && surfaces_apart(design))
      centre_ = mean(centre_, design);
    return design;
  }

 private:
  Generator& random_;
  double sigma_;
  CstAirfoil centre_;
};

// One time in four a circle that stays divides the domain into two regions, near and far.
class OneAirfoil : public SoakWalk {
 public:
  OneAirfoil(Generator& random, const AirfoilDomainOptions& options)
      : walk_(random), options_(options), two_regions_(random.uniform() < 0.25) {}

  Domain next() override {
    Domain domain = airfoil_domain(std::exchange(first_, false) ? walk_.centre() : walk_.next(), options_);
    if (two_regions_) divide(domain);
    return domain;
  }

 private:
  static void divide(Domain& domain) {
    for (Loop& loop : domain.loops) loop.region = loop.role == LoopRole::outer ? "far" : "near";
    domain.loops.push_back({.role = LoopRole::internal,
                            .curves = {{"interface", Arc{{0.5, 0.0}, 2.0}, Parameters::uniform(60)}},
                            .region = "near",
                            .right_region = "far"});
  }

  AirfoilWalk walk_;
  AirfoilDomainOptions options_;
  bool two_regions_;
  bool first_ = true;
};

// Slat and flap turn and shift about their usual places, far enough to touch the main airfoil at times.
class HighLift : public SoakWalk {
 public:
  HighLift(Generator& random, const AirfoilDomainOptions& options)
      : random_(random), walk_(random), options_(options), reach_(portable::exp(-4.0 * random.uniform())) {}

  Domain next() override {
    const bool first = std::exchange(first_, false);
    const double reach = first ? 0.0 : reach_;
    const auto about = [&](Placement usual) {
      usual.rotation_deg += reach * between(random_, -20.0, 20.0);
      usual.position.x += reach * between(random_, -0.05, 0.05);
      usual.position.y += reach * between(random_, -0.05, 0.05);
      return usual;
    };
    const CstAirfoil main =
        first || random_.uniform() < 0.7 ? airfoil_catalogue().front().airfoil() : walk_.next();
    const CstAirfoil small = airfoil_catalogue().front().airfoil();
    return airfoils_domain(
        {{"slat", small, about({.chord = 0.18, .rotation_deg = 25, .position = {-0.17, -0.10}})},
         {"main", main, {}},
         {"flap", small, about({.chord = 0.3, .rotation_deg = -30, .position = {1.0, -0.06}})}},
        options_);
  }

 private:
  Generator& random_;
  AirfoilWalk walk_;
  AirfoilDomainOptions options_;
  double reach_;
  bool first_ = true;
};

// A channel of three by one whose floor is a spline through points that rise and fall, above the ceiling at
// times; one step in ten has other numbers of stations.
class Duct : public SoakWalk {
 public:
  explicit Duct(Generator& random) : random_(random), step_(0.3 * portable::exp(-4.0 * random.uniform())) {}

  Domain next() override {
    for (double& height : heights_)
      if (random_.uniform() < 0.4) height = std::clamp(height + step_ * random_.normal(), -1.0, 1.1);
    if (random_.uniform() < 0.1) pieces_ = 12 + random_.next() % 60;
    std::vector<Point> floor{{0.0, 0.0}};
    for (std::size_t i = 0; i < heights_.size(); ++i)
      floor.push_back({0.75 * static_cast<double>(i + 1), heights_[i]});
    floor.push_back({3.0, 0.0});
    const std::vector<Curve> curves{{"inlet", Line{{0, 1}, {0, 0}}, Parameters::uniform(5)},
                                    {"wall", spline_through(floor), Parameters::uniform(pieces_)},
                                    {"outlet", Line{{3, 0}, {3, 1}}, Parameters::uniform(5)},
                                    {"wall", Line{{3, 1}, {0, 1}}, Parameters::uniform(12)}};
    return {.loops = {{.role = LoopRole::outer, .curves = curves}}};
  }

 private:
  Generator& random_;
  double step_;
  std::array<double, 3> heights_{};
  std::size_t pieces_ = 24;
};

// A round lake with an island, a wall standing in the water and measuring points, all of which drift; they
// meet the shore and each other at times.
class Lake : public SoakWalk {
 public:
  explicit Lake(Generator& random) : random_(random), step_(0.1 * portable::exp(-5.0 * random.uniform())) {
    for (Point& point : points_) point = {between(random, -0.5, 0.5), between(random, -0.8, -0.3)};
  }

  Domain next() override {
    if (!std::exchange(first_, false)) {
      drift(island_);
      drift(wall_);
      for (Point& point : points_) drift(point);
    }
    Domain lake;
    const auto add = [&](LoopRole role, bool open, const char* name, Shape shape, std::size_t pieces) {
      lake.loops.push_back(
          {.role = role, .curves = {{name, std::move(shape), Parameters::uniform(pieces)}}, .open = open});
    };
    add(LoopRole::outer, false, "shore", Arc{{0, 0}, 1.0}, 40);
    add(LoopRole::hole, false, "island", Arc{island_, 0.15}, 16);
    add(LoopRole::internal, true, "wall", Line{wall_, wall_ + Point{0.3, 0.1}}, 6);
    for (const Point& point : points_) add(LoopRole::internal, true, "gauge", Line{point, point}, 1);
    return lake;
  }

 private:
  void drift(Point& point) {
    if (random_.uniform() < 0.5) return;
    point = {std::clamp(point.x + step_ * random_.normal(), -1.05, 1.05),
             std::clamp(point.y + step_ * random_.normal(), -1.05, 1.05)};
  }

  Generator& random_;
  double step_;
  Point island_{0.0, 0.3}, wall_{-0.7, 0.0};
  std::array<Point, 3> points_{};
  bool first_ = true;
};

// Designs in the place of the airfoil of a mesh that knows none.
class ForeignMesh : public SoakWalk {
 public:
  ForeignMesh(Generator& random, const Domain& domain)
      : walk_(random), domain_(domain), place_(find_airfoil(domain, "airfoil", "soak")) {}
  Domain next() override { return with_airfoil(domain_, place_, walk_.next()); }

 private:
  AirfoilWalk walk_;
  Domain domain_;
  AirfoilPlace place_;
};

// Another walk's domains, in metres from the origin of a map.
class OnAMap : public SoakWalk {
 public:
  OnAMap(Generator& random, std::unique_ptr<SoakWalk> walk)
      : walk_(std::move(walk)),
        scale_(pick(random, std::array{1.0, 30.0, 1000.0})),
        origin_{between(random, 3e5, 7e5), between(random, 5e6, 6e6)} {}

  Domain next() override {
    Domain domain = walk_->next();
    for (Loop& loop : domain.loops) {
      loop.placement.chord *= scale_;
      loop.placement.position = origin_ + scale_ * loop.placement.position;
    }
    return domain;
  }

 private:
  std::unique_ptr<SoakWalk> walk_;
  double scale_;
  Point origin_;
};

// Another walk's domains, with stations for layers: those of the first one.
class WithStations : public SoakWalk {
 public:
  WithStations(std::unique_ptr<SoakWalk> walk, const WallSpacing& spacing)
      : walk_(std::move(walk)), first_(walk_->next()) {
    space_walls(first_, spacing);
  }

  const Domain& first() const { return first_; }

  Domain next() override {
    Domain domain = walk_->next();
    for (std::size_t l = 0; l < domain.loops.size(); ++l)
      for (std::size_t c = 0; c < domain.loops[l].curves.size(); ++c)
        domain.loops[l].curves[c].parameters = first_.loops[l].curves[c].parameters;
    return domain;
  }

 private:
  std::unique_ptr<SoakWalk> walk_;
  Domain first_;
};

LayerOptions draw_layer(Generator& random) {
  LayerOptions layer;
  layer.first_height = 3e-4 * portable::exp(-6.9 * random.uniform());
  layer.growth = pick(random, std::array{1.15, 1.2, 1.2, 1.3});
  layer.thickness = pick(random, std::array{0.005, 0.01, 0.02, 0.03});
  return layer;
}

QualityOptions draw_quality(Generator& random, int points) {
  QualityOptions quality;
  quality.gradation = std::max(0.5, points / 50.0 * pick(random, std::array{0.5, 1.0, 1.0, 2.0}));
  return quality;
}

RemodelOptions draw_remodel(Generator& random) {
  RemodelOptions options;
  options.distance = pick(random, std::array{0.5, 1.0, 2.0, 4.0});
  options.method = pick(random, std::array{Method::automatic, Method::automatic, Method::general});
  options.strategy =
      pick(random, std::array{Strategy::renew, Strategy::chain, Strategy::morph, Strategy::reference});
  return options;
}

Mesh without_design(const Mesh& mesh) {
  const FrozenMesh all = mesh.freeze();
  FrozenMesh file;
  file.points = all.points;
  file.triangles = all.triangles;
  file.boundaries = all.boundaries;
  file.region = all.region;
  file.region_names = all.region_names;
  return import_mesh(file, "soak").mesh;
}

}  // namespace

SoakCase<Mesh> draw_case(Generator& random) {
  const int points = pick(random, std::array{8, 20, 50, 50, 50, 80, 100, 100, 150, 200, 400});
  const AirfoilDomainOptions airfoils{.points = points};
  const double kind = random.uniform();
  std::unique_ptr<SoakWalk> walk;
  if (kind < 0.6)  // a sixth of these as meshes without a design
    walk = std::make_unique<OneAirfoil>(random, airfoils);
  else if (kind < 0.75)
    walk = std::make_unique<HighLift>(random, AirfoilDomainOptions{.points = std::max(20, points / 4 * 2)});
  else if (kind < 0.875)
    walk = std::make_unique<Duct>(random);
  else
    walk = std::make_unique<Lake>(random);
  const bool foreign = kind < 0.1;
  if (!foreign && random.uniform() < 0.2) walk = std::make_unique<OnAMap>(random, std::move(walk));

  SoakCase<Mesh> drawn;
  drawn.remodel = draw_remodel(random);
  QualityOptions quality = draw_quality(random, points);
  if (drawn.remodel.strategy == Strategy::reference) quality.refine_angle_deg = angle_with_slack(quality);
  drawn.mesh = generate(walk->next(), quality).mesh;
  if (foreign) {
    drawn.mesh = without_design(drawn.mesh);
    walk = std::make_unique<ForeignMesh>(random, drawn.mesh.domain());
  }
  drawn.walk = std::move(walk);
  return drawn;
}

SoakCase<LayeredMesh> draw_layered_case(Generator& random) {
  std::unique_ptr<SoakWalk> walk;
  if (random.uniform() < 0.65)
    walk = std::make_unique<OneAirfoil>(random, AirfoilDomainOptions{});
  else
    walk = std::make_unique<HighLift>(random, AirfoilDomainOptions{});
  const double size = pick(random, std::array{1.0, 2.0, 4.0});
  auto stations = std::make_unique<WithStations>(
      std::move(walk), WallSpacing{0.0015 * size, 0.0015 * size, 0.008 * size, std::min(0.11 * size, 0.4)});
  SoakCase<LayeredMesh> drawn;
  drawn.remodel = draw_remodel(random);
  QualityOptions quality{.gradation = std::max(2.0, 8.0 / size)};
  if (drawn.remodel.strategy == Strategy::reference) quality.refine_angle_deg = angle_with_slack(quality);
  drawn.mesh = generate_layered(stations->first(), draw_layer(random), quality).mesh;
  drawn.walk = std::move(stations);
  return drawn;
}

}  // namespace remodel
