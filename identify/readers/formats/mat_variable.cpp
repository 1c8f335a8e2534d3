#include "identify/readers/formats/mat_variable.hpp"

#include <matio.h>

#include <algorithm>
#include <cstdint>
#include <regex>

#include "identify/readers/text.hpp"

namespace dualdamp::identify {

namespace {

template <typename Stored>
std::vector<double> converted(const matvar_t& variable, std::size_t size) {
  const auto* from = static_cast<const Stored*>(variable.data);
  std::vector<double> values(size);
  std::transform(from, from + size, values.begin(), [](Stored value) { return static_cast<double>(value); });
  return values;
}

}  // namespace

std::string describe(const matvar_t& variable) {
  std::string text;
  for (int i = 0; i < variable.rank; ++i) text += (i == 0 ? "" : " x ") + std::to_string(variable.dims[i]);
  char* const* const fields = variable.class_type == MAT_C_STRUCT ? Mat_VarGetStructFieldnames(&variable) : nullptr;
  if (fields == nullptr) return text;
  auto* const record = const_cast<matvar_t*>(&variable);  // matio takes no const pointer here
  for (unsigned i = 0; i < Mat_VarGetNumberOfFields(record); ++i)
    text += (i == 0 ? " with " : ", ") + to_utf8(fields[i]);
  return text;
}

std::size_t size_of(const matvar_t& variable) {
  std::size_t size = 1;
  constexpr std::size_t most = most_mat_values + 1;
  for (int i = 0; i < variable.rank; ++i) size = std::min(size * std::min(variable.dims[i], most), most);
  return variable.rank == 0 ? 0 : size;
}

std::optional<std::vector<double>> numbers(const matvar_t& variable) {
  const std::size_t size = size_of(variable);
  if (variable.data == nullptr || variable.nbytes < size * Mat_SizeOf(variable.data_type)) return std::nullopt;
  switch (variable.data_type) {
    case MAT_T_DOUBLE:
      return converted<double>(variable, size);
    case MAT_T_SINGLE:
      return converted<float>(variable, size);
    case MAT_T_INT8:
      return converted<std::int8_t>(variable, size);
    case MAT_T_UINT8:
      return converted<std::uint8_t>(variable, size);
    case MAT_T_INT16:
      return converted<std::int16_t>(variable, size);
    case MAT_T_UINT16:
      return converted<std::uint16_t>(variable, size);
    case MAT_T_INT32:
      return converted<std::int32_t>(variable, size);
    case MAT_T_UINT32:
      return converted<std::uint32_t>(variable, size);
    case MAT_T_INT64:
      return converted<std::int64_t>(variable, size);
    case MAT_T_UINT64:
      return converted<std::uint64_t>(variable, size);
    default:
      return std::nullopt;
  }
}

std::optional<SliceName> parse_slice(const std::string& text) {
  static const std::regex pattern(R"((\w+(?:\.\w+)?)\s*\(\s*(:|\d{1,6})\s*,\s*(:|\d{1,6})\s*\))");
  std::smatch parts;
  if (!std::regex_match(text, parts, pattern) || (parts[2] == ":") == (parts[3] == ":")) return std::nullopt;
  const bool is_row = parts[3] == ":";
  const std::size_t number = std::stoul(is_row ? parts[2] : parts[3]);
  if (number == 0) return std::nullopt;
  return SliceName{parts[1], {is_row, number - 1}};
}

bool is_matrix(const matvar_t& variable) {
  return variable.rank == 2 && std::min(variable.dims[0], variable.dims[1]) > 1 &&
         variable.class_type >= MAT_C_DOUBLE && variable.class_type <= MAT_C_UINT64;
}

std::vector<double> part_of(const std::vector<double>& values, const matvar_t& variable, Slice slice) {
  const std::size_t rows = variable.dims[0];
  const std::size_t columns = variable.dims[1];
  std::vector<double> result(slice.is_row ? columns : rows);
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = slice.is_row ? values[i * rows + slice.index] : values[slice.index * rows + i];
  return result;
}

}  // namespace dualdamp::identify
