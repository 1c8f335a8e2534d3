#include "identify/readers/formats/mat_structure.hpp"

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "core/constants.hpp"
#include "identify/readers/data_table.hpp"

namespace dualdamp::identify {

namespace {

constexpr std::size_t header_size = 128;  ///< bytes, of versions 5 to 7.3

std::uint32_t word(std::string_view bytes, std::size_t at, bool swap) {
  std::array<char, sizeof(std::uint32_t)> raw{};
  std::copy_n(bytes.data() + at, raw.size(), raw.begin());
  if (swap) std::reverse(raw.begin(), raw.end());
  std::uint32_t value = 0;
  std::memcpy(&value, raw.data(), raw.size());
  return value;
}

/// Header of a matrix of version 4: type, rows, columns, complex, length of the name.
struct Head4 {
  std::uint64_t size = 0;  ///< of the matrix with header and name; 0: this is no such header
};

Head4 head4(std::string_view bytes, std::size_t at) {
  constexpr std::size_t words = 5;
  constexpr std::array<std::uint64_t, 6> precision = {8, 4, 4, 2, 2, 1};
  if (bytes.size() - at < words * sizeof(std::uint32_t)) return {};
  for (const bool swap : {false, true}) {
    const auto entry = [&](std::size_t i) { return word(bytes, at + i * sizeof(std::uint32_t), swap); };
    const std::uint32_t type = entry(0);
    constexpr std::uint32_t most_type = 4052;
    constexpr std::uint32_t longest_name = 64;
    const std::uint32_t digit_P = type / 10 % 10;
    if (type > most_type || type / 100 % 10 != 0 || digit_P >= precision.size() || type % 10 > 2) continue;
    if (entry(3) > 1 || entry(4) < 2 || entry(4) > longest_name) continue;
    const std::uint64_t values = std::uint64_t{entry(1)} * entry(2) * (1 + entry(3));
    if (entry(1) >> 31U != 0 || entry(2) >> 31U != 0) continue;
    return {words * sizeof(std::uint32_t) + entry(4) + values * precision[digit_P]};
  }
  return {};
}

bool is_mat_5(std::string_view bytes) {
  if (bytes.size() < header_size || !bytes.starts_with("MATLAB")) return false;
  const std::string_view mark = bytes.substr(header_size - 2, 2);
  return mark == "IM" || mark == "MI";
}

bool is_mat_73(std::string_view bytes) { return is_mat_5(bytes) && bytes.starts_with("MATLAB 7.3"); }

/// A data element of version 5: its type and the position of its content.
struct Element {
  std::uint32_t type = 0;
  std::size_t begin = 0;
  std::size_t size = 0;
  std::size_t next = 0;  ///< start of the following element
};

/// Checks a file of version 5: every element must end within the element that holds it, and every array must have
/// as many numbers as its dimensions say. Compressed elements are checked by zlib's checksum.
class Elements {
 public:
  Elements(std::string_view bytes, const std::string& file)
      : bytes_(bytes), file_(file), swap_(word(bytes, header_size - 4, false) >> 16U != 0x4D49U) {}

  void check() const {
    for (std::size_t at = header_size; at < bytes_.size();) {
      const Element element = read(at, bytes_.size());
      if (element.type == matrix) check_matrix(element, 0);
      at = element.next;
    }
  }

 private:
  static constexpr std::uint32_t matrix = 14;
  static constexpr std::uint32_t compressed = 15;
  static constexpr std::size_t tag = 8;

  [[nodiscard]] Element read(std::size_t at, std::size_t end) const {
    if (at > end || end - at < tag) refuse_damaged_mat(file_);
    const std::uint32_t first = word(bytes_, at, swap_);
    if (first >> 16U != 0) {  // up to four bytes of content are in the tag itself
      const std::size_t size = first >> 16U;
      if (size > 4) refuse_damaged_mat(file_);
      return {first & 0xFFFFU, at + 4, size, at + tag};
    }
    const std::size_t size = word(bytes_, at + 4, swap_);
    if (size > end - at - tag) refuse_damaged_mat(file_);
    const std::size_t padded = first == compressed ? size : (size + 7) / 8 * 8;
    return {first, at + tag, size, std::min(at + tag + padded, end)};
  }

