#pragma once

// JSON with bytes in it, as CBOR (RFC 8949): every double exact. For messages between processes.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace remodel {

inline nlohmann::json binary_json(const std::string& bytes) {
  return nlohmann::json::binary({bytes.begin(), bytes.end()});
}

inline std::string bytes_in(const nlohmann::json& json) {
  const auto& bytes = json.get_binary();
  return {bytes.begin(), bytes.end()};
}

template <class Json>
std::string cbor_of(const Json& json) {
  const std::vector<std::uint8_t> bytes = Json::to_cbor(json);
  return {bytes.begin(), bytes.end()};
}

}  // namespace remodel
