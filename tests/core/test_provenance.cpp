#include "core/provenance.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace dualdamp::core;

TEST_CASE("provenance: SHA-256 of the standard's examples", "[core][provenance]") {
  // FIPS 180-2, appendix B
  CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(sha256("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST_CASE("provenance: every library has a version", "[core][provenance]") {
  REQUIRE_FALSE(libraries().empty());
  CHECK(std::ranges::is_sorted(libraries(), {}, &Library::name));
  for (const Library& library : libraries()) {
    CAPTURE(library.name);
    CHECK_FALSE(library.version.empty());
  }
}

TEST_CASE("provenance: the time is UTC in ISO 8601", "[core][provenance]") {
  const std::string now = utc_now();
  REQUIRE(now.size() == 20);
  CHECK(now[10] == 'T');
  CHECK(now.back() == 'Z');
}
