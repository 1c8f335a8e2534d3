#include "core/coordinate.hpp"

#include <catch2/catch.hpp>
#include <numbers>
#include <string>

#include "core/uncertain_quantity.hpp"
#include "core/units.hpp"

using dualdamp::core::Coordinate;
using dualdamp::core::coordinate_told_by;
using dualdamp::core::parse_quantity;
using dualdamp::core::unit_for;

namespace {

double of_rotation(const char* text, const char* dimension) {
  const auto quantity = parse_quantity(text, dimension, Coordinate::angle);
  INFO(text << ": " << quantity.fault);
  REQUIRE(quantity.value.has_value());
  return *quantity.value;
}

std::string fault_of(const char* text, const char* dimension, Coordinate coordinate) {
  const auto quantity = parse_quantity(text, dimension, coordinate);
  CHECK_FALSE(quantity.value.has_value());
  return quantity.fault;
}

}  // namespace

TEST_CASE("coordinate: the units of an angle follow from those of a displacement", "[core][coordinate]") {
  const std::pair<const char*, const char*> twins[] = {{"m", "rad"},
                                                       {"kg", "kg.m^2"},
                                                       {"N", "N.m"},
                                                       {"N/m", "N.m/rad"},
                                                       {"N.s/m", "N.m.s/rad"},
                                                       {"m/s", "rad/s"},
                                                       {"m/s^2", "rad/s^2"},
                                                       {"N/s", "N.m/s"},
                                                       {"N/m^3", "N.m/rad^3"},
                                                       {"m^2.s", "rad^2.s"},
                                                       {"N^2.s", "N^2.m^2.s"},
                                                       {"m^2/s^2", "rad^2/s^2"},
                                                       {"N.s^2/m^2", "N.m.s^2/rad^2"},
                                                       {"m/N", "rad/N/m"},
                                                       {"1/s", "1/s"},
                                                       {"s", "s"},
                                                       {"J", "J"},
                                                       {"W", "W"},
                                                       {"1", "1"},
                                                       {"", ""},
                                                       {"rad", "rad"}};
  for (const auto& [unit, twin] : twins) {
    CAPTURE(unit);
    CHECK(unit_for(Coordinate::angle, unit) == twin);
    CHECK(unit_for(Coordinate::angle, twin) == twin);
    CHECK(unit_for(Coordinate::displacement, unit) == unit);
  }
}

TEST_CASE("coordinate: quantities of rotation", "[core][coordinate]") {
  CHECK(of_rotation("0.3 kg.m^2", "kg") == 0.3);
  CHECK(of_rotation("3 kg.cm^2", "kg") == Approx(3e-4).epsilon(1e-15));
  CHECK(of_rotation("12 N.m/rad", "N/m") == 12.0);
  CHECK(of_rotation("12 N·m/rad", "N/m") == 12.0);
  CHECK(of_rotation("1 N.m/deg", "N/m") == Approx(180.0 / std::numbers::pi).epsilon(1e-15));
  CHECK(of_rotation("4 mN.m.s/rad", "N.s/m") == 0.004);
  CHECK(of_rotation("90 deg", "m") == std::numbers::pi / 2.0);
  CHECK(of_rotation("90", "m") == 90.0);
  CHECK(of_rotation("-3 rad/s", "m/s") == -3.0);
  CHECK(of_rotation("0", "m/s") == 0.0);
  CHECK(of_rotation("180°/s", "m/s") == Approx(std::numbers::pi).epsilon(1e-15));
  CHECK(of_rotation("60 rpm", "m/s") == Approx(2.0 * std::numbers::pi).epsilon(1e-15));
  CHECK(of_rotation("2 N.m", "N") == 2.0);
  CHECK(of_rotation("6 Hz", "rad/s") == 12.0 * std::numbers::pi);
  const auto uncertain = dualdamp::core::parse_uncertain_quantity("0.3 kg.m^2 +- 1 %", "kg", Coordinate::angle);
  CHECK(uncertain.value == 0.3);
  CHECK(*uncertain.uncertainty == Approx(0.003));
}

TEST_CASE("coordinate: a unit of the other kind is refused, and one without its radian", "[core][coordinate]") {
  CHECK(fault_of("3 kg", "kg", Coordinate::angle) == "'kg' is not a unit of a moment of inertia");
  CHECK(fault_of("3 mm", "m", Coordinate::angle) == "'mm' is not a unit of an angle");
  CHECK(fault_of("3 Hz", "m/s", Coordinate::angle) == "'Hz' is not a unit of an angular velocity");
  CHECK(fault_of("3 N.m", "N/m", Coordinate::angle) == "'N.m' is not a unit of a torsional stiffness");
  CHECK(parse_quantity("3 N.m", "N/m", Coordinate::angle).suggestion == "3 N.m/rad");
  CHECK(parse_quantity("3 N.m.s", "N.s/m", Coordinate::angle).suggestion == "3 N.m.s/rad");
  CHECK(fault_of("3 N.m/rad", "N/m", Coordinate::displacement) == "'N.m/rad' is not a unit of a stiffness");
  CHECK(fault_of("3 deg", "m", Coordinate::displacement) == "'deg' is not a unit of a length");
}

TEST_CASE("coordinate: usual units of rotation are units of their dimension", "[core][coordinate]") {
  for (const char* dimension : {"kg", "m", "N", "N/m", "N.s/m", "m/s", "m/s^2", "N/s", "N/m^3", "m^2.s", "N^2.s"}) {
    CAPTURE(dimension);
    const auto& units = dualdamp::core::usual_units(dimension, Coordinate::angle);
    REQUIRE_FALSE(units.empty());
    CHECK(units.front() == unit_for(Coordinate::angle, dimension));
    for (const std::string_view unit : units) {
      CAPTURE(unit);
      CHECK(parse_quantity("1 " + std::string(unit), dimension, Coordinate::angle).value.has_value());
      CHECK(coordinate_told_by(unit, dimension) == Coordinate::angle);
    }
  }
}

TEST_CASE("coordinate: what a unit tells", "[core][coordinate]") {
  CHECK(coordinate_told_by("kg", "kg") == Coordinate::displacement);
  CHECK(coordinate_told_by("N.m", "N") == Coordinate::angle);
  CHECK(coordinate_told_by("Hz", "rad/s") == std::nullopt);
  CHECK(coordinate_told_by("", "kg") == std::nullopt);
  CHECK(coordinate_told_by("bananas", "kg") == std::nullopt);
}
