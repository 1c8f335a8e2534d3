#include "identify/methods.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/identify/records.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

TEST_CASE("The list of methods is sorted, complete and can be searched") {
  const auto& list = methods();
  REQUIRE(list.size() >= 3);
  CHECK(std::is_sorted(list.begin(), list.end(),
                       [](const MethodEntry& a, const MethodEntry& b) { return a.name < b.name; }));
  for (const MethodEntry& method : list) {
    CAPTURE(method.name);
    CHECK(find_method(method.name) == &method);
    CHECK_FALSE(method.summary.empty());
    CHECK_FALSE(method.assumes.empty());
    CHECK_FALSE(method.equation.empty());
    // Every method names itself, and says so when the record is not of its kind.
    const Estimate e = method.run(Record{}, table_1_constants, {});
    CHECK(e.method == method.name);
    CHECK_FALSE(e.outcome.ok());
    CHECK(e.reason == method.lacks(Record{}));
    CHECK_FALSE(method.sources.empty());
  }
  CHECK(find_method("free_decay")->needs == RecordKind::decay);
  CHECK(find_method("resonance_two_point")->needs == RecordKind::pairs);
  CHECK(find_method("resonance_two_point")->lacks(Record{}) == "the record holds no x-Y pairs");
  CHECK(find_method("resonance") == nullptr);
  CHECK(find_method("") == nullptr);
}

TEST_CASE("Pairs at several frequencies are no record of a resonance method") {
  Record record;
  record.pairs = PairRecord{{{.Y = 0.1, .x = 0.2, .sweep = {}, .number = 1, .omega = 10.0},
                             {.Y = 0.2, .x = 0.5, .sweep = {}, .number = 2, .omega = 10.5}}};
  CHECK(find_method("resonance_two_point")->lacks(record) == "the pairs were measured at several frequencies");
  record.pairs->pairs[1].omega = 10.0;
  CHECK(find_method("resonance_two_point")->lacks(record).empty());
}
