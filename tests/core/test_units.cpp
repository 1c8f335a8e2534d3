#include "core/units.hpp"

#include <catch2/catch.hpp>
#include <numbers>
#include <thread>
#include <vector>

using namespace dualdamp::core;

namespace {

constexpr double pi = std::numbers::pi;

double si(const char* text, const char* unit) {
  const QuantityText quantity = parse_quantity(text, unit);
  CAPTURE(text, quantity.fault);
  REQUIRE(quantity.value.has_value());
  return *quantity.value;
}

std::string fault(const char* text, const char* unit) {
  const QuantityText quantity = parse_quantity(text, unit);
  CAPTURE(text);
  CHECK_FALSE(quantity.value.has_value());
  return quantity.fault;
}

}  // namespace

TEST_CASE("units: what an engineer types", "[core][units]") {
  CHECK(si("1.042 kg", "kg") == 1.042);
  CHECK(si("200 g", "kg") == 0.2);
  CHECK(si("3 um", "m") == 3e-6);
  CHECK(si("3um", "m") == 3e-6);
  CHECK(si("3 \u00b5m", "m") == 3e-6);
  CHECK(si("3 \u03bcm", "m") == 3e-6);
  CHECK(si("5 mm", "m") == 0.005);
  CHECK(si("1 in", "m") == 0.0254);
  CHECK(si("5 N/mm", "N/m") == 5000.0);
  CHECK(si("1.5 kN/m", "N/m") == 1500.0);
  for (const char* text :
       {"4 N.s/m", "4 N*s/m", "4 N s/m", "4 N\u00b7s/m", "4 kg/s", "4 s.N/m", "4 N.s.m^-1", "4 N.s.m-1"})
    CHECK(si(text, "N.s/m") == 4.0);
  CHECK(si("20 ms", "s") == 0.02);
  CHECK(si("36 km/h", "m/s") == Approx(10.0).epsilon(1e-15));
  CHECK(si("2000 N/m\u00b3", "N/m^3") == 2000.0);
  CHECK(si("20 %", "1") == 0.2);
  CHECK(si("-3 %/min", "1/s") == Approx(-0.0005).epsilon(1e-15));
  CHECK(si("5", "kg") == 5.0);
}

TEST_CASE("units: units with an exact definition have it", "[core][units]") {
  struct Exact {
    const char* text;
    const char* si_unit;
    double value;
  };
  constexpr double pound = 0.45359237;
  constexpr double foot = 0.3048;
  for (const Exact& exact : std::vector<Exact>{{"1 lb", "kg", pound},
                                               {"1 oz", "kg", 0.028349523125},
                                               {"1 avoirdupois_ounce", "kg", 0.028349523125},
                                               {"1 dram", "kg", 0.0017718451953125},
                                               {"1 grain", "kg", 6.479891e-5},
                                               {"1 troy_ounce", "kg", 0.0311034768},
                                               {"1 ton", "kg", 907.18474},
                                               {"1 long_ton", "kg", 1016.0469088},
                                               {"1 t", "kg", 1000.0},
                                               {"1 slug", "kg", 14.593902937206365},
                                               {"1 slugs", "kg", 14.593902937206365},
                                               {"1 in", "m", 0.0254},
                                               {"1 mil", "m", 2.54e-5},
                                               {"1 ft", "m", foot},
                                               {"1 yd", "m", 0.9144},
                                               {"1 mi", "m", 1609.344},
                                               {"1 lbf", "N", 4.4482216152605},
                                               {"1 ozf", "N", 0.27801385095378125},
                                               {"1 ounce_force", "N", 0.27801385095378125},
                                               {"1 kip", "N", 4448.2216152605},
                                               {"1 poundal", "N", 0.138254954376},
                                               {"1 kgf", "N", 9.80665},
                                               {"1 gf", "N", 0.00980665},
                                               {"1 dyne", "N", 1e-5},
                                               {"1 dyn", "N", 1e-5},
                                               {"1 g", "m/s^2", 9.80665},
                                               {"1 g_n", "m/s^2", 9.80665},
                                               {"1 gal", "m/s^2", 0.01},
                                               {"1 mi/h", "m/s", 0.44704},
                                               {"1 knot", "m/s", 1852.0 / 3600.0},
                                               {"1 lbf/in", "N/m", 175.12683524647636},
                                               {"1 ozf.in", "N.m", 0.0070615518142260438},
                                               {"1 lbf.ft", "N.m", 1.3558179483314004},
                                               {"1 lbf.s/in", "N.s/m", 175.12683524647636},
                                               {"1 psi", "Pa", 6894.7572931683608},
                                               {"1 psi.in", "N/m", 175.12683524647636},
                                               {"1 hp", "W", 745.69987158227022},
                                               {"1 deg", "rad", pi / 180.0},
                                               {"1 rpm", "rad/s", pi / 30.0}}) {
    const QuantityText quantity = parse_quantity(exact.text, exact.si_unit);
    CAPTURE(exact.text, exact.value, quantity.fault);
    REQUIRE(quantity.value.has_value());
    CHECK(*quantity.value == Approx(exact.value).epsilon(4e-16));
  }
}

