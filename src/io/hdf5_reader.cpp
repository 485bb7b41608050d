#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <memory>

#include "io/hdf5_file.h"
#include "io/hdf5_storage.h"
#include "io/hdf5_types.h"
#include "io/inflate.h"
#include "remodel/error.h"
#include "remodel/io.h"

namespace remodel::io {

namespace {

// Ends at the first of the zeros that fill a fixed length.
std::string cut_at_zero(std::string_view text) {
  return std::string(text.substr(0, text.find('\0')));
}

// HDF5 would copy a file's image several times: these callbacks hand it the reader's own bytes each time.
void* same_image(std::size_t, H5FD_file_image_op_t, void* bytes) {
  return bytes;
}
void* uncopied_image(void* to, const void*, std::size_t, H5FD_file_image_op_t, void*) {
  return to;
}
void* ungrown_image(void*, std::size_t, H5FD_file_image_op_t, void*) {
  return nullptr;
}
herr_t unfreed_image(void*, H5FD_file_image_op_t, void*) {
  return 0;
}
void* same_owner(void* bytes) {
  return bytes;
}
herr_t unfreed_owner(void*) {
  return 0;
}

Hdf5Handle opened_image(std::string& bytes) {
  // Two files of one name would be one to HDF5, though the file may have changed in between.
  static std::atomic<unsigned> count = 0;
  const std::string name = "image " + std::to_string(count++);
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);  // damage may leave objects open that have no handle
  H5Pset_fapl_core(access.get(), always_allowed, 0);
  H5FD_file_image_callbacks_t callbacks = {same_image, uncopied_image, ungrown_image, unfreed_image,
                                           same_owner, unfreed_owner,  bytes.data()};
  H5Pset_file_image_callbacks(access.get(), &callbacks);
  if (bytes.empty() || H5Pset_file_image(access.get(), bytes.data(), bytes.size()) < 0) return {};
  return {H5Fopen(name.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose};
}

// Memory for texts of any length, as much as is allowed: any number of them may be one and the same in the
// file.
class TextMemory {
 public:
  explicit TextMemory(std::size_t& allowance) : allowance_(allowance) {}

  static void* take(std::size_t size, void* memory) {
    auto& self = *static_cast<TextMemory*>(memory);
    if (size > self.allowance_) return nullptr;
    self.allowance_ -= size;
    return self.pieces_.emplace_back(std::make_unique<char[]>(size)).get();
  }
  static void keep(void*, void*) {}

