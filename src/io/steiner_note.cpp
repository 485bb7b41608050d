#include "io/steiner_note.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <utility>

#include "io/text_writer.h"

namespace remodel::io {

namespace {

// The number of the mesh's points follows, then the points.
constexpr std::string_view steiner_mark = "remodel: Steiner points of ";
constexpr std::size_t points_per_line = 12;
constexpr std::string_view generation_mark = "last generation of vertex_key:";

// The next number of a line, behind blanks and the colon; false at its end.
bool next_number(std::string_view& line, std::uint64_t& number) {
  line.remove_prefix(std::min(line.find_first_not_of(" :"), line.size()));
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
  if (error != std::errc{}) return false;
  line.remove_prefix(static_cast<std::size_t>(end - line.data()));
  return true;
}

}  // namespace

std::string steiner_note(const FrozenMesh& mesh, std::string_view prefix) {
  TextWriter out;
  std::size_t written = 0;
  for (std::size_t i = 0; i < mesh.steiner.size(); ++i) {
    if (mesh.steiner[i] == 0) continue;
    if (written % points_per_line == 0) {
      if (written > 0) out << '\n';
      out << prefix << steiner_mark << mesh.points.size() << ':';
    }
    out << ' ' << i;
    ++written;
  }
  if (written > 0) out << '\n';
  return out.take();
}

void take_steiner_notes(std::string_view text, FrozenMesh& mesh) {
  for (std::size_t at = text.find(steiner_mark); at != text.npos; at = text.find(steiner_mark, at)) {
    at += steiner_mark.size();
    std::string_view line = text.substr(at, std::min(text.find('\n', at), text.size()) - at);
    std::uint64_t number = 0;
    if (!next_number(line, number) || number != mesh.points.size()) continue;
    mesh.steiner.resize(mesh.points.size(), 0);
    while (next_number(line, number) && number < mesh.steiner.size()) mesh.steiner[number] = 1;
  }
}

std::string generation_note(const FrozenMesh& mesh) {
  if (mesh.vertex_keys.empty()) return {};
  return std::string(generation_mark) + " " + std::to_string(mesh.last_generation) + "\n";
}

void take_generation_note(std::string_view text, FrozenMesh& mesh) {
  const std::size_t at = text.find(generation_mark);
  if (at == text.npos) return;
  text.remove_prefix(at + generation_mark.size());
  if (std::uint64_t number = 0; next_number(text, number) && std::in_range<std::uint32_t>(number))
    mesh.last_generation = static_cast<std::uint32_t>(number);
}

}  // namespace remodel::io
