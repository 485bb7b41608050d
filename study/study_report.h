#pragma once

// Reports on a study: means over its scenarios beside the paper's tables A1 to A27, as a page, tables and
// figures. The store (study.sqlite) is only read.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "remodel/airfoil.h"

namespace remodel {

// Mean and standard deviation (n - 1 in the denominator) over the scenarios that have the figure. The mean is
// NaN if there is none, the deviation if there are fewer than two.
struct StudyMean {
  double mean = std::numeric_limits<double>::quiet_NaN();
  double deviation = std::numeric_limits<double>::quiet_NaN();
  std::size_t count = 0;
};
// Ignores NaN.
StudyMean study_mean(const std::vector<double>& values);

// One row of a table: I, G and D for an airfoil and an initial standard deviation of the search.
struct StudyCase {
  std::string airfoil;  // as the study names it
  double sigma = 0.0;
  int points = 0;          // I
  double gradation = 0.0;  // G
  double distance = 0.0;   // D
  friend auto operator<=>(const StudyCase&, const StudyCase&) = default;
};

// The figures of a case: counts in triangles, times in milliseconds, the others in per cent or as ratios, as
// in OptimiseResult (remodel/optimise.h).
enum class StudyFigure {
  generated_triangles,
  generate_ms,
  triangles,
  remodel_ms,
  preserved_percent,
  surplus_percent,
  speedup,
  lost,                           // triangles lost per step
  full_adjustments_percent,       // of the evaluations
  gradation_deviation,            // of the remodelled meshes
  generated_gradation_deviation,  // of the fresh ones
};
inline constexpr std::size_t study_figure_count = 11;
// The paper's tables have the first seven, in this order.
inline constexpr std::size_t paper_figure_count = 7;
// The keys of CSV and JSON: "generation_triangles", "generation_ms", "remodelling_triangles", ...
std::string_view key_of(StudyFigure figure);

// One case with one strategy: means over its scenarios.
struct StudyRow {
  StudyCase at;
  std::string strategy;
  std::size_t scenarios = 0;
  std::array<StudyMean, study_figure_count> figures{};
  double min_angle_deg = std::numeric_limits<double>::quiet_NaN();  // smallest of all meshes
  std::uint64_t evaluations = 0;                                    // of all scenarios
  std::uint64_t invalid_meshes = 0;
  std::uint64_t recoveries = 0;
  std::uint64_t refreshes = 0;
  std::uint64_t stopped_early = 0;  // replays that ended before their last evaluation

  const StudyMean& operator[](StudyFigure figure) const { return figures[static_cast<std::size_t>(figure)]; }
};

// A range of evaluations of a run: means over the scenarios of a row.
struct StudyBlock {
  std::size_t row = 0;                // index into StudyContents::rows
  std::uint64_t first = 0, last = 0;  // evaluations, both included
  StudyMean triangles, preserved_percent, surplus_percent;
};

struct StudyOutline {
  std::string name;                  // as the study names it
  std::string title;                 // the paper's name, or the same
  std::optional<CstAirfoil> design;  // nothing where the store's text is no design
};

struct StudyGap {  // results that an unfinished study lacks
  std::string airfoil;
  double sigma = 0.0;
  std::size_t replays = 0, expected = 0;
};

struct StudyPictured {  // the scenario that the mesh figures show
  std::string airfoil;
  double sigma = 0.0;
  std::uint64_t seed = 0;
  std::vector<CstAirfoil> designs;  // the start, and the first thousand or so of its path
};

struct StudyContents {
  std::filesystem::path directory;
  std::string version, created;
  std::string options;  // JSON text, as the study was given them
  std::string machine;  // JSON text
  std::size_t scenarios = 0, expected_scenarios = 0;
  std::size_t replays = 0, expected_replays = 0;
  std::uint64_t evaluations = 0;  // requested per scenario
  double seconds = 0.0;           // of all scenarios, fresh meshes and replays: processor time of one core
  StudyPictured pictured;  // RAE 2822 with the largest sigma, if it is there; no designs without a path
  std::vector<StudyOutline> airfoils;  // of the store, the paper's order first
  std::vector<StudyRow> rows;          // by airfoil, sigma, I, G, D, strategy
  std::vector<StudyBlock> blocks;      // by row, then evaluation
  std::vector<StudyGap> gaps;          // airfoil and sigma with replays missing

