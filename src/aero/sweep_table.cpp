#include "aero/sweep_table.h"

#include <cmath>
#include <limits>
#include <string>

#include "aero/field_template.h"
#include "aero/sweep_record.h"
#include "aero/table_cell.h"
#include "io/column_file.h"
#include "remodel/error.h"
#include "remodel/io.h"
#include "remodel/version.h"

namespace remodel {
namespace {

constexpr std::size_t usual_outline = 100;  // stations of outlines where no pressures are kept

// The columns of flows that are numbers, in both tables. Seconds are in neither: they are another time other
// ones.
struct NumberColumn {
  const char* name;
  double (*of)(const SweepFlow&);
};
constexpr NumberColumn number_columns[] = {
    {"mach", [](const SweepFlow& f) { return f.mach; }},
    {"reynolds", [](const SweepFlow& f) { return f.reynolds > 0.0 ? f.reynolds : PolarPoint::none; }},
    {"asked", [](const SweepFlow& f) { return f.asked; }},
    {"alpha_deg", [](const SweepFlow& f) { return f.point.alpha_deg; }},
    {"cl", [](const SweepFlow& f) { return f.point.cl; }},
    {"cd", [](const SweepFlow& f) { return f.point.cd; }},
    {"cm", [](const SweepFlow& f) { return f.point.cm; }},
    {"cd_pressure", [](const SweepFlow& f) { return f.point.cd_pressure; }},
    {"cd_friction", [](const SweepFlow& f) { return f.point.cd_friction; }},
    {"y_plus_max",
     [](const SweepFlow& f) { return f.reynolds > 0.0 ? f.point.y_plus_max : PolarPoint::none; }},
    {"residual", [](const SweepFlow& f) { return f.point.residual; }},
};

std::string start_of(const SweepFlow& flow) {
  return flow.point.status ? name_of(flow.point.start) : "";
}

std::string row_of(const SweepProblem& problem, const SweepFlow& flow) {
  std::string row = std::to_string(flow.section) + ',' + table_cell(problem.sections[flow.section].name);
  for (const NumberColumn& column : number_columns) row += ',' + table_cell(column.of(flow));
  const PolarPoint& point = flow.point;
  row += point.converged ? ",1," : ",0,";
  row += std::string(status_of(flow)) + ',' + start_of(flow) + ',' + std::to_string(point.newton_steps) +
         ',' + table_cell(joined(point.warnings)) + ',' + table_cell(point.reason) + '\n';
  return row;
}

std::string csv_of(const SweepProblem& problem, const std::vector<SweepFlow>& flows) {
  std::string table = "section,shape";
  for (const NumberColumn& column : number_columns) table += std::string(",") + column.name;
  table += ",converged,status,start,newton_steps,warnings,reason\n";
  for (const SweepFlow& flow : flows) table += row_of(problem, flow);
  return table;
}

template <class Value, class Of>
io::FileColumn column(const std::string& name, const std::vector<SweepFlow>& flows, Of of) {
  std::vector<Value> values;
  values.reserve(flows.size());
  for (const SweepFlow& flow : flows) values.push_back(static_cast<Value>(of(flow)));
  return {.path = "/flows/" + name, .values = std::move(values)};
}

void add_flows(const std::vector<SweepFlow>& flows, std::vector<io::FileColumn>& columns) {
  columns.push_back(column<std::int64_t>("section", flows, [](const SweepFlow& f) { return f.section; }));
  for (const NumberColumn& number : number_columns)
    columns.push_back(column<double>(number.name, flows, number.of));
  columns.push_back(
      column<std::uint8_t>("converged", flows, [](const SweepFlow& f) { return f.point.converged; }));
  columns.push_back(
      column<std::int64_t>("newton_steps", flows, [](const SweepFlow& f) { return f.point.newton_steps; }));
  columns.push_back(column<std::string>("status", flows, status_of));
  columns.push_back(column<std::string>("start", flows, start_of));
  columns.push_back(
      column<std::string>("warnings", flows, [](const SweepFlow& f) { return joined(f.point.warnings); }));
  columns.push_back(column<std::string>("reason", flows, [](const SweepFlow& f) { return f.point.reason; }));
}

// y of a section over x; not a number where there is none.
void add_sections(const SweepProblem& problem, std::vector<io::FileColumn>& columns) {
  const std::vector<double> x = sweep_stations(problem.stations != 0 ? problem.stations : usual_outline);
  std::vector<std::string> names, airfoils;
  std::vector<double> upper, lower;
  for (const SweepSection& section : problem.sections) {
    const bool is_there = section.problem.empty();
    names.push_back(section.name);
    airfoils.push_back(is_there ? airfoil_to_json(section.airfoil) : "");
    for (std::size_t j = 0; j < x.size(); ++j) {
      const double t = 0.5 * (1.0 - static_cast<double>(j) / static_cast<double>(x.size() - 1));
      upper.push_back(is_there ? section.airfoil.at(t).y : PolarPoint::none);
      lower.push_back(is_there ? section.airfoil.at(1.0 - t).y : PolarPoint::none);
    }
  }
  columns.push_back({.path = "/sections/name", .values = std::move(names)});
  columns.push_back({.path = "/sections/airfoil", .values = std::move(airfoils)});
  columns.push_back({.path = "/sections/x", .values = x});
  columns.push_back({.path = "/sections/upper", .values = std::move(upper), .width = x.size()});
  columns.push_back({.path = "/sections/lower", .values = std::move(lower), .width = x.size()});
}

void add_surfaces(const SweepProblem& problem, const std::vector<SweepFlow>& flows,
                  std::vector<io::FileColumn>& columns) {
  if (problem.stations == 0) return;
  columns.push_back({.path = "/surface/x", .values = sweep_stations(problem.stations)});
  const auto add = [&](const char* name, std::vector<double> SweepFlow::*member) {
    const std::size_t width = 2 * problem.stations;
    std::vector<double> values;
    for (const SweepFlow& flow : flows) {
      values.insert(values.end(), (flow.*member).begin(), (flow.*member).end());
      values.resize(values.size() + width - (flow.*member).size(), PolarPoint::none);
    }
    columns.push_back({.path = std::string("/surface/") + name, .values = std::move(values), .width = width});
  };
  add("cp", &SweepFlow::cp);
  if (problem.model != FlowModel::euler) add("cf", &SweepFlow::cf);
}

// Flows by points; not a number, and not known, where there is no flow or the point is not in the mesh.
void add_template(const SweepProblem& problem, const std::vector<SweepFlow>& flows,
                  std::vector<io::FileColumn>& columns) {
  const std::size_t width = problem.field_points.size();
  if (width == 0) return;
  std::vector<double> points;
  for (const Point p : problem.field_points) points.insert(points.end(), {p.x, p.y});
  columns.push_back({.path = "/template/points", .values = std::move(points), .width = 2});
  std::vector<std::uint8_t> known;
  for (const SweepFlow& flow : flows)
    for (std::size_t i = 0; i < width; ++i)
      known.push_back(!flow.fields.empty() && !std::isnan(flow.fields[i]) ? 1 : 0);
  columns.push_back({.path = "/template/known", .values = std::move(known), .width = width});
  std::size_t first = 0;
  for (const std::string& name : template_fields(problem.model)) {
    std::vector<double> values;
    for (const SweepFlow& flow : flows)
      for (std::size_t i = 0; i < width; ++i)
        values.push_back(flow.fields.empty() ? PolarPoint::none : flow.fields[first + i]);
    columns.push_back({.path = "/template/" + name, .values = std::move(values), .width = width});
    first += width;
  }
}

void require_sizes(const std::filesystem::path& directory, const SweepProblem& problem,
                   const std::vector<SweepFlow>& flows) {
  const auto require = [&](const std::vector<double>& values, std::size_t expected, const char* what) {
    if (!values.empty() && values.size() != expected)
      throw Error(ErrorCode::format, directory.string(),
                  "found " + std::to_string(values.size()) + " values " + what + ", expected " +
                      std::to_string(expected));
  };
  for (const SweepFlow& flow : flows) {
    for (const std::vector<double>* values : {&flow.cp, &flow.cf})
      require(*values, 2 * problem.stations, "on a section");
    require(flow.fields, template_fields(problem.model).size() * problem.field_points.size(),
            "at the points of a template");
  }
}

}  // namespace

void write_sweep_tables(const std::filesystem::path& directory, const SweepProblem& problem,
                        const std::vector<SweepFlow>& flows) {
  require_sizes(directory, problem, flows);
  write_text_atomically(directory / "table.csv", csv_of(problem, flows));
  std::vector<io::FileColumn> columns;
  add_sections(problem, columns);
  add_flows(flows, columns);
  add_surfaces(problem, flows, columns);
  add_template(problem, flows, columns);
  columns.push_back({.path = "/sweep", .values = std::vector<std::string>{to_json(problem).dump(1)}});
  io::write_columns(directory / "table.h5", columns,
                    {{"format", "remodel sweep 1"}, {"version", REMODEL_VERSION}});
}

}  // namespace remodel
