#include "flow_files.h"

#include <cstdio>
#include <map>

#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel::app {

void require_different_files(const MeshOutputs& outputs,
                             const std::vector<std::pair<std::string, std::string>>& others) {
  std::map<std::filesystem::path, std::string> options;  // by the files
  const auto note = [&](const std::string& file, const std::string& option) {
    const auto place = std::filesystem::weakly_canonical(std::filesystem::absolute(file));
    const auto [at, is_new] = options.emplace(place, option);
    if (!is_new)
      throw Error(ErrorCode::argument, option,
                  "found '" + file + "', which is the file of " + at->second + " too, expected another one");
  };
  for (const std::string& file : outputs.files()) note(file, "-o");
  for (const auto& [option, file] : others)
    if (!file.empty()) note(file, option);
}

void say_flow_left_out(const MeshOutputs& outputs) {
  for (const std::string& file : outputs.files()) {
    const MeshFormat format = mesh_format(file);
    if (format == MeshFormat::su2 || format == MeshFormat::foam)
      std::fprintf(stderr, "remodel: %s: the flow left out, for which the format has no place\n",
                   file.c_str());
  }
}

void print_warnings(const std::string& source, const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings)
    std::fprintf(stderr, "remodel: %s: %s\n", source.c_str(), warning.c_str());
}

}  // namespace remodel::app
