#include <catch2/catch.hpp>

#include "core/diagnostics.hpp"

using dualdamp::core::joined;

TEST_CASE("words are joined, the last one by a word of its own") {
  CHECK(joined({}).empty());
  CHECK(joined({"a"}, " and ") == "a");
  CHECK(joined({"a", "b", "c"}) == "a, b, c");
  CHECK(joined({"a", "b", "c"}, " and ") == "a, b and c");
}
