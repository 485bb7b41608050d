#pragma once

// HDF5's types for the numbers that we read and write.

#include <hdf5.h>

#include <cstdint>

namespace remodel::io {

struct Hdf5Types {
  hid_t stored;  // little-endian in the file, on every machine
  hid_t native;
  H5T_class_t kind;
};

template <class Value>
Hdf5Types types_of();
template <>
inline Hdf5Types types_of<double>() {
  return {H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, H5T_FLOAT};
}
template <>
inline Hdf5Types types_of<std::int64_t>() {
  return {H5T_STD_I64LE, H5T_NATIVE_INT64, H5T_INTEGER};
}
template <>
inline Hdf5Types types_of<std::int32_t>() {
  return {H5T_STD_I32LE, H5T_NATIVE_INT32, H5T_INTEGER};
}
template <>
inline Hdf5Types types_of<std::uint64_t>() {
  return {H5T_STD_U64LE, H5T_NATIVE_UINT64, H5T_INTEGER};
}
template <>
inline Hdf5Types types_of<std::uint32_t>() {
  return {H5T_STD_U32LE, H5T_NATIVE_UINT32, H5T_INTEGER};
}
template <>
inline Hdf5Types types_of<std::uint8_t>() {
  return {H5T_STD_U8LE, H5T_NATIVE_UINT8, H5T_INTEGER};
}

// make(Value) for each of them, to instantiate templates.
#define REMODEL_FOR_EACH_HDF5_VALUE(make) \
  make(double);                           \
  make(std::int64_t);                     \
  make(std::int32_t);                     \
  make(std::uint64_t);                    \
  make(std::uint32_t);                    \
  make(std::uint8_t)

}  // namespace remodel::io
