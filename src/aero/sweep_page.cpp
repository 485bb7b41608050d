// The page of a sweep.

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "aero/page_parts.h"
#include "aero/sweep_record.h"
#include "remodel/io.h"
#include "remodel/plot.h"
#include "remodel/sweep.h"

namespace remodel {
namespace {

namespace fs = std::filesystem;

struct Swept {
  SweepProblem problem;
  std::vector<SweepFlow> flows;  // by section, Mach number, Reynolds number and value
  std::size_t planned = 0;
};

Swept swept_in(const fs::path& directory) {
  Swept swept{.problem = read_sweep_problem(directory), .flows = read_sweep_flows(directory)};
  std::size_t of_a_section = 0;
  for (const SweepRow& row : swept.problem.rows) of_a_section += row.values.size();
  swept.planned = swept.problem.sections.size() * of_a_section;
  return swept;
}

bool has_friction(const Swept& swept) {
  return swept.problem.model != FlowModel::euler;
}
bool is_good(const SweepFlow& flow) {
  return flow.point.converged && !std::isnan(flow.point.cl);
}

// Conditions but for the value: what a polar is of.
using Stream = std::pair<double, double>;  // Mach and Reynolds number
Stream stream_of(const SweepFlow& flow) {
  return {flow.mach, flow.reynolds};
}
std::string text_of(const Stream& stream) {
  return "M " + number(stream.first) + (stream.second > 0.0 ? ", Re " + number(stream.second) : "");
}

// The flow of the largest value of a function, if there is any flow.
const SweepFlow* largest(const Swept& swept, double (*of)(const PolarPoint&)) {
  const SweepFlow* found = nullptr;
  for (const SweepFlow& flow : swept.flows)
    if (is_good(flow) && (found == nullptr || of(flow.point) > of(found->point))) found = &flow;
  return found;
}

struct Extreme {
  const char* name;
  const SweepFlow* flow;
};

// Without friction drag is the mesh's, or a shock's: ratios to it mean nothing.
std::vector<Extreme> extremes_of(const Swept& swept) {
  std::vector<Extreme> extremes;
  if (has_friction(swept))
    extremes.push_back(
        {"most lift over drag", largest(swept, [](const PolarPoint& p) { return p.cl / p.cd; })});
  extremes.push_back({"most lift", largest(swept, [](const PolarPoint& p) { return p.cl; })});
  extremes.push_back({"least drag", largest(swept, [](const PolarPoint& p) { return -p.cd; })});
  extremes.push_back({"most drag", largest(swept, [](const PolarPoint& p) { return p.cd; })});
  extremes.push_back({"most nose down", largest(swept, [](const PolarPoint& p) { return -p.cm; })});
  std::erase_if(extremes, [](const Extreme& extreme) { return extreme.flow == nullptr; });
  return extremes;
}

std::string thumbnail(const CstAirfoil& airfoil) {
  constexpr int points = 120;
  std::string svg =
      "<svg class=\"outlines\" style=\"width:220px\" viewBox=\"-20 -160 1040 320\"><polygon class=\"first\" "
      "points=\"";
  for (int i = 0; i <= points; ++i) {
    const Point p = airfoil.at(static_cast<double>(i) / points);
    svg += number(1000.0 * p.x, "%.1f") + "," + number(-1000.0 * p.y, "%.1f") + " ";
  }
  return svg + "\"/></svg>";
}

std::string extremes_table(const Swept& swept) {
  std::string table =
      "<h2>Extremes</h2>\n<table>\n<tr><th></th><th>section</th><th></th><th>at</th><th>α</th><th>CL</th>"
      "<th>CD, counts</th><th>CM</th></tr>\n";
  for (const auto& [name, flow] : extremes_of(swept)) {
    const SweepSection& section = swept.problem.sections[flow->section];
    table += std::string("<tr><th>") + name + "</th>" +
             cells({escaped(section.name), thumbnail(section.airfoil), text_of(stream_of(*flow)),
                    number(flow->point.alpha_deg, "%.3g") + "°", number(flow->point.cl, "%.4f"),
                    number(1e4 * flow->point.cd, "%.2f"), number(flow->point.cm, "%.4f")}) +
             "</tr>\n";
  }
  return table + "</table>\n";
}

// Polars of the first section and of the extremes'.
std::string polars(const Scratch& scratch, const Swept& swept) {
  constexpr std::size_t most = 6;
  std::vector<std::size_t> sections;
  const auto add = [&](std::size_t section) {
    if (sections.size() < most && std::ranges::count(sections, section) == 0) sections.push_back(section);
  };
  if (!swept.flows.empty()) add(swept.flows.front().section);
  for (const Extreme& extreme : extremes_of(swept)) add(extreme.flow->section);
  std::string pictures;
  std::set<Stream> streams;
  for (const SweepFlow& flow : swept.flows) streams.insert(stream_of(flow));
  constexpr std::size_t most_streams = 8;
  for (const Stream& stream : streams) {
    if (streams.size() > most_streams) break;  // of samples, which make no polars
    std::vector<PolarCurve> curves;
    for (const std::size_t section : sections) {
      PolarCurve& curve = curves.emplace_back();
      curve.name = swept.problem.sections[section].name;
      curve.model = swept.problem.model, curve.mach = stream.first, curve.reynolds = stream.second;
      curve.transition = swept.problem.transition;
      for (const SweepFlow& flow : swept.flows)
        if (flow.section == section && stream_of(flow) == stream) curve.points.push_back(flow.point);
    }
    const std::vector<Plot> plots = polar_plots(curves);
    if (!plots.empty())
      pictures += scratch.picture(
          ".svg", [&](const fs::path& file) { draw_plots(plots, plots.size() == 4 ? 2 : 3, file); });
  }
  if (pictures.empty()) return {};
  return "<h2>Polars</h2>\n<p>Of the first section and of those with extremes.</p>\n" + pictures;
}

// Means over all sections by the value, a curve for each Mach and Reynolds number: of flows whose conditions
// all sections have.
std::string means(const Scratch& scratch, const Swept& swept) {
  struct Sum {
    double x = 0.0, cl = 0.0, cd = 0.0;
    int flows = 0;
  };
  std::map<Stream, std::map<double, Sum>> sums;
  for (const SweepFlow& flow : swept.flows) {
    if (!is_good(flow)) continue;
    Sum& sum = sums[stream_of(flow)][flow.asked];
    sum.x += flow.point.alpha_deg, sum.cl += flow.point.cl, sum.cd += flow.point.cd, ++sum.flows;
  }
  Plot lift{.x = {"α, degrees"}, .y = {"CL"}, .width = 800}, drag{.x = {"CD"}, .y = {"CL"}, .width = 800};
  constexpr std::size_t most_streams = 12;
  for (const auto& [stream, by_value] : sums) {
    if (sums.size() > most_streams || by_value.size() < 2) continue;
    PlotCurve of_lift{.name = text_of(stream), .dots = true}, of_drag = of_lift;
    for (const auto& [value, sum] : by_value) {
      const double n = sum.flows;
      of_lift.points.push_back({sum.x / n, sum.cl / n});
      of_drag.points.push_back({sum.cd / n, sum.cl / n});
    }
    lift.curves.push_back(std::move(of_lift)), drag.curves.push_back(std::move(of_drag));
  }
  if (lift.curves.empty()) return {};
  return "<h2>Means over the sections</h2>\n" + scratch.picture(".svg", [&](const fs::path& file) {
    draw_plots({lift, drag}, 2, file);
  });
}

std::string missing_table(const Swept& swept) {
  std::map<std::string, std::vector<const SweepFlow*>> by_status;
  for (const SweepFlow& flow : swept.flows)
    if (!flow.point.converged) by_status[status_of(flow)].push_back(&flow);
  if (by_status.empty()) return {};
  constexpr std::size_t most = 20;
  std::string table = "<h2>Not found</h2>\n";
  for (const auto& [status, flows] : by_status) {
    table += "<p>" + status + ": " + std::to_string(flows.size()) +
             (flows.size() > most ? ", the first " + std::to_string(most) + ":" : "") +
             "</p>\n<table>\n<tr><th>section</th><th>at</th><th>" + (swept.problem.over_lift ? "CL" : "α") +
             "</th><th>reason</th></tr>\n";
    for (std::size_t i = 0; i < std::min(flows.size(), most); ++i)
      table += "<tr>" +
               cells({escaped(swept.problem.sections[flows[i]->section].name), text_of(stream_of(*flows[i])),
                      number(flows[i]->asked), escaped(flows[i]->point.reason)}) +
               "</tr>\n";
    table += "</table>\n";
  }
  return table;
}

Json figures_of(const Swept& swept) {
  const SweepCounts counts = counts_of(swept.flows);
  Json figures{{"sections", swept.problem.sections.size()},
               {"planned", swept.planned},
               {"flows", swept.flows.size()},
               {"found", counts.found},
               {"not_found", swept.flows.size() - counts.found},
               {"with_warnings", counts.warned},
               {"flow_seconds", counts.seconds}};
  figures["cold_seconds_estimate"] =
      counts.cold_seconds_estimate ? Json(*counts.cold_seconds_estimate) : Json();
  return figures;
}

std::string sweep_cost(const Json& figures) {
  const auto at = [&](const char* key, const char* format) {
    return figures.at(key).is_null() ? std::string("not known")
                                     : number(figures.at(key).get<double>(), format);
  };
  return "<h2>Cost</h2>\n<table>\n" + row("flows", at("flows", "%.0f")) + row("found", at("found", "%.0f")) +
         row("found, with a warning (table.csv says which)", at("with_warnings", "%.0f")) +
         row("searches, seconds of one core", at("flow_seconds", "%.1f")) +
         row("as many at the mean time of those found cold, about", at("cold_seconds_estimate", "%.1f")) +
         "</table>\n";
}

}  // namespace

std::string write_sweep_page(const fs::path& directory, const fs::path& page) {
  const Swept swept = swept_in(directory);
  const Json figures = figures_of(swept);
  const Scratch scratch;
  std::string text = page_head("Remodel: a sweep") + "<h1>A sweep of " +
                     std::to_string(swept.problem.sections.size()) + " sections</h1>\n<p>" +
                     std::to_string(swept.flows.size()) + " of " + std::to_string(swept.planned) +
                     " flows are done, <b>" + figures.at("found").dump() + "</b> were found; model " +
                     name_of(swept.problem.model) + ".</p>\n";
  text += extremes_table(swept) + polars(scratch, swept) + means(scratch, swept) + missing_table(swept) +
          sweep_cost(figures) + "</body></html>\n";
  write_text_atomically(page, text);
  return figures.dump();
}

}  // namespace remodel
