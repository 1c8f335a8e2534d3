#pragma once
/// Measured data from a file: CSV, MATLAB or universal file format. docs/data-files.md is the guide for users.
///
/// The type of a file is recognised by its content, not by its name. Columns (vectors, data sets) are known by
/// name: t (time), Y, x (position), y, v (velocity), a (acceleration), force, omega (frequency), phase,
/// fundamental, mean_square_speed, sweep. Numbers are in SI unless the file or the caller states a unit. The
/// columns decide the kind of the record:
/// * Y and x: x-Y pairs, with the other columns of a pair if there are any;
/// * x alone, or t and x where x turns back at four rows of five or more: extremes of a free vibration;
/// * t, or a stated sample rate, and any of x, y, v, a, force: histories, one for each label of `sweep`. Times must
///   be evenly spaced, within the rounding of the printed numbers and 1 % of a step. Gaps, bursts and jitter are
///   handled with a warning, or refused (identify/readers/time_base.hpp).
///
/// Errors: `core::InputError` with the places of the first 20 problems. Cost: linear, about 0.1 us a number. Files
/// above 1 GiB or 20 million rows are refused before all of them is read.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/setting.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// Names of the columns that a file may hold; `numbers_only`: without labels.
[[nodiscard]] std::vector<std::string_view> column_names(bool numbers_only);

struct ReadOptions {
  /// Column -> unit, such as x -> mm. Replaces a unit that the file states, with a warning.
  std::map<std::string, std::string> units = {};
  /// Column -> its name in the file, such as x -> "LVDT 2", or its number from 1.
  std::map<std::string, std::string> columns = {};
  /// Column -> scale of its numbers, such as x -> "2.5 mm/V", a -> "100 mV/g", force -> "35.15".
  std::map<std::string, std::string> scales = {};
  char decimal = '.';                                            ///< decimal mark of a CSV file: a point or a comma
  core::Coordinate coordinate = core::Coordinate::displacement;  ///< what x is
  std::string coordinate_reason = {};  ///< for messages: why x is one; empty: the caller does not know
  bool force_levels = false;           ///< Y is the amplitude of a force [N]
  bool is_imposed = false;  ///< a drive moves the mass along x, and may stop anywhere: no stop is called clipped
  bool no_header = false;   ///< the first row of a CSV file holds numbers; `columns` has the number of each column
  double sample_rate =
      0.0;  ///< 1/s, of a file without times: the rows of each test are samples from t = 0; 0: none
  /// Names of the columns to be read, without aliases; others are not read. Empty: all.
  std::vector<std::string> only = {};
  /// Name of the file in messages; empty: its path.
  std::string name = {};
  core::SettingWords words = {};  ///< how messages name these options
};

/// Units of the columns that were read.
struct ColumnUnits {
  std::vector<std::string> assumed;           ///< columns without a stated unit, taken in SI
  std::map<std::string, std::string> stated;  ///< column -> its unit, as the file or the caller states it
};

struct MeasuredRecord {
  Record record;
  std::vector<std::string> warnings;  ///< what was left out or assumed
  std::vector<std::string> ignored;   ///< those about unknown columns, variables or fields
  std::string sha256;                 ///< of the bytes of the file
  ColumnUnits units;
};

[[nodiscard]] MeasuredRecord read_record(const std::string& path, const ReadOptions& options = {});

/// The same from text already in memory: CSV or universal file format.
[[nodiscard]] MeasuredRecord parse_record(std::string_view text, const ReadOptions& options);

/// The same with default options. `name`: name of the file in messages.
[[nodiscard]] MeasuredRecord parse_record(std::string_view text, const std::string& name);

/// One signal over its own times, as in the file: the drive of an oscillator, or a motion to compare with a
/// simulated one. The times need not be evenly spaced.
struct MeasuredSignal {
  std::vector<double> times;          ///< s, as in the file
  std::vector<double> values;         ///< SI
  std::vector<std::string> warnings;  ///< what was left out or assumed
  std::string sha256;                 ///< of the bytes of the file
};

/// Reads one column (y, force, x, ...) and the times t. `options.columns` has their names in the file. Other
/// columns are not read. Errors: those of `read_record`; fewer than two rows, a time that does not increase,
/// several tests.
[[nodiscard]] MeasuredSignal read_signal(const std::string& path, std::string_view column,
                                         const ReadOptions& options = {});

/// The same from text already in memory.
[[nodiscard]] MeasuredSignal parse_signal(std::string_view text, std::string_view column,
                                          const ReadOptions& options);

}  // namespace dualdamp::identify
