#include "remodel/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>

#include "aero/unit_samples.h"
#include "io/test_meshes.h"
#include "remodel/error.h"
#include "remodel/flow_layer.h"
#include "remodel/generate.h"
#include "remodel/io.h"

namespace remodel {
namespace {

using test::error_of;

SweepProblem small_sweep() {
  SweepProblem problem;
  for (const char* name : {"naca:0012", "naca:2412", "naca:0010", "naca:2410", "naca:0014"})
    problem.sections.push_back({.name = name, .airfoil = named_airfoil(name, 5)});
  problem.rows = {{.mach = 0.4, .values = {-1, 0, 2}}, {.mach = 0.5, .values = {1}}};
  problem.domain = {.points = 40, .farfield_radius = 10.0};
  problem.gradation = 1.0;
  problem.tolerance = 1e-10;
  problem.chain = 2;
  problem.stations = 9;
  return problem;
}

class CancelsAfter final : public SweepObserver {
 public:
  explicit CancelsAfter(std::size_t chains) : chains_(chains) {}
  void finished(const SweepProgress& progress) override { done_ = progress.chains_done >= chains_; }
  bool cancelled() override { return done_; }

 private:
  std::size_t chains_;
  std::atomic<bool> done_ = false;
};

std::string table_of(const std::filesystem::path& directory) {
  return read_text(directory / "table.csv") + read_text(directory / "table.h5");
}

const SweepFlow& flow_at(const std::vector<SweepFlow>& flows, std::size_t section, double mach,
                         double asked) {
  const auto found = std::find_if(flows.begin(), flows.end(), [&](const SweepFlow& flow) {
    return flow.section == section && flow.mach == mach && flow.asked == asked;
  });
  if (found == flows.end()) throw std::runtime_error("no such flow");
  return *found;
}

TEST(Sweeps, HaveTheFlowsThatAreFoundOneByOne) {
  const test::Scratch scratch;
  const SweepProblem problem = small_sweep();
  ThreadCrew crew(1);
  const SweepResult result = sweep(scratch / "s", problem, SweepMode::begin, crew);
  EXPECT_EQ(result.flows, 20U);
  EXPECT_EQ(result.found, 20U);
  EXPECT_EQ(result.chains, 3U);
  EXPECT_GT(result.cold_seconds_estimate, 0.0);
  const std::vector<SweepFlow> flows = read_sweep_flows(scratch / "s");
  ASSERT_EQ(flows.size(), 20U);
  for (std::size_t i = 0; i < problem.sections.size(); ++i) {
    const Mesh mesh =
        generate(airfoil_domain(problem.sections[i].airfoil, problem.domain), {.gradation = 1.0}).mesh;
    for (const SweepRow& row : problem.rows) {
      for (const double alpha : row.values) {
        const FlowResult fresh = solve_flow(mesh, {.mach = row.mach, .alpha_deg = alpha});
        const PolarPoint& point = flow_at(flows, i, row.mach, alpha).point;
        ASSERT_TRUE(fresh.converged() && point.converged);
        // Another mesh of the same section, but for the first of a chain: so coarse a one has errors of a
        // hundredth, and a section that is not its own would be off by more.
        EXPECT_NEAR(point.cl, fresh.cl, 0.02) << problem.sections[i].name << " at " << alpha;
        EXPECT_EQ(point.alpha_deg, alpha);
      }
    }
  }
  const FlowResult cold = solve_flow(
      generate(airfoil_domain(problem.sections[0].airfoil, problem.domain), {.gradation = 1.0}).mesh,
      {.mach = 0.4, .alpha_deg = 2});
  EXPECT_NEAR(flow_at(flows, 0, 0.4, 2).point.cl, cold.cl, 1e-8);
  EXPECT_NEAR(flow_at(flows, 0, 0.4, 2).point.cd, cold.cd, 1e-8);
}

TEST(Sweeps, HaveOneTableForAnyNumberOfThreadsAndAfterAnyInterrupt) {
  const test::Scratch scratch;
  const SweepProblem problem = small_sweep();
  ThreadCrew one(1), three(3);
  sweep(scratch / "1", problem, SweepMode::begin, one);
  sweep(scratch / "3", problem, SweepMode::begin, three);
  const std::string table = table_of(scratch / "1");
  EXPECT_EQ(table_of(scratch / "3"), table);
  for (const std::size_t chains : {0U, 1U, 2U}) {
    const std::filesystem::path directory = scratch / ("cut" + std::to_string(chains));
    CancelsAfter observer(chains);
    const SweepResult part = sweep(directory, problem, SweepMode::begin, one, &observer);
    if (chains != 0) {
      EXPECT_EQ(part.stopped, SweepStopped::interrupted);
      EXPECT_LT(part.flows, part.planned);
      EXPECT_NE(table_of(directory), table);
    }
    const SweepResult whole = sweep(directory, problem, SweepMode::resume, three);
    EXPECT_EQ(whole.stopped, SweepStopped::done);
    EXPECT_EQ(whole.flows, whole.planned);
    EXPECT_EQ(table_of(directory), table);
  }
}

using Place = std::tuple<std::string, double, double>;

std::map<Place, double> lifts_of(const std::filesystem::path& directory) {
  const SweepProblem problem = read_sweep_problem(directory);
  std::map<Place, double> lifts;
  for (const SweepFlow& flow : read_sweep_flows(directory)) {
    const Place place{problem.sections[flow.section].name, flow.mach, flow.asked};
    EXPECT_TRUE(lifts.emplace(place, flow.point.cl).second) << "twice";
  }
  return lifts;
}

TEST(Sweeps, AreExtendedBySectionsAndConditionsAndKeepWhatTheyHad) {
  const test::Scratch scratch;
  const std::filesystem::path directory = scratch / "s";
  SweepProblem problem = small_sweep();
  ThreadCrew crew(2);
  sweep(directory, problem, SweepMode::begin, crew);
  const auto before = lifts_of(directory);
  problem.sections.insert(problem.sections.begin(),
                          {.name = "naca:4412", .airfoil = named_airfoil("naca:4412", 5)});
  problem.rows[0].values = {0, 1, 2};  // one is gone, one is new
  problem.rows.push_back({.mach = 0.3, .values = {0}});
  const SweepResult result = sweep(directory, problem, SweepMode::resume, crew);
  // Six sections at -1, 0, 1 and 2 degrees of Mach 0.4, 1 degree of 0.5 and 0 of 0.3.
  EXPECT_EQ(result.flows, 36U);
  const auto after = lifts_of(directory);
  EXPECT_EQ(after.size(), 36U);
  for (const auto& [place, lift] : before) EXPECT_EQ(after.at(place), lift);
  EXPECT_EQ(sweep(directory, problem, SweepMode::resume, crew).flows, 36U);
}

TEST(Sweeps, AreNotGoneOnWithByOthers) {
  const test::Scratch scratch;
  const std::filesystem::path directory = scratch / "s";
  SweepProblem problem = small_sweep();
  problem.sections.resize(1), problem.rows = {{.mach = 0.4, .values = {0}}};
  ThreadCrew crew(1);
  const auto refusal = [&](SweepMode mode) {
    return error_of([&] { sweep(directory, problem, mode, crew); });
  };
  EXPECT_NE(refusal(SweepMode::resume).find("not found, expected a sweep's directory"), std::string::npos);
  sweep(directory, problem, SweepMode::begin, crew);
  EXPECT_NE(refusal(SweepMode::begin).find("holds a sweep"), std::string::npos);
  problem.domain.points = 60;
  EXPECT_EQ(refusal(SweepMode::resume),
            directory.string() +
                ": holds a sweep with 40 as 'points', found 60: expected the same, or another directory");
}

TEST(Sweeps, HaveRowsOfSectionsThatAreNone) {
  const test::Scratch scratch;
  SweepProblem problem = small_sweep();
  problem.sections[1].problem = "two.dat: is a poem";
  CstAirfoil crossed = problem.sections[2].airfoil;
  std::swap(crossed.upper, crossed.lower);
  problem.sections[2].airfoil = crossed;  // the mesher finds that out
  ThreadCrew crew(1);
  const SweepResult result = sweep(scratch / "s", problem, SweepMode::begin, crew);
  EXPECT_EQ(result.flows, 20U);
  EXPECT_EQ(result.not_found, 8U);
  for (const SweepFlow& flow : read_sweep_flows(scratch / "s")) {
    const bool is_none = flow.section == 1 || flow.section == 2;
    EXPECT_EQ(flow.refused, is_none);
    EXPECT_EQ(flow.point.converged, !is_none);
    EXPECT_EQ(flow.point.reason.empty(), !is_none);
    if (flow.section == 1) {
      EXPECT_EQ(flow.point.reason, "two.dat: is a poem");
    }
  }
}

TEST(Sweeps, KeepThePressuresOfWallsAtStations) {
  const test::Scratch scratch;
  SweepProblem problem = small_sweep();
  problem.sections = {problem.sections[1]};
  problem.rows = {{.mach = 0.4, .values = {2}}};
  problem.stations = 21;  // 40 points lie at these stations: x = (1 - cos(pi j / 20)) / 2
  ThreadCrew crew(1);
  sweep(scratch / "s", problem, SweepMode::begin, crew);
  const SweepFlow flow = read_sweep_flows(scratch / "s").at(0);
  const Mesh mesh =
      generate(airfoil_domain(problem.sections[0].airfoil, problem.domain), {.gradation = 1.0}).mesh;
  const FlowResult result = solve_flow(mesh, {.mach = 0.4, .alpha_deg = 2});
  const std::vector<double> cp = pressure_coefficients(result), x = sweep_stations(21);
  const FrozenMesh frozen = mesh.freeze();
  ASSERT_EQ(flow.cp.size(), 42U);
  int compared = 0;
  for (std::size_t p = 0; p < frozen.points.size(); ++p) {
    if (frozen.curve[p] != 0 || frozen.steiner[p] != 0) continue;
    const Point at = frozen.points[p];
    const auto station = static_cast<std::size_t>(
        std::min_element(x.begin(), x.end(),
                         [&](double a, double b) { return std::fabs(a - at.x) < std::fabs(b - at.x); }) -
        x.begin());
    EXPECT_NEAR(x[station], at.x, 1e-12);
    const bool upper = frozen.parameter[p] <= 0.5;
    EXPECT_NEAR(flow.cp[upper ? station : 21 + station], cp[p], 1e-7);
    ++compared;
  }
  EXPECT_EQ(compared, 40);
  EXPECT_LT(flow.cp[5], flow.cp[21 + 5]) << "the upper surface has the lower pressure";
}

TEST(Sweeps, FindLiftsWithFriction) {
  const test::Scratch scratch;
  SweepProblem problem = small_sweep();
  problem.sections.resize(2);
  problem.model = FlowModel::laminar;
  problem.over_lift = true;
  problem.rows = {{.mach = 0.3, .reynolds = 1000, .values = {0.05, 0.1}}};
  problem.domain = {.points = 150, .farfield_radius = 10.0};
  problem.gradation = 2.0;
  ThreadCrew crew(2);
  const SweepResult result = sweep(scratch / "s", problem, SweepMode::begin, crew);
  EXPECT_EQ(result.found, 4U);
  for (const SweepFlow& flow : read_sweep_flows(scratch / "s")) {
    EXPECT_NEAR(flow.point.cl, flow.asked, 1e-8);
    EXPECT_NEAR(flow.point.cd, flow.point.cd_pressure + flow.point.cd_friction, 1e-12);
    EXPECT_GT(flow.point.cd_friction, 0.05);  // Blasius: 2 * 1.328 / sqrt(1000) = 0.084 of a plate
    ASSERT_EQ(flow.cf.size(), 18U);
    EXPECT_GT(flow.cf[3], 0.0);
  }
}

TEST(Samples, OfSobolAreHisAndBeginAlike) {
  const auto samples = unit_samples(Sampling::sobol, 8, 3, 7), more = unit_samples(Sampling::sobol, 20, 3, 7);
  for (std::size_t i = 0; i < samples.size(); ++i) EXPECT_EQ(samples[i], more[i]);
  // The sequence in two dimensions, behind its origin; each coordinate is shifted by the same amount.
  const double expected[][2] = {{.5, .5}, {.75, .25}, {.25, .75}, {.375, .375}, {.875, .875}, {.625, .125}};
  for (std::size_t d = 0; d < 2; ++d)
    for (std::size_t i = 1; i < 6; ++i) {
      const double step = samples[i][d] - samples[0][d] - (expected[i][d] - expected[0][d]);
      EXPECT_NEAR(step, std::round(step), 1e-12) << i << ", " << d;
    }
  EXPECT_NE(unit_samples(Sampling::sobol, 8, 3, 8), samples);
}

TEST(Samples, OfALatinHypercubeHaveOneInEachInterval) {
  const auto samples = unit_samples(Sampling::latin_hypercube, 50, 4, 3);
  for (std::size_t d = 0; d < 4; ++d) {
    std::set<int> intervals;
    for (const auto& sample : samples) intervals.insert(static_cast<int>(sample[d] * 50.0));
    EXPECT_EQ(intervals.size(), 50U);
    EXPECT_EQ(*intervals.rbegin(), 49);
  }
}

std::string with(const std::string& conditions, const std::string& more = "") {
  return R"({"sections": ["naca:0012"], "conditions": {)" + conditions + "}" + more + "}";
}

TEST(SweepFiles, HaveGridsAndSamplesOfConditions) {
  const SweepProblem grid = parse_sweep(
      with(R"("mach": [0.5, 0.3], "alpha_deg": "0:4:2", "reynolds": [1e6, 2e6])", R"(, "model": "sa")"),
      "f.json");
  ASSERT_EQ(grid.rows.size(), 4U);
  EXPECT_EQ(grid.rows[1], (SweepRow{.mach = 0.3, .reynolds = 2e6, .values = {0, 2, 4}}));
  const SweepProblem samples =
      parse_sweep(with(R"("samples": 30, "mach": [0.3, 0.5], "cl": [0, 1])"), "f.json");
  ASSERT_EQ(samples.rows.size(), 30U);
  EXPECT_TRUE(samples.over_lift);
  for (const SweepRow& row : samples.rows) {
    EXPECT_TRUE(row.mach >= 0.3 && row.mach <= 0.5);
    ASSERT_EQ(row.values.size(), 1U);
    EXPECT_TRUE(row.values[0] >= 0 && row.values[0] <= 1);
  }
}

TEST(SweepFiles, AreRefusedInASentence) {
  const auto refusal = [](const std::string& text) { return error_of([&] { parse_sweep(text, "f.json"); }); };
  const std::string good = R"("mach": 0.3, "alpha_deg": 0)";
  EXPECT_EQ(refusal(with(good)), "");
  const std::pair<std::string, std::string> cases[] = {
      {"{}", "f.json: the key 'conditions' is missing"},
      {R"({"conditions": {"mach": 0.3, "alpha_deg": 0}})", "f.json: the key 'sections' is missing"},
      {with(R"("mach": 0.3)"), "f.json, conditions: expected one of 'alpha_deg' and 'cl'"},
      {with(R"("alpha_deg": 0)"), "f.json, conditions: the key 'mach' is missing"},
      {with(R"("mach": 4, "alpha_deg": 0)"), "f.json, conditions: found 4.0 as 'mach', expected 0.01 to 3.0"},
      {with(R"("mach": 1.2, "cl": 0.1)"),
       "f.json: found Mach 1.2 with lifts, expected less than 1, or angles"},
      {with(R"("mach": [], "alpha_deg": 0)"),
       "f.json, conditions: found 0 values as 'mach', expected 1 to 10000"},
      {with(R"("mach": 0.3, "alpha_deg": [1, 1])"),
       "f.json, conditions: found a value twice in 'alpha_deg', expected each once"},
      {with(R"("mach": 0.3, "alpha_deg": "0:x:1")"),
       "f.json, conditions: alpha_deg: found '0:x:1', expected a number, or FIRST:LAST:STEP"},
      {with(good, R"(, "model": "sa")"), "f.json, conditions: the key 'reynolds' is missing"},
      {with(R"("mach": 0.3, "alpha_deg": 0, "reynolds": 1e6)"),
       "f.json, conditions: found 'reynolds' without a model with friction, expected \"laminar\" or \"sa\" "
       "as 'model'"},
      {with(good, R"(, "transition": [0, 0])"),
       "f.json: found 'transition' without turbulence, expected \"sa\" as 'model'"},
      {with(good, R"(, "mesh": {"points": 41})"),
       "f.json: found 41 as 'points', expected an even number, 8 or more"},
      {with(good, R"(, "surface_stations": 1)"),
       "f.json: found 1 as 'surface_stations', expected 0, or 2 or more"},
      {with(good, R"(, "order": "best")"),
       "f.json: found 'best' as 'order', expected nearest, given or random"},
      {with(R"("mach": 0.3, "alpha_deg": 0, "seed": 3)"),
       "f.json, conditions: found 'seed' without 'samples', expected both or none"},
      {R"({"sections": [7], "conditions": {"mach": 0.3, "alpha_deg": 0}})",
       "f.json, section 1: found number, expected a name, or an object"},
      {R"({"sections": [{"samples": 3, "around": "naca:0012", "range": 2}], "conditions": {"mach": 0.3, "alpha_deg": 0}})",
       "f.json, section 1: found 2.0 as 'range', expected a number above 0, at most 1"},
      {R"({"sections": [], "conditions": {"mach": 0.3, "alpha_deg": 0}})",
       "f.json: found no sections, expected one at least"},
  };
  for (const auto& [text, expected] : cases) EXPECT_EQ(refusal(text), expected) << text;
}

}  // namespace
}  // namespace remodel
