// Domains as JSON: docs/domains.md describes the layout. What is written is exact and complete; what is read
// may also use the short forms for people: stations instead of parameters, airfoils by name or file.

#include <cmath>

#include "airfoil_json.h"
#include "json_reader.h"
#include "remodel/domain.h"
#include "remodel/error.h"

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

ordered_json json_of_shape(const Spline& spline) {
  ordered_json points = ordered_json::array();
  for (const Point p : spline.points) points.push_back(json_of(p));
  ordered_json result{{"kind", "spline"}, {"points", std::move(points)}};
  if (spline.corner) result["corner"] = true;
  return result;
}

ordered_json json_of(const Curve& curve) {
  return {{"name", curve.name},
          {"shape", std::visit([](const auto& s) { return json_of_shape(s); }, curve.shape)},
          {"parameters", finite_for_json(curve.parameters, what)}};
}

ordered_json json_of(const Loop& loop) {
  ordered_json curves = ordered_json::array();
  for (const Curve& curve : loop.curves) curves.push_back(json_of(curve));
  ordered_json result{{"role", name_of(loop.role)}, {"curves", std::move(curves)}};
  if (loop.open) result["open"] = true;
  if (!loop.region.empty()) result["region"] = loop.region;
  if (!loop.right_region.empty()) result["right_region"] = loop.right_region;
  if (!(loop.placement == Placement{})) {
    result["placement"] = {{"chord", finite(loop.placement.chord)},
                           {"rotation_deg", finite(loop.placement.rotation_deg)},
                           {"position", json_of(loop.placement.position)}};
  }
  return result;
}

Point point_of(const JsonReader& reader) {
  const std::vector<double> values = reader.numbers();
  if (values.size() != 2) reader.refuse("expected two numbers, x and y");
  return {values[0], values[1]};
}

std::vector<Point> points_of(const JsonReader& reader) {
  std::vector<Point> points;
  for (const JsonReader& element : reader["points"].elements()) points.push_back(point_of(element));
  if (points.size() < 2) reader["points"].refuse("expected at least 2 points");
  return points;
}

Spline spline_of(const JsonReader& reader) {
  try {
    const bool corner = reader.has("corner") && reader["corner"].truth();
    return spline_through(points_of(reader), corner ? SplineEnds::corner : SplineEnds::smooth);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::argument) throw;
    reader["points"].refuse(error.what());
  }
}

int whole_number(const JsonReader& reader, const char* key, int low, int high) {
  const double value = reader[key].number();
  if (value != std::floor(value) || value < low || value > high)
    reader[key].refuse("expected a whole number from " + std::to_string(low) + " to " + std::to_string(high));
  return static_cast<int>(value);
}

// Reads a domain. Without a resolver airfoils by name are refused.
class DomainReader {
 public:
  explicit DomainReader(const AirfoilResolver& resolve) : resolve_(resolve) {}

  Loop loop_of(const JsonReader& reader) const {
    if (!reader.is_object()) reader.refuse("expected an object");
    Loop loop = reader.has("airfoil") ? airfoil_loop(reader) : loop_of_curves(reader);
    if (reader.has("placement")) loop.placement = placement_of(reader["placement"]);
    return loop;
  }

 private:
  // {"airfoil": SHAPE, "name": ..., "stations": I, "turning_share": S, "cst_degree": N}: a hole of that
  // shape.
  Loop airfoil_loop(const JsonReader& reader) const {
    reader.expect_keys({"airfoil", "stations"}, {"name", "turning_share", "cst_degree", "placement"});
    const int stations = whole_number(reader, "stations", 8, 100000);
    if (stations % 2 != 0) reader["stations"].refuse("expected an even number");
    const double share = reader.number_or("turning_share", 0.0);
    if (!(share >= 0.0 && share <= 0.9)) reader["turning_share"].refuse("expected a part from 0 to 0.9");
    Domain domain = airfoil_domain(named_airfoil(reader, "airfoil", TrailingEdge::kept),
                                   {.points = stations, .turning_share = share});
    Loop loop = std::move(domain.loops.front());
    if (reader.has("name"))
      for (Curve& curve : loop.curves) curve.name = reader["name"].text();
    return loop;
  }

  static Loop with_role(const JsonReader& reader) {
    const std::string role = reader["role"].text();
    for (const LoopRole each :
         {LoopRole::outer, LoopRole::hole, LoopRole::internal, LoopRole::left, LoopRole::right})
      if (role == name_of(each)) return {.role = each, .curves = {}};
    reader["role"].refuse("found \"" + role + "\", expected outer, hole, internal, left or right");
  }

