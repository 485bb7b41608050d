#include "io/mesh_bytes.h"

#include <cstring>
#include <type_traits>

#include "io/state_parts.h"
#include "remodel/domain.h"
#include "remodel/error.h"

namespace remodel::io {
namespace {

class ByteWriter {
 public:
  template <class Value>
  void number(const Value& value) {
    static_assert(std::is_arithmetic_v<Value>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class Values>
  void array(const Values& values) {
    number(std::uint64_t{values.size()});
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof values[0]);
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class ByteReader {
 public:
  ByteReader(const std::string& bytes, const std::string& source) : bytes_(bytes), source_(source) {}

  template <class Value>
  void number(Value& value) {
    copy(&value, sizeof value);
  }
  template <class Values>
  void array(Values& values) {
    std::uint64_t count = 0;
    number(count);
    if (count > left() / sizeof values[0]) fail();
    values.resize(count);
    copy(values.data(), count * sizeof values[0]);
  }
  std::size_t left() const { return bytes_.size() - at_; }
  [[noreturn]] void fail() const {
    throw Error(ErrorCode::format, source_, "found other bytes than those of a mesh's state");
  }

 private:
  void copy(void* to, std::size_t size) {
    if (size > left()) fail();
    if (size != 0) std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }

  const std::string& bytes_;
  const std::string& source_;
  std::size_t at_ = 0;
};

}  // namespace

std::string mesh_to_bytes(const Mesh& mesh) {
  const MeshState state = mesh.state();
  ByteWriter out;
  for_each_state_number(state, [&](const char*, const auto& value) { out.number(value); });
  for_each_state_array(state, [&](const char*, const auto& values, std::size_t) { out.array(values); });
  for_each_reference_array(state, [&](const char*, const auto& values, std::size_t) { out.array(values); });
  out.number(state.delaunay_slack_deg);
  out.array(domain_to_json(state.domain));
  out.array(state.reference_coordinates.empty() ? std::string() : domain_to_json(state.reference_domain));
  out.number(std::uint64_t{state.imported.markers.size()});
  for (const std::string& marker : state.imported.markers) out.array(marker);
  return out.take();
}

Mesh mesh_from_bytes(const std::string& bytes, const std::string& source) {
  ByteReader in(bytes, source);
  MeshState state;
  for_each_state_number(state, [&](const char*, auto& value) { in.number(value); });
  for_each_state_array(state, [&](const char*, auto& values, std::size_t) { in.array(values); });
  for_each_reference_array(state, [&](const char*, auto& values, std::size_t) { in.array(values); });
  in.number(state.delaunay_slack_deg);
  std::string domain, reference;
  in.array(domain);
  in.array(reference);
  state.domain = domain_from_json(domain, source);
  if (!reference.empty()) state.reference_domain = domain_from_json(reference, source);
  std::uint64_t markers = 0;
  in.number(markers);
  if (markers > in.left()) in.fail();
  state.imported.markers.resize(markers);
  for (std::string& marker : state.imported.markers) in.array(marker);
  if (in.left() != 0) in.fail();
  return Mesh::restore(state, source);
}

}  // namespace remodel::io