  bool finished() const { return replays >= expected_replays && scenarios >= expected_scenarios; }
};

// Reads DIRECTORY/study.sqlite of a finished, unfinished or running study. Throws Error (file, format) if
// there is no such store, or it is of another version, damaged, or without a replay.
StudyContents read_study(const std::filesystem::path& directory);

// The paper's tables A1 to A27, "Two-Dimensional Quality-Mesh Remodelling for Engineering Design
// Optimisation", appendix A.3: means over thirty scenarios of about nine thousand evaluations. Its generation
// times are derived: speed-up times remodelling time.
struct PaperRow {
  std::string table;  // "A1" to "A27"
  StudyCase at;       // the airfoil as the catalogue names it
  std::array<double, paper_figure_count> figures{};
};
const std::vector<PaperRow>& paper_rows();
// Returns the paper's row of a case, whose airfoil has a catalogue name or is a file of that name; nothing if
// the paper has no such row.
const PaperRow* paper_row(const StudyCase& at);

// The comparison of a row with the paper's.
struct VerdictRow {
  StudyCase at;
  std::size_t scenarios = 0;
  double generation_percent = 0.0;  // of generation's triangles, ours over the paper's minus one
  double preserved_points = 0.0;    // ours minus the paper's, percentage points
  double surplus_points = 0.0;
  double triangles_percent = 0.0;  // of remodelling's triangles
  double speedup_ratio = 0.0;      // ours over the paper's
  double preserved_error = 0.0;    // standard error of ours, points; NaN for one scenario

  bool judged() const { return at.points >= 200; }  // counted in the shares
  bool generation_inside() const;                   // within verdict_generation_percent
  bool preserved_inside() const;                    // within verdict_preserved_points
  bool inside() const { return generation_inside() && preserved_inside(); }
};
inline constexpr double verdict_generation_percent = 5.0;
inline constexpr double verdict_preserved_points = 1.0;

struct VerdictTable {
  std::string table;
  std::string airfoil;
  double sigma = 0.0;
  std::vector<VerdictRow> rows;
};
// Returns one line per table of the paper that the study has rows of, for one strategy. Rows without figures
// (no comparison) are omitted.
std::vector<VerdictTable> judge_study(const StudyContents& study, const std::string& strategy = "chain");
struct VerdictShare {
  std::size_t rows = 0, inside = 0, generation_inside = 0, preserved_inside = 0;  // of the judged rows
};
VerdictShare verdict_share(const std::vector<VerdictTable>& tables);

// The outputs as text. CSV has one row per case and strategy with means, deviations and the paper's figures,
// in 17 significant digits. Markdown has the options and the verdict; study_markdown() appends a table per
// airfoil and sigma.
std::string study_csv(const StudyContents& study);
std::string study_blocks_csv(const StudyContents& study);
std::string verdict_csv(const std::vector<VerdictTable>& tables);
std::string verdict_markdown(const StudyContents& study);
std::string study_markdown(const StudyContents& study);

// The figures as SVG, by file name without extension: preservation, surplus and speed-up of each airfoil
// beside the paper's (its figures 2 to 4 and A11 to A37), surplus against lost triangles, removal regions
// (figure 1), gradation of a remodelled mesh and of a fresh one (figure 5), airfoils (A1 to A10).
struct StudySvg {
  std::string name;
  std::string title;  // a caption
  std::string text;
};
std::vector<StudySvg> study_charts(const StudyContents& study);
struct MeshFigureOptions {
  int points = 400;                // I of figure 5, with G = I / 50
  std::size_t evaluations = 1000;  // remodellings that precede the drawn mesh
};
// Makes the meshes anew: the search of study.pictured, remodelled by chain and by renew. Empty if the store
// has no design of its airfoil.
std::vector<StudySvg> study_mesh_figures(const StudyContents& study, const MeshFigureOptions& options = {});
std::vector<StudySvg> study_airfoil_figures(const StudyContents& study);

// The page: one self-contained HTML file, which needs no network. Throws Error (file) if the program was
// built without the page's scripts (scripts/install-dependencies fetches them).
std::string study_page(const StudyContents& study, const std::vector<StudySvg>& mesh_figures);

}  // namespace remodel
