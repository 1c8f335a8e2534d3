#include "core/numbers.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>

using namespace dualdamp::core;

TEST_CASE("numbers: the grammar of JSON is accepted", "[core][numbers]") {
  const std::pair<const char*, double> cases[] = {{"5", 5.0},         {"-0.5", -0.5},     {"1e-3", 1e-3},
                                                  {"1.0e-3", 1e-3},   {"0", 0.0},         {"0.0", 0.0},
                                                  {"1E5", 1e5},       {"2e+3", 2000.0},   {"0e-400", 0.0},
                                                  {"1e-310", 1e-310}, {"123.25", 123.25}, {"11.6e4", 116000.0}};
  for (const auto& [text, value] : cases) {
    CAPTURE(text);
    REQUIRE(parse_number(text).value.has_value());
    CHECK(*parse_number(text).value == value);
  }
}

TEST_CASE("numbers: what only looks like a number is refused with its reason", "[core][numbers]") {
  const std::pair<const char*, const char*> cases[] = {
      {"+1", "plus"},         {"010", "leading zero"},   {"00", "leading zero"},   {".5", "before its point"},
      {"-.5", "before"},      {"5.", "after its point"}, {"0x10", "hexadecimal"},  {"nan", "not finite"},
      {".nan", "not finite"}, {"-inf", "not finite"},    {".Inf", "not finite"},   {"1e-400", "outside the range"},
      {"1e400", "outside"},   {"0,5", "comma"},          {"1,000", "comma"},       {"1_000", "followed"},
      {"1 2", "followed"},    {"", "missing"},           {"five", "with a digit"}, {"-", "missing"},
      {"1e", "followed"},     {"1.2.3", "followed"}};
  for (const auto& [text, reason] : cases) {
    CAPTURE(text, reason);
    CHECK_FALSE(parse_number(text).value.has_value());
    CHECK(parse_number(text).fault.find(reason) != std::string::npos);
  }
}

TEST_CASE("numbers: reading stops where the unit begins", "[core][numbers]") {
  CHECK(read_number("5 kg").length == 1);
  CHECK(read_number("1e-3kg").length == 4);
  CHECK(read_number("5eV").length == 1);
  CHECK(read_number("5e3V").length == 3);
}

TEST_CASE("numbers: what is written reads back to the same bits", "[core][numbers]") {
  std::mt19937_64 random(20240607);
  for (int i = 0; i < 20'000; ++i) {
    double value = 0.0;
    const std::uint64_t bits = random();
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    const std::string text = format_number(value);
    CAPTURE(text);
    REQUIRE(parse_number(text).value == value);
  }
}

TEST_CASE("numbers: an exponent comes with a point, for readers of YAML 1.1", "[core][numbers]") {
  CHECK(format_number(1e-5) == "1.0e-05");
  CHECK(format_number(1.5e-7) == "1.5e-07");
  CHECK(format_number(0.1) == "0.1");
  CHECK(format_number(100.0) == "100");
  CHECK(format_number(0.18607809795678620, 6) == "0.186078");
}

TEST_CASE("numbers: a share is written in percent, with a sign where it is a change", "[core][numbers]") {
  CHECK(percent(0.03, 1) == "3 %");
  CHECK(percent(-0.12345, 3) == "-12.3 %");
  CHECK(signed_percent(0.12345, 2) == "+12 %");
  CHECK(signed_percent(-0.5, 2) == "-50 %");
  CHECK(signed_percent(0.0, 2) == "+0 %");
}

TEST_CASE("numbers: a share above its digits is in whole percents, without an exponent", "[core][numbers]") {
  CHECK(percent(0.12, 1) == "12 %");
  CHECK(percent(0.098, 1) == "10 %");
  CHECK(percent(0.996, 2) == "100 %");
  CHECK(percent(1.234, 2) == "123 %");
  CHECK(signed_percent(-34.56, 3) == "-3456 %");
  CHECK(percent(1e5, 3) == "1e+07 %");
}

TEST_CASE("numbers: the range of sizes as text is the range of sizes, and its squares are finite",
          "[core][numbers]") {
  const NumberText least = read_number(magnitude_range);
  CHECK(*least.value == least_magnitude);
  CHECK(*parse_number(magnitude_range.substr(magnitude_range.rfind(' ') + 1)).value == most_magnitude);
  CHECK(least_magnitude * least_magnitude > 0.0);
  CHECK(std::isfinite(most_magnitude * most_magnitude));
}
