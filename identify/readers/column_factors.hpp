#pragma once
/// From the numbers of a column to SI: the unit that the file states, the unit and the scale that the caller
/// states.
///
/// A scale is a quantity for one unit of the signal, `2.5 mm/V`, or the sensitivity of a sensor, `100 mV/g`; the
/// dimensions tell which. Without a unit it multiplies: `35.15`, in the column's own unit.
///
/// A column for which nobody states a unit is read in SI, and the caller is warned of that. An angle or a frequency
/// without unit is refused: degrees and radians, hertz and rad/s differ too little to be told by the numbers.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.hpp"
#include "identify/readers/columns.hpp"
#include "identify/readers/problems.hpp"
#include "identify/readers/record_reader.hpp"

namespace dualdamp::identify {

/// Refuses names in the caller's options that are no known columns.
void check_names(const ReadOptions& options, Problems& problems);

/// What the caller says of a column, under either of its names; nullptr: nothing.
[[nodiscard]] const std::string* find_for(const std::map<std::string, std::string>& map, const KnownColumn& known);

/// Whether the caller wants the column at all.
[[nodiscard]] bool is_wanted(const ReadOptions& options, const KnownColumn& known);

class ColumnFactors {
 public:
  ColumnFactors(const ReadOptions& options, Problems& problems, std::vector<std::string>& warnings)
      : options_(options), problems_(problems), warnings_(warnings) {}

  /// What a number of the column is multiplied by. `stated`: the unit in the file, may be empty. A fault goes to
  /// the problems with the place and the finding of `where`.
  double factor_of(const KnownColumn& known, const std::string& stated, const core::Diagnostic& where);

  /// The units of all columns, with one warning for those without.
  ColumnUnits take_units();

 private:
  void assume(const std::string& name, const std::string& unit);
  double scaled(const KnownColumn& known, const std::string& scale, const std::string& unit,
                const core::Diagnostic& where);
  double refuse(const core::Diagnostic& where, std::string message, std::string allowed,
                std::string suggestion = {});

  const ReadOptions& options_;
  Problems& problems_;
  std::vector<std::string>& warnings_;
  struct Assumption {
    std::string name, unit;
  };
  std::vector<Assumption> assumed_;
  std::map<std::string, std::string> stated_;
};

}  // namespace dualdamp::identify
