#include "core/cancellation.hpp"

#include <catch2/catch.hpp>
#include <stdexcept>

using namespace dualdamp;

TEST_CASE("A requested cancellation stops every poll until it is cleared") {
  CHECK_NOTHROW(core::stop_if_cancelled());
  core::request_cancellation();
  CHECK(core::cancellation_requested());
  CHECK_THROWS_AS(core::stop_if_cancelled(), core::Cancelled);
  core::clear_cancellation();
  CHECK_FALSE(core::cancellation_requested());
  CHECK_NOTHROW(core::stop_if_cancelled());
}

TEST_CASE("A cancellation is not taken for a failed case") {
  core::request_cancellation();
  const auto failed_case = [] {
    try {
      core::stop_if_cancelled();
    } catch (const std::exception&) {
      return;
    }
  };
  CHECK_THROWS_AS(failed_case(), core::Cancelled);
  core::clear_cancellation();
}
