#include "friction_models/parameters.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "tests/support/parameter_table.hpp"

using namespace dualdamp::friction;

namespace {

const std::vector<Parameter> force_levels = {
    {.name = "kinetic", .unit = "N", .range = {.low = 0.0}, .meaning = "level"},
    {.name = "static",
     .unit = "N",
     .same_as = "kinetic",
     .range = {.low = 0.0},
     .at_least = "kinetic",
     .meaning = "limit"},
    {.name = "exponent", .unit = "1", .fallback = 2.0, .range = {.low = 0.0, .low_open = true}, .meaning = "power"},
};

const std::vector<Parameter> kinds = dualdamp::test::parameters_of_two_forms();

using Records = std::vector<ParameterValues>;

/// "name: message" of each fault.
std::vector<std::string> faults_of(ParameterValues values) {
  std::vector<std::string> list;
  for (const ParameterFault& fault : complete(kinds, values)) list.push_back(fault.name + ": " + fault.message);
  return list;
}

using Faults = std::vector<std::string>;

}  // namespace

TEST_CASE("parameters: defaults are filled in", "[friction][parameters]") {
  ParameterValues values = {{"kinetic", 2.0}};
  CHECK(complete(force_levels, values).empty());
  CHECK(values.number("static") == 2.0);
  CHECK(values.number("exponent") == 2.0);
}

TEST_CASE("parameters: every fault is reported", "[friction][parameters]") {
  ParameterValues values = {{"static", -1.0}, {"exponent", 0.0}, {"colour", 1.0}};
  const std::vector<ParameterFault> faults = complete(force_levels, values);
  REQUIRE(faults.size() == 4);
  CHECK(faults[0].name == "colour");
  CHECK(faults[1].message == "'kinetic' is missing");
  CHECK(faults[2].allowed == ">= 0 N");
  CHECK(faults[2].found == "-1 N");
  CHECK(faults[3].allowed == "> 0");
}

TEST_CASE("parameters: bounds between parameters, and what is not finite", "[friction][parameters]") {
  ParameterValues below = {{"kinetic", 2.0}, {"static", 1.0}};
  REQUIRE(complete(force_levels, below).size() == 1);
  CHECK(complete(force_levels, below)[0].allowed == ">= 2 N");
  ParameterValues broken = {{"kinetic", std::numeric_limits<double>::quiet_NaN()}};
  REQUIRE_FALSE(complete(force_levels, broken).empty());
  CHECK(complete(force_levels, broken)[0].message == "'kinetic' is not finite");
}

TEST_CASE("parameters: ranges in words", "[friction][parameters]") {
  CHECK(Range{}.describe("N") == "any finite value");
  CHECK(Range{.low = 0.0, .high = 1.0, .low_open = true}.describe("1") == "> 0 and <= 1");
  CHECK(Range{.high = 3.0, .high_open = true}.describe("m") == "< 3 m");
}

TEST_CASE("parameters: each kind is read by its type", "[friction][parameters]") {
  ParameterValues values = {
      {"total", 3.0},
      {"count", 5.0},
      {"symmetric", false},
      {"fluctuation", Records{{{"ratio", 0.5}, {"correlation_time", 1.0}, {"seed", 9007199254740991.0}}}}};
  REQUIRE(complete(kinds, values).empty());
  CHECK(values.count("count") == 5);
  CHECK(values.choice("form") == "uniform");
  CHECK_FALSE(values.flag("symmetric"));
  CHECK(values.record("fluctuation").number("ratio") == 0.5);
  CHECK(values.record("fluctuation").seed("seed") == 9007199254740991U);
  CHECK_FALSE(values.has("elements"));
  CHECK_THROWS(values.number("elements"));
  CHECK_THROWS(values.number("form"));
}

TEST_CASE("parameters: records of a list get their own defaults", "[friction][parameters]") {
  ParameterValues values = {{"elements", Records{{{"stiffness", 10.0}}, {{"stiffness", 20.0}, {"limit", 2.0}}}}};
  REQUIRE(complete(kinds, values).empty());
  REQUIRE(values.list("elements").size() == 2);
  CHECK(values.list("elements")[0].number("limit") == 1.0);
  CHECK(values.list("elements")[1].number("limit") == 2.0);
  // The other form's defaults stay away, and what is optional has no value.
  CHECK_FALSE(values.has("form"));
  CHECK_FALSE(values.has("fluctuation"));
  CHECK(values.flag("symmetric"));
}

TEST_CASE("parameters: one form or the other", "[friction][parameters]") {
  const ParameterValues::Value elements = Records{{{"stiffness", 10.0}}};
  CHECK(faults_of({}) == Faults{"elements: 'elements' is missing"});
  CHECK(faults_of({{"total", 1.0}}) == Faults{"count: 'count' is missing"});
  CHECK(faults_of({{"form", "linear"}}) == Faults{"total: 'total' is missing", "count: 'count' is missing"});
  CHECK(faults_of({{"elements", elements}, {"count", 2.0}, {"form", "linear"}}) ==
        Faults{"count: 'count' stands beside 'elements', which it replaces",
               "form: 'form' stands beside 'elements', which it replaces"});
  ParameterValues none;
  CHECK(complete(kinds, none)[0].allowed ==
        "a list of 1 to 10000 records of stiffness, limit; or total, count, form instead");
}

TEST_CASE("parameters: faults inside records are named by their way", "[friction][parameters]") {
  CHECK(faults_of({{"elements", Records{{{"stiffness", 1.0}},
                                        {{"stiffness", 0.0}, {"limit", -1.0}},
                                        {{"limit", 1.0}, {"colour", 1.0}}}},
                   {"fluctuation", Records{{{"ratio", 2.0}, {"correlation_time", 1.0}, {"seed", -1.0}}}}}) ==
        Faults{"elements[1].stiffness: 'elements[1].stiffness' is out of range",
               "elements[1].limit: 'elements[1].limit' is out of range",
               "elements[2].colour: there is no parameter 'elements[2].colour'",
               "elements[2].stiffness: 'elements[2].stiffness' is missing",
               "fluctuation.ratio: 'fluctuation.ratio' is out of range",
               "fluctuation.seed: 'fluctuation.seed' is out of range"});
}

TEST_CASE("parameters: faults of each kind", "[friction][parameters]") {
  CHECK(faults_of({{"total", 1.0}, {"count", 2.5}}) == Faults{"count: 'count' is not a whole number"});
  CHECK(faults_of({{"total", 1.0}, {"count", 101.0}}) == Faults{"count: 'count' is out of range"});
  CHECK(faults_of({{"total", 1.0}, {"count", 1.0}, {"form", "cubic"}}) == Faults{"form: 'form' cannot be 'cubic'"});
  CHECK(faults_of({{"total", "much"}, {"count", true}}) ==
        Faults{"total: 'total' is of the wrong kind", "count: 'count' is of the wrong kind"});
  CHECK(faults_of({{"elements", Records{}}}) == Faults{"elements: 'elements' has the wrong number of items"});
  CHECK(faults_of({{"elements", Records(10'001, {{"stiffness", 1.0}})}}) ==
        Faults{"elements: 'elements' has the wrong number of items"});
  CHECK(faults_of({{"elements", Records{{{"stiffness", 1.0}}}}, {"fluctuation", Records(2)}, {"symmetric", 1.0}}) ==
        Faults{"symmetric: 'symmetric' is of the wrong kind", "fluctuation: 'fluctuation' is of the wrong kind"});
}
