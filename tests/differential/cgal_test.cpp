// Compares the kernel with CGAL's constrained Delaunay triangulation. Where four points are cocircular CGAL
// may break the tie differently; then only the edges that every constrained Delaunay triangulation has are
// compared.

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include "mesh/mesh_data.h"
#include "reference/designs.h"
#include "reference/kernel_walk.h"
#include "remodel/generate.h"
#include "remodel/remodel.h"
#include "support.h"

namespace remodel {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<Kernel>;
using Handle = Cdt::Vertex_handle;

template <class Index>
std::set<reference::Face> faces_of(const Cdt& cdt, const Index& index) {
  std::set<reference::Face> result;
  for (auto face = cdt.finite_faces_begin(); face != cdt.finite_faces_end(); ++face)
    result.insert(
        reference::face_of(index.at(face->vertex(0)), index.at(face->vertex(1)), index.at(face->vertex(2))));
  return result;
}

template <class Index>
std::set<reference::Edge> constraints_of(const Cdt& cdt, const Index& index) {
  std::set<reference::Edge> result;
  for (auto edge = cdt.finite_edges_begin(); edge != cdt.finite_edges_end(); ++edge)
    if (cdt.is_constrained(*edge))
      result.insert(reference::edge_of(index.at(edge->first->vertex(Cdt::ccw(edge->second))),
                                       index.at(edge->first->vertex(Cdt::cw(edge->second)))));
  return result;
}

// Applies the same commands to both triangulations.
class Pair : public test::KernelWalk {
 public:
  Pair(std::mt19937_64& random, test::Family family) : KernelWalk(random, family) {
    for (const VertexId v : vertices) Pair::on_insert(v, triangulation.point(v));
  }

  struct Comparison {
    bool same_edges = false;      // of all edges that no tie-break decides, constraints included
    bool same_triangles = false;  // of all triangles
    std::size_t triangles = 0;
    std::size_t ties = 0;  // edges that a tie-break decided
  };
  Comparison compare() const {
    std::map<Handle, std::size_t> index;
    for (std::size_t i = 0; i < vertices.size(); ++i) index[handles_.at(vertices[i])] = i;
    const auto ours = faces(), theirs = faces_of(cdt_, index);
    const auto fixed = constraints();
    const std::vector<Point> points = this->points();
    const auto certain = reference::certain_edges(points, ours, fixed);
    Comparison result;
    result.same_edges = cdt_.number_of_vertices() == vertices.size() &&
                        fixed == constraints_of(cdt_, index) && ours.size() == theirs.size() &&
                        certain == reference::certain_edges(points, theirs, fixed);
    result.same_triangles = ours == theirs;
    result.triangles = ours.size();
    result.ties =
        points.size() + ours.size() - 1 - certain.size();  // Euler: all edges minus the certain ones
    return result;
  }

 private:
  void on_insert(VertexId v, Point p) override { handles_[v] = cdt_.insert({p.x, p.y}); }
  void on_remove(VertexId v) override {
    cdt_.remove(handles_.at(v));
    handles_.erase(v);
  }
  void on_constrain(VertexId a, VertexId b) override {
    cdt_.insert_constraint(handles_.at(a), handles_.at(b));
  }
  void on_release(VertexId a, VertexId b) override {
    Cdt::Face_handle face;
    int index = 0;
    ASSERT_TRUE(cdt_.is_edge(handles_.at(a), handles_.at(b), face, index));
    cdt_.remove_constrained_edge(face, index);
  }

