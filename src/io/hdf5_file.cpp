#include "io/hdf5_file.h"

#include <array>
#include <limits>
#include <utility>

#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel::io {

namespace {

struct Types {
  hid_t stored;  // little-endian in the file, on every machine
  hid_t native;
  H5T_class_t kind;
};

template <class Value>
Types types_of();
template <>
Types types_of<double>() {
  return {H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, H5T_FLOAT};
}
template <>
Types types_of<std::int64_t>() {
  return {H5T_STD_I64LE, H5T_NATIVE_INT64, H5T_INTEGER};
}
template <>
Types types_of<std::int32_t>() {
  return {H5T_STD_I32LE, H5T_NATIVE_INT32, H5T_INTEGER};
}
template <>
Types types_of<std::uint64_t>() {
  return {H5T_STD_U64LE, H5T_NATIVE_UINT64, H5T_INTEGER};
}
template <>
Types types_of<std::uint32_t>() {
  return {H5T_STD_U32LE, H5T_NATIVE_UINT32, H5T_INTEGER};
}
template <>
Types types_of<std::uint8_t>() {
  return {H5T_STD_U8LE, H5T_NATIVE_UINT8, H5T_INTEGER};
}

// A string type of that many bytes, padded with zeros; H5T_VARIABLE: of any length.
Hdf5Handle string_type(std::size_t size) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), size);
  if (size != H5T_VARIABLE) H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  return type;
}

Hdf5Handle without_times(hid_t kind) {
  Hdf5Handle properties(H5Pcreate(kind), H5Pclose);
  H5Pset_obj_track_times(properties.get(), 0);
  return properties;
}

constexpr std::string_view seal_mark = "rmdlseal";
constexpr std::size_t seal_size = 16;

// FNV-1a, lowest byte first whatever the machine.
std::string checksum_bytes(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  std::string result;
  for (int shift = 0; shift < 64; shift += 8) result += static_cast<char>(hash >> shift & 0xff);
  return result;
}

// A file without a seal was made or changed by another program: nothing is said about it.
bool has_broken_seal(std::string_view bytes) {
  if (bytes.size() < seal_size) return false;
  const std::string_view seal = bytes.substr(bytes.size() - seal_size);
  const std::string_view content = bytes.substr(0, bytes.size() - seal_size);
  return seal.starts_with(seal_mark) && seal.substr(seal_mark.size()) != checksum_bytes(content);
}

// Ends at the first of the zeros that fill a fixed length.
std::string cut_at_zero(std::string_view text) {
  return std::string(text.substr(0, text.find('\0')));
}

}  // namespace

std::string sealed(std::string bytes) {
  const std::string checksum = checksum_bytes(bytes);
  return std::move(bytes.append(seal_mark).append(checksum));
}

Hdf5Handle::~Hdf5Handle() {
  if (id_ >= 0) close_(id_);
}
Hdf5Handle::Hdf5Handle(Hdf5Handle&& other) noexcept
    : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
Hdf5Handle& Hdf5Handle::operator=(Hdf5Handle&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(close_, other.close_);
  return *this;
}

Hdf5Silence::Hdf5Silence() {
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}
Hdf5Silence::~Hdf5Silence() {
  H5Eset_auto2(H5E_DEFAULT, function_, data_);
}

// ------------------------------------------------------------------------------------------------ writing

Hdf5Writer::Hdf5Writer(std::string name) : name_(std::move(name)) {
  constexpr std::size_t growth = std::size_t{4} << 20;
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access.get(), growth, 0);  // 0: stays in memory
  const Hdf5Handle creation = without_times(H5P_FILE_CREATE);
  file_ = Hdf5Handle(H5Fcreate(name_.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose);
  if (!file_) fail("/");
}

void Hdf5Writer::fail(const std::string& path) const {
  throw Error(ErrorCode::file, name_ + ":" + path,
              "cannot be written: HDF5 refuses it or memory is exhausted");
}

void Hdf5Writer::group(const std::string& path) {
  const Hdf5Handle creation = without_times(H5P_GROUP_CREATE);
  const Hdf5Handle group(H5Gcreate2(file_.get(), path.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT),
                         H5Gclose);
  if (!group) fail(path);
}

void Hdf5Writer::write(const std::string& path, hid_t stored, hid_t given, std::span<const hsize_t> size,
                       const void* data) {
  const Hdf5Handle space(size.empty() ? H5Screate(H5S_SCALAR)
                                      : H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr),
                         H5Sclose);
  const Hdf5Handle creation = without_times(H5P_DATASET_CREATE);
  const Hdf5Handle set(
      H5Dcreate2(file_.get(), path.c_str(), stored, space.get(), H5P_DEFAULT, creation.get(), H5P_DEFAULT),
      H5Dclose);
  if (!set || H5Dwrite(set.get(), given, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) fail(path);
}

