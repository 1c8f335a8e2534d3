#include <array>
#include <catch2/catch.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.hpp"

using dualdamp::core::joined;

TEST_CASE("words are joined, the last one by a word of its own") {
  CHECK(joined(std::vector<std::string>{}).empty());
  CHECK(joined({"a"}, " and ") == "a");
  CHECK(joined({"a", "b", "c"}) == "a, b, c");
  CHECK(joined({"a", "b", "c"}, " and ") == "a, b and c");
  CHECK(joined(std::array<std::string_view, 2>{"a", "b"}, " or ") == "a or b");
}
