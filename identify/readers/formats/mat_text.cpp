#include "identify/readers/formats/mat_text.hpp"

#include <matio.h>

#include <bit>
#include <cstring>

#include "identify/readers/formats/mat_variable.hpp"
#include "identify/readers/text.hpp"

namespace dualdamp::identify {

namespace {

constexpr const char* utf16 = std::endian::native == std::endian::little ? "UTF-16LE" : "UTF-16BE";

std::u16string units_of(const void* data, std::size_t bytes) {
  std::u16string units(bytes / sizeof(char16_t), u'\0');
  std::memcpy(units.data(), data, units.size() * sizeof(char16_t));
  return units;
}

/// All characters as MATLAB counts them, in UTF-16, column by column. Empty if the variable is no text.
std::u16string characters(const matvar_t& variable) {
  if (variable.class_type != MAT_C_CHAR || variable.rank != 2 || variable.data == nullptr) return {};
  switch (variable.data_type) {
    case MAT_T_UTF8:
    case MAT_T_UINT8: {
      const std::string text = to_utf8({static_cast<const char*>(variable.data), variable.nbytes});
      const std::string wide = converted(text, "UTF-8", utf16).value_or("");
      return units_of(wide.data(), wide.size());
    }
    case MAT_T_UTF16:
    case MAT_T_UINT16:
      return units_of(variable.data, variable.nbytes);
    default:
      return {};  // matio 1.5 reads other types as zeros
  }
}

std::optional<std::vector<std::string>> rows_of(const matvar_t& variable) {
  const std::u16string all = characters(variable);
  if (all.empty() || all.size() != size_of(variable)) return std::nullopt;
  const std::size_t rows = variable.dims[0];
  std::vector<std::u16string> units(rows);
  for (std::size_t i = 0; i < all.size(); ++i) units[i % rows] += all[i];
  std::vector<std::string> result;
  for (const std::u16string& row : units) {
    const auto text =
        converted({reinterpret_cast<const char*>(row.data()), row.size() * sizeof(char16_t)}, utf16);  // NOLINT
    if (!text) return std::nullopt;  // half of a pair
    result.emplace_back(trimmed(to_utf8(*text)));
  }
  return result;
}

}  // namespace

std::optional<std::vector<std::string>> texts(const matvar_t& variable) {
  if (variable.class_type != MAT_C_CELL) return rows_of(variable);
  if (variable.data == nullptr || size_of(variable) == 0 || variable.nbytes < size_of(variable) * sizeof(matvar_t*))
    return std::nullopt;
  std::vector<std::string> result;
  auto* const* cells = static_cast<matvar_t* const*>(variable.data);
  for (std::size_t i = 0; i < size_of(variable); ++i) {
    const auto rows = cells[i] == nullptr ? std::nullopt : rows_of(*cells[i]);
    if (!rows || rows->size() != 1) return std::nullopt;
    result.push_back(rows->front());
  }
  return result;
}

std::vector<LabelRun> runs_of(const std::vector<std::string>& labels) {
  std::vector<LabelRun> runs;
  for (std::size_t row = 0; row < labels.size(); ++row)
    if (row == 0 || labels[row] != labels[row - 1]) runs.push_back({labels[row], row});
  return runs;
}

}  // namespace dualdamp::identify
