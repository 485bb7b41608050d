#pragma once

// Sweeps: the flows around many sections at many conditions, as a table: polars of a catalogue, response
// surfaces, data to learn from.
//
//   ThreadCrew crew(2);
//   sweep("run", read_sweep("sweep.json"), SweepMode::begin, crew);
//   // run/table.csv, run/table.h5
//
// Sections are put in an order in which neighbours are alike, and cut into chains. A chain is one living mesh
// that goes from section to section, with flows that go on from those of the section before. Each chain is a
// job and depends on nothing but the sweep, so that the table is the same to the bit for any number of
// threads and ranks, and after any interrupt.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "remodel/airfoil.h"
#include "remodel/crew.h"
#include "remodel/domain.h"
#include "remodel/flow.h"
#include "remodel/layers.h"
#include "remodel/polar.h"

namespace remodel {

struct SweepSection {
  std::string name;
  CstAirfoil airfoil = {};
  // Why there is no such section: a file that is none, a sample whose surfaces cross. Its flows are rows that
  // say so.
  std::string problem = {};
  friend bool operator==(const SweepSection&, const SweepSection&) = default;
};

// Flows at one Mach number and, with friction, one Reynolds number of the chord.
struct SweepRow {
  double mach = 0.5;           // 0.01 to 3
  double reynolds = 0.0;       // 1 to 1e10; without friction 0
  std::vector<double> values;  // ascending: angles of attack in degrees, or lift coefficients
  friend bool operator==(const SweepRow&, const SweepRow&) = default;
};

// Chains meet the sections in one of these orders.
enum class SweepOrder {
  nearest,  // order_designs() of remodel/batch.h
  given,
  random,  // by the seed, for comparison
};
const char* name_of(SweepOrder order);

struct SweepProblem {
  std::vector<SweepSection> sections;
  std::vector<SweepRow> rows;  // each section has all of them
  bool over_lift = false;      // SweepRow::values are lift coefficients
  FlowModel model = FlowModel::euler;
  std::optional<std::array<double, 2>> transition = {};  // FlowConditions::transition
  // All meshes have these. With friction `points` is about how many stations a section has, 150 or more. A
  // gradation that is not given is points / 50.
  AirfoilDomainOptions domain = {};
  std::optional<double> gradation = {};
  // With friction; none: of what layer_for_flow() has for the Reynolds numbers, the least first height and
  // the largest thickness.
  std::optional<LayerOptions> layer = {};
  double tolerance = 1e-8;  // FlowOptions: coefficients are off by less than that of tables
  int max_steps = 200;
  std::size_t chain = 20;  // sections of a chain, at most
  SweepOrder order = SweepOrder::nearest;
  std::uint64_t seed = 1;    // of a random order
  std::size_t stations = 0;  // of pressures on each surface, from nose to trailing edge; 0: none are kept
  bool fields = false;       // each flow's mesh and fields as a .vtu file, fields/ in the directory
  // Each flow's density, velocity, pressure and, with turbulence, viscosity ratio at these points, in chords.
  std::vector<Point> field_points = {};
  std::vector<std::string> warnings = {};  // of a reader: sections that were turned, sheared or closed
};

// Reads a sweep's file (docs/sweep.md). Names of files lead on from its directory. Throws Error (file,
// format, argument) naming the file and the place.
SweepProblem read_sweep(const std::string& file);
SweepProblem parse_sweep(const std::string& text, const std::string& file);

// Throws Error (argument) naming `source` for what is missing or out of range.
void validate(const SweepProblem& problem, const std::string& source);

// The stations of pressures: x in chords, (1 - cos(pi j / (count - 1))) / 2.
std::vector<double> sweep_stations(std::size_t count);

// A flow of a sweep.
struct SweepFlow {
  std::size_t section = 0;  // its index in SweepProblem::sections
  double mach = 0.0, reynolds = 0.0;
  double asked = 0.0;     // the angle or the lift
  bool refused = false;   // there is no section, or no mesh: point.reason says why
  PolarPoint point = {};  // its seconds are of all searches; without a flow it has no lift, `asked` has that
  // At the stations of the upper surface from nose to trailing edge, then of the lower one: the pressure
  // coefficient and, with friction, the friction coefficient. Empty where there is no flow.
  std::vector<double> cp = {}, cf = {};
  // At SweepProblem::field_points: density, velocity in x and in y, pressure and, with turbulence, turbulent
  // over molecular viscosity, one after the other, in the units of FlowResult. Not a number where a point is
  // in the body or beyond the far field; empty where there is no flow.
  std::vector<double> fields = {};
};
// "converged" or why there is no flow: another name_of(FlowStatus), "refused", "not-looked-for".
const char* status_of(const SweepFlow& flow);

struct SweepProgress {
  std::size_t chains = 0, chains_done = 0;
  std::size_t flows = 0, flows_done = 0, found = 0;
  std::size_t flows_before = 0;  // done before this session
};

// Called from one thread at a time, not always the same; cancelled() from any thread, also concurrently.
class SweepObserver {
 public:
  virtual ~SweepObserver() = default;
  virtual void finished(const SweepProgress& progress) { static_cast<void>(progress); }
  // True ends the sweep in order: finished chains are kept, others are begun anew by the next session.
  virtual bool cancelled() { return false; }
};

enum class SweepStopped { done, interrupted };
const char* name_of(SweepStopped stopped);  // "done", "interrupted"

struct SweepResult {
  std::size_t flows = 0, found = 0, not_found = 0;  // of finished chains
  std::size_t planned = 0;                          // flows of all chains
  std::size_t sections = 0, chains = 0;
  double seconds = 0.0;       // wall time of this session
  double flow_seconds = 0.0;  // of all searches, of all sessions
  double mesh_seconds = 0.0;  // of all meshes, likewise
  // Estimated for as many flows, each by itself: their number times the mean time of those that were
  // found cold.
  double cold_seconds_estimate = 0.0;
  SweepStopped stopped = SweepStopped::done;
};

enum class SweepMode { begin, resume };

// Runs a sweep in a directory, which holds sweep.json (the sweep and its chains) and a file for each chain
// that is finished; at the end, or when it is interrupted, table.csv and table.h5 of all finished flows
// (docs/sweep.md has their columns). One process at a time holds the directory.
//
// begin: the directory is missing or empty. resume: it holds a sweep that is the same but for its sections
// and rows, of which this one may have more. What is missing then is planned as chains of its own.
//
// Throws Error (argument, file, format).
SweepResult sweep(const std::filesystem::path& directory, const SweepProblem& problem, SweepMode mode,
                  Crew& crew, SweepObserver* observer = nullptr);

// Does one chain, from bytes to bytes: the CrewWork of sweep().
std::optional<std::string> run_sweep_chain(const std::string& work, const std::function<bool()>& cancelled);

// The file of a flow's mesh and fields, from the sweep's directory: "fields/000012_M0.3_Re6000000_2.vtu" of
// section 12.
std::string sweep_fields_file(const SweepFlow& flow);

// A sweep's directory: the sweep, and the flows of its finished chains by section, Mach number, Reynolds
// number and value. Throws Error (file, format).
SweepProblem read_sweep_problem(const std::filesystem::path& directory);
std::vector<SweepFlow> read_sweep_flows(const std::filesystem::path& directory);

// Writes a sweep's page (.html), finished or not, with everything in it: polars, means over sections,
// extremes, what was not found and why, what it cost. Returns its figures, a JSON object. Throws Error (file,
// format).
std::string write_sweep_page(const std::filesystem::path& directory, const std::filesystem::path& page);

}  // namespace remodel