 private:
  std::size_t& allowance_;
  std::vector<std::unique_ptr<char[]>> pieces_;
};

}  // namespace

Hdf5Reader::Hdf5Reader(const std::filesystem::path& file) : name_(file.string()) {
  // HDF5 knows one reason for a file that it cannot open; this tells missing from damaged.
  bytes_ = read_text(file, std::numeric_limits<std::size_t>::max());
  if (has_broken_seal(bytes_)) {
    throw Error(ErrorCode::format, name_,
                "another checksum than that of the content found: the file is damaged");
  }
  allowance_ = always_allowed + largest_growth * bytes_.size();
  file_ = opened_image(bytes_);
  if (!file_) throw Error(ErrorCode::format, name_, "no HDF5 file or a damaged one found, VTKHDF expected");
}

void Hdf5Reader::fail(const std::string& path, const std::string& problem) const {
  throw Error(ErrorCode::format, place(path), problem);
}

bool Hdf5Reader::exists(const std::string& path) const {
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    const std::string prefix = path.substr(0, end);
    if (H5Lexists(file_.get(), prefix.c_str(), H5P_DEFAULT) <= 0) return false;
    H5L_info_t link;
    if (H5Lget_info(file_.get(), prefix.c_str(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD) {
      fail(prefix, "a link to another place found, data in the file itself expected");
    }
    if (end == std::string::npos) return true;
  }
}

bool Hdf5Reader::has_attribute(const std::string& group, const std::string& name) const {
  return exists(group) && H5Aexists_by_name(file_.get(), group.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

Hdf5Handle Hdf5Reader::open_dataset(const std::string& path) const {
  if (!exists(path)) fail(path, "not found, a dataset expected");
  Hdf5Handle set(H5Dopen2(file_.get(), path.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set) fail(path, "something else or damage found, a dataset expected");
  if (const std::string problem = storage_problem(set.get()); !problem.empty()) fail(path, problem);
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

std::size_t Hdf5Reader::claim(const std::string& path, hid_t space, std::size_t value_size) const {
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (count < 0 || value_size == 0 || static_cast<std::uint64_t>(count) > allowance_ / value_size) {
    fail(path, std::to_string(count) + " values found, no more than the file can hold expected");
  }
  allowance_ -= static_cast<std::size_t>(count) * value_size;
  return static_cast<std::size_t>(count);
}

std::vector<std::string> Hdf5Reader::real_arrays(const std::string& group) const {
  std::vector<std::string> names;
  H5G_info_t info;
  if (!exists(group) || H5Gget_info_by_name(file_.get(), group.c_str(), &info, H5P_DEFAULT) < 0) return names;
  constexpr hsize_t most = 1000;  // datasets that a file of fields may have
  if (info.nlinks > most) fail(group, std::to_string(info.nlinks) + " arrays found, at most 1000 expected");
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    std::array<char, 1000> name{};
    const ssize_t length = H5Lget_name_by_idx(file_.get(), group.c_str(), H5_INDEX_NAME, H5_ITER_INC, i,
                                              name.data(), name.size(), H5P_DEFAULT);
    if (length <= 0 || static_cast<std::size_t>(length) >= name.size()) fail(group, "a damaged name found");
    const std::string path = group + "/" + name.data();
    if (!exists(path)) fail(group, "a damaged name found");
    const Hdf5Handle set(H5Dopen2(file_.get(), path.c_str(), H5P_DEFAULT), H5Dclose);
    if (!set) continue;  // another group
    const Hdf5Handle stored(H5Dget_type(set.get()), H5Tclose);
    if (H5Tget_class(stored.get()) == H5T_FLOAT) names.emplace_back(name.data());
  }
  return names;
}

std::size_t Hdf5Reader::columns(const std::string& path) const {
  const Hdf5Handle set = open_dataset(path);
  const Hdf5Handle space(H5Dget_space(set.get()), H5Sclose);
  std::array<hsize_t, 2> size = {0, 1};
  const int dimensions = H5Sget_simple_extent_ndims(space.get());
  if (dimensions < 1 || dimensions > 2) return 0;
  if (H5Sget_simple_extent_dims(space.get(), size.data(), nullptr) < 0) fail(path, "damaged data found");
  return static_cast<std::size_t>(dimensions == 1 ? 1 : size[1]);
}

template <class Value>
std::vector<Value> Hdf5Reader::array(const std::string& path) const {
  const Hdf5Handle set = open_dataset(path);
  const Hdf5Handle stored(H5Dget_type(set.get()), H5Tclose);
  const Hdf5Handle space(H5Dget_space(set.get()), H5Sclose);
  const Hdf5Types types = types_of<Value>();
  const std::size_t stored_size = H5Tget_size(stored.get());
  if (H5Tget_class(stored.get()) != types.kind || stored_size > 16) {
    fail(path, std::string("another type found, ") + (types.kind == H5T_FLOAT ? "reals" : "integers") +
                   " expected");
  }
  std::vector<Value> values(claim(path, space.get(), std::max(stored_size, sizeof(Value))));
  if (!values.empty()) read_values(path, set.get(), types.native, values.data());
  return values;
}

void Hdf5Reader::read_values(const std::string& path, hid_t set, hid_t type, void* values,
                             hid_t transfer) const {
  if (!has_sound_pieces(set, allowance_) || H5Dread(set, type, H5S_ALL, H5S_ALL, transfer, values) < 0) {
    fail(path, "damaged data or more than the file can hold found");
  }
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
  const std::size_t count = claim(path, space.get(), std::max(size, sizeof(std::string)));
  if (H5Tis_variable_str(stored.get()) > 0) return texts_of_any_length(path, set.get(), count);
  std::string bytes(count * size, '\0');
  if (count > 0) read_values(path, set.get(), stored.get(), bytes.data());
  std::vector<std::string> result;
  for (std::size_t i = 0; i < count; ++i)
    result.push_back(cut_at_zero(std::string_view(bytes).substr(i * size, size)));
  return result;
}

std::vector<std::string> Hdf5Reader::texts_of_any_length(const std::string& path, hid_t set,
                                                         std::size_t count) const {
  TextMemory memory(allowance_);
  const Hdf5Handle transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
  H5Pset_vlen_mem_manager(transfer.get(), TextMemory::take, &memory, TextMemory::keep, &memory);
  const Hdf5Handle type(H5Dget_type(set), H5Tclose);
  std::vector<char*> pointers(count);
  if (count > 0) read_values(path, set, type.get(), pointers.data(), transfer.get());
  std::vector<std::string> result;
  for (const char* text : pointers) result.emplace_back(text != nullptr ? text : "");
  return result;
}

template <class Value>
std::vector<Value> Hdf5Reader::attribute(const std::string& group, const std::string& name) const {
  const Hdf5Handle attribute = open_attribute(group, name);
  const Hdf5Handle stored(H5Aget_type(attribute.get()), H5Tclose);
  const Hdf5Handle space(H5Aget_space(attribute.get()), H5Sclose);
  const Hdf5Types types = types_of<Value>();
  const std::string path = group + "@" + name;
  if (H5Tget_class(stored.get()) != types.kind) fail(path, "another type found, numbers expected");
  std::vector<Value> values(
      claim(path, space.get(), std::max<std::size_t>(H5Tget_size(stored.get()), sizeof(Value))));
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
  std::string bytes(claim(path, space.get(), size) * size, '\0');
  if (H5Aread(attribute.get(), stored.get(), bytes.data()) < 0) fail(path, "damaged data found");
  return cut_at_zero(bytes);
}

#define REMODEL_HDF5_VALUE(Value)                                          \
  template std::vector<Value> Hdf5Reader::array(const std::string&) const; \
  template std::vector<Value> Hdf5Reader::attribute(const std::string&, const std::string&) const
REMODEL_FOR_EACH_HDF5_VALUE(REMODEL_HDF5_VALUE);
#undef REMODEL_HDF5_VALUE

}  // namespace remodel::io
