#include "core/uncertain_quantity.hpp"

#include <catch2/catch.hpp>
#include <numbers>

using dualdamp::core::parse_uncertain_quantity;
using dualdamp::core::split_uncertainty;

TEST_CASE("A quantity may state its uncertainty in percent, in its own unit or in another of its dimension") {
  for (const char* text :
       {"1.042 kg ± 0.5 %", "1.042 kg +- 5.21 g", "1.042 kg +/- 0.00521 kg", "(1.042 ± 0.00521) kg",
        "1.042 ± 0.00521 kg", "1.042 kg ± 0.00521", "1.042 ± 0.5 %", "1042 g±5.21 g", "(1.042 ± 0.5 %) kg",
        "1.042 ± 0.5 % kg", "1.042±0.5% kg", "1.042 +- 0.5 % kg", "(1042 +/- 0.5%)g", "(1.042 kg ± 0.5 %)"}) {
    CAPTURE(text);
    const auto quantity = parse_uncertain_quantity(text, "kg");
    CHECK(quantity.fault.empty());
    REQUIRE(quantity.value);
    REQUIRE(quantity.uncertainty);
    CHECK(*quantity.value == Approx(1.042).epsilon(1e-14));
    CHECK(*quantity.uncertainty == Approx(0.00521).epsilon(1e-12));
  }
}

TEST_CASE("The uncertainty of a frequency has a unit of its own") {
  const auto frequency = parse_uncertain_quantity("6 Hz ± 0.3 rad/s", "rad/s");
  CHECK(*frequency.value == Approx(12.0 * std::numbers::pi));
  CHECK(*frequency.uncertainty == Approx(0.3));
  CHECK(*parse_uncertain_quantity("6 Hz +- 0.01", "rad/s").uncertainty == Approx(0.02 * std::numbers::pi));
}

TEST_CASE("A unit behind parentheses is that of both sides, percent included") {
  const auto share = parse_uncertain_quantity("(5 ± 1) %", "1");
  CHECK(*share.value == Approx(0.05));
  CHECK(*share.uncertainty == Approx(0.01));
}

TEST_CASE("A quantity without uncertainty states none") {
  const auto quantity = parse_uncertain_quantity("1568 N/m", "N/m");
  CHECK(*quantity.value == 1568.0);
  CHECK_FALSE(quantity.uncertainty);
}

TEST_CASE("A negative value has a positive uncertainty, and zero is one") {
  CHECK(*parse_uncertain_quantity("-2 m ± 10 %", "m").uncertainty == Approx(0.2));
  CHECK(*parse_uncertain_quantity("2 m ± 0 m", "m").uncertainty == 0.0);
}

TEST_CASE("An uncertainty that cannot be read is refused with the reason") {
  CHECK(parse_uncertain_quantity("1 kg ± 5 mm", "kg").fault == "the uncertainty: 'mm' is not a unit of a mass");
  CHECK(parse_uncertain_quantity("1 kg ± -5 g", "kg").fault == "the uncertainty is negative");
  for (const char* text : {"1 kg ±", "± 5 g", "1 kg ± ± 5 g", "1 kg ± 5 g ± 2 g", "(1 ± 2 kg", "1 kg ± nan",
                           "kg ± 1 %", "1 kg ± 5 % kg", "(1 kg ± 2 g) kg", "(1 ± 2 g) kg", "(1 ± 2 %) % kg"}) {
    CAPTURE(text);
    const auto quantity = parse_uncertain_quantity(text, "kg");
    CHECK_FALSE(quantity.value);
    CHECK_FALSE(quantity.fault.empty());
  }
}

TEST_CASE("The relative uncertainty of a scale stands apart from the scale") {
  for (const char* text : {"2.5 mm/V ± 1 %", "2.5 mm/V +- 0.025 mm/V", "2.5 mm/V +- 0.025", "(2.5 ± 0.025) mm/V",
                           "(2.5 ± 1 %) mm/V", "2.5 ± 1 % mm/V"}) {
    CAPTURE(text);
    const auto split = split_uncertainty(text);
    CHECK(split.fault.empty());
    CHECK(split.quantity == "2.5 mm/V");
    CHECK(*split.relative == Approx(0.01));
  }
  CHECK(split_uncertainty("35.15 ± 2 %").quantity == "35.15");
  CHECK(split_uncertainty("2.5 mm/V").quantity == "2.5 mm/V");
  CHECK_FALSE(split_uncertainty("2.5 mm/V").relative);
  for (const char* text : {"2.5 mm/V ± 1 V", "2.5 mm/V ±", "mm/V ± 1 %", "0 ± 1 %", "2.5 ± -1 %"}) {
    CAPTURE(text);
    CHECK_FALSE(split_uncertainty(text).fault.empty());
  }
}
