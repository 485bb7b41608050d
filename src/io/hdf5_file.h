#pragma once

// The part of HDF5 that we use, with errors that name the file and the dataset, and without HDF5's own
// messages on standard error.

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace remodel::io {

// Owns an HDF5 identifier.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, Close close) : id_(id), close_(close) {}
  ~Hdf5Handle();
  Hdf5Handle(Hdf5Handle&& other) noexcept;
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept;
  hid_t get() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }

 private:
  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

// HDF5 prints its errors unless told otherwise; what the program set is restored.
class Hdf5Silence {
 public:
  Hdf5Silence();
  ~Hdf5Silence();
  Hdf5Silence(const Hdf5Silence&) = delete;
  Hdf5Silence& operator=(const Hdf5Silence&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

// The memory in which HDF5 builds a file, kept when it closes it.
struct Hdf5Image {
  Hdf5Image() = default;
  ~Hdf5Image();
  Hdf5Image(const Hdf5Image&) = delete;
  Hdf5Image& operator=(const Hdf5Image&) = delete;
  char* bytes = nullptr;  // of std::malloc, with room for a seal
  std::size_t size = 0;
};

// HDF5 ignores what follows its own end of a file. There stands a seal, sixteen bytes: a mark and a checksum
// over all before it, so that a damaged file of ours is refused before HDF5 follows its broken links.
// A file without a seal was made or changed by another program: nothing is said about it.
bool has_broken_seal(std::string_view bytes);

// Value is double, std::int64_t, std::int32_t, std::uint64_t, std::uint32_t or std::uint8_t throughout.

// Builds a file in memory. The same calls give the same bytes: no times are recorded.
class Hdf5Writer {
 public:
  explicit Hdf5Writer(std::string name);  // name: for messages

  void group(const std::string& path);
  // One dimension, or two if columns is more than 1.
  template <class Value>
  void array(const std::string& path, const std::vector<Value>& values, std::size_t columns = 1);
  void text(const std::string& path, const std::string& value);                 // of fixed length
  void texts(const std::string& path, const std::vector<std::string>& values);  // of variable length
  template <class Value>
  void attribute(const std::string& group, const std::string& name, const std::vector<Value>& values);
  void attribute(const std::string& group, const std::string& name, const std::string& value);

  // The file, which ends with that, without a seal or with one; as long as the writer is there.
  std::string_view bytes();
  std::string_view sealed();

 private:
  [[noreturn]] void fail(const std::string& path) const;
  void write(const std::string& path, hid_t stored, hid_t given, std::span<const hsize_t> size,
             const void* data);

  Hdf5Silence silence_;
  std::string name_;
  Hdf5Image image_;
  Hdf5Handle file_;
};

// Reads a file that nobody vouches for: from memory alone, never another file that it names (links that are
// not hard, external and virtual datasets are errors), and never more bytes in all than a compressed mesh may
// become.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::filesystem::path& file);
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  bool exists(const std::string& path) const;
  bool has_attribute(const std::string& group, const std::string& name) const;
  // The names of the datasets of reals in a group, in alphabetical order; none if there is no such group.
  std::vector<std::string> real_arrays(const std::string& group) const;
  // How many columns a dataset of two dimensions has; 1 if it has one dimension, 0 if it has others.
  std::size_t columns(const std::string& path) const;
  template <class Value>
  std::vector<Value> array(const std::string& path) const;
  std::string text(const std::string& path) const;
  std::vector<std::string> texts(const std::string& path) const;  // of fixed or variable length
  template <class Value>
  std::vector<Value> attribute(const std::string& group, const std::string& name) const;
  std::string text_attribute(const std::string& group, const std::string& name) const;

  std::string place(const std::string& path) const { return name_ + ":" + path; }
  [[noreturn]] void fail(const std::string& path, const std::string& problem) const;

 private:
  Hdf5Handle open_dataset(const std::string& path) const;
  Hdf5Handle open_attribute(const std::string& group, const std::string& name) const;
  // The size of a space, taken off what may still be read.
  std::size_t claim(const std::string& path, hid_t space, std::size_t value_size) const;
  void read_values(const std::string& path, hid_t set, hid_t type, void* values,
                   hid_t transfer = H5P_DEFAULT) const;
  std::vector<std::string> texts_of_any_length(const std::string& path, hid_t set, std::size_t count) const;

  Hdf5Silence silence_;
  std::string name_;
  std::string bytes_;                  // HDF5 reads here
  mutable std::size_t allowance_ = 0;  // of bytes that may still be read
  Hdf5Handle file_;
};

}  // namespace remodel::io
