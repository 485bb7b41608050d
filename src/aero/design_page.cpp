#include "remodel/design_run.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "aero/design_mesh.h"
#include "aero/page_parts.h"
#include "remodel/draw.h"
#include "remodel/error.h"
#include "remodel/flow_plots.h"
#include "remodel/io.h"
#include "remodel/plot.h"
#include "remodel/remodel.h"

// The page of a run.

namespace remodel {

namespace {

namespace fs = std::filesystem;
using PageJson = nlohmann::ordered_json;

// One design: its mesh and the flows through it, whole.
struct Shown {
  std::string name;
  std::vector<double> design;
  std::vector<DesignPoint> points;
  FrozenMesh mesh;
  std::vector<FlowResult> flows;
  std::vector<std::vector<double>> mach, cp;
};

Shown shown_of(const std::string& name, const std::vector<double>& design, const Mesh& mesh,
               const DesignRun& run) {
  const FrozenMesh frozen = DesignMesh(*run.space, mesh, design).frozen();
  const bool half = run.space->half();
  Shown result{name, design, run.points, half ? mirrored(frozen) : frozen, {}, {}, {}};
  for (const DesignPoint& point : run.points) {
    FlowResult flow = solve_design_flow(*run.space, mesh, design, point);
    result.mach.push_back(mach_numbers(flow)), result.cp.push_back(pressure_coefficients(flow));
    if (half) {
      result.mach.back() = mirrored(frozen, result.mach.back());
      result.cp.back() = mirrored(frozen, result.cp.back());
    }
    result.flows.push_back(std::move(flow));
  }
  return result;
}

// Outlines of both designs.
std::string both_outlines(const Shown& first, const Shown& last, const DesignRun& run) {
  const auto [x0, y0, x1, y1] = window_of(run, {-0.02, -0.21, 1.02, 0.21}, 0.02, 0.02);
  std::string svg = "<svg class=\"outlines\" viewBox=\"";
  for (const double corner : {x0, -y1, x1 - x0, y1 - y0}) svg += number(1000.0 * corner, "%.0f") + " ";
  svg += "\" role=\"img\" aria-label=\"first and best design\">";
  for (const Shown* of : {&first, &last})
    for (const std::vector<Point>& outline : outlines(*run.space, of->design)) {
      svg += std::string("<polygon class=\"") + (of == &first ? "first" : "last") + "\" points=\"";
      for (const Point p : outline)
        svg += number(1000.0 * p.x, "%.2f") + "," + number(-1000.0 * p.y, "%.2f") + " ";
      svg += "\"/>";
    }
  return svg + "</svg>\n";
}

// The numbers of both designs that have names.
std::string numbers_table(const Shown& first, const Shown& last, const FlowSpace& space) {
  const std::vector<NamedNumber> from = space.named(first.design), to = space.named(last.design);
  if (from.empty()) return {};
  std::string table = "<table>\n<tr><th></th><th>" + first.name + "</th><th>" + last.name + "</th></tr>\n";
  for (std::size_t i = 0; i < from.size(); ++i)
    table += "<tr><th>" + escaped(from[i].name) + "</th><td>" + number(from[i].value, "%.5g") + "</td><td>" +
             number(to[i].value, "%.5g") + "</td></tr>\n";
  return table + "</table>\n";
}

// All flows of a problem have friction, or none has.
bool has_friction(const Shown& of) {
  return !of.flows.empty() && of.flows.front().friction.has_value();
}

std::string cells_of(const FrozenMesh& mesh) {
  const std::string triangles = std::to_string(mesh.triangles.size()) + " triangles";
  return mesh.quads.empty() ? triangles
                            : triangles + ", " + std::to_string(mesh.quads.size()) + " quadrilaterals";
}

std::string not_found(const Shown& of, std::size_t point) {
  return "<p>" + of.name + ", point " + std::to_string(point + 1) + ": no flow was found.</p>\n";
}

bool has_openings(const DesignPoint& point) {
  return !point.inlets.empty() || !point.outlets.empty();
}

// The mesh without boundaries that are no walls.
FrozenMesh walls_alone(const FrozenMesh& mesh, const DesignPoint& point) {
  std::vector<std::string> names = point.symmetry;
  for (const FlowInlet& inlet : point.inlets) names.push_back(inlet.name);
  for (const FlowOutlet& outlet : point.outlets) names.push_back(outlet.name);
  for (const auto& pair : mesh.periodic) names.insert(names.end(), pair.begin(), pair.end());
  return without_boundaries(mesh, names);
}

std::string caption_of(const FlowResult& flow, const DesignPoint& point) {
  return has_openings(point) ? duct_caption(flow.mach) : flow_caption(flow.mach, flow.alpha_deg, flow.cl);
}

// What `plot_of` draws of a design along its sections, both designs in one picture.
std::string along_sections(const Scratch& scratch, const Shown& first, const Shown& last,
                           std::size_t sections, std::size_t point,
                           const std::function<Plot(const Shown&, const std::string& caption)>& plot_of) {
  Plot plot;
  std::string missing;
  for (const Shown* of : {&first, &last}) {
    const FlowResult& flow = of->flows[point];
    if (!flow.converged()) {
      missing += not_found(*of, point);
      continue;
    }
    Plot one = plot_of(*of, caption_of(flow, of->points[point]));
    if (plot.curves.empty()) plot.x = one.x, plot.y = one.y, plot.caption = one.caption;
    for (std::size_t i = 0; i < one.curves.size(); ++i) {
      PlotCurve& curve = one.curves[i];
      // The boundary of one section may be several rows of edges. Of several sections each has a curve.
      if (sections == 1 && i != 0) {
        std::vector<Point>& points = plot.curves.back().points;
        points.insert(points.end(), curve.points.begin(), curve.points.end());
        continue;
      }
      curve.name = sections == 1 ? of->name : of->name + ", " + curve.name;
      plot.curves.push_back(std::move(curve));
    }
  }
  if (plot.curves.empty()) return missing;
  return scratch.picture(".svg", [&](const fs::path& file) { draw_plot(plot, file); }) + missing;
}

std::string pressures(const Scratch& scratch, const Shown& first, const Shown& last, std::size_t sections) {
  std::string pictures = "<h2>Pressure</h2>\n";
  for (std::size_t i = 0; i < first.flows.size(); ++i)
    pictures +=
        along_sections(scratch, first, last, sections, i, [&](const Shown& of, const std::string& caption) {
          return cp_plot(walls_alone(of.mesh, of.points[i]), {"farfield"}, of.cp[i], caption, "report");
        });
  return pictures;
}

// Nothing where flows have none.
std::string frictions(const Scratch& scratch, const Shown& first, const Shown& last, std::size_t sections) {
  if (!has_friction(first)) return {};
  std::string pictures = "<h2>Friction</h2>\n";
  for (std::size_t i = 0; i < first.flows.size(); ++i)
    pictures +=
        along_sections(scratch, first, last, sections, i, [&](const Shown& of, const std::string& caption) {
          return cf_plot(walls_alone(of.mesh, of.points[i]), {"farfield"}, of.flows[i].friction->cf, caption,
                         "report");
        });
  return pictures;
}

// Mach numbers of one point around a section, in colours of one range.
std::string mach_field(const Scratch& scratch, const DesignRun& run, const Shown& of, std::size_t point,
                       double most) {
  const FlowResult& flow = of.flows[point];
  if (!flow.converged()) return not_found(of, point);
  DrawField field;
  field.field.name = "mach";
  field.field.values = of.mach[point];
  field.label = "Mach";
  field.range = {0.0, most};
  field.iso_lines = 24;
  DrawOptions options{
      .window = window_of(run, {-0.35, -0.55, 1.35, 0.65}, 0.15, 0.25), .width = 1000, .line = 1.8};
  options.field = std::move(field);
  options.caption = of.name + ": " + caption_of(flow, of.points[point]) + ", " +
                    number(1e4 * flow.cd, "%.1f") + " counts of drag";
  return scratch.picture(".png", [&](const fs::path& file) { draw(of.mesh, file, options); });
}

std::string convergence(const Scratch& scratch, const DesignRun& run) {
  PlotCurve each{"each design", {}}, best{"best so far", {}};
  bool positive = true;
  for (const EvaluationRecord& row : run.rows) {
    const double at = static_cast<double>(row.evaluation);
    if (std::isfinite(row.objective)) each.points.push_back({at, row.objective});
    if (std::isfinite(row.best_objective)) best.points.push_back({at, row.best_objective});
    positive = positive && row.objective > 0.0 && (row.best_objective > 0.0);
  }
  if (each.points.empty()) return "<p>No design had a flow.</p>\n";
  Plot plot{.x = {.label = "design", .whole = true}, .y = {.label = "objective", .logarithmic = positive}};
  plot.curves.push_back(std::move(each));
  if (!best.points.empty()) plot.curves.push_back(std::move(best));
  return scratch.picture(".svg", [&](const fs::path& file) { draw_plot(plot, file); });
}

PageJson or_null(const std::optional<double>& value) {
  return value ? PageJson(*value) : PageJson();
}

// What the run cost, and what a cold solve of every flow would have.
PageJson cost_of(const DesignRun& run, const Shown& first, const Shown& last) {
  PageJson violations = PageJson::object();
  for (const auto& [name, violation] : run.violations()) violations[name] = violation;
  std::size_t kept = 0;
  double connected = 0.0;
  std::optional<double> shift;
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    const EvaluationRecord& row = run.rows[i];
    kept += row.changed() == 0 ? 1 : 0;
    connected += row.connectivity_percent / static_cast<double>(run.rows.size());
    // The same design on two connectivities.
    for (std::size_t j = 0; j < i; ++j)
      if (run.rows[j].coefficients == row.coefficients && std::isfinite(row.objective) &&
          std::isfinite(run.rows[j].objective))
        shift = std::max(shift.value_or(0.0), std::fabs(row.objective - run.rows[j].objective));
  }
  double cold = 0.0;
  for (const Shown* of : {&first, &last})
    for (const FlowResult& flow : of->flows) cold += 0.5 * flow.seconds;
  const double flow_seconds = run.sum("flow_seconds"), gradient_seconds = run.sum("gradient_seconds");
  const double designs = static_cast<double>(run.rows.size());
  return {{"designs", run.rows.size()},
          {"flows", run.rows.size() * run.points.size()},
          {"connectivity_kept", kept},
          {"connectivity_percent", connected},
          {"factorisations", static_cast<std::uint64_t>(run.sum("factorisations"))},
          {"flow_seconds", flow_seconds},
          {"gradient_seconds", gradient_seconds},
          {"cold_seconds_a_design", cold},
          {"cold_seconds", cold * designs},
          {"cold_equivalents", (flow_seconds + gradient_seconds) / cold},
          {"largest_shift", or_null(shift)},
          {"start_objective", or_null(run.start_objective())},
          {"objective", run.has_best() ? PageJson(run.rows[run.best].objective) : PageJson()},
          {"constraints", std::move(violations)}};
}

std::string cost_table(const PageJson& cost) {
  const auto at = [&](const char* key, const char* format = "%.4g") {
    return number(cost.at(key).get<double>(), format);
  };
  return "<table>\n" + row("designs, each with its gradients", at("designs", "%.0f")) +
         row("flows", at("flows", "%.0f")) +
         row("meshes with the connectivity of the design before", at("connectivity_kept", "%.0f")) +
         row("triangles joined as they were from design to design, mean",
             at("connectivity_percent", "%.1f") + " %") +
         row("factorisations", at("factorisations", "%.0f")) +
         row("flows, seconds", at("flow_seconds", "%.1f")) +
         row("gradients, seconds", at("gradient_seconds", "%.1f")) +
         row("one design's flows found cold, seconds (mean of the first and the best)",
             at("cold_seconds_a_design", "%.2f")) +
         row("all flows found cold would have taken, seconds", at("cold_seconds", "%.0f")) +
         row("the whole search, in cold solves of a design", at("cold_equivalents", "%.1f")) +
         row("largest shift of the objective by a change of connectivity, same design",
             cost.at("largest_shift").is_null() ? "not measured" : at("largest_shift", "%.2g")) +
         "</table>\n";
}

std::string counts(double cd) {
  return number(1e4 * cd, "%.2f");
}

std::string points_table(const Shown& first, const Shown& last) {
  const bool friction = has_friction(first);
  std::string table = "<table>\n<tr><th></th><th>Mach</th><th>α</th><th>CL</th><th>CD, counts</th>";
  if (friction) table += "<th>of pressure</th><th>of friction</th><th>y⁺, at most</th>";
  table += "<th>CM</th></tr>\n";
  for (std::size_t i = 0; i < first.flows.size(); ++i)
    for (const Shown* of : {&first, &last}) {
      const FlowResult& flow = of->flows[i];
      table += "<tr><th>" + of->name + "</th>" + cells({number(flow.mach)});
      if (!flow.converged()) {
        table += std::string("<td colspan=\"") + (friction ? "7" : "4") + "\">no flow was found</td></tr>\n";
        continue;
      }
      table += cells({number(flow.alpha_deg, "%.3f") + "°", number(flow.cl, "%.4f"), counts(flow.cd)});
      if (friction)
        table += cells({counts(flow.friction->cd_pressure), counts(flow.friction->cd_friction),
                        number(flow.friction->y_plus_max, "%.2f")});
      table += cells({number(flow.cm, "%.4f")}) + "</tr>\n";
    }
  return table + "</table>\n";
}

// By how much the best design, or the one shown in its place, violates constraints.
std::string constraints_table(const PageJson& by) {
  if (by.empty()) return {};
  std::string table = "<table>\n<tr><th>constraint</th><th>violated by</th></tr>\n";
  for (const auto& [name, violation] : by.items())
    table += row(escaped(name), violation == 0.0 ? "kept" : number(violation.get<double>()));
  return table + "</table>\n";
}

// Columns that flows on fresh meshes have where these are of friction, or of a duct.
struct FreshColumns {
  bool friction = false, duct = false;
  int behind_mach() const { return 7 + 2 * friction + 2 * duct; }
};

std::string fresh_row(const std::string& name, const PageJson& entry, const FreshColumns& columns) {
  std::string row = "<tr><th>" + name + "</th>" +
                    cells({entry.at("points").dump(), entry.at("vertices").dump(), number(entry.at("mach"))});
  if (entry.at("converged") != true)
    return row + "<td colspan=\"" + std::to_string(columns.behind_mach()) +
           "\">no flow was found</td></tr>\n";
  std::string violated;
  for (const auto& [constraint, excess] : entry.at("violated").items())
    violated += (violated.empty() ? "" : ", ") + escaped(constraint) + " by " + number(excess.get<double>());
  row += cells(
      {number(entry.at("alpha_deg"), "%.3f") + "°", number(entry.at("cl"), "%.4f"), counts(entry.at("cd"))});
  if (columns.friction)
    for (const char* part : {"cd_pressure", "cd_friction"})
      row += cells({entry.contains(part) ? counts(entry.at(part)) : ""});
  if (columns.duct)
    for (const char* part : {"mass_flow", "total_pressure"})
      row += cells({entry.contains(part) ? number(entry.at(part), "%.6g") : ""});
  return row +
         cells({entry.contains("error") ? counts(entry.at("error").at("cd")) : "",
                number(entry.at("cm"), "%.4f"), violated.empty() ? "none" : violated,
                number(entry.at("seconds"), "%.1f")}) +
         "</tr>\n";
}

// The first and the best design on fresh meshes, as the command left them: nothing where the file is that of
// another design.
std::string fresh_table(const fs::path& directory, const DesignRun& run) {
  const fs::path file = directory / "fresh.json";
  const PageJson fresh = fs::exists(file) ? PageJson::parse(read_text(file), nullptr, false) : PageJson();
  if (!run.has_best() || !fresh.is_object() || fresh.at("design") != PageJson(run.best_design())) return {};
  const PageJson& best = fresh.at("verified");
  const PageJson first = fresh.value("verified_start", PageJson::array());
  const auto any_has = [&](const char* key) {
    return std::any_of(best.begin(), best.end(), [&](const PageJson& entry) { return entry.contains(key); });
  };
  const FreshColumns columns{.friction = any_has("cd_friction"), .duct = any_has("mass_flow")};
  std::string table =
      "<h2>On fresh meshes</h2>\n<p>The first and the best design on meshes that the search has not seen, "
      "flows found cold. What the finest lacks of an infinitely fine mesh is estimated by it and the "
      "next.</p>\n<table>\n<tr><th></th><th>points</th><th>vertices</th><th>Mach</th><th>α</th><th>CL</th>"
      "<th>CD, counts</th>";
  if (columns.friction) table += "<th>of pressure</th><th>of friction</th>";
  if (columns.duct) table += "<th>mass flow</th><th>total pressure</th>";
  table += "<th>CD lacks about</th><th>CM</th><th>constraints violated</th><th>seconds</th></tr>\n";
  for (std::size_t i = 0; i < best.size(); ++i) {
    if (i < first.size()) table += fresh_row("start", first[i], columns);
    table += fresh_row("best", best[i], columns);
  }
  return table + "</table>\n";
}

// The search from coarse to fine, as the command left it.
std::string stages_table(const fs::path& directory) {
  const fs::path file = directory / "stages.json";
  const PageJson stages = fs::exists(file) ? PageJson::parse(read_text(file), nullptr, false) : PageJson();
  if (!stages.is_array()) return {};
  const auto shown = [](const PageJson& value) { return value.is_null() ? "none" : number(value, "%.6g"); };
  std::string table =
      "<h2>From coarse to fine</h2>\n<p>Each mesh begins with the best design of the one before; all else "
      "here "
      "is of the last one.</p>\n<table>\n<tr><th>points</th><th>triangles, "
      "mean</th><th>designs</th><th>first "
      "objective</th><th>best objective</th><th>seconds</th></tr>\n";
  for (const PageJson& stage : stages)
    table += "<tr>" +
             cells({stage.at("points").dump(), number(stage.at("triangles"), "%.0f"),
                    stage.at("evaluations").dump(), shown(stage.at("start_objective")),
                    shown(stage.at("objective")), number(stage.at("seconds"), "%.1f")}) +
             "</tr>\n";
  return table + "</table>\n";
}

// What the search has come to, in words.
std::string outcome(const DesignRun& run, const PageJson& cost) {
  const std::string objective = escaped(run.objective);
  if (!run.has_best()) return "Objective: " + objective + ". No best design: " + escaped(run.why_no_design());
  const PageJson& start = cost["start_objective"];
  return "Objective (" + objective +
         "): " + (start.is_null() ? "" : "from " + number(start.get<double>(), "%.6g") + " to ") + "<b>" +
         number(cost["objective"].get<double>(), "%.6g") + "</b>";
}

// The mesh that the last design left, led to the best one. A run that has not finished may have left none:
// then that of the start is.
Mesh mesh_of_best(const fs::path& directory, const DesignRun& run) {
  const fs::path last = directory / "last.vtkhdf";
  Mesh mesh = read_outer_mesh(fs::exists(last) ? last : directory / "first.vtkhdf");
  remodel(mesh, run.space->domain(run.best_design()), {.strategy = info_of(design_strategy).step});
  return mesh;
}

const char* name_of_best(const DesignRun& run) {
  if (run.has_best()) return "best";
  return run.has_flow ? "least violated" : "first tried";
}

// Sections. A deformed domain counts as one where it has one wall in a far field, otherwise as several.
std::size_t walls_of(const DesignRun& run, const Shown& of) {
  if (run.space->sections() != 0) return run.space->sections();
  const auto is_wall = [](const FrozenBoundary& boundary) { return boundary.name != "farfield"; };
  const auto count = std::count_if(of.mesh.boundaries.begin(), of.mesh.boundaries.end(), is_wall);
  return count == 1 ? 1 : 2;
}

std::string page_of(const fs::path& directory, const DesignRun& run, const Shown& first, const Shown& last,
                    const PageJson& cost) {
  const Scratch scratch;
  std::string page = page_head("Remodel: a design") + "<h1>A design on one mesh</h1>\n";
  page += "<p>" + outcome(run, cost) + "; " + std::to_string(run.rows.size()) +
          (run.rows.size() == 1 ? " design" : " designs") + " on a mesh of " + cells_of(first.mesh) +
          (run.space->half() ? ", computed in the upper half and mirrored" : "") + ".</p>\n";
  page += "<h2>Sections</h2>\n<p><span class=\"first\">first</span>, <span class=\"last\">" + last.name +
          "</span></p>\n" + both_outlines(first, last, run) + numbers_table(first, last, *run.space) +
          points_table(first, last) + "<p class=\"note\">The run's own mesh; CD in counts (10⁻⁴).</p>\n" +
          constraints_table(cost.at("constraints"));
  page += stages_table(directory) + fresh_table(directory, run);
  const std::size_t walls = walls_of(run, first);
  page += pressures(scratch, first, last, walls) + frictions(scratch, first, last, walls);
  page += "<h2>Mach number</h2>\n";
  for (std::size_t i = 0; i < run.points.size(); ++i) {
    const double most = std::max(*std::max_element(first.mach[i].begin(), first.mach[i].end()),
                                 *std::max_element(last.mach[i].begin(), last.mach[i].end()));
    page += "<div class=\"pair\">" + mach_field(scratch, run, first, i, most) +
            mach_field(scratch, run, last, i, most) + "</div>\n";
  }
  page += "<h2>Convergence</h2>\n" + convergence(scratch, run);
  page +=
      "<h2>What it cost</h2>\n" + cost_table(cost) +
      "<p class=\"note\">Seconds are wall time on the machine of the run; cold solves were timed when this "
      "page was made.</p>\n";
  page += "<h2>Mesh</h2>\n";
  for (const Shown* of : {&first, &last})
    page += scratch.picture(".svg", [&](const fs::path& file) {
      draw(of->mesh, file,
           {.window = window_of(run, {-0.15, -0.25, 1.15, 0.25}, 0.08, 0.08),
            .width = 1000,
            .caption = of->name + ": " + cells_of(of->mesh)});
    });
  return page + "<h2>Problem</h2>\n<pre>" + escaped(PageJson::parse(run.problem).dump(1)) +
         "</pre>\n</body></html>\n";
}

}  // namespace

std::string write_design_page(const fs::path& directory, const fs::path& page) {
  const DesignRun run = read_design_run(directory);
  const Shown first = shown_of("first", run.first_design, read_outer_mesh(directory / "first.vtkhdf"), run);
  const Shown last = shown_of(name_of_best(run), run.best_design(), mesh_of_best(directory, run), run);
  const PageJson figures = cost_of(run, first, last);
  write_text_atomically(page, page_of(directory, run, first, last, figures));
  return figures.dump();
}

}  // namespace remodel
