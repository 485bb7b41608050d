// Domains as JSON:
//
//   {"loops": [{"role": "hole", "curves": [{"name": "airfoil", "shape": {"kind": "airfoil", ...},
//                                           "parameters": [0, 0.005, ...]}, ...]}, ...]}
//
// where a shape is an airfoil (the keys of airfoil_json.cpp), a line (from, to), a polyline (points) or an
// arc (centre, radius, start, sweep); points are [x, y].

#include "airfoil_json.h"
#include "json_reader.h"
#include "remodel/domain.h"

namespace remodel {
namespace {

using nlohmann::ordered_json;

constexpr const char* what = "domain to JSON";

double finite(double value) {
  return finite_for_json(value, what);
}
ordered_json json_of(Point p) {
  return {finite(p.x), finite(p.y)};
}

ordered_json json_of_shape(const CstAirfoil& airfoil) {
  ordered_json result{{"kind", "airfoil"}};
  result.update(json_of(airfoil));
  return result;
}
ordered_json json_of_shape(const Line& line) {
  return {{"kind", "line"}, {"from", json_of(line.from)}, {"to", json_of(line.to)}};
}
ordered_json json_of_shape(const Polyline& polyline) {
  ordered_json points = ordered_json::array();
  for (const Point p : polyline.points) points.push_back(json_of(p));
  return {{"kind", "polyline"}, {"points", std::move(points)}};
}
ordered_json json_of_shape(const Arc& arc) {
  return {{"kind", "arc"},
          {"centre", json_of(arc.centre)},
          {"radius", finite(arc.radius)},
          {"start", finite(arc.start)},
          {"sweep", finite(arc.sweep)}};
}

ordered_json json_of(const Curve& curve) {
  return {{"name", curve.name},
          {"shape", std::visit([](const auto& s) { return json_of_shape(s); }, curve.shape)},
          {"parameters", finite_for_json(curve.parameters, what)}};
}

ordered_json json_of(const Loop& loop) {
  ordered_json curves = ordered_json::array();
  for (const Curve& curve : loop.curves) curves.push_back(json_of(curve));
  return {{"role", loop.role == LoopRole::outer ? "outer" : "hole"}, {"curves", std::move(curves)}};
}

Point point_of(const JsonReader& reader) {
  const std::vector<double> values = reader.numbers();
  if (values.size() != 2) reader.refuse("expected two numbers, x and y");
  return {values[0], values[1]};
}

Shape shape_of(const JsonReader& reader) {
  if (!reader.is_object() || !reader.has("kind")) reader.refuse("expected an object with the key \"kind\"");
  const std::string kind = reader["kind"].text();
  if (kind == "airfoil") {
    reader.expect_keys({"kind", "degree", "upper", "lower"}, {"e1", "e2", "te_upper", "te_lower"});
    return airfoil_of(reader);
  }
  if (kind == "line") {
    reader.expect_keys({"kind", "from", "to"});
    return Line{.from = point_of(reader["from"]), .to = point_of(reader["to"])};
  }
  if (kind == "polyline") {
    reader.expect_keys({"kind", "points"});
    Polyline polyline;
    for (const JsonReader& element : reader["points"].elements())
      polyline.points.push_back(point_of(element));
    if (polyline.points.size() < 2) reader["points"].refuse("expected at least 2 points");
    return polyline;
  }
  if (kind == "arc") {
    reader.expect_keys({"kind", "centre", "radius", "start", "sweep"});
    return Arc{.centre = point_of(reader["centre"]),
               .radius = reader["radius"].number(),
               .start = reader["start"].number(),
               .sweep = reader["sweep"].number()};
  }
  reader["kind"].refuse("found \"" + kind + "\", expected airfoil, line, polyline or arc");
}

Curve curve_of(const JsonReader& reader) {
  reader.expect_keys({"name", "shape", "parameters"});
  return {.name = reader["name"].text(),
          .shape = shape_of(reader["shape"]),
          .parameters = reader["parameters"].numbers()};
}

Loop loop_of(const JsonReader& reader) {
  reader.expect_keys({"role", "curves"});
  const std::string role = reader["role"].text();
  if (role != "outer" && role != "hole") {
    reader["role"].refuse("found \"" + role + "\", expected outer or hole");
  }
  Loop loop{.role = role == "outer" ? LoopRole::outer : LoopRole::hole, .curves = {}};
  for (const JsonReader& element : reader["curves"].elements()) loop.curves.push_back(curve_of(element));
  return loop;
}

}  // namespace

std::string domain_to_json(const Domain& domain) {
  ordered_json loops = ordered_json::array();
  for (const Loop& loop : domain.loops) loops.push_back(json_of(loop));
  return ordered_json{{"loops", std::move(loops)}}.dump();
}

Domain domain_from_json(std::string_view text, const std::string& source) {
  const nlohmann::json parsed = parse_json(text, source);
  const JsonReader reader(parsed, source);
  reader.expect_keys({"loops"});
  Domain domain;
  for (const JsonReader& element : reader["loops"].elements()) domain.loops.push_back(loop_of(element));
  return domain;
}

}  // namespace remodel
