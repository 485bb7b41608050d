#include "contestants.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <list>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <unistd.h>

#include "timing.h"

namespace remodel::bench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

// The length scale of a vertex; 0 if not yet known.
struct Scale {
  double value = 0.0;
};
using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_2<Scale, Kernel, CGAL::Delaunay_mesh_vertex_base_2<Kernel>>;
using FaceBase = CGAL::Delaunay_mesh_face_base_2<Kernel>;
using Cdt =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel,
                                               CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>>;

double distance(const Kernel::Point_2& a, const Kernel::Point_2& b) {
  return std::hypot(b.x() - a.x(), b.y() - a.y());
}

// Our bounds as criteria of Mesh_2: its quality is our badness.
class Criteria {
 public:
  using Face_handle = Cdt::Face_handle;
  using Quality = double;

  explicit Criteria(const QualityOptions& options)
      : squared_gradation_(options.max_gradation * options.max_gradation), gradation_(options.gradation) {
    const double sine = std::sin(options.min_angle_deg * std::numbers::pi / 180.0);
    squared_radius_edge_ = 0.25 / (sine * sine);
  }

  class Is_bad {
   public:
    explicit Is_bad(const Criteria& criteria) : criteria_(criteria) {}
    CGAL::Mesh_2::Face_badness operator()(Quality quality) const {
      return quality > 1.0 ? CGAL::Mesh_2::BAD : CGAL::Mesh_2::NOT_BAD;
    }
    // Mesh_2 refines the triangle of smallest quality first.
    CGAL::Mesh_2::Face_badness operator()(Face_handle face, Quality& quality) const {
      const double badness = criteria_.badness(face);
      quality = -badness;
      return badness > 1.0 ? CGAL::Mesh_2::BAD : CGAL::Mesh_2::NOT_BAD;
    }

   private:
    const Criteria& criteria_;
  };
  Is_bad is_bad_object() const { return Is_bad(*this); }

 private:
  double badness(Face_handle face) const {
    const auto &a = face->vertex(0)->point(), &b = face->vertex(1)->point(), &c = face->vertex(2)->point();
    const double la = CGAL::squared_distance(b, c), lb = CGAL::squared_distance(c, a),
                 lc = CGAL::squared_distance(a, b);
    const double twice_area = (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
    const double squared_radius = la * lb * lc / (4.0 * twice_area * twice_area);
    double mean = 0.0;
    for (int i = 0; i < 3; ++i) mean += scale(face->vertex(i)) / 3.0;
    return std::max(squared_radius / (squared_radius_edge_ * std::min({la, lb, lc})),
                    squared_radius / (squared_gradation_ * mean * mean));
  }

  double scale(Cdt::Vertex_handle v) const {
    if (v->info().value > 0.0) return v->info().value;
    double smallest = std::numeric_limits<double>::infinity();
    const auto first = v->face();
    auto face = first;
    do {
      const int i = face->index(v);
      const auto u = face->vertex(Cdt::ccw(i));
      if (u->info().value > 0.0)
        smallest = std::min(smallest, u->info().value + distance(u->point(), v->point()) / gradation_);
      face = face->neighbor(Cdt::ccw(i));
    } while (face != first && face != nullptr);
    return v->info().value = smallest;
  }

  double squared_radius_edge_, squared_gradation_, gradation_;
};

std::vector<std::vector<Point>> station_points(const Domain& domain) {
  std::vector<std::vector<Point>> loops;
  for (std::size_t loop = 0; loop < domain.loops.size(); ++loop) {
    loops.emplace_back();
    for (const BoundaryStation& station : domain.stations(loop)) loops.back().push_back(domain.at(station));
  }
  return loops;
}

// The distance of each vertex to its nearer neighbour along the loop.
std::vector<double> spacings(const std::vector<Point>& loop) {
  const std::size_t n = loop.size();
  std::vector<double> result(n);
  for (std::size_t i = 0; i < n; ++i)
    result[i] = std::sqrt(std::min(squared_distance(loop[i], loop[(i + 1) % n]),
                                   squared_distance(loop[i], loop[(i + n - 1) % n])));
  return result;
}

}  // namespace

double yardstick() {
  constexpr std::size_t count = 27'000;
  static std::mt19937_64 random(1);
  std::vector<Kernel::Point_2> points;
  const auto uniform = [] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  for (std::size_t i = 0; i < count; ++i) {
    const double x = uniform();
    points.emplace_back(x, uniform());
  }
  CGAL::Delaunay_triangulation_2<Kernel> triangulation;
  const CpuClock clock;
  triangulation.insert(points.begin(), points.end());
  return clock.seconds() / static_cast<double>(count);
}

