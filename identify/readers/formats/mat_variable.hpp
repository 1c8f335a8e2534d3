#pragma once
/// A variable of a MATLAB file as numbers, whole or a row or column of it.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

struct matvar_t;  // of matio

namespace dualdamp::identify {

/// Variables with more numbers are refused.
inline constexpr std::size_t most_mat_values = 20'000'000;

/// "100 x 3"
[[nodiscard]] std::string describe(const matvar_t& variable);

/// Numbers in it, counted to one more than `most_mat_values` at each side.
[[nodiscard]] std::size_t size_of(const matvar_t& variable);

/// Numbers with two sides longer than one.
[[nodiscard]] bool is_matrix(const matvar_t& variable);

/// All numbers, column by column; nothing when the variable holds fewer than it says, or no numbers.
[[nodiscard]] std::optional<std::vector<double>> numbers(const matvar_t& variable);

/// A column or a row of a matrix, counted from 0.
struct Slice {
  bool is_row = false;
  std::size_t index = 0;
};

/// `data(:,2)` or `data(2,:)`, as MATLAB writes it.
struct SliceName {
  std::string variable;
  Slice slice;
};
[[nodiscard]] std::optional<SliceName> parse_slice(const std::string& text);

/// The slice of a matrix with these numbers; it must be within.
[[nodiscard]] std::vector<double> part_of(const std::vector<double>& values, const matvar_t& variable, Slice slice);

}  // namespace dualdamp::identify
