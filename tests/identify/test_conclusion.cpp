#include "identify/conclusion.hpp"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

using namespace dualdamp::identify;

TEST_CASE("A parameter whose corrected interval lies below zero is no estimate, whatever the value is") {
  const auto faults_of = [](double value, const Interval& interval) {
    Estimate estimate;
    std::vector<std::string> faults;
    judge_sign(value, 1.0, &interval, "the Coulomb friction", estimate, faults);
    return faults.size();
  };
  CHECK(faults_of(3.5, {-43.0, -38.0}) == 1);  // corrected for a bias that is larger than it
  CHECK(faults_of(-40.0, {-43.0, -38.0}) == 1);
  CHECK(faults_of(-0.1, {-0.4, 0.2}) == 0);
  CHECK(faults_of(3.5, {3.0, 4.0}) == 0);
  CHECK(faults_of(0.0, {-2e-12, -1e-12}) == 0);  // rounding
}

TEST_CASE("A parameter whose interval contains zero, its ends included, is said to be indistinguishable from it") {
  const auto warnings_of = [](double value, const Interval& interval) {
    Estimate estimate;
    std::vector<std::string> faults;
    judge_sign(value, 1.0, &interval, "the Coulomb friction", estimate, faults);
    CHECK(faults.empty());
    return estimate.warnings.size();
  };
  CHECK(warnings_of(0.1, {-0.2, 0.4}) == 1);
  CHECK(warnings_of(0.2, {0.0, 0.4}) == 1);
  CHECK(warnings_of(-0.2, {-0.4, 0.0}) == 1);
  CHECK(warnings_of(0.2, {0.1, 0.3}) == 0);
  CHECK(warnings_of(0.0, {-4e-10, 4e-10}) == 0);  // rounding
}
