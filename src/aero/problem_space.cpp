#include "aero/problem_space.h"

#include "aero/problem_place.h"

namespace remodel {
namespace {

constexpr std::size_t most_parts = 1000;
constexpr const char* name_of_outline = "airfoil";

// Where a space stands: its text, its file and the directory that its paths lead on from.
struct SpaceSource {
  Json json;
  std::string where;
  std::filesystem::path directory;
};

SpaceSource source_of(const Keys& keys, const Json& problem, const std::string& file) {
  const std::filesystem::path directory = std::filesystem::path(file).parent_path();
  const Json& given = problem.at("space");
  if (!given.is_string()) return {given, file + ", space", directory};
  const std::filesystem::path path = directory / given.get<std::string>();
  constexpr std::size_t most_bytes = std::size_t{16} << 20;
  try {
    return {parse_design_json(read_text(path, most_bytes), path.string(), "a design space, a JSON object"),
            path.string(), path.parent_path()};
  } catch (const Error& error) {
    keys.fail("as 'space', " + std::string(error.what()));
  }
}

std::vector<Point> points_named(const Keys& keys, const std::filesystem::path& directory,
                                std::vector<std::string>& warnings) {
  const std::string name = keys.get<std::string>("outline");
  constexpr const char* naca = "naca:";
  if (name.starts_with(naca)) {
    const AirfoilCoordinates section = naca_airfoil(name.substr(std::string(naca).size()));
    std::vector<Point> points(section.upper.rbegin(), section.upper.rend());
    points.insert(points.end(), section.lower.begin() + 1, section.lower.end());
    return points;
  }
  const AirfoilOutlines file = read_outlines(directory / name);
  if (file.elements.size() != 1)
    keys.fail("found " + std::to_string(file.elements.size()) + " elements in '" + name +
              "', expected an outline of one, or a 'domain'");
  warnings.insert(warnings.end(), file.warnings.begin(), file.warnings.end());
  const AirfoilOutline& outline = file.elements.front();
  if (lies_in_chords(outline.frame)) return outline.points;
  warnings.push_back((directory / name).string() + ": its chord of " + shown(outline.frame.chord) +
                     " is scaled to 1, and its nose moved from " +
                     shown(std::array{outline.frame.nose.x, outline.frame.nose.y}) + " to the origin");
  return moved_to_origin(outline);
}

// The outline's points are begun at the trailing edge, along the upper side first, each once: whatever the
// file's order.
Domain outline_domain(const Keys& keys, const SpaceSource& source, const AirfoilDomainOptions& farfield,
                      std::vector<Point>& points, std::vector<std::string>& warnings) {
  const std::string curve = keys.get<std::string>("curve", "spline");
  if (curve != "spline" && curve != "polyline")
    keys.fail("found '" + curve + "' as 'curve', expected spline or polyline");
  try {
    points = points_named(keys, source.directory, warnings);
    if (points.size() < 4) keys.fail("found an outline of fewer than 4 points");
    // Stations come later: how many there are is the mesh's `points`.
    AirfoilDomainOptions around = farfield;
    around.points += around.points % 2;
    const OutlineCurve kind = curve == "spline" ? OutlineCurve::spline : OutlineCurve::polyline;
    return airfoils_domain(
        {{.name = name_of_outline, .airfoil = {}, .outline = outline_of(points, kind, name_of_outline)}},
        around);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::format && std::string(error.what()).starts_with(source.where)) throw;
    keys.fail("as 'outline', " + std::string(error.what()));
  }
}

Domain domain_named(const Keys& keys, const SpaceSource& source, std::vector<std::string>& warnings) {
  const std::string name = keys.get<std::string>("domain");
  try {
    return load_domain(source.directory / name, default_join, nullptr, &warnings);
  } catch (const Error& error) {
    keys.fail("as 'domain', " + std::string(error.what()));
  }
}

Moves moves_named(const Keys& keys) {
  return choice(keys, "move", {Moves::y, Moves::x, Moves::xy});
}

DeformationRange range_given(const Keys& keys) {
  DeformationRange range{.scale = keys.get<double>("scale", 1.0)};
  if (keys.has("bounds")) range.bounds = keys.pair("bounds");
  return range;
}

FreeFormBox box_of(const Keys& keys, const Json& entry, const std::string& where, const std::string& on) {
  const auto x = keys.pair("x"), y = keys.pair("y");
  FreeFormBox box{.on = on, .low = {x[0], y[0]}, .high = {x[1], y[1]}};
  const Json counts = keys.list("points", 2);
  if (counts.size() != 2) keys.fail("expected two numbers as 'points', of columns and of rows");
  box.columns = keys.whole_number<std::size_t>(counts[0], "points", 2, 30);
  box.rows = keys.whole_number<std::size_t>(counts[1], "points", 2, 30);
  if (entry.contains("hold")) {
    const Keys hold(entry.at("hold"), where + ", hold", {"left", "right", "bottom", "top"});
    const auto held = [&](const char* side) { return hold.whole<std::size_t>(side, 0, 0, 30); };
    box.hold = {.left = held("left"), .right = held("right"), .bottom = held("bottom"), .top = held("top")};
  }
  box.moves = moves_named(keys), box.range = range_given(keys);
  return box;
}

HicksHenneBumps bumps_of(const Keys& keys, const std::string& on) {
  const std::string surface = keys.get<std::string>("surface");
  if (surface != "upper" && surface != "lower")
    keys.fail("found '" + surface + "' as 'surface', expected upper or lower");
  return {.on = on,
          .upper = surface == "upper",
          .peaks = keys.get<std::vector<double>>("x"),
          .width = keys.get<double>("width", 3.0),
          .range = range_given(keys)};
}

CurvePoints points_of(const Keys& keys, const std::string& on) {
  CurvePoints points{.on = on, .points = {}, .moves = moves_named(keys), .range = range_given(keys)};
  keys.require("points");
  for (const Json& entry : keys.list("points", most_parts))
    points.points.push_back(keys.whole_number<std::size_t>(entry, "points", 0, 1000000));
  return points;
}

// Says where points lie that are named by their numbers in an outline, which may not have the file's order.
void say_places(const CurvePoints& part, const std::vector<Point>& outline, const std::string& where,
                std::vector<std::string>& warnings) {
  std::string places;
  for (const std::size_t i : part.points)
    if (i < outline.size())
      places += (places.empty() ? "" : ", ") + std::to_string(i) + " lies at " + shown(outline[i].x) + ", " +
                shown(outline[i].y);
  if (!places.empty())
    warnings.push_back(where + ": points count from the trailing edge along the upper side: " + places);
}

DeformationPart part_of(const Json& entry, const std::string& where, bool is_outline) {
  const Keys any(entry, where);
  const std::string kind = any.get<std::string>("kind");
  const std::string on =
      is_outline ? any.get<std::string>("on", name_of_outline) : any.get<std::string>("on");
  if (kind == "box")
    return box_of(Keys(entry, where, {"kind", "on", "x", "y", "points", "hold", "move", "bounds", "scale"}),
                  entry, where, on);
  if (kind == "bumps")
    return bumps_of(Keys(entry, where, {"kind", "on", "surface", "x", "width", "bounds", "scale"}), on);
  if (kind == "points")
    return points_of(Keys(entry, where, {"kind", "on", "points", "move", "bounds", "scale"}), on);
  any.fail("found '" + kind + "' as 'kind', expected box, bumps or points");
}

}  // namespace

