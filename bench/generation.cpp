#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <string>

#include "contestants.h"
#include "measurements.h"
#include "remodel/airfoil.h"
#include "remodel/generate.h"
#include "timing.h"

namespace remodel::bench {

namespace {

// RAE 2822, or a design so close to it that only rounding errors differ.
Domain design(int points, int round) {
  CstAirfoil airfoil = named_airfoil("rae2822", 5);
  for (double& c : airfoil.upper) c *= 1.0 + 1e-5 * round;
  return airfoil_domain(airfoil, {.points = points});
}

struct Pair {
  int points;
  double gradation;
};

struct Samples {
  std::vector<double> seconds, ratios;

  // Seconds per triangle, and the yardstick measured just before.
  void add(double a_triangle, double y) {
    seconds.push_back(a_triangle);
    ratios.push_back(a_triangle / y);
  }
};

double generate_once(const Domain& domain, const QualityOptions& options, GenerateResult& result) {
  const CpuClock clock;
  GenerateResult made = generate(domain, options);
  const double seconds = clock.seconds();
  result = std::move(made);
  return seconds / static_cast<double>(result.mesh.triangle_count());
}

nlohmann::ordered_json row(Pair pair, const Samples& samples, const Samples& y) {
  GenerateResult result;
  generate_once(design(pair.points, 0), {.gradation = pair.gradation, .max_vertices = 100'000'000}, result);
  return {{"I", pair.points},
          {"G", pair.gradation},
          {"triangles", result.mesh.triangle_count()},
          {"min angle", result.mesh.statistics().min_angle_deg},
          {"ms", 1e3 * median(samples.seconds) * static_cast<double>(result.mesh.triangle_count())},
          {"ns a triangle", 1e9 * median(samples.seconds)},
          {"Y, ns", 1e9 * median(y.seconds)},
          {"in Y", median(samples.ratios)}};
}

std::size_t resident_bytes(const char* field) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == field) {
      std::size_t kilobytes = 0;
      status >> kilobytes;
      return 1024 * kilobytes;
    }
  return 0;
}

// The peak of resident memory that a mesh adds, per triangle, measured in a process of its own.
double peak_bytes(Pair pair) {
  int channel[2];
  if (pipe(channel) != 0) return 0.0;
  const pid_t child = fork();
  if (child == 0) {
    const Domain domain = design(pair.points, 0);
    const std::size_t before = resident_bytes("VmRSS:");
    std::ofstream("/proc/self/clear_refs") << 5;  // resets the peak
    const GenerateResult result =
        generate(domain, {.gradation = pair.gradation, .max_vertices = 100'000'000});
    const double bytes = static_cast<double>(resident_bytes("VmHWM:") - before) /
                         static_cast<double>(result.mesh.triangle_count());
    _exit(write(channel[1], &bytes, sizeof bytes) == sizeof bytes ? 0 : 1);
  }
  double bytes = 0.0;
  if (read(channel[0], &bytes, sizeof bytes) != sizeof bytes) bytes = 0.0;
  waitpid(child, nullptr, 0);
  close(channel[0]);
  close(channel[1]);
  return bytes;
}

}  // namespace

Rows generation(int rounds, bool others) {
  constexpr Pair pairs[] = {{50, 1}, {100, 2}, {200, 4}, {300, 6}, {400, 8}, {700, 14}};
  std::vector<Samples> samples(std::size(pairs));
  Samples y;
  for (int round = 1; round <= rounds; ++round)
    for (std::size_t i = 0; i < std::size(pairs); ++i) {
      const double now = yardstick();
      y.add(now, now);
      const Domain domain = design(pairs[i].points, round);
      GenerateResult result;
      // Small meshes are generated several times, because the first one finds the yardstick's data in the
      // caches.
      const int repeats = 1 + 2000 / pairs[i].points;
      std::vector<double> seconds;
      for (int k = 0; k < repeats; ++k)
        seconds.push_back(generate_once(domain, {.gradation = pairs[i].gradation}, result));
      samples[i].add(median(seconds), now);
    }
  Rows rows;
  for (std::size_t i = 0; i < std::size(pairs); ++i) {
    rows.push_back(row(pairs[i], samples[i], y));
    if (!others) continue;
    const auto against = [&](const char* name, const Contest& contest) {
      rows.back()[std::string(name) + ", triangles"] = contest.triangles;
      rows.back()[std::string(name) + ", ms"] = 1e3 * contest.seconds;
    };
    const Domain domain = design(pairs[i].points, 0);
    against("Mesh_2", cgal_mesh(domain, {.gradation = pairs[i].gradation}));
    against("Gmsh", gmsh_mesh(domain, {.gradation = pairs[i].gradation}));
  }
  return rows;
}

Rows large_generation(int rounds, bool ten_million) {
  std::vector<Pair> pairs{{3010, 60.2}};
  if (ten_million) pairs.push_back({9160, 183.2});
  // This comes first, because the pages of freed meshes stay with the process.
  std::vector<double> peaks;
  for (const Pair pair : pairs) peaks.push_back(peak_bytes(pair));
  Rows rows;
  for (const Pair pair : pairs) {
    Samples samples, y;
    for (int round = 1; round <= rounds; ++round) {
      const double now = yardstick();
      y.add(now, now);
      GenerateResult result;
      const QualityOptions options{.gradation = pair.gradation, .max_vertices = 100'000'000};
      samples.add(generate_once(design(pair.points, round), options, result), now);
    }
    rows.push_back(row(pair, samples, y));
    rows.back()["peak bytes a triangle"] = peaks[rows.size() - 1];
  }
  return rows;
}

}  // namespace remodel::bench
