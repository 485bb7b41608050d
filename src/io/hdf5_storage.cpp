#include "io/hdf5_storage.h"

#include <algorithm>
#include <array>
#include <vector>

#include "io/hdf5_file.h"
#include "io/inflate.h"

namespace remodel::io {

namespace {

// A text of any length stands elsewhere in the file: here are its length, an address and a number.
constexpr std::size_t text_reference_size = 4 + 8 + 4;

bool is_known_filter(H5Z_filter_t filter) {
  return filter == H5Z_FILTER_DEFLATE || filter == H5Z_FILTER_SHUFFLE;
}

H5Z_filter_t filter_at(hid_t creation, unsigned place) {
  unsigned flags = 0;
  std::size_t no_values = 0;
  return H5Pget_filter2(creation, place, &flags, &no_values, nullptr, 0, nullptr, nullptr);
}

// Deflate twice over compresses a millionfold; each of the filters once is all that programs use.
std::string filter_problem(hid_t creation) {
  std::vector<H5Z_filter_t> seen;
  for (int place = 0; place < H5Pget_nfilters(creation); ++place) {
    const H5Z_filter_t filter = filter_at(creation, static_cast<unsigned>(place));
    if (!is_known_filter(filter)) {
      return "filter " + std::to_string(filter) + " found, deflate or shuffle expected";
    }
    if (std::find(seen.begin(), seen.end(), filter) != seen.end()) {
      return "filter " + std::to_string(filter) + " found twice, each filter once expected";
    }
    seen.push_back(filter);
  }
  return {};
}

// One row of pieces after the other. A dataset of one dimension has one column.
class Pieces {
 public:
  Pieces(hid_t set, std::size_t most)
      : set_(set), most_(most), creation_(H5Dget_create_plist(set), H5Pclose) {
    const Hdf5Handle type(H5Dget_type(set), H5Tclose);
    const Hdf5Handle space(H5Dget_space(set), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space.get());
    if (rank != 1 && rank != 2) return;
    H5Sget_simple_extent_dims(space.get(), size_.data(), nullptr);
    H5Pget_chunk(creation_.get(), rank, piece_.data());
    value_size_ = H5Tis_variable_str(type.get()) > 0 ? text_reference_size : H5Tget_size(type.get());
  }

  bool are_sound() const {
    if (value_size_ == 0 || piece_[0] == 0 || piece_[1] == 0) return false;
    if (piece_[0] > most_ / piece_[1] / value_size_) return false;
    for (hsize_t row = 0; row < size_[0]; row += piece_[0]) {
      for (hsize_t column = 0; column < size_[1]; column += piece_[1]) {
        if (!is_sound({row, column})) return false;
      }
    }
    return true;
  }

 private:
  bool is_sound(std::array<hsize_t, 2> offset) const {
    hsize_t stored = 0;
    if (H5Dget_chunk_storage_size(set_, offset.data(), &stored) < 0 || stored == 0 || stored > most_)
      return false;
    std::string bytes(stored, '\0');
    std::uint32_t left_out = 0;
    if (H5Dread_chunk(set_, H5P_DEFAULT, offset.data(), &left_out, bytes.data()) < 0) return false;
    const std::size_t size = piece_[0] * piece_[1] * value_size_;
    return is_deflated(left_out) ? inflated(bytes, size).has_value() : stored == size;
  }

  // A piece may be written without a filter that the others have.
  bool is_deflated(std::uint32_t left_out) const {
    for (int place = 0; place < H5Pget_nfilters(creation_.get()); ++place) {
      if (filter_at(creation_.get(), static_cast<unsigned>(place)) == H5Z_FILTER_DEFLATE) {
        return (left_out >> place & 1) == 0;
      }
    }
    return false;
  }

  hid_t set_;
  std::size_t most_;
  Hdf5Handle creation_;
  std::size_t value_size_ = 0;
  std::array<hsize_t, 2> size_ = {1, 1};
  std::array<hsize_t, 2> piece_ = {1, 1};
};

}  // namespace

std::string storage_problem(hid_t set) {
  const Hdf5Handle creation(H5Dget_create_plist(set), H5Pclose);
  if (!creation) return "damage found, a dataset expected";
  if (H5Pget_layout(creation.get()) == H5D_VIRTUAL) {
    return "a virtual dataset found, values in the file itself expected";
  }
  if (H5Pget_external_count(creation.get()) != 0) {
    return "values in another file found, values in the file itself expected";
  }
  return filter_problem(creation.get());
}

bool has_sound_pieces(hid_t set, std::size_t most) {
  const Hdf5Handle creation(H5Dget_create_plist(set), H5Pclose);
  return H5Pget_layout(creation.get()) != H5D_CHUNKED || Pieces(set, most).are_sound();
}

}  // namespace remodel::io
