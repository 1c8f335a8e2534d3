#pragma once
/// The texts of a MATLAB variable.

#include <optional>
#include <string>
#include <vector>

#include "identify/readers/data_table.hpp"

struct _mat_t;    // of matio, NOLINT(bugprone-reserved-identifier)
struct matvar_t;  // of matio

namespace dualdamp::identify {

/// The rows of a char array, or the elements of a cell array of such rows, in UTF-8 without blanks at their ends.
/// Nothing if the variable holds no text. MATLAB writes UTF-16, and UTF-8 if all characters are ASCII; other
/// programs write UTF-8 or single bytes.
[[nodiscard]] std::optional<std::vector<std::string>> texts(const matvar_t& variable);

/// matio 1.5 reads characters that are stored as signed numbers as zeros. Returns the variable again, with these
/// characters, for the caller to own; null if it holds none. In compressed cells they remain zeros, which are no
/// text.
[[nodiscard]] matvar_t* with_signed_texts(_mat_t* file, const matvar_t& variable);

/// What a variable without `texts` should be to label rows or tests.
[[nodiscard]] std::string instead_of_labels(const matvar_t& variable);

/// The labels of rows, alike neighbours together.
[[nodiscard]] std::vector<LabelRun> runs_of(const std::vector<std::string>& labels);

}  // namespace dualdamp::identify