TEST_CASE("units: a hertz is 2 pi radians a second", "[core][units]") {
  CHECK(si("1 Hz", "rad/s") == 2.0 * pi);
  CHECK(si("6.17 Hz", "rad/s") == 6.17 * 2.0 * pi);
  CHECK(si("1 kHz", "rad/s") == Approx(2000.0 * pi).epsilon(1e-15));
  CHECK(si("60 rpm", "rad/s") == Approx(2.0 * pi).epsilon(1e-15));
  CHECK(si("38.79 rad/s", "rad/s") == 38.79);
  CHECK(fault("10", "rad/s").find("needs its unit") != std::string::npos);
  CHECK(fault("10 1/s", "rad/s").find("not a unit of a frequency") != std::string::npos);
  CHECK(fault("10 deg/s", "rad/s").find("not a unit of a frequency") != std::string::npos);
}

TEST_CASE("units: rates and frequencies do not mix", "[core][units]") {
  CHECK(si("1 kHz", "1/s") == 1000.0);
  CHECK(si("1 1/s", "1/s") == 1.0);
  CHECK(fault("1 rad/s", "1/s").find("not a unit of a rate") != std::string::npos);
  CHECK(fault("1 rpm", "1/s").find("not a unit of a rate") != std::string::npos);
  CHECK(fault("0.2 rad", "1").find("not a unit of a number") != std::string::npos);
}

TEST_CASE("units: angles", "[core][units]") {
  CHECK(si("90 deg", "rad") == pi / 2.0);
  CHECK(si("90\u00b0", "rad") == pi / 2.0);
  CHECK(si("180 deg", "rad") == pi);
  CHECK(si("1", "rad") == 1.0);
  CHECK(si("0.25 turn", "rad") == Approx(pi / 2.0).epsilon(1e-15));
  CHECK(si("30 arcmin", "rad") == Approx(pi / 360.0).epsilon(1e-15));
  CHECK(fault("1 m", "rad").find("not a unit of an angle") != std::string::npos);
  CHECK(fault("1 rev", "rad").find("not known") != std::string::npos);
  CHECK(fault("5 %", "rad").find("not a unit of an angle") != std::string::npos);
}

TEST_CASE("units: the wrong dimension is refused, reciprocals included", "[core][units]") {
  CHECK(fault("1 N", "kg") == "'N' is not a unit of a mass");
  CHECK(fault("4 N/m", "N.s/m") == "'N/m' is not a unit of a damping coefficient");
  CHECK(fault("10 Hz", "s") == "'Hz' is not a unit of a time");
  CHECK(fault("10 s", "1/s") == "'s' is not a unit of a rate");
  CHECK(fault("20 degC", "K").find("not a unit") != std::string::npos);
}

