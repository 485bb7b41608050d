#include "io/msh_fields.h"

#include <algorithm>
#include <array>
#include <tuple>

#include "io/plane_vectors.h"

namespace remodel::io {

// The first text of the section.
std::string MshFields::read_name() {
  std::string name;
  const std::size_t texts = scan_.count("a number of texts");
  scan_.skip_line();
  for (std::size_t i = 0; i < texts; ++i) {
    scan_.peek();  // to the beginning of the line
    std::string_view text = scan_.rest_of_line();
    if (text.size() < 2 || text.front() != '"' || text.back() != '"')
      scan_.fail_found(text, "a name in quotes");
    if (i == 0) name = text.substr(1, text.size() - 2);
  }
  return name;
}

void MshFields::read(FieldPlace place, bool binary,
                     const std::unordered_map<std::int64_t, std::uint32_t>& indices,
                     const std::vector<bool>& used) {
  const bool in_plane = plane_.contains(++sections_);
  const std::string name = read_name();
  for (auto left = scan_.count("a number of reals"); left > 0; --left) scan_.real("a real, a time say,");
  const std::size_t integers = scan_.count("a number of integers");
  if (integers < 3) scan_.fail(std::to_string(integers) + " integers found, at least 3 expected");
  scan_.integer("a time step");
  const std::size_t components = scan_.count("a number of components");
  const std::size_t entries = scan_.count("a number of values");
  for (std::size_t i = 3; i < integers; ++i) scan_.integer("an integer, a partition say,");
  if (components < 1 || components > 9) scan_.fail("1 to 9 components expected");

  if (binary) numbers_.begin_binary();
  const bool wanted = components <= 3;
  std::vector<double> values(wanted ? components * used.size() : 0);
  std::vector<bool> given(used.size());
  std::array<double, 9> entry{};
  for (std::size_t i = 0; i < entries; ++i) {
    const auto found = indices.find(numbers_.integer("the tag of a node or element"));
    for (std::size_t k = 0; k < components; ++k) entry[k] = numbers_.real("a value");
    if (found == indices.end()) continue;
    given[found->second] = true;
    if (wanted)
      std::copy_n(entry.begin(), components,
                  values.begin() + static_cast<std::ptrdiff_t>(components * found->second));
  }
  if (!wanted || name.empty() || known_.contains({place, name}) ||
      !std::equal(given.begin(), given.end(), used.begin(),
                  [](bool is, bool has_to) { return is || !has_to; }))
    return;
  known_.emplace(place, name);
  const bool is_plane = in_plane && components == 3 && take_third_component(values);
  fields_.push_back({name, place, is_plane ? 2 : static_cast<int>(components), std::move(values)});
}

std::vector<Field> MshFields::take() {
  const auto key = [](const Field& field) { return std::tie(field.place, field.name); };
  std::sort(fields_.begin(), fields_.end(), [&](const Field& a, const Field& b) { return key(a) < key(b); });
  return std::move(fields_);
}

}  // namespace remodel::io