Deformation read_space(const Keys& problem_keys, const Json& problem, const std::string& file,
                       const AirfoilDomainOptions& farfield, std::vector<std::string>& warnings) {
  const SpaceSource source = source_of(problem_keys, problem, file);
  const Keys keys(source.json, source.where, {"outline", "curve", "domain", "deformations"});
  if (keys.has("outline") == keys.has("domain")) keys.fail("expected one of 'outline' and 'domain'");
  const bool is_outline = keys.has("outline");
  if (!is_outline && keys.has("curve")) keys.fail("found 'curve' with 'domain', expected 'outline'");
  if (!is_outline && object_of(problem, "mesh").contains("farfield_radius"))
    problem_keys.fail("found 'farfield_radius' in 'mesh' with a 'domain', expected it with an 'outline'");
  std::vector<Point> outline;
  Deformation result{.domain = is_outline ? outline_domain(keys, source, farfield, outline, warnings)
                                          : domain_named(keys, source, warnings),
                     .parts = {}};
  keys.require("deformations");
  for (const Json& entry : keys.list("deformations", most_parts)) {
    const std::string where = source.where + ", deformation " + std::to_string(result.parts.size() + 1);
    result.parts.push_back(part_of(entry, where, is_outline));
    const std::string& on =
        std::visit([](const auto& part) -> const std::string& { return part.on; }, result.parts.back());
    if (splines_for_airfoils(result.domain, on))
      warnings.push_back(where + ": the airfoil '" + on +
                         "' is a spline through points of its own from here on");
    if (const auto* points = std::get_if<CurvePoints>(&result.parts.back()))
      say_places(*points, outline, where, warnings);
  }
  return result;
}

}  // namespace remodel
