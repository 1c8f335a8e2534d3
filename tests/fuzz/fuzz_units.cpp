/// Quantities, uncertain quantities and unit factors from any text: the first byte chooses dimension and
/// coordinate.

#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "core/uncertain_quantity.hpp"
#include "core/units.hpp"
#include "tests/fuzz/harness.hpp"

namespace {

using namespace dualdamp;
using fuzz::require;

constexpr std::array<std::string_view, 10> dimensions = {"kg",  "N/m",   "N.s/m", "1", "rad",
                                                         "m/s", "rad/s", "s",     "m", "N"};

void quantities(std::string_view text, std::string_view dimension, core::Coordinate coordinate) {
  for (const core::QuantityText& read :
       {core::parse_quantity(text, dimension, coordinate), core::unit_factor(text, dimension, coordinate)}) {
    require(read.value.has_value() == read.fault.empty(), "a quantity has a value or a fault");
    if (read.value) require(std::isfinite(*read.value), "a quantity is finite");
  }
  const core::UncertainQuantityText uncertain = core::parse_uncertain_quantity(text, dimension, coordinate);
  require(uncertain.value.has_value() == uncertain.fault.empty(), "an uncertain quantity has a value or a fault");
  if (uncertain.value)
    require(std::isfinite(*uncertain.value) && std::isfinite(uncertain.uncertainty.value_or(0.0)) &&
                uncertain.uncertainty.value_or(0.0) >= 0.0,
            "an uncertain quantity is finite");
}

}  // namespace

void dualdamp::fuzz::consume(std::string_view input) {
  if (input.empty()) return;
  const auto choice = static_cast<unsigned char>(input.front());
  input.remove_prefix(1);
  quantities(input, dimensions.at(choice % dimensions.size()),
             (choice & 128U) != 0 ? core::Coordinate::angle : core::Coordinate::displacement);
  (void)core::is_si(input);
}
