// The paper's figure 1 (removal regions) and figure 5 (surplus and bad gradation), drawn from meshes that are
// made for the purpose: one mesh is remodelled along the designs of a scenario's search.

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "study/report/names.h"
#include "study/report/svg.h"
#include "study/study_report.h"

namespace remodel {

namespace {

using report::fixed;
using report::pixels;
using report::Svg;

constexpr double figure_width = 1100;
constexpr Point window_low{-0.12, -0.24}, window_high{1.12, 0.24};  // the window, chords

constexpr double figure_scale = figure_width / (window_high.x - window_low.x);
constexpr double plot_height = figure_scale * (window_high.y - window_low.y);

Point figure_pixel(Point p) {
  return {figure_scale * (p.x - window_low.x), figure_scale * (window_high.y - p.y)};
}

bool in_window(Point a, Point b, Point c) {
  return std::max({a.x, b.x, c.x}) >= window_low.x && std::min({a.x, b.x, c.x}) <= window_high.x &&
         std::max({a.y, b.y, c.y}) >= window_low.y && std::min({a.y, b.y, c.y}) <= window_high.y;
}

void open_plot(Svg& svg) {
  svg.raw("<svg width='" + pixels(figure_width) + "' height='" + pixels(plot_height) + "' viewBox='0 0 " +
          pixels(figure_width) + ' ' + pixels(plot_height) + "'>\n");
}
void close_plot(Svg& svg) {
  svg.raw("</svg>\n");
}

std::string triangle_path(Point a, Point b, Point c) {
  return 'M' + pixels(figure_pixel(a)) + 'L' + pixels(figure_pixel(b)) + ' ' + pixels(figure_pixel(c)) + 'z';
}

void draw_edges(Svg& svg, const FrozenMesh& mesh) {
  std::string d;
  std::set<std::array<std::uint32_t, 2>> drawn;
  for (const auto& [a, b, c] : mesh.triangles) {
    if (!in_window(mesh.points[a], mesh.points[b], mesh.points[c])) continue;
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}})
      if (drawn.insert({std::min(from, to), std::max(from, to)}).second)
        d += 'M' + pixels(figure_pixel(mesh.points[from])) + 'L' + pixels(figure_pixel(mesh.points[to]));
  }
  svg.path(d, "fill='none' stroke='currentColor' stroke-opacity='.28' stroke-width='.6'");
}

std::vector<Point> closed(std::vector<Point> points) {
  points.push_back(points.front());
  for (Point& p : points) p = figure_pixel(p);
  return points;
}

// Radii as in the specialised method by chain (src/step/replace.cpp): D times the pair's distance, and at
// least the distance to the farther neighbour on the outline.
void draw_regions(Svg& svg, const std::vector<Point>& olds, const std::vector<Point>& news, double distance) {
  const std::size_t n = olds.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
    if (olds[i] == news[i]) continue;
    // The domain lies to the right of the outline, which runs counter-clockwise.
    const bool outwards = cross(news[after] - news[before], news[i] - olds[i]) < 0.0;
    const std::vector<Point>& outer = outwards ? news : olds;
    const double farther =
        std::max(squared_distance(outer[i], outer[before]), squared_distance(outer[i], outer[after]));
    const double radius =
        std::max(distance * std::sqrt(squared_distance(olds[i], news[i])), std::sqrt(farther));
    svg.circle(figure_pixel(outer[i]), figure_scale * radius,
               "fill='#d55e00' fill-opacity='.08' stroke='#d55e00' stroke-width='.8'");
  }
}

StudySvg removal_regions(const StudyPictured& pictured) {
  const AirfoilDomainOptions options{.points = 150};
  const Domain from = airfoil_domain(pictured.designs[0], options);
  const Domain to = airfoil_domain(pictured.designs[1], options);
  const std::string title =
      "Circular removal regions: 150 vertices, D = 1, from the start to the first design of " +
      report::title_of(pictured.airfoil) + ", σ = " + report::short_number(pictured.sigma) + ", seed " +
      std::to_string(pictured.seed);
  Svg svg(figure_width, plot_height + 24, title);
  open_plot(svg);
  draw_edges(svg, generate(from, {.gradation = 3.0}).mesh.freeze());
  draw_regions(svg, from.points(0), to.points(0), 1.0);
  svg.polyline(closed(from.points(0)), "fill='none' stroke='currentColor' stroke-width='1.6'");
  svg.polyline(closed(to.points(0)),
               "fill='none' stroke='#0072b2' stroke-width='1.6' stroke-dasharray='6 3'");
  close_plot(svg);
  svg.text({4, plot_height + 18},
           "solid: the old outline with its mesh; dashed: the new one; circles: what is removed, one for "
           "each pair of vertices");
  return {"figure-1-removal-regions", title, svg.finish()};
}

// Ratios of a triangle's size to the size that the design asks for, and their colours: blue for too fine,
// orange for too coarse.
struct GradationBand {
  double below;
  const char* color;
};
constexpr std::array<GradationBand, 8> gradation_bands = {{{0.35, "#08306b"},
                                                           {0.45, "#2166ac"},
                                                           {0.55, "#6baed6"},
                                                           {0.65, "#c6dbef"},
                                                           {0.85, "#f2efe6"},
                                                           {1.0, "#fdd9a8"},
                                                           {1.15, "#f79646"},
                                                           {HUGE_VAL, "#a63603"}}};

