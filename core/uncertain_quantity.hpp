#pragma once
/// Quantities that state their uncertainty: `1.042 kg ± 0.5 %`, `1568 N/m +- 8 N/m`, `(1.042 ± 0.005) kg`.
///
/// The number after `±`, `+-` or `+/-` is the standard uncertainty (one standard deviation): in percent of the
/// value, in a unit of its dimension, or without unit. A side without unit has the unit of the other side, and a
/// unit behind parentheses is that of both sides: `(1.042 ± 0.5 %) kg` and `1.042 ± 0.5 % kg` are 1.042 kg ± 0.5 %.

#include <optional>
#include <string>
#include <string_view>

#include "core/coordinate.hpp"

namespace dualdamp::core {

struct UncertainQuantityText {
  std::optional<double> value;        ///< SI
  std::optional<double> uncertainty;  ///< SI, one standard deviation, >= 0; nothing where the text states none
  std::string fault;                  ///< why there is no value, a sentence without final stop
  std::string suggestion;             ///< a quantity that was perhaps meant; may be empty
};

/// A quantity of the dimension of `si_unit` (core/units.hpp), with or without its uncertainty.
[[nodiscard]] UncertainQuantityText parse_uncertain_quantity(std::string_view text, std::string_view si_unit,
                                                             Coordinate coordinate = Coordinate::displacement);

/// A quantity and its relative uncertainty, taken apart as text; the caller knows the dimension.
struct SplitQuantityText {
  std::string quantity;            ///< the text without the uncertainty
  std::optional<double> relative;  ///< standard uncertainty; nothing where the text states none
  std::string fault;               ///< why the uncertainty cannot be read; empty when it can
};

/// "2.5 mm/V" and 0.01 for "2.5 mm/V ± 1 %" or "2.5 mm/V ± 0.025 mm/V": the uncertainty is in percent or in the
/// unit of the value.
[[nodiscard]] SplitQuantityText split_uncertainty(std::string_view text);

}  // namespace dualdamp::core
