// All fuzz targets in one program without libFuzzer: a target gets the seeds themselves and then random
// mutations of them. The same arguments give the same inputs.
//   fuzz_driver TARGET SEED_DIRECTORY INPUTS [SEED]
// Prints how many inputs were refused with an Error. One that crashes or breaks an invariant is written to
// fuzz-found-TARGET in the working directory.

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <vector>

#include "fuzz.h"

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/common_interface_defs.h>
#endif

#define REMODEL_FUZZ_TARGETS \
  X(airfoil_text)            \
  X(airfoil_json)            \
  X(domain_json)             \
  X(poly)                    \
  X(import)                  \
  X(su2)                     \
  X(msh)                     \
  X(vtu)                     \
  X(vtkhdf)                  \
  X(vtkhdf_values)           \
  X(mesh_state)              \
  X(kernel)                  \
  X(remodel)

extern "C" {
#define X(name) int fuzz_##name(const std::uint8_t* data, std::size_t size);
REMODEL_FUZZ_TARGETS
#undef X
}

namespace {

using Target = int (*)(const std::uint8_t*, std::size_t);

const std::map<std::string, Target> targets = {
#define X(name) {#name, fuzz_##name},
    REMODEL_FUZZ_TARGETS
#undef X
};

// The current target and input, for the signal handlers below.
std::string name, input;

void keep_input() {
  std::ofstream("fuzz-found-" + name, std::ios::binary) << input;
}

void on_abort(int) {
  keep_input();
  std::signal(SIGABRT, SIG_DFL);
  std::raise(SIGABRT);
}

std::vector<std::string> read_seeds(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> seeds;
  for (const auto& file : files) {
    std::ifstream stream(file, std::ios::binary);
    seeds.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return seeds;
}

class Changes {
 public:
  Changes(const std::vector<std::string>& seeds, unsigned long long seed) : seeds_(seeds), random_(seed) {}

  std::string next() {
    std::string text = any_seed();
    for (std::size_t edits = 1 + below(2) * below(6); edits > 0; --edits) change(text);
    if (text.size() > longest) text.resize(longest);
    return text;
  }

 private:
  static constexpr std::size_t longest = 65536;

  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }
  const std::string& any_seed() { return seeds_[below(seeds_.size())]; }

  void change(std::string& text) {
    const std::size_t at = below(text.size()), length = 1 + below(std::size_t{1} << below(8));
    switch (below(8)) {
      case 0:
        if (!text.empty()) text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
        break;
      case 1:
        if (!text.empty()) text[at] = static_cast<char>(below(256));
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(below(text.size() + 1), text.substr(at, length));
        break;
      case 4:
        text.insert(at, any_token());
        break;
      case 5:
        replace_number(text, at);
        break;
      case 6:
        text.resize(at);
        break;
      case 7: {
        const std::string& other = any_seed();
        text.replace(at, text.npos, other.substr(std::min(other.size(), at + below(64))));
        break;
      }
    }
  }

  void replace_number(std::string& text, std::size_t from) {
    constexpr const char* digits = "0123456789.+-eE";
    const std::size_t begin = text.find_first_of("0123456789", from);
    if (begin == text.npos) return;
    const std::size_t end = std::min(text.find_first_not_of(digits, begin), text.size());
    text.replace(begin, end - begin, any_token());
  }

  std::string any_token() {
    static const std::vector<std::string> tokens = {"0",
                                                    "-1",
                                                    "1",
                                                    "2",
                                                    "3",
                                                    "1e-300",
                                                    "1e300",
                                                    "1e60",
                                                    "-1e61",
                                                    "nan",
                                                    "inf",
                                                    "0x10",
                                                    "1.5",
                                                    "0.9999999999999999",
                                                    "4294967295",
                                                    "4294967296",
                                                    "-2147483649",
                                                    "18446744073709551616",
                                                    "99999999999999999999",
                                                    " ",
                                                    "\n",
                                                    "\r\n",
                                                    "\t",
                                                    "\"",
                                                    "'",
                                                    "<",
                                                    ">",
                                                    "</",
                                                    "{",
                                                    "}",
                                                    "[",
                                                    "]",
                                                    ",",
                                                    "=",
                                                    ":",
                                                    "%",
                                                    "#",
                                                    "$End",
                                                    "null",
                                                    "\\u0000",
                                                    "\xff"};
    return tokens[below(tokens.size())];
  }

  const std::vector<std::string>& seeds_;
  std::mt19937_64 random_;
};

}  // namespace

int main(int argc, char** argv) {
  const auto target = argc > 1 ? targets.find(argv[1]) : targets.end();
  if (argc < 4 || argc > 5 || target == targets.end()) {
    std::fprintf(stderr, "usage: fuzz_driver TARGET SEED_DIRECTORY INPUTS [SEED]\n");
    return 2;
  }
  name = target->first;
  const std::vector<std::string> seeds = read_seeds(argv[2]);
  const unsigned long inputs = std::strtoul(argv[3], nullptr, 10);
  const unsigned long long seed = argc > 4 ? std::strtoull(argv[4], nullptr, 10) : 1;
  if (seeds.empty()) {
    std::fprintf(stderr, "fuzz_driver: no seeds in %s\n", argv[2]);
    return 2;
  }
  std::printf("%s: seed %llu, ", name.c_str(), seed);
  std::fflush(stdout);
  std::signal(SIGABRT, on_abort);
#if defined(__SANITIZE_ADDRESS__)
  __sanitizer_set_death_callback(keep_input);
#endif

  Changes changes(seeds, seed);
  unsigned long refused = 0;
  for (unsigned long i = 0; i < inputs; ++i) {
    input = i < seeds.size() ? seeds[i] : changes.next();
    const long before = remodel::fuzz::refusals;
    target->second(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
    if (remodel::fuzz::refusals != before) ++refused;
  }
  std::printf("%lu inputs, %lu refused, %lu accepted\n", inputs, refused, inputs - refused);
  return 0;
}