  void check_matrix(const Element& element, int depth) const {
    constexpr int deepest = 16;
    constexpr std::uint32_t cell = 1;
    constexpr std::uint32_t structure = 2;
    constexpr std::uint32_t first_numeric = 6;
    constexpr std::uint32_t last_numeric = 15;
    const std::size_t end = element.begin + element.size;
    if (element.size == 0) return;  // an empty field
    if (depth > deepest) refuse_damaged_mat(file_);
    const Element flags = read(element.begin, end);
    const Element sides = read(flags.next, end);
    const Element name = read(sides.next, end);
    if (flags.size < 8) refuse_damaged_mat(file_);
    const std::uint32_t kind = word(bytes_, flags.begin, swap_) & 0xFFU;
    if (kind >= first_numeric && kind <= last_numeric) {
      const Element numbers = read(name.next, end);
      if (count(sides) != static_cast<double>(numbers.size) / width(numbers.type)) refuse_damaged_mat(file_);
      return;
    }
    if (kind != cell && kind != structure) return;
    std::size_t at = name.next;
    if (kind == structure) at = read(read(at, end).next, end).next;  // skips length and text of the field names
    while (at < end) {
      const Element field = read(at, end);
      if (field.type != matrix) refuse_damaged_mat(file_);
      check_matrix(field, depth + 1);
      at = field.next;
    }
  }

  /// Number of values by the dimensions. A double, so that the product cannot overflow.
  [[nodiscard]] double count(const Element& sides) const {
    double product = 1.0;
    for (std::size_t i = 0; i + 4 <= sides.size; i += 4) product *= word(bytes_, sides.begin + i, swap_);
    return product;
  }

  /// Bytes of one number of a type. Infinite for an unknown type, so that only a count of zero fits.
  [[nodiscard]] static double width(std::uint32_t type) {
    constexpr std::array<double, 14> widths = {0, 1, 1, 2, 2, 4, 4, 4, 0, 8, 0, 0, 8, 8};
    return type < widths.size() && widths[type] > 0 ? widths[type] : core::infinity;
  }

  std::string_view bytes_;
  const std::string& file_;
  bool swap_;
};

}  // namespace

bool is_mat(std::string_view bytes) { return is_mat_5(bytes) || head4(bytes, 0).size > 0; }

void check_mat(std::string_view bytes, const std::string& file) {
  if (is_mat_73(bytes)) return;  // HDF5 checks the end of its files
  const bool is_5 = is_mat_5(bytes);
  if (is_5 && bytes.size() == header_size)
    core::refuse({.file = file}, "the MATLAB file is empty: it holds no variables");
  if (is_5) {
    Elements(bytes, file).check();
    return;
  }
  for (std::uint64_t at = 0; at < bytes.size();) {
    const std::uint64_t size = head4(bytes, at).size;
    if (size == 0 || size > bytes.size() - at) refuse_damaged_mat(file);
    at += size;
  }
}

void refuse_damaged_mat(const std::string& file) {
  core::refuse({.file = file}, "the MATLAB file is damaged or cut off", "the whole file");
}

bool is_whole_hdf5(const std::string& path) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file >= 0) H5Fclose(file);
  return file >= 0;
}

bool lacks_class(const std::string& path, const std::string& variable) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0) return false;
  const htri_t has = H5Aexists_by_name(file, variable.c_str(), "MATLAB_class", H5P_DEFAULT);
  bool is_foreign = has == 0;
  if (has > 0) {
    const hid_t attribute = H5Aopen_by_name(file, variable.c_str(), "MATLAB_class", H5P_DEFAULT, H5P_DEFAULT);
    const hid_t type = H5Aget_type(attribute);
    is_foreign = H5Tget_class(type) == H5T_STRING && H5Tget_strpad(type) != H5T_STR_NULLTERM;
    H5Tclose(type);
    H5Aclose(attribute);
  }
  H5Fclose(file);
  return is_foreign;
}

core::Diagnostic foreign_variable(const std::string& file, const std::string& name) {
  return {{file, 0, 0, {}},
          "variable '" + name +
              "' has no attribute MATLAB_class, or not as a text that ends with a zero byte: another program than "
              "MATLAB wrote it into the HDF5 file, and MATLAB itself could not read it",
          "scipy.io.savemat, which writes MATLAB 5 files; or, of h5py, dataset.attrs.create('MATLAB_class', "
          "numpy.bytes_('double'), dtype='S7'); or a CSV file",
          {},
          {}};
}

void refuse_unread_mat(const std::string& file, IsolatedEnd end) {
  switch (end) {
    case IsolatedEnd::out_of_time:
      core::refuse({.file = file}, "the MATLAB file is damaged: reading it does not end", "the whole file");
    case IsolatedEnd::out_of_memory:
      core::refuse({.file = file},
                   "reading the MATLAB file takes more than 4 GiB of memory: it is damaged or too large",
                   "the whole file, or a part of the record");
    case IsolatedEnd::crashed:
    case IsolatedEnd::done:
      break;
  }
  refuse_damaged_mat(file);
}

IsolationLimits mat_limits(const std::string& path) {
  constexpr std::chrono::seconds least{2};
  constexpr std::uintmax_t bytes_a_second = std::uintmax_t{8} << 20U;
  constexpr int load = 8;
  constexpr std::size_t memory = std::size_t{4} << 30U;
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  const std::chrono::seconds time = least + std::chrono::seconds(error ? 0 : size / bytes_a_second);
  return {time, load * time, memory};
}

}  // namespace dualdamp::identify
