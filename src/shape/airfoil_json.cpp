#include "airfoil_json.h"

#include <cmath>
#include <sstream>

#include "remodel/error.h"

namespace remodel {
namespace {

constexpr std::size_t largest_degree = 100;
constexpr double largest_exponent = 10.0;

double exponent_of(const JsonReader& reader, const char* key, double otherwise) {
  const double value = reader.number_or(key, otherwise);
  if (!(value > 0.0 && value <= largest_exponent)) {
    reader[key].refuse("found " + std::to_string(value) + ", expected a class exponent over 0, up to 10");
  }
  return value;
}

}  // namespace

nlohmann::ordered_json json_of(const CstAirfoil& airfoil) {
  constexpr const char* what = "airfoil to JSON";
  return {{"degree", airfoil.degree()},
          {"upper", finite_for_json(airfoil.upper, what)},
          {"lower", finite_for_json(airfoil.lower, what)},
          {"e1", finite_for_json(airfoil.e1, what)},
          {"e2", finite_for_json(airfoil.e2, what)},
          {"te_upper", finite_for_json(airfoil.te_upper, what)},
          {"te_lower", finite_for_json(airfoil.te_lower, what)}};
}

// Far beyond any airfoil, and far from where squares of lengths overflow.
constexpr double largest_coefficient = 1000.0;  // chords

void require_moderate(const JsonReader& reader, const char* key, const std::vector<double>& values) {
  for (const double value : values) {
    if (std::abs(value) <= largest_coefficient) continue;
    std::ostringstream found;
    found << "found " << value << ", expected coefficients from -1000 to 1000 chords";
    reader[key].refuse(found.str());
  }
}

CstAirfoil airfoil_of(const JsonReader& reader) {
  const CstAirfoil paper_class;
  CstAirfoil airfoil{.upper = reader["upper"].numbers(),
                     .lower = reader["lower"].numbers(),
                     .e1 = exponent_of(reader, "e1", paper_class.e1),
                     .e2 = exponent_of(reader, "e2", paper_class.e2),
                     .te_upper = reader.number_or("te_upper", 0.0),
                     .te_lower = reader.number_or("te_lower", 0.0)};
  require_moderate(reader, "upper", airfoil.upper);
  require_moderate(reader, "lower", airfoil.lower);
  if (airfoil.te_upper != 0.0) require_moderate(reader, "te_upper", {airfoil.te_upper});
  if (airfoil.te_lower != 0.0) require_moderate(reader, "te_lower", {airfoil.te_lower});
  const double degree = reader["degree"].number();
  if (!(degree >= 1.0 && degree <= static_cast<double>(largest_degree)) || degree != std::floor(degree)) {
    reader["degree"].refuse("expected a whole number from 1 to " + std::to_string(largest_degree));
  }
  for (const char* key : {"upper", "lower"}) {
    const std::size_t expected = static_cast<std::size_t>(degree) + 1;
    const std::size_t found = (key[0] == 'u' ? airfoil.upper : airfoil.lower).size();
    if (found == expected) continue;
    reader[key].refuse("found " + std::to_string(found) +
                       " coefficients, expected degree + 1 = " + std::to_string(expected));
  }
  return airfoil;
}

std::string airfoil_to_json(const CstAirfoil& airfoil) {
  return json_of(airfoil).dump(2) + "\n";
}

CstAirfoil airfoil_from_json(std::string_view text, const std::string& source) {
  const nlohmann::json parsed = parse_json(text, source);
  const JsonReader reader(parsed, source);
  // What `remodel fit` reports beside the coefficients may stay in the file.
  reader.expect_keys({"degree", "upper", "lower"}, {"e1", "e2", "te_upper", "te_lower", "name", "max_error",
                                                    "rms_error", "thickness", "camber"});
  return airfoil_of(reader);
}

}  // namespace remodel