TEST_CASE("units: udunits2 never sees what it would misread", "[core][units]") {
  for (const char* text : {"5 m^0.5", "5 % m", "5 m.%",   "5 percent m",    "5 m^1/2",       "5 m^(1/2)", "5 m0.5",
                           "5 2 m",   "5 m 2", "5 m @ 3", "5 s since 1990", "5 lg(re 1 mW)", "5 m^",      "5 /s",
                           "5 m^10",  "5 m)",  "5 (m",    "5 m..m",         "5 1000 m",      "5 m\nm"})
    CHECK(fault(text, "m").find("is not a unit") != std::string::npos);
}

TEST_CASE("units: an unknown unit, and one that differs in case only", "[core][units]") {
  CHECK(fault("9 bananas", "N") == "the unit 'bananas' is not known");
  CHECK(parse_quantity("5 KG", "kg").suggestion == "5 kg");
  CHECK(parse_quantity("5 n", "N").suggestion == "5 N");
  CHECK(parse_quantity("4 Ns/m", "N.s/m").suggestion == "4 N.s/m");
  CHECK(parse_quantity("0.3 kgm2", "kg", dualdamp::core::Coordinate::angle).suggestion == "0.3 kg.m^2");
}

TEST_CASE("units: all usual units are units of their dimension", "[core][units]") {
  for (const char* dimension : {"1", "kg", "m", "s", "N", "N/m", "N.s/m", "m/s", "m/s^2", "N/s", "N/m^3", "1/s",
                                "J", "W", "rad", "rad/s"}) {
    REQUIRE_FALSE(usual_units(dimension).empty());
    CHECK(usual_units(dimension).front() == dimension);
    for (const std::string_view unit : usual_units(dimension)) {
      CAPTURE(dimension, unit);
      if (unit != "1") CHECK(parse_quantity("1 " + std::string(unit), dimension).value.has_value());
    }
  }
}

TEST_CASE("units: factors for the heads of columns", "[core][units]") {
  CHECK(unit_factor("mm", "m").value == 1e-3);
  CHECK(unit_factor("", "m").value == 1.0);
  CHECK_FALSE(unit_factor("kg", "m").value.has_value());
}

TEST_CASE("units: several threads may ask at once", "[core][units]") {
  std::vector<std::jthread> threads;
  std::vector<int> good(4, 0);
  for (std::size_t t = 0; t < good.size(); ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 500; ++i)
        good[t] += parse_quantity(std::to_string(i) + " N/cm", "N/m").value == 100.0 * i ? 1 : 0;
    });
  threads.clear();
  for (const int count : good) CHECK(count == 500);
}

TEST_CASE("units that name a dimension are those of SI with factor 1", "[core][units]") {
  for (const char* unit : {"1", "N", "N.s/m", "m/s^2", "rad/s", "kg", "Pa", "1/m", "kg.m^2/s"}) {
    INFO(unit);
    CHECK(is_si(unit));
  }
  for (const char* unit :
       {"", "g", "mm", "lbf", "parsec", "degC", "%", "2 N", "N.mm", "N.m/rad", "rpm", "nonsense"}) {
    INFO(unit);
    CHECK_FALSE(is_si(unit));
  }
}

TEST_CASE("units: a long unit is quoted up to a whole character", "[core][units]") {
  // Every second byte of the unit begins a micro sign, so one of the two texts has one across the limit.
  for (const std::string start : {"1 ", "1 m"}) {
    std::string text = start;
    for (int i = 0; i < 60; ++i) text += "\u00b5";
    const std::string message = fault(text.c_str(), "m");
    CAPTURE(message);
    CHECK(message.find("\u00b5...'") != std::string::npos);
    for (std::size_t at = 0; at < message.size(); ++at)
      if (message[at] == '\xC2') CHECK(message[at + 1] == '\xB5');
  }
}
