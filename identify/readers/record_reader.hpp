#pragma once
/// Measured data from a file: CSV, MATLAB or universal file format. docs/data-files.md is the guide to them.
///
/// What the file is follows from its content; its name counts for nothing. Columns (vectors, data sets) are known
/// by name: t (time), Y, x (position), y, v (velocity), a (acceleration), force, omega (frequency), phase,
/// fundamental, mean_square_speed, sweep. Numbers are SI unless the file or the caller states a unit. What they
/// make:
/// * Y and x: x-Y pairs, with what else there is of a pair;
/// * x alone, or t and x with every row turning back: extremes of a free vibration;
/// * t and any of x, y, v, a, force: histories, one for each label of `sweep`. Times must be evenly spaced, within
///   the rounding of the printed numbers and 1 % of a step; gaps, bursts and jitter are handled with a warning, or
///   refused (identify/readers/time_base.hpp).
///
/// Errors: whatever is wrong with the file, `core::InputError` with place, for the first 20 problems at once.
/// Cost: linear, about 0.1 us a number. Files above 1 GiB or 20 million rows are refused before they are read
/// through.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "identify/record.hpp"

namespace dualdamp::identify {

/// Names of the columns that a file may hold; `numbers_only`: without labels.
[[nodiscard]] std::vector<std::string_view> column_names(bool numbers_only = false);

struct ReadOptions {
  /// Column -> its unit, such as x -> mm: for files that do not state it; replaces a stated one with a warning.
  std::map<std::string, std::string> units = {};
  /// Column -> what the file calls it, such as x -> "LVDT 2", or its number from 1.
  std::map<std::string, std::string> columns = {};
  /// Column -> what its numbers are multiplied by, such as x -> "2.5 mm/V", a -> "100 mV/g", force -> "35.15".
  std::map<std::string, std::string> scales = {};
  char decimal = '.';                                            ///< decimal mark of a CSV file: a point or a comma
  core::Coordinate coordinate = core::Coordinate::displacement;  ///< what x is
  bool no_header = false;  ///< the first row of a CSV file holds numbers; `columns` says which is which
  /// Columns to be read, by their first names; the others are left alone. Empty: all.
  std::vector<std::string> only = {};
  /// Stands for the file in messages; empty: its path.
  std::string name = {};
};

/// Units of the columns that were read.
struct ColumnUnits {
  std::vector<std::string> assumed;           ///< columns for which nobody stated a unit: taken in SI
  std::map<std::string, std::string> stated;  ///< column -> its unit, as the file or the caller states it
};

struct MeasuredRecord {
  Record record;
  std::vector<std::string> warnings;  ///< what was left out or taken for granted
  std::string sha256;                 ///< of the bytes of the file
  ColumnUnits units;
};

[[nodiscard]] MeasuredRecord read_record(const std::string& path, const ReadOptions& options = {});

/// The same from text already in memory: CSV or universal file format.
[[nodiscard]] MeasuredRecord parse_record(std::string_view text, const ReadOptions& options);

/// With `name` for the file in messages.
[[nodiscard]] MeasuredRecord parse_record(std::string_view text, const std::string& name);

/// Whether a warning names a column, variable or field that the reader does not know.
[[nodiscard]] bool is_of_ignored(std::string_view warning);

/// One signal over its own times, as it stands in the file: what drives an oscillator, or a motion beside a
/// simulated one. The times need not be evenly spaced.
struct MeasuredSignal {
  std::vector<double> times;          ///< s, as in the file
  std::vector<double> values;         ///< SI
  std::vector<std::string> warnings;  ///< what was left out or taken for granted
  std::string sha256;                 ///< of the bytes of the file
};

/// The column y, force, x, ...; `options.columns` says what the file calls it and the times t. Other columns are
/// left alone. Errors, beside those of a record: fewer than two rows, a time that does not increase, several tests.
[[nodiscard]] MeasuredSignal read_signal(const std::string& path, std::string_view column,
                                         const ReadOptions& options = {});

/// The same from text already in memory.
[[nodiscard]] MeasuredSignal parse_signal(std::string_view text, std::string_view column,
                                          const ReadOptions& options);

}  // namespace dualdamp::identify
