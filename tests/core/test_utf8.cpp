#include "core/utf8.hpp"

#include <catch2/catch.hpp>
#include <string>

using namespace dualdamp::core;

TEST_CASE("utf8: characters of one to four bytes", "[core][utf8]") {
  const std::string text = "a\u00b5\u20ac\U0001F600";
  const std::uint32_t codes[] = {'a', 0xB5, 0x20AC, 0x1F600};
  std::size_t at = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto character = decode(text, at);
    REQUIRE(character);
    CHECK(character->code == codes[i]);
    CHECK(character->length == i + 1);
    at += character->length;
  }
  CHECK(at == text.size());
  CHECK(count_characters(text) == 4);
  CHECK(decode("\xF4\x8F\xBF\xBF", 0)->code == 0x10FFFF);
}

TEST_CASE("utf8: bytes that are no character", "[core][utf8]") {
  for (const char* text : {"\x80", "\xC2", "\xC2z", "\xE2\x82", "\xFF", "\xF5\x80\x80\x80", "\xF4\x90\x80\x80"}) {
    CAPTURE(text);
    CHECK_FALSE(decode(text, 0));
  }
  for (const char* overlong : {"\xC0\xAF", "\xC1\xBF", "\xE0\x9F\xBF", "\xF0\x8F\xBF\xBF"}) {
    CAPTURE(overlong);
    CHECK_FALSE(decode(overlong, 0));
  }
  for (const char* surrogate : {"\xED\xA0\x80", "\xED\xBF\xBF"}) {
    CAPTURE(surrogate);
    CHECK_FALSE(decode(surrogate, 0));
  }
}

TEST_CASE("utf8: a text is cut between characters", "[core][utf8]") {
  const std::string text = "1\u00b5\u20ac";
  const char* const beginnings[] = {
      "", "1", "1", "1\u00b5", "1\u00b5", "1\u00b5", "1\u00b5\u20ac", "1\u00b5\u20ac"};
  for (std::size_t bytes = 0; bytes < 8; ++bytes) {
    CAPTURE(bytes);
    CHECK(beginning(text, bytes) == beginnings[bytes]);
    CHECK(shortened(text, bytes) == std::string(beginnings[bytes]) + (bytes < 6 ? "..." : ""));
  }
}
