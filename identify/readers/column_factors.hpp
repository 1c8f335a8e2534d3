#pragma once
/// Conversion of the numbers of a column to SI, by the unit that the file states and by the unit and the scale that
/// the caller states.
///
/// A scale is a quantity for one unit of the signal, `2.5 mm/V`, or the sensitivity of a sensor, `100 mV/g`; its
/// dimension decides which. A scale without a unit, `35.15`, is a factor in the column's own unit.
///
/// A column without a stated unit is read in SI, with a warning. An angle or a frequency without a unit is refused,
/// because the numbers cannot show whether they are degrees or radians, hertz or rad/s.

#include <map>
#include <string>
#include <vector>

#include "core/diagnostics.hpp"
#include "identify/readers/columns.hpp"
#include "identify/readers/problems.hpp"
#include "identify/readers/record_reader.hpp"

namespace dualdamp::identify {

/// Adds a problem for each name in the caller's options that is no known column.
void check_names(const ReadOptions& options, Problems& problems);

/// The value for a column in one of the caller's maps, by name or alias; nullptr: the caller states none.
[[nodiscard]] const std::string* find_for(const std::map<std::string, std::string>& map, const KnownColumn& known);

/// Whether the caller wants to read the column (`ReadOptions::only`).
[[nodiscard]] bool is_wanted(const ReadOptions& options, const KnownColumn& known);

class ColumnFactors {
 public:
  ColumnFactors(const ReadOptions& options, Problems& problems, std::vector<std::string>& warnings)
      : options_(options), problems_(problems), warnings_(warnings) {}

  /// The factor from numbers of the column to SI. `stated`: the unit in the file; may be empty. A fault is added to
  /// the problems, with place and text from `where`.
  double factor_of(KnownColumn known, const std::string& stated, const core::Diagnostic& where);

  /// Warns of a unit that is read from the end of a name without brackets and may be none: the mass of `x_m`, the
  /// input of `x_in`; once for all tests. `_in` is a problem beside an output, `x_out`.
  void check_suffix(const KnownColumn& known, const std::string& name, const std::string& unit, bool has_output,
                    const core::Diagnostic& where);

  /// Refuses amplitudes that the heading calls rms or peak to peak, unless a scale states what becomes of them: a
  /// number, or a scale with a unit beside a stated unit of the column, which replaces the heading.
  void check_amplitude(const KnownColumn& known, const std::string& heading, const std::string& unit,
                       const core::Diagnostic& where);

  /// The units of all columns. Adds one warning for all columns without a unit.
  ColumnUnits take_units();

 private:
  /// What a voltage needs; empty for other units.
  [[nodiscard]] std::string scale_of_voltage(const KnownColumn& known, const std::string& unit) const;
  void assume(const std::string& name, const std::string& unit);
  double scaled(const KnownColumn& known, const std::string& scale, const std::string& unit,
                const core::Diagnostic& where);
  double refuse(const core::Diagnostic& where, std::string message, std::string allowed,
                std::string suggestion = {});

  const ReadOptions& options_;
  Problems& problems_;
  std::vector<std::string>& warnings_;
  struct AssumedUnit {
    std::string name, unit;
  };
  std::vector<AssumedUnit> assumed_;
  std::map<std::string, std::string> stated_;
};

}  // namespace dualdamp::identify