  Loop loop_of_curves(const JsonReader& reader) const {
    reader.expect_keys({"role", "curves"}, {"open", "placement", "region", "right_region"});
    Loop loop = with_role(reader);
    for (const JsonReader& element : reader["curves"].elements()) loop.curves.push_back(curve_of(element));
    if (reader.has("open")) loop.open = reader["open"].truth();
    if (reader.has("region")) loop.region = reader["region"].text();
    if (reader.has("right_region")) loop.right_region = reader["right_region"].text();
    return loop;
  }

  static Placement placement_of(const JsonReader& reader) {
    reader.expect_keys({}, {"chord", "rotation_deg", "position"});
    Placement placement{.chord = reader.number_or("chord", 1.0),
                        .rotation_deg = reader.number_or("rotation_deg", 0.0)};
    if (reader.has("position")) placement.position = point_of(reader["position"]);
    return placement;
  }

  Curve curve_of(const JsonReader& reader) const {
    if (!reader.is_object() || !reader.has("stations")) {
      reader.expect_keys({"name", "shape", "parameters"});
      return {.name = reader["name"].text(),
              .shape = shape_of(reader["shape"]),
              .parameters = reader["parameters"].numbers()};
    }
    reader.expect_keys({"name", "shape", "stations"});
    const int n = whole_number(reader, "stations", 1, 1000000);
    std::vector<double> parameters;
    for (int i = 0; i < n; ++i) parameters.push_back(static_cast<double>(i) / n);
    return {.name = reader["name"].text(),
            .shape = shape_of(reader["shape"]),
            .parameters = std::move(parameters)};
  }

  Shape shape_of(const JsonReader& reader) const {
    if (!reader.is_object() || !reader.has("kind")) reader.refuse("expected an object with the key \"kind\"");
    const std::string kind = reader["kind"].text();
    if (kind == "airfoil") {
      if (reader.has("shape")) {
        reader.expect_keys({"kind", "shape"}, {"cst_degree"});
        return named_airfoil(reader, "shape", TrailingEdge::closed);
      }
      reader.expect_keys({"kind", "degree", "upper", "lower"}, {"e1", "e2", "te_upper", "te_lower"});
      return airfoil_of(reader);
    }
    if (kind == "line") {
      reader.expect_keys({"kind", "from", "to"});
      return Line{.from = point_of(reader["from"]), .to = point_of(reader["to"])};
    }
    if (kind == "polyline") {
      reader.expect_keys({"kind", "points"});
      return Polyline{points_of(reader)};
    }
    if (kind == "spline") {
      reader.expect_keys({"kind", "points"}, {"corner"});
      return spline_of(reader);
    }
    if (kind == "arc") {
      reader.expect_keys({"kind", "centre", "radius", "start", "sweep"});
      return Arc{.centre = point_of(reader["centre"]),
                 .radius = reader["radius"].number(),
                 .start = reader["start"].number(),
                 .sweep = reader["sweep"].number()};
    }
    reader["kind"].refuse("found \"" + kind + "\", expected airfoil, line, polyline, spline or arc");
  }

  CstAirfoil named_airfoil(const JsonReader& reader, const char* key, TrailingEdge trailing_edge) const {
    if (!resolve_) reader[key].refuse("airfoils by name or file belong into a domain file");
    const int degree = reader.has("cst_degree") ? whole_number(reader, "cst_degree", 2, 12) : 5;
    try {
      return resolve_(reader[key].text(), degree, trailing_edge);
    } catch (const Error& error) {
      reader[key].refuse(error.what());
    }
  }

  const AirfoilResolver& resolve_;
};

}  // namespace

std::string domain_to_json(const Domain& domain) {
  ordered_json loops = ordered_json::array();
  for (const Loop& loop : domain.loops) loops.push_back(json_of(loop));
  ordered_json result = {{"loops", std::move(loops)}};
  for (const PeriodicPair& pair : domain.periodic)
    result["periodic"].push_back(ordered_json::array({pair.name, pair.moved}));
  return result.dump();
}

Domain domain_from_json(std::string_view text, const std::string& source, const AirfoilResolver& resolve) {
  const nlohmann::json parsed = parse_json(text, source);
  const JsonReader reader(parsed, source);
  reader.expect_keys({"loops"}, {"periodic"});
  const DomainReader domain_reader(resolve);
  Domain domain;
  for (const JsonReader& element : reader["loops"].elements())
    domain.loops.push_back(domain_reader.loop_of(element));
  if (reader.has("periodic"))
    for (const JsonReader& element : reader["periodic"].elements()) {
      const std::vector<JsonReader> names = element.elements();
      if (names.size() != 2) element.refuse("expected the names of two curves");
      domain.periodic.push_back({names[0].text(), names[1].text()});
    }
  return domain;
}

bool holds_domain(std::string_view text, const std::string& source) {
  const nlohmann::json parsed = parse_json(text, source);
  return parsed.is_object() && parsed.contains("loops");
}

}  // namespace remodel