  Cdt cdt_;
  std::map<VertexId, Handle> handles_;
};

class AgainstCgal : public testing::TestWithParam<test::Family> {};
INSTANTIATE_TEST_SUITE_P(Families, AgainstCgal, testing::ValuesIn(test::families),
                         [](const auto& param_info) { return std::string(test::name_of(param_info.param)); });

TEST_P(AgainstCgal, RandomCommandsGiveTheSameTriangles) {
  const auto seed = test::seed(201 + static_cast<unsigned long long>(GetParam()));
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  std::size_t compared = 0, triangles = 0, ties = 0;
  for (int round = 0; round < 120 * test::effort(); ++round) {
    Pair pair(random, GetParam());
    const std::size_t most = 8U << (round % 6);
    for (int step = 0; step < 400; ++step) {
      pair.step(most);
      if (step % 8 != 7) continue;
      const Pair::Comparison found = pair.compare();
      ASSERT_TRUE(found.same_edges) << "round " << round << " step " << step;
      // CGAL breaks ties by the same symbolic perturbation as incircle_sos.
      ASSERT_TRUE(found.same_triangles) << "round " << round << " step " << step;
      ++compared;
      triangles += found.triangles;
      ties += found.ties;
    }
    ASSERT_EQ(pair.triangulation.check(), "");
  }
  std::cout << compared << " comparisons, " << triangles << " triangles, " << ties
            << " edges chosen by the tie-break\n";
  test::counted(static_cast<long long>(compared), "differential cases");
  if (GetParam() == test::Family::gridded || GetParam() == test::Family::cocircular) {
    EXPECT_GT(ties, compared);
  }
}

// Domain triangles and constraints of a mesh, vertices by position in `points`.
struct Content {
  std::vector<Point> points;
  std::set<reference::Face> domain;
  std::set<reference::Edge> constraints;
};

Content content_of(const MeshData& mesh) {
  Content content;
  std::vector<std::size_t> index(mesh.triangulation.vertex_slots(), 0);
  for (std::uint32_t v = 1; v < mesh.triangulation.vertex_slots(); ++v) {
    if (!mesh.triangulation[VertexId{v}].alive()) continue;
    index[v] = content.points.size();
    content.points.push_back(mesh.triangulation.point(VertexId{v}));
  }
  for (std::uint32_t i = 0; i < mesh.triangulation.triangle_slots(); ++i) {
    const Triangle& t = mesh.triangulation[TriangleId{i}];
    if (!t.alive()) continue;
    if (t.region == Region::domain)
      content.domain.insert(
          reference::face_of(index[t.vertex[0].index], index[t.vertex[1].index], index[t.vertex[2].index]));
    for (int k = 0; k < 3; ++k)
      if (t.link[k].constrained())
        content.constraints.insert(
            reference::edge_of(index[t.vertex[next3(k)].index], index[t.vertex[previous3(k)].index]));
  }
  return content;
}

// Faces reached from those of the domain's own seed without crossing a constraint need no labels: a face is
// in the domain if the mesh has it there.
TEST(RemodelledMeshes, HaveTheDomainTrianglesOfCgalAndOfARebuild) {
  const auto seed = test::seed(221);
  SCOPED_TRACE("REMODEL_TEST_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  int compared = 0, full = 0;
  for (int round = 0; round < 10 * test::effort(); ++round) {
    const CstAirfoil base = airfoil_catalogue()[static_cast<std::size_t>(round % 10)].airfoil();
    const AirfoilDomainOptions options{.points = round % 3 == 0 ? 50 : 100};
    Mesh mesh = generate(airfoil_domain(base, options), {.gradation = 2.0}).mesh;
    for (int step = 0; step < 12; ++step) {
      const double sigma = std::array{0.003, 0.02, 0.1, 0.25}[random() % 4];
      const RemodelResult result = remodel(
          mesh, airfoil_domain(test::random_variant(random, base, sigma), options),
          {.method = random() % 3 == 0 ? Method::general : Method::automatic, .strategy = Strategy::chain});
      full += result.full_adjustment ? 1 : 0;
      const Content content = content_of(mesh.data());

      std::vector<std::size_t> order(content.points.size());
      for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
      std::shuffle(order.begin(), order.end(), random);
      const auto third = std::find_if(order.begin() + 2, order.end(), [&](std::size_t i) {
        return orient2d(content.points[order[0]], content.points[order[1]], content.points[i]) != 0;
      });
      Triangulation rebuilt;
      rebuilt.start(content.points[order[0]], content.points[order[1]], content.points[*third]);
      std::vector<VertexId> vertex_of(content.points.size());
      std::vector<std::size_t> index_of(content.points.size() + 1);
      Cdt cdt;
      std::map<Handle, std::size_t> handle_index;
      std::vector<Handle> handles(content.points.size());
      for (const std::size_t i : order) {
        vertex_of[i] = rebuilt.insert(content.points[i], rebuilt.star(VertexId{1}).triangle).vertex;
        index_of[vertex_of[i].index] = i;
        handles[i] = cdt.insert({content.points[i].x, content.points[i].y});
        handle_index[handles[i]] = i;
      }
      for (const auto& [a, b] : content.constraints) {
        ASSERT_EQ(rebuilt.constrain(vertex_of[a], vertex_of[b]).kind, ConstrainResult::Kind::done);
        cdt.insert_constraint(handles[a], handles[b]);
      }
      ASSERT_EQ(rebuilt.check(), "");
      std::set<reference::Face> faces;
      for (std::uint32_t i = 0; i < rebuilt.triangle_slots(); ++i) {
        const Triangle& t = rebuilt[TriangleId{i}];
        if (t.alive() && !t.ghost())
          faces.insert(reference::face_of(index_of[t.vertex[0].index], index_of[t.vertex[1].index],
                                          index_of[t.vertex[2].index]));
      }
      ASSERT_TRUE(std::includes(faces.begin(), faces.end(), content.domain.begin(), content.domain.end()))
          << "round " << round << " step " << step << ": a domain triangle is not that of a rebuild";

      const auto theirs =
          reference::certain_edges(content.points, faces_of(cdt, handle_index), content.constraints);
      ASSERT_EQ(reference::certain_edges(content.points, faces, content.constraints), theirs)
          << "round " << round << " step " << step << ": CGAL has other edges";
      ++compared;
    }
  }
  EXPECT_GT(full, 5);
  test::counted(2LL * compared, "differential cases");
  std::cout << compared << " meshes compared, " << full << " of them after full adjustments\n";
}

}  // namespace
}  // namespace remodel
