// Every kind of law parameter from YAML to the values a law is made of, with a table that no shipped law has.
#include <algorithm>
#include <catch2/catch.hpp>

#include "scenarios/format/law_values.hpp"
#include "scenarios/format/reader.hpp"
#include "tests/support/parameter_table.hpp"

using namespace dualdamp;

namespace {

const std::vector<friction::Parameter> both_forms = test::parameters_of_two_forms();

scenarios::Reading reading_of(const std::string& text) {
  const scenarios::Document document("test.yaml", text);
  return scenarios::read(document, {scenarios::fields_of(both_forms)});
}

/// The values from which a law is made; the text must be valid.
friction::ParameterValues values_of(const std::string& text) {
  const scenarios::Reading reading = reading_of(text);
  REQUIRE(reading.problems.empty());
  friction::ParameterValues values = scenarios::law_values(both_forms, reading.values);
  REQUIRE(friction::complete(both_forms, values).empty());
  return values;
}

/// "line:column: message" of each problem.
std::vector<std::string> messages_of(const std::string& text) {
  std::vector<std::string> list;
  for (const core::Diagnostic& problem : reading_of(text).problems)
    list.push_back(std::to_string(problem.place.line) + ":" + std::to_string(problem.place.column) + ": " +
                   problem.message);
  return list;
}

using Problems = std::vector<std::string>;

}  // namespace

TEST_CASE("law parameters: lists, counts, words, flags and records", "[scenarios][parameters]") {
  const auto list = values_of("elements: [{stiffness: 1 kN/m, limit: 2 N}, {stiffness: 50 N/m, limit: 0 N}]\n");
  REQUIRE(list.list("elements").size() == 2);
  CHECK(list.list("elements")[0].number("stiffness") == 1000.0);
  CHECK(list.list("elements")[1].number("limit") == 0.0);
  CHECK(list.flag("symmetric"));

  const auto divided = values_of(
      "total: 3 N\ncount: 20\nform: linear\nsymmetric: false\ndrift: -1 1/min\n"
      "fluctuation: {ratio: 0.1, correlation_time: 20 ms, seed: 9007199254740991}\n");
  CHECK(divided.count("count") == 20);
  CHECK(divided.choice("form") == "linear");
  CHECK_FALSE(divided.flag("symmetric"));
  CHECK(divided.number("drift") == Approx(-1.0 / 60.0).epsilon(1e-15));
  CHECK(divided.record("fluctuation").number("correlation_time") == Approx(0.02).epsilon(1e-15));
  CHECK(divided.record("fluctuation").seed("seed") == 9007199254740991U);
}

TEST_CASE("law parameters: the resolved form means the same, in the order of the table",
          "[scenarios][parameters]") {
  const auto values =
      values_of("fluctuation: {ratio: 0.1, correlation_time: 2 s, seed: 3}\ntotal: 3 N\ncount: 2\n");
  const scenarios::Json json = scenarios::law_json(both_forms, values);
  CHECK(json.dump() == R"({"total":3.0,"count":2,"form":"uniform","symmetric":true,)"
                       R"("fluctuation":{"ratio":0.1,"correlation_time":2.0,"seed":3}})");
  CHECK(scenarios::law_json(both_forms, scenarios::law_values(both_forms, json)) == json);
}

TEST_CASE("law parameters: one form or the other", "[scenarios][parameters]") {
  CHECK(messages_of("symmetric: true\n") == Problems{"1:1: 'elements' is missing"});
  CHECK(messages_of("form: linear\ntotal: 1 N\n") ==
        Problems{"1:1: 'count' is missing: it is needed without 'elements'"});
  CHECK(messages_of("elements: [{stiffness: 1, limit: 1}]\nform: linear\ncount: x\n") ==
        Problems{"3:1: 'count' stands beside 'elements', which it replaces",
                 "2:1: 'form' stands beside 'elements', which it replaces"});
  CHECK(reading_of("symmetric: true\n").problems[0].allowed ==
        "a list of 1 to 10000 maps; or total, count, form instead");
  // A value that cannot be read is not missing.
  CHECK(messages_of("elements: 7\n") == Problems{"1:11: 'elements' is of the wrong kind"});
  CHECK(messages_of("total: 1 N\ncount: 1.5\n") == Problems{"2:8: 'count' is of the wrong kind"});
}

TEST_CASE("law parameters: faults are told at the item and by its number", "[scenarios][parameters]") {
  CHECK(messages_of("elements:\n"
                    "  - {stiffness: 1000 N/m, limit: 2 N}\n"
                    "  - {stiffness: 0 N/m, limit: 2 kg}\n"
                    "  - {stifness: 10 N/m, limit: 2 N}\n"
                    "  - 5 N\n"
                    "  - {stiffness: 10 N/m, limit: -2 N}\n") ==
        Problems{"3:17: 'elements[1].stiffness' is out of range",
                 "3:31: 'elements[1].limit': 'kg' is not a unit of a force",
                 "4:6: unknown key 'stifness' in 'elements[2]'", "4:5: 'elements[2].stiffness' is missing",
                 "5:5: 'elements[3]' is of the wrong kind", "6:32: 'elements[4].limit' is out of range"});
  CHECK(messages_of(
            "total: 1 N\ncount: 2\nform: linaer\nfluctuation: {ratio: 2, correlation_time: 0 s, seed: -1}\n") ==
        Problems{"3:7: 'form' cannot be 'linaer'", "4:22: 'fluctuation.ratio' is out of range",
                 "4:43: 'fluctuation.correlation_time' is out of range",
                 "4:54: 'fluctuation.seed' is out of range"});
}

TEST_CASE("law parameters: a list has a largest length", "[scenarios][parameters]") {
  std::string text = "elements:\n";
  for (int i = 0; i < 10'001; ++i) text += "  - {stiffness: 1, limit: 1}\n";
  CHECK(messages_of(text) == Problems{"2:3: 'elements' has the wrong number of items"});
  CHECK(messages_of("elements: []\n") == Problems{"1:11: 'elements' has the wrong number of items"});
}

TEST_CASE("law parameters: --set reaches into a list", "[scenarios][parameters]") {
  scenarios::Document document("test.yaml", "elements: [{stiffness: 1, limit: 1}, {stiffness: 2, limit: 2}]\n");
  document.set("elements[1].limit=3", "--set");
  const scenarios::Reading reading = scenarios::read(document, {scenarios::fields_of(both_forms)});
  REQUIRE(reading.problems.empty());
  CHECK(scenarios::law_values(both_forms, reading.values).list("elements")[1].number("limit") == 3.0);
}
