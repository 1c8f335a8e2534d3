#include "scenarios/schema.hpp"

#include <catch2/catch.hpp>

#include "files.hpp"

using namespace dualdamp;

TEST_CASE("schema: the committed schema is the one the program prints", "[scenarios][schema]") {
  // Refresh: dualdamp schema > scenarios/scenario.schema.json
  CHECK(testing::text_of(testing::root / "scenarios/scenario.schema.json") ==
        scenarios::json_schema(bench::analyses()));
}

TEST_CASE("schema: the committed reference page is the one the program prints", "[scenarios][schema]") {
  // Refresh: dualdamp schema --markdown > docs/scenario-reference.md
  CHECK(testing::text_of(testing::root / "docs/scenario-reference.md") ==
        scenarios::reference_page(bench::analyses()));
}
