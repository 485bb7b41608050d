#include "io/words.h"

#include <algorithm>
#include <map>

#include "io/scanner.h"
#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel::io {

std::string as_word(std::string name) {
  std::ranges::replace_if(
      name, [](char c) { return c == ' ' || c == '\t'; }, '_');
  return name;
}

void require_different_words(const std::vector<FrozenBoundary>& boundaries, const std::string& file) {
  std::map<std::string, std::string> known;
  for (const FrozenBoundary& boundary : boundaries) {
    const auto [entry, is_new] = known.try_emplace(as_word(boundary.name), boundary.name);
    if (!is_new && entry->second != boundary.name)
      throw Error(ErrorCode::argument, file,
                  "boundaries " + in_quotes(entry->second) + " and " + in_quotes(boundary.name) +
                      " found, which would both be " + in_quotes(entry->first) +
                      " in a file without blanks in names, different names expected");
  }
}

}  // namespace remodel::io

namespace remodel {

std::string name_in(MeshFormat format, const std::string& boundary) {
  return format == MeshFormat::su2 || format == MeshFormat::foam ? io::as_word(boundary) : boundary;
}

}  // namespace remodel
