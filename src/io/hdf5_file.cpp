#include "io/hdf5_file.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

#include "base/checksum.h"
#include "io/hdf5_types.h"
#include "remodel/error.h"

namespace remodel::io {

namespace {

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

// HDF5 would copy the whole file to hand it out: its memory is ours from the beginning.
void* begin_image(std::size_t size, H5FD_file_image_op_t, void*) {
  return std::malloc(size + seal_size);
}
void* grow_image(void* bytes, std::size_t size, H5FD_file_image_op_t, void*) {
  return std::realloc(bytes, size + seal_size);
}
herr_t end_image(void* bytes, H5FD_file_image_op_t operation, void* image) {
  if (operation == H5FD_FILE_IMAGE_OP_FILE_CLOSE)
    static_cast<Hdf5Image*>(image)->bytes = static_cast<char*>(bytes);
  else
    std::free(bytes);
  return 0;
}
void* same_image_owner(void* image) {
  return image;
}
herr_t keep_image_owner(void*) {
  return 0;
}

// Lowest byte first whatever the machine.
std::string checksum_bytes(std::string_view bytes) {
  Checksum sum;
  sum.add(bytes);
  std::string result;
  for (int shift = 0; shift < 64; shift += 8) result += static_cast<char>(sum.value() >> shift & 0xff);
  return result;
}

}  // namespace

bool has_broken_seal(std::string_view bytes) {
  if (bytes.size() < seal_size) return false;
  const std::string_view seal = bytes.substr(bytes.size() - seal_size);
  const std::string_view content = bytes.substr(0, bytes.size() - seal_size);
  return seal.starts_with(seal_mark) && seal.substr(seal_mark.size()) != checksum_bytes(content);
}

Hdf5Image::~Hdf5Image() {
  std::free(bytes);
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

Hdf5Writer::Hdf5Writer(std::string name) : name_(std::move(name)) {
  constexpr std::size_t growth = std::size_t{4} << 20;
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access.get(), growth, 0);  // 0: stays in memory
  H5FD_file_image_callbacks_t callbacks = {begin_image,      nullptr,          grow_image, end_image,
                                           same_image_owner, keep_image_owner, &image_};
  H5Pset_file_image_callbacks(access.get(), &callbacks);
  const Hdf5Handle creation = without_times(H5P_FILE_CREATE);
  // HDF5 opens a file of this name, if there is one, although nothing is written to it: a FIFO's reader would
  // see its end. So the name is one that cannot be opened.
  const std::string no_file = name_ + "/in-memory";
  file_ = Hdf5Handle(H5Fcreate(no_file.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose);
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
  const Hdf5Types types = types_of<Value>();
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
  const Hdf5Types types = types_of<Value>();
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

std::string_view Hdf5Writer::bytes() {
  if (file_) {
    if (H5Fflush(file_.get(), H5F_SCOPE_GLOBAL) < 0) fail("/");
    const ssize_t size = H5Fget_file_image(file_.get(), nullptr, 0);
    if (size < 0) fail("/");
    image_.size = static_cast<std::size_t>(size);
    file_ = Hdf5Handle();
    if (image_.bytes == nullptr) fail("/");
  }
  return {image_.bytes, image_.size};
}

std::string_view Hdf5Writer::sealed() {
  const std::string_view content = bytes();
  const std::string checksum = checksum_bytes(content);
  std::copy(seal_mark.begin(), seal_mark.end(), image_.bytes + content.size());
  std::copy(checksum.begin(), checksum.end(), image_.bytes + content.size() + seal_mark.size());
  return {image_.bytes, content.size() + seal_size};
}

#define REMODEL_HDF5_VALUE(Value)                                                              \
  template void Hdf5Writer::array(const std::string&, const std::vector<Value>&, std::size_t); \
  template void Hdf5Writer::attribute(const std::string&, const std::string&, const std::vector<Value>&)
REMODEL_FOR_EACH_HDF5_VALUE(REMODEL_HDF5_VALUE);
#undef REMODEL_HDF5_VALUE

}  // namespace remodel::io