template <class Value>
void Hdf5Writer::array(const std::string& path, const std::vector<Value>& values, std::size_t columns) {
  const std::array<hsize_t, 2> size = {values.size() / columns, columns};
  const Types types = types_of<Value>();
  write(path, types.stored, types.native, std::span(size).first(columns > 1 ? 2 : 1), values.data());
}

void Hdf5Writer::text(const std::string& path, const std::string& value) {
  const std::string filled = value.empty() ? std::string(1, '\0') : value;
  const Hdf5Handle type = string_type(filled.size());
  write(path, type.get(), type.get(), {}, filled.data());
}

void Hdf5Writer::texts(const std::string& path, const std::vector<std::string>& values) {
  std::vector<const char*> pointers;
  for (const auto& value : values) pointers.push_back(value.c_str());
  const Hdf5Handle type = string_type(H5T_VARIABLE);
  const std::array<hsize_t, 1> size = {values.size()};
  write(path, type.get(), type.get(), size, pointers.data());
}

template <class Value>
void Hdf5Writer::attribute(const std::string& group, const std::string& name,
                           const std::vector<Value>& values) {
  const hsize_t size = values.size();
  const Hdf5Handle space(size == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &size, nullptr), H5Sclose);
  const Types types = types_of<Value>();
  const Hdf5Handle attribute(H5Acreate_by_name(file_.get(), group.c_str(), name.c_str(), types.stored,
                                               space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose);
  if (!attribute || H5Awrite(attribute.get(), types.native, values.data()) < 0) fail(group + "@" + name);
}

