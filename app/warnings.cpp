#include "warnings.h"

#include <algorithm>
#include <cstdio>

#include "remodel/limits.h"

namespace remodel::app {
namespace {

std::vector<std::string>& list() {
  static std::vector<std::string> all;
  return all;
}

}  // namespace

void warn(const std::string& sentence) {
  if (std::find(list().begin(), list().end(), sentence) == list().end()) list().push_back(sentence);
}

void warn(const std::vector<std::string>& sentences) {
  for (const std::string& sentence : sentences) warn(sentence);
}

// File names and foreign content may hold anything; a sentence stays one line.
void print_warnings() {
  for (std::string sentence : list()) {
    for (char& c : sentence) {
      const auto byte = static_cast<unsigned char>(c);
      if (byte < 0x20 || byte == 0x7f) c = ' ';
    }
    std::fprintf(stderr, "remodel: %s\n", sentence.c_str());
  }
}

const std::vector<std::string>& warnings() {
  return list();
}

void warn_of(const ReadNotes& notes) {
  for (const std::string& sentence : notes.warnings) warn(sentence);
}

void warn_of_limit(Stopped stopped, const Mesh& mesh) {
  if (stopped != Stopped::vertex_budget && stopped != Stopped::minimum_edge) return;
  const std::string limit = stopped == Stopped::vertex_budget
                                ? "the limit of " + std::to_string(mesh.options().max_vertices) + " vertices"
                                : "the limit on the shortest edge";
  warn(limit + " ended refinement, the mesh is valid but below its quality; triangles are smallest " +
       crowded_place(mesh));
}

}  // namespace remodel::app
