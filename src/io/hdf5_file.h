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

// HDF5 ignores what follows its own end of a file. There stands a seal, sixteen bytes: a mark and a checksum
// over all before it, so that a damaged file of ours is refused before HDF5 follows its broken links.
std::string sealed(std::string bytes);

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

  std::string bytes();

 private:
  [[noreturn]] void fail(const std::string& path) const;
  void write(const std::string& path, hid_t stored, hid_t given, std::span<const hsize_t> size,
             const void* data);

  Hdf5Silence silence_;
  std::string name_;
  Hdf5Handle file_;
};

class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::filesystem::path& file);

  bool exists(const std::string& path) const;
  bool has_attribute(const std::string& group, const std::string& name) const;
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
  std::size_t value_count(const std::string& path, hid_t space, std::size_t value_size) const;

  Hdf5Silence silence_;
  std::string name_;
  std::uint64_t file_size_ = 0;
  Hdf5Handle file_;
};

}  // namespace remodel::io
