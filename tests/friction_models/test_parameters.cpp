#include "friction_models/parameters.hpp"

#include <catch2/catch.hpp>
#include <limits>

using namespace dualdamp::friction;

namespace {

const std::vector<Parameter> table = {
    {.name = "kinetic", .unit = "N", .range = {.low = 0.0}, .meaning = "level"},
    {.name = "static",
     .unit = "N",
     .same_as = "kinetic",
     .range = {.low = 0.0},
     .at_least = "kinetic",
     .meaning = "limit"},
    {.name = "exponent", .unit = "1", .fallback = 2.0, .range = {.low = 0.0, .low_open = true}, .meaning = "power"},
};

}  // namespace

TEST_CASE("parameters: defaults are filled in", "[friction][parameters]") {
  ParameterValues values = {{"kinetic", 2.0}};
  CHECK(complete(table, values).empty());
  CHECK(values.at("static") == 2.0);
  CHECK(values.at("exponent") == 2.0);
}

TEST_CASE("parameters: every fault is reported", "[friction][parameters]") {
  ParameterValues values = {{"static", -1.0}, {"exponent", 0.0}, {"colour", 1.0}};
  const std::vector<ParameterFault> faults = complete(table, values);
  REQUIRE(faults.size() == 4);
  CHECK(faults[0].name == "colour");
  CHECK(faults[1].message == "'kinetic' is missing");
  CHECK(faults[2].allowed == ">= 0 N");
  CHECK(faults[2].found == "-1 N");
  CHECK(faults[3].allowed == "> 0");
}

TEST_CASE("parameters: bounds between parameters, and what is not finite", "[friction][parameters]") {
  ParameterValues below = {{"kinetic", 2.0}, {"static", 1.0}};
  REQUIRE(complete(table, below).size() == 1);
  CHECK(complete(table, below)[0].allowed == ">= 2 N");
  ParameterValues broken = {{"kinetic", std::numeric_limits<double>::quiet_NaN()}};
  REQUIRE_FALSE(complete(table, broken).empty());
  CHECK(complete(table, broken)[0].message == "'kinetic' is not finite");
}

TEST_CASE("parameters: ranges in words", "[friction][parameters]") {
  CHECK(Range{}.describe("N") == "any finite value");
  CHECK(Range{.low = 0.0, .high = 1.0, .low_open = true}.describe("1") == "> 0 and <= 1");
  CHECK(Range{.high = 3.0, .high_open = true}.describe("m") == "< 3 m");
}
