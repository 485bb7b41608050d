#include "io/plane_vectors.h"

#include <algorithm>
#include <charconv>

namespace remodel::io {

namespace {

constexpr std::string_view plane_note_mark = "remodel: data of two components, the third one added:";

}  // namespace

std::vector<double> with_third_component(std::span<const double> of_two) {
  std::vector<double> result;
  result.reserve(of_two.size() / 2 * 3);
  for (std::size_t i = 0; i + 1 < of_two.size(); i += 2)
    result.insert(result.end(), {of_two[i], of_two[i + 1], 0.0});
  return result;
}

bool take_third_component(std::vector<double>& of_three) {
  for (std::size_t i = 2; i < of_three.size(); i += 3)
    if (of_three[i] != 0.0) return false;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < of_three.size(); ++i)
    if (i % 3 != 2) of_three[kept++] = of_three[i];
  of_three.resize(kept);
  return true;
}

std::string plane_note(std::span<const std::size_t> sections) {
  if (sections.empty()) return {};
  std::string note(plane_note_mark);
  for (const std::size_t section : sections) note += " " + std::to_string(section);
  return note + "\n";
}

std::set<std::size_t> sections_in_plane(std::string_view text) {
  std::set<std::size_t> sections;
  const std::size_t at = text.find(plane_note_mark);
  if (at == text.npos) return sections;
  text.remove_prefix(at + plane_note_mark.size());
  for (std::size_t section = 0; text.starts_with(' ');) {
    text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), section);
    if (error != std::errc{}) break;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    sections.insert(section);
  }
  return sections;
}

}  // namespace remodel::io