Contest cgal_mesh(const Domain& domain, const QualityOptions& options) {
  const auto loops = station_points(domain);
  const CpuClock clock;
  Cdt cdt;
  std::list<Kernel::Point_2> seeds;
  for (std::size_t loop = 0; loop < loops.size(); ++loop) {
    const std::vector<double> scales = spacings(loops[loop]);
    std::vector<Cdt::Vertex_handle> vertices;
    for (std::size_t i = 0; i < loops[loop].size(); ++i) {
      vertices.push_back(cdt.insert({loops[loop][i].x, loops[loop][i].y}));
      vertices.back()->info().value = scales[i];
    }
    for (std::size_t i = 0; i < vertices.size(); ++i)
      cdt.insert_constraint(vertices[i], vertices[(i + 1) % vertices.size()]);
    if (domain.loops[loop].role == LoopRole::hole) {  // airfoils: half way up at half chord
      const std::size_t n = loops[loop].size();
      const Point above = loops[loop][n / 4], below = loops[loop][n - n / 4];
      seeds.emplace_back(0.5 * (above.x + below.x), 0.5 * (above.y + below.y));
    }
  }
  CGAL::Delaunay_mesher_2<Cdt, Criteria> mesher(cdt, Criteria(options));
  mesher.set_seeds(seeds.begin(), seeds.end());
  mesher.refine_mesh();
  Contest result;
  result.seconds = clock.seconds();
  double cosine = -1.0;
  for (auto face = cdt.finite_faces_begin(); face != cdt.finite_faces_end(); ++face) {
    if (!face->is_in_domain()) continue;
    ++result.triangles;
    for (int i = 0; i < 3; ++i) {
      const auto p = face->vertex(i)->point(), q = face->vertex(Cdt::ccw(i))->point(),
                 r = face->vertex(Cdt::cw(i))->point();
      cosine = std::max(cosine, (q - p) * (r - p) / (distance(p, q) * distance(p, r)));
    }
  }
  result.min_angle_deg = std::acos(cosine) * 180.0 / std::numbers::pi;
  return result;
}

// Gmsh extends the sizes of boundary points inwards by interpolation only, so it gets a size field: the mean
// spacing of each loop plus a multiple of the distance to it.
Contest gmsh_mesh(const Domain& domain, const QualityOptions& options) {
  namespace fs = std::filesystem;
  const auto loops = station_points(domain);
  const fs::path directory = fs::temp_directory_path() / ("compare-" + std::to_string(getpid()));
  fs::create_directories(directory);
  std::ofstream geo(directory / "domain.geo");
  geo.precision(17);
  std::size_t id = 0;
  std::string surface, fields;
  for (std::size_t loop = 0; loop < loops.size(); ++loop) {
    const std::size_t first = id + 1;
    double mean = 0.0;
    for (const double spacing : spacings(loops[loop]))
      mean += spacing / static_cast<double>(loops[loop].size());
    for (const Point p : loops[loop]) geo << "Point(" << ++id << ") = {" << p.x << ',' << p.y << ",0};\n";
    for (std::size_t k = first; k <= id; ++k)
      geo << "Line(" << k << ") = {" << k << ',' << (k == id ? first : k + 1) << "};\n";
    geo << "Transfinite Curve {" << first << ':' << id << "} = 2;\n";
    geo << "Curve Loop(" << loop + 1 << ") = {" << first << ':' << id << "};\n";
    geo << "Field[" << 2 * loop + 1 << "] = Distance; Field[" << 2 * loop + 1 << "].PointsList = {" << first
        << ':' << id << "};\n";
    geo << "Field[" << 2 * loop + 2 << "] = MathEval; Field[" << 2 * loop + 2 << "].F = \"" << mean << " + F"
        << 2 * loop + 1 << " / " << options.gradation << "\";\n";
    const bool outer = domain.loops[loop].role == LoopRole::outer;
    surface = outer ? std::to_string(loop + 1) + (surface.empty() ? "" : "," + surface)
                    : surface + (surface.empty() ? "" : ",") + std::to_string(loop + 1);
    fields += (fields.empty() ? "" : ",") + std::to_string(2 * loop + 2);
  }
  geo << "Field[99] = Min; Field[99].FieldsList = {" << fields << "};\nBackground Field = 99;\n"
      << "Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0;\n"
      << "Plane Surface(1) = {" << surface << "};\n";
  geo.close();
  const std::string command = "gmsh -2 -nt 1 -v 5 -o " + (directory / "mesh.msh").string() + " " +
                              (directory / "domain.geo").string() + " 2>&1";
  Contest result;
  if (FILE* pipe = popen(command.c_str(), "r")) {
    char line[512];
    while (std::fgets(line, sizeof line, pipe) != nullptr) {
      const std::string text(line);
      if (const auto at = text.find("Done meshing 2D"); at != std::string::npos)
        if (const auto cpu = text.find("CPU "); cpu != std::string::npos)
          result.seconds = std::strtod(text.c_str() + cpu + 4, nullptr);
      unsigned long nodes = 0, elements = 0;
      if (const auto at = text.find("Info"); at != std::string::npos)
        if (const auto digits = text.find_first_of("0123456789", at);
            digits != std::string::npos &&
            std::sscanf(text.c_str() + digits, "%lu nodes %lu elements", &nodes, &elements) == 2)
          result.triangles = 2 * nodes - id;  // Euler: 2 V - B for one hole, boundary not split
    }
    if (pclose(pipe) != 0) result = {};
  }
  fs::remove_all(directory);
  return result;
}

}  // namespace remodel::bench
