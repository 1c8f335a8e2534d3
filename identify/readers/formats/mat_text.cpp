#include "identify/readers/formats/mat_text.hpp"

#include <matio.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <span>

#include "identify/readers/formats/mat_variable.hpp"
#include "identify/readers/text.hpp"

namespace dualdamp::identify {

namespace {

constexpr const char* utf16 = std::endian::native == std::endian::little ? "UTF-16LE" : "UTF-16BE";

/// The class whose numbers matio reads where this variable holds characters; else its own class.
matio_classes class_to_read(const matvar_t& variable) {
  if (variable.class_type != MAT_C_CHAR) return variable.class_type;
  if (variable.data_type == MAT_T_INT8) return MAT_C_INT8;
  return variable.data_type == MAT_T_INT16 ? MAT_C_INT16 : MAT_C_CHAR;
}

/// Elements of a cell array, fields of a struct; none of other variables.
std::span<matvar_t* const> parts_of(const matvar_t& variable) {
  if ((variable.class_type != MAT_C_CELL && variable.class_type != MAT_C_STRUCT) || variable.data == nullptr)
    return {};
  return {static_cast<matvar_t* const*>(variable.data), variable.nbytes / sizeof(matvar_t*)};
}

bool holds_signed_text(const matvar_t& variable) {
  return class_to_read(variable) != variable.class_type ||
         std::ranges::any_of(parts_of(variable),
                             [](const matvar_t* part) { return part && holds_signed_text(*part); });
}

/// Gives `variable` the classes to read, or those of `model`, of which it is a second copy.
void set_classes(const matvar_t& model, bool to_read, matvar_t& variable) {
  variable.class_type = to_read ? class_to_read(model) : model.class_type;
  const auto parts = parts_of(variable);
  const auto models = parts_of(model);
  for (std::size_t i = 0; i < std::min(parts.size(), models.size()); ++i)
    if (parts[i] != nullptr && models[i] != nullptr) set_classes(*models[i], to_read, *parts[i]);
}

std::u16string units_of(const void* data, std::size_t bytes) {
  std::u16string units(bytes / sizeof(char16_t), u'\0');
  std::memcpy(units.data(), data, units.size() * sizeof(char16_t));
  return units;
}

/// All characters as MATLAB counts them, in UTF-16, column by column. Empty if the variable is no text.
std::u16string characters(const matvar_t& variable) {
  if (variable.class_type != MAT_C_CHAR || variable.rank != 2 || variable.data == nullptr) return {};
  // Characters that matio 1.5 could not read are zeros.
  const std::string_view bytes(static_cast<const char*>(variable.data), variable.nbytes);
  if (std::ranges::all_of(bytes, [](char byte) { return byte == 0; })) return {};
  switch (variable.data_type) {
    case MAT_T_UTF8:
    case MAT_T_INT8:
    case MAT_T_UINT8: {
      const std::string text = to_utf8(bytes);
      const std::string wide = converted(text, "UTF-8", utf16).value_or("");
      return units_of(wide.data(), wide.size());
    }
    case MAT_T_UTF16:
    case MAT_T_INT16:
    case MAT_T_UINT16:
      return units_of(variable.data, variable.nbytes);
    default:
      return {};
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

matvar_t* with_signed_texts(_mat_t* file, const matvar_t& variable) {
  if (!holds_signed_text(variable)) return nullptr;
  matvar_t* again = Mat_VarReadInfo(file, variable.name);
  if (again == nullptr) return nullptr;
  set_classes(variable, true, *again);
  static_cast<void>(Mat_VarReadDataAll(file, again));
  set_classes(variable, false, *again);
  return again;
}

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

std::string instead_of_labels(const matvar_t& variable) {
  const auto cells = parts_of(variable);
  // Of characters in a compressed cell array matio has read zeros, or nothing.
  if (variable.compression == MAT_COMPRESSION_ZLIB && holds_signed_text(variable))
    return "characters of a compressed cell array that are not stored as signed integers: save the file without "
           "compression (save -v6), or number the tests";
  const auto is_number = [](const matvar_t* cell) {
    return cell != nullptr && cell->class_type != MAT_C_CHAR && cell->class_type != MAT_C_CELL &&
           cell->class_type != MAT_C_STRUCT && size_of(*cell) > 0;
  };
  if (std::ranges::any_of(cells, is_number))
    return "texts in the cell array, cellfun(@char, " + std::string(variable.name) +
           ", 'UniformOutput', false), or a vector of numbers";
  return "a text or a number for the test, or for each row";
}

std::vector<LabelRun> runs_of(const std::vector<std::string>& labels) {
  std::vector<LabelRun> runs;
  for (std::size_t row = 0; row < labels.size(); ++row)
    if (row == 0 || labels[row] != labels[row - 1]) runs.push_back({labels[row], row});
  return runs;
}

}  // namespace dualdamp::identify