void Hdf5Writer::attribute(const std::string& group, const std::string& name, const std::string& value) {
  const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Hdf5Handle type = string_type(value.size());
  const Hdf5Handle attribute(H5Acreate_by_name(file_.get(), group.c_str(), name.c_str(), type.get(),
                                               space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose);
  if (!attribute || H5Awrite(attribute.get(), type.get(), value.data()) < 0) fail(group + "@" + name);
}

std::string Hdf5Writer::bytes() {
  if (H5Fflush(file_.get(), H5F_SCOPE_GLOBAL) < 0) fail("/");
  const ssize_t size = H5Fget_file_image(file_.get(), nullptr, 0);
  if (size < 0) fail("/");
  std::string image(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(file_.get(), image.data(), image.size()) < 0) fail("/");
  return image;
}

// ------------------------------------------------------------------------------------------------ reading

Hdf5Reader::Hdf5Reader(const std::filesystem::path& file) : name_(file.string()) {
  // HDF5 knows one reason for a file that it cannot open; this tells missing from damaged.
  const std::string bytes = read_text(file, std::numeric_limits<std::size_t>::max());
  file_size_ = bytes.size();
  if (has_broken_seal(bytes)) {
    throw Error(ErrorCode::format, name_,
                "another checksum than that of the content found: the file is damaged");
  }
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);  // damage may leave objects open that have no handle
  file_ = Hdf5Handle(H5Fopen(file.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose);
  if (!file_) throw Error(ErrorCode::format, name_, "no HDF5 file or a damaged one found, VTKHDF expected");
}

void Hdf5Reader::fail(const std::string& path, const std::string& problem) const {
  throw Error(ErrorCode::format, place(path), problem);
}

bool Hdf5Reader::exists(const std::string& path) const {
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    if (H5Lexists(file_.get(), path.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) return true;
  }
}

bool Hdf5Reader::has_attribute(const std::string& group, const std::string& name) const {
  return H5Aexists_by_name(file_.get(), group.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

Hdf5Handle Hdf5Reader::open_dataset(const std::string& path) const {
  if (!exists(path)) fail(path, "not found, a dataset expected");
  Hdf5Handle set(H5Dopen2(file_.get(), path.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set) fail(path, "something else or damage found, a dataset expected");
  return set;
}

Hdf5Handle Hdf5Reader::open_attribute(const std::string& group, const std::string& name) const {
  Hdf5Handle attribute;
  if (has_attribute(group, name)) {
    attribute = Hdf5Handle(
        H5Aopen_by_name(file_.get(), group.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  }
  if (!attribute) fail(group + "@" + name, "not found, an attribute expected");
  return attribute;
}

// A damaged size must not ask for gigabytes: not even compressed data grows more than a thousandfold.
std::size_t Hdf5Reader::value_count(const std::string& path, hid_t space, std::size_t value_size) const {
  constexpr std::uint64_t largest_compression = 1040;
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (count < 0 || static_cast<std::uint64_t>(count) > file_size_ * largest_compression / value_size) {
    fail(path, std::to_string(count) + " values found, no more than the file can hold expected");
  }
  return static_cast<std::size_t>(count);
}

template <class Value>
std::vector<Value> Hdf5Reader::array(const std::string& path) const {
  const Hdf5Handle set = open_dataset(path);
  const Hdf5Handle stored(H5Dget_type(set.get()), H5Tclose);
  const Hdf5Handle space(H5Dget_space(set.get()), H5Sclose);
  const Types types = types_of<Value>();
  if (H5Tget_class(stored.get()) != types.kind) {
    fail(path, std::string("another type found, ") + (types.kind == H5T_FLOAT ? "reals" : "integers") +
                   " expected");
  }
  std::vector<Value> values(value_count(path, space.get(), H5Tget_size(stored.get())));
  if (!values.empty() && H5Dread(set.get(), types.native, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    fail(path, "damaged data found");
  }
  return values;
}

std::string Hdf5Reader::text(const std::string& path) const {
  const auto found = texts(path);
  if (found.size() != 1) fail(path, std::to_string(found.size()) + " texts found, one expected");
  return found.front();
}

std::vector<std::string> Hdf5Reader::texts(const std::string& path) const {
  const Hdf5Handle set = open_dataset(path);
  const Hdf5Handle stored(H5Dget_type(set.get()), H5Tclose);
  const Hdf5Handle space(H5Dget_space(set.get()), H5Sclose);
  if (H5Tget_class(stored.get()) != H5T_STRING) fail(path, "another type found, text expected");
  const std::size_t size = H5Tget_size(stored.get());
  const std::size_t count = value_count(path, space.get(), size);
  std::vector<std::string> result;
  if (H5Tis_variable_str(stored.get()) > 0) {
    std::vector<char*> pointers(count);
    if (H5Dread(set.get(), stored.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()) < 0) {
      fail(path, "damaged data found");
    }
    for (const char* text : pointers) result.emplace_back(text != nullptr ? text : "");
    H5Dvlen_reclaim(stored.get(), space.get(), H5P_DEFAULT, pointers.data());
  } else {
    std::string bytes(count * size, '\0');
    if (H5Dread(set.get(), stored.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()) < 0) {
      fail(path, "damaged data found");
    }
    for (std::size_t i = 0; i < count; ++i)
      result.push_back(cut_at_zero(std::string_view(bytes).substr(i * size, size)));
  }
  return result;
}

template <class Value>
std::vector<Value> Hdf5Reader::attribute(const std::string& group, const std::string& name) const {
  const Hdf5Handle attribute = open_attribute(group, name);
  const Hdf5Handle stored(H5Aget_type(attribute.get()), H5Tclose);
  const Hdf5Handle space(H5Aget_space(attribute.get()), H5Sclose);
  const Types types = types_of<Value>();
  const std::string path = group + "@" + name;
  if (H5Tget_class(stored.get()) != types.kind) fail(path, "another type found, numbers expected");
  std::vector<Value> values(value_count(path, space.get(), H5Tget_size(stored.get())));
  if (values.empty() || H5Aread(attribute.get(), types.native, values.data()) < 0)
    fail(path, "damaged data found");
  return values;
}

std::string Hdf5Reader::text_attribute(const std::string& group, const std::string& name) const {
  const Hdf5Handle attribute = open_attribute(group, name);
  const Hdf5Handle stored(H5Aget_type(attribute.get()), H5Tclose);
  const Hdf5Handle space(H5Aget_space(attribute.get()), H5Sclose);
  const std::string path = group + "@" + name;
  if (H5Tget_class(stored.get()) != H5T_STRING || H5Sget_simple_extent_npoints(space.get()) != 1) {
    fail(path, "another type found, one text expected");
  }
  if (H5Tis_variable_str(stored.get()) > 0) {
    char* pointer = nullptr;
    if (H5Aread(attribute.get(), stored.get(), &pointer) < 0) fail(path, "damaged data found");
    const std::string value = pointer != nullptr ? pointer : "";
    H5Dvlen_reclaim(stored.get(), space.get(), H5P_DEFAULT, &pointer);
    return value;
  }
  const std::size_t size = H5Tget_size(stored.get());
  std::string bytes(value_count(path, space.get(), size) * size, '\0');
  if (H5Aread(attribute.get(), stored.get(), bytes.data()) < 0) fail(path, "damaged data found");
  return cut_at_zero(bytes);
}

#define REMODEL_HDF5_VALUE(Value)                                                                         \
  template void Hdf5Writer::array(const std::string&, const std::vector<Value>&, std::size_t);            \
  template void Hdf5Writer::attribute(const std::string&, const std::string&, const std::vector<Value>&); \
  template std::vector<Value> Hdf5Reader::array(const std::string&) const;                                \
  template std::vector<Value> Hdf5Reader::attribute(const std::string&, const std::string&) const;
REMODEL_HDF5_VALUE(double)
REMODEL_HDF5_VALUE(std::int64_t)
REMODEL_HDF5_VALUE(std::int32_t)
REMODEL_HDF5_VALUE(std::uint64_t)
REMODEL_HDF5_VALUE(std::uint32_t)
REMODEL_HDF5_VALUE(std::uint8_t)
#undef REMODEL_HDF5_VALUE

}  // namespace remodel::io
