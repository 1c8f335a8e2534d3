#pragma once
/// The numbers of a MATLAB variable: all of them, or a row or a column.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

struct matvar_t;  // of matio

namespace dualdamp::identify {

/// Variables with more numbers are refused.
inline constexpr std::size_t most_mat_values = 20'000'000;

/// For messages: the size, "100 x 3", and the fields of a struct, "1 x 1 with Fs, LVDT".
[[nodiscard]] std::string describe(const matvar_t& variable);

/// Number of values; larger ones than `most_mat_values` are not counted exactly.
[[nodiscard]] std::size_t size_of(const matvar_t& variable);

/// Whether two sides are longer than one.
[[nodiscard]] bool is_matrix(const matvar_t& variable);

/// All numbers, column by column. Nothing if the variable holds no numbers, or fewer than its size.
[[nodiscard]] std::optional<std::vector<double>> numbers(const matvar_t& variable);

/// A column or a row of a matrix, counted from 0.
struct Slice {
  bool is_row = false;
  std::size_t index = 0;
};

/// `data(:,2)`, `data(2,:)` or, in a struct, `run.data(:,2)`, as MATLAB writes it.
struct SliceName {
  std::string variable;
  Slice slice;
};
[[nodiscard]] std::optional<SliceName> parse_slice(const std::string& text);

/// A slice of a matrix. `values`: all numbers of the matrix. The slice must lie within the matrix.
[[nodiscard]] std::vector<double> part_of(const std::vector<double>& values, const matvar_t& variable, Slice slice);

}  // namespace dualdamp::identify
