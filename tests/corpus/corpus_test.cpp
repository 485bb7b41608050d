// The adversarial corpus: each file of this directory is a chain of designs with the outcome of every one.
//
//   {"about": "what is hard here",
//    "options": {"gradation": 4, "min_angle_deg": 30, "max_vertices": 100000},      all optional
//    "distance": 1, "method": "auto",                                               of remodelling, optional
//    "designs": [DESIGN, ...], "expected": [OUTCOME, ...],   one outcome per design, or one for all
//    "repeat": 1,                                             passes over the designs, in the same mesh
//    "max_triangles": 100000}                                 of each mesh
//
// DESIGN is {"catalogue": NAME, ...}, {"upper": [...], "lower": [...], ...} (CST coefficients) or {"domain":
// {...}} (the JSON of a domain). Airfoils take "points", "farfield_radius" and "farfield_points", and "sigma"
// with "seed": every coefficient times 1 + sigma * noise. "circle": {"stations": n} is an annulus of 2 n
// cocircular stations. "scale": k multiplies all coordinates of a domain by 2^k.
//
// OUTCOME is "valid", "refused: WORDS" (an Error whose message has these words; a mesh that was there is
// untouched) or "stopped: REASON" (a valid mesh of lower quality). A first design is generated, later ones
// are remodelled to.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "mesh/mesh_data.h"
#include "reference/designs.h"
#include "remodel/check.h"
#include "remodel/error.h"
#include "remodel/generate.h"
#include "remodel/remodel.h"

namespace remodel {
namespace {

using nlohmann::json;

void scale(Domain& domain, int exponent) {
  const auto by = [&](double& value) { value = std::ldexp(value, exponent); };
  for (Loop& loop : domain.loops)
    for (Curve& curve : loop.curves) {
      if (auto* line = std::get_if<Polyline>(&curve.shape))
        for (Point& p : line->points) by(p.x), by(p.y);
      if (auto* arc = std::get_if<Arc>(&curve.shape)) by(arc->centre.x), by(arc->centre.y), by(arc->radius);
    }
}

Domain annulus(int stations) {
  std::vector<double> parameters;
  for (int i = 0; i < stations; ++i) parameters.push_back(static_cast<double>(i) / stations);
  return {{{LoopRole::outer, {{"outer", Arc{.centre = {}, .radius = 4}, parameters}}},
           {LoopRole::hole, {{"inner", Arc{.centre = {}, .radius = 1}, parameters}}}}};
}

Domain design_of(const json& design) {
  if (design.contains("circle")) return annulus(design["circle"]["stations"]);
  if (design.contains("domain")) {
    Domain domain = domain_from_json(design["domain"].dump(), "corpus");
    scale(domain, design.value("scale", 0));
    return domain;
  }
  CstAirfoil airfoil;
  if (design.contains("catalogue")) {
    airfoil = named_airfoil(design["catalogue"], 5);
  } else {
    airfoil.upper = design["upper"].get<std::vector<double>>();
    airfoil.lower = design["lower"].get<std::vector<double>>();
  }
  if (design.contains("sigma")) {
    std::mt19937_64 random(design["seed"].get<unsigned>());
    airfoil = test::random_variant(random, airfoil, design["sigma"]);
  }
  return airfoil_domain(airfoil, {.points = design.value("points", 200),
                                  .farfield_radius = design.value("farfield_radius", 25.0),
                                  .farfield_points = design.value("farfield_points", 50)});
}

class Case {
 public:
  explicit Case(const json& text) : text_(text) {
    const json options = text.value("options", json::object());
    options_.gradation = options.value("gradation", options_.gradation);
    options_.min_angle_deg = options.value("min_angle_deg", options_.min_angle_deg);
    options_.max_vertices = options.value("max_vertices", 2'000'000U);
    remodelling_.distance = text.value("distance", 1.0);
    if (text.value("method", "auto") == "general") remodelling_.method = Method::general;
  }

  // Returns the outcome of one design, as the corpus writes it.
  std::string run(const json& design) {
    const std::optional<MeshState> before = mesh_ ? std::optional(mesh_->state()) : std::nullopt;
    try {
      const Domain domain = design_of(design);
      Stopped stopped = Stopped::done;
      if (mesh_) {
        stopped = remodel::remodel(*mesh_, domain, remodelling_).stopped;
      } else {
        GenerateResult result = generate(domain, options_);
        stopped = result.stopped;
        exempt_ = result.exempt_triangles > 0;
        mesh_ = std::move(result.mesh);
      }
      if (stopped != Stopped::done) return std::string("stopped: ") + name_of(stopped) + broken(false);
      return "valid" + broken(!exempt_);
    } catch (const Error& error) {
      if (before && !(mesh_->state() == *before)) return "a refusal that changed the mesh";
      return std::string("refused: ") + error.what();
    }
  }

  std::size_t triangles() const { return mesh_ ? mesh_->triangle_count() : 0; }

 private:
  // Describes the defects of the mesh, to be appended to an outcome; empty if there are none.
  std::string broken(bool quality) const {
    if (quality) {
      const std::string problem = mesh_->quick_check();
      if (!problem.empty()) return ", but " + problem;
    }
    const std::string topology = mesh_->data().triangulation.check_topology() + check_boundary(mesh_->data());
    if (!topology.empty()) return ", but " + topology;
    if (mesh_->statistics().vertices != mesh_->data().triangulation.vertex_count())
      return ", but it has vertices outside of the domain";
    if (mesh_->triangle_count() > 20000) return {};  // the slow validator, for all that it takes a second for
    CheckOptions options;
    options.design = &mesh_->domain();
    if (quality) options.min_angle_deg = options_.min_angle_deg;
    const CheckResult result = check(mesh_->freeze(), options);
    return result.valid ? ""
                        : ", but check says " + result.violations.front().rule + ": " +
                              result.violations.front().detail;
  }

  const json& text_;
  QualityOptions options_;
  RemodelOptions remodelling_{.strategy = Strategy::chain};
  std::optional<Mesh> mesh_;
  bool exempt_ = false;
};

class Corpus : public testing::TestWithParam<std::string> {};

std::vector<std::string> corpus_files() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(REMODEL_SOURCE_DIR "/tests/corpus"))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(Files, Corpus, testing::ValuesIn(corpus_files()),
                         [](const auto& name) { return name.param; });

TEST_P(Corpus, EndsInOrder) {
  std::ifstream file(REMODEL_SOURCE_DIR "/tests/corpus/" + GetParam() + ".json");
  const json text = json::parse(file);
  Case chain(text);
  const json &designs = text["designs"], &expected = text["expected"];
  ASSERT_TRUE(expected.size() == 1 || expected.size() == designs.size());
  for (int pass = 0; pass < text.value("repeat", 1); ++pass)
    for (std::size_t i = 0; i < designs.size(); ++i) {
      SCOPED_TRACE("pass " + std::to_string(pass) + ", design " + std::to_string(i));
      const std::string found = chain.run(designs[i]);
      const std::string wanted = expected[expected.size() == 1 ? 0 : i];
      constexpr std::string_view refused = "refused: ";
      if (wanted.starts_with(refused)) {
        EXPECT_TRUE(found.starts_with(refused)) << found;
        EXPECT_NE(found.find(wanted.substr(refused.size())), std::string::npos) << found;
      } else {
        EXPECT_EQ(found, wanted);
      }
      EXPECT_LE(chain.triangles(), text["max_triangles"].get<std::size_t>());
    }
}

}  // namespace
}  // namespace remodel
