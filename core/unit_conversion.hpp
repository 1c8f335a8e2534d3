#pragma once
/// Units by udunits2, restricted to the unambiguous part of its grammar.

#include <optional>
#include <string>
#include <string_view>

namespace dualdamp::core {

/// value * multiply / divide: kept apart so that 90 deg and 3 um round once where one rounding is enough.
struct Factor {
  double multiply = 1.0;
  double divide = 1.0;

  [[nodiscard]] double apply(double value) const { return value * multiply / divide; }
};

/// Whether `text` is in the unambiguous part of udunits2's grammar: a product of names with integer powers. Numbers
/// (`2 N`), fractional powers, offsets and references (`K @ 273`, `s since 1990`, `lg(re 1 mW)`) are not.
[[nodiscard]] bool is_product_of_units(std::string_view text);

struct Conversion {
  bool known = false;            ///< udunits2 knows the unit
  std::optional<Factor> factor;  ///< none where the unit is of another dimension
};

/// `unit` and `si_unit`: products of units. Errors: `std::runtime_error` where the unit database of udunits2 cannot
/// be read.
[[nodiscard]] Conversion conversion(const std::string& unit, const std::string& si_unit);
/// Whether `unit` is a product of SI base units without a factor or an offset, and without an angle.
[[nodiscard]] bool is_coherent(const std::string& unit);

}  // namespace dualdamp::core
