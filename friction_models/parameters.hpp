#pragma once
/// Parameters of a law, stated once: the scenario reader, the schema, `dualdamp laws`, the range checks and the
/// documentation all come from this table.

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dualdamp::friction {

/// The interval a parameter must lie in; ends are included unless marked open.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;
  bool high_open = false;

  [[nodiscard]] bool contains(double value) const;
  /// For messages: ">= 0 N", "> 0 and <= 1".
  [[nodiscard]] std::string describe(std::string_view unit) const;
};

struct Parameter {
  std::string_view name;             ///< YAML key
  std::string_view unit;             ///< SI unit in udunits2 spelling: "N", "N/m", "N.s/m", "m/s", "m", "s", "1"
  std::optional<double> fallback{};  ///< default; none and no `same_as`: the parameter is required
  std::string_view same_as{};        ///< default is the value of this earlier parameter
  Range range{};
  std::string_view at_least{};  ///< must be >= the value of this earlier parameter
  std::string_view meaning{};   ///< one line for documentation

  [[nodiscard]] bool required() const { return !fallback && same_as.empty(); }
};

/// Values by name, SI, defaults filled in.
using ParameterValues = std::map<std::string, double, std::less<>>;

/// One complaint about one parameter; the reader turns it into a located diagnostic.
struct ParameterFault {
  std::string name;
  std::string message;
  std::string allowed;
  std::string found;
};

/// Fills in the defaults of `values` and returns every fault: missing, unknown, not finite, out of range, below
/// the parameter named by `at_least`. `values` is complete when the returned list is empty.
[[nodiscard]] std::vector<ParameterFault> complete(const std::vector<Parameter>& table, ParameterValues& values);

}  // namespace dualdamp::friction
