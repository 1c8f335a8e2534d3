#include "identify/readers/formats/mat_text.hpp"

#include <matio.h>

#include <algorithm>
#include <cstdint>

#include "identify/readers/formats/mat_variable.hpp"
#include "identify/readers/text.hpp"

namespace dualdamp::identify {

namespace {

void append(std::string& text, char32_t point) {
  const auto byte = [&text](char32_t bits) { text += static_cast<char>(bits); };
  if (point < 0x80) return byte(point);
  if (point < 0x800) {
    byte(0xC0U | point >> 6U);
  } else {
    if (point < 0x10000) {
      byte(0xE0U | point >> 12U);
    } else {
      byte(0xF0U | point >> 18U);
      byte(0x80U | (point >> 12U & 0x3FU));
    }
    byte(0x80U | (point >> 6U & 0x3FU));
  }
  byte(0x80U | (point & 0x3FU));
}

/// UTF-16 as UTF-8. Halves of a pair without the other half become question marks.
std::string from_utf16(const std::u16string& units) {
  std::string text;
  const auto is_half = [](char16_t unit, unsigned high) { return (unit & 0xFC00U) == high; };
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (is_half(units[i], 0xD800U) && i + 1 < units.size() && is_half(units[i + 1], 0xDC00U)) {
      append(text, 0x10000U + ((units[i] & 0x3FFU) << 10U) + (units[i + 1] & 0x3FFU));
      ++i;
    } else {
      append(text, (units[i] & 0xF800U) == 0xD800U ? U'?' : units[i]);
    }
  }
  return text;
}

/// The bytes of a variable as UTF-16: MATLAB counts a row's characters so, which tells its rows apart.
std::u16string to_utf16(std::string_view text) {
  std::u16string units;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const std::size_t length = first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
    char32_t point = length == 1 ? first : first & (0x7FU >> length);
    for (std::size_t k = 1; k < length && i + k < text.size(); ++k)
      point = point << 6U | (static_cast<unsigned char>(text[i + k]) & 0x3FU);
    if (point >= 0x10000) {
      units += static_cast<char16_t>(0xD800U + ((point - 0x10000U) >> 10U));
      units += static_cast<char16_t>(0xDC00U + (point & 0x3FFU));
    } else {
      units += static_cast<char16_t>(point);
    }
    i += length;
  }
  return units;
}

/// All characters, column by column. Empty if the variable is no text.
std::u16string characters(const matvar_t& variable) {
  if (variable.class_type != MAT_C_CHAR || variable.rank != 2 || variable.data == nullptr) return {};
  switch (variable.data_type) {
    case MAT_T_UTF8:
    case MAT_T_UINT8:
      return to_utf16(to_utf8({static_cast<const char*>(variable.data), variable.nbytes}));
    case MAT_T_UTF16:
    case MAT_T_UINT16: {
      const auto* const from = static_cast<const std::uint16_t*>(variable.data);
      return {from, from + variable.nbytes / sizeof(std::uint16_t)};
    }
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
  for (const std::u16string& row : units) result.emplace_back(trimmed(to_utf8(from_utf16(row))));
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