// The length scale that a design asks for at x: LS*(x), the minimum of LS_b + |x - b| / G over its boundary.
class DesignScale {
 public:
  explicit DesignScale(const Mesh& mesh) : gradation_(mesh.options().gradation) {
    for (std::size_t loop = 0; loop < mesh.domain().loops.size(); ++loop) {
      const std::vector<Point> points = mesh.domain().points(loop);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Point before = points[(i + points.size() - 1) % points.size()],
                    after = points[(i + 1) % points.size()];
        const double nearest =
            std::min(squared_distance(points[i], before), squared_distance(points[i], after));
        sources_.push_back({points[i], std::sqrt(nearest) / mesh.options().resolution});
      }
    }
  }
  double at(Point p) const {
    double least = HUGE_VAL;
    for (const auto& [point, value] : sources_)
      least = std::min(least, value + std::sqrt(squared_distance(p, point)) / gradation_);
    return least;
  }

 private:
  struct Source {
    Point point;
    double value;
  };
  double gradation_;
  std::vector<Source> sources_;
};

double circumradius(Point a, Point b, Point c) {
  const double product = squared_distance(a, b) * squared_distance(b, c) * squared_distance(c, a);
  return std::sqrt(product) / (2.0 * std::abs(cross(b - a, c - a)));
}

void fill_by_gradation(Svg& svg, const Mesh& living, const FrozenMesh& mesh) {
  const DesignScale scales(living);
  std::vector<double> asked(mesh.points.size(), -1.0);
  const auto scale_at = [&](std::uint32_t point) {
    if (asked[point] < 0.0) asked[point] = scales.at(mesh.points[point]);
    return asked[point];
  };
  std::array<std::string, gradation_bands.size()> paths;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Point p = mesh.points[a], q = mesh.points[b], r = mesh.points[c];
    if (!in_window(p, q, r)) continue;
    const double mean = (scale_at(a) + scale_at(b) + scale_at(c)) / 3.0;
    const double size = circumradius(p, q, r) / (living.options().max_gradation * mean);
    std::size_t band = 0;
    while (size >= gradation_bands[band].below) ++band;
    paths[band] += triangle_path(p, q, r);
  }
  for (std::size_t i = 0; i < gradation_bands.size(); ++i)
    svg.path(paths[i], "fill='" + std::string(gradation_bands[i].color) +
                           "' stroke='#333' stroke-opacity='.4' stroke-width='.25'");
}

void draw_bands(Svg& svg, double y) {
  double x = 4;
  for (std::size_t i = 0; i < gradation_bands.size(); ++i) {
    svg.rectangle({x, y - 11}, 14, 14,
                  "fill='" + std::string(gradation_bands[i].color) + "' stroke='#333' stroke-width='.4'");
    const std::string label = i + 1 < gradation_bands.size()
                                  ? "< " + report::short_number(gradation_bands[i].below)
                                  : "≥ " + report::short_number(gradation_bands[i - 1].below);
    svg.text({x + 19, y}, label);
    x += 66;
  }
  svg.text({x + 6, y}, "circumradius over H times the length scale that the design asks for");
}

StudySvg gradation_figure(const Mesh& mesh, const std::string& file, const std::string& what) {
  const GradationError error = mesh.gradation_error();
  const std::string title = what + ": " + std::to_string(mesh.triangle_count()) +
                            " triangles, gradation error " + fixed(error.deviation, 3) + " about " +
                            fixed(error.bias, 3);
  Svg svg(figure_width, plot_height + 26, title);
  open_plot(svg);
  fill_by_gradation(svg, mesh, mesh.freeze());
  close_plot(svg);
  draw_bands(svg, plot_height + 18);
  return {file, title, svg.finish()};
}

Mesh remodelled(const std::vector<CstAirfoil>& designs, const AirfoilDomainOptions& domain,
                const QualityOptions& quality, Strategy strategy) {
  Mesh mesh = std::move(generate(airfoil_domain(designs.front(), domain), quality).mesh);
  for (std::size_t i = 1; i < designs.size(); ++i)
    remodel(mesh, airfoil_domain(designs[i], domain), {.distance = 1.0, .strategy = strategy});
  return mesh;
}

// Returns the paper's I, or the next smaller I of the study: the study's designs are feasible for its own I
// only.
int points_of(const StudyContents& study, int wanted) {
  int best = 0;
  for (const StudyRow& row : study.rows)
    if (row.at.airfoil == study.pictured.airfoil && (row.at.points <= wanted || best == 0))
      best = best > wanted ? row.at.points : std::max(best, row.at.points);
  return best == 0 ? wanted : best;
}

}  // namespace

std::vector<StudySvg> study_mesh_figures(const StudyContents& study, const MeshFigureOptions& options) {
  const StudyPictured& pictured = study.pictured;
  if (pictured.designs.size() < 2) return {};
  const std::size_t count = std::min(pictured.designs.size(), options.evaluations + 1);
  const std::vector<CstAirfoil> designs(pictured.designs.begin(),
                                        pictured.designs.begin() + static_cast<std::ptrdiff_t>(count));
  const int points = points_of(study, options.points);
  const AirfoilDomainOptions domain{.points = points};
  const QualityOptions quality{.gradation = points / 50.0};
  const std::string of = " (I = " + std::to_string(points) +
                         ", G = " + report::short_number(quality.gradation) +
                         ", D = 1, σ = " + report::short_number(pictured.sigma) + ", " +
                         report::title_of(pictured.airfoil) + ")";
  const std::string steps = " after " + std::to_string(count - 1) + " remodellings";
  std::vector<StudySvg> figures{removal_regions(pictured)};
  figures.push_back(gradation_figure(remodelled(designs, domain, quality, Strategy::chain), "figure-5-chain",
                                     "chain" + steps + of));
  figures.push_back(gradation_figure(remodelled(designs, domain, quality, Strategy::renew), "figure-5-renew",
                                     "renew" + steps + of));
  figures.push_back(gradation_figure(generate(airfoil_domain(designs.back(), domain), quality).mesh,
                                     "figure-5-fresh", "a fresh mesh of the same design" + of));
  return figures;
}

}  // namespace remodel
