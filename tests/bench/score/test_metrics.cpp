#include "bench/score/metrics.hpp"

#include <catch2/catch.hpp>

using namespace dualdamp::bench;

TEST_CASE("area of risk: by hand") {
  RiskArea area;  // losses 0, 1 in this order: risks 0, 1/2
  area.add(1.0, 0.0);
  area.end_group();
  area.add(1.0, 1.0);
  area.end_group();
  CHECK(area.area() == Approx(0.25));
  RiskArea reversed;
  reversed.add(1.0, 1.0);
  reversed.end_group();
  reversed.add(1.0, 0.0);
  reversed.end_group();
  CHECK(reversed.area() == Approx(0.75));
  RiskArea tied;  // equal confidences have the mean risk
  tied.add(1.0, 0.0);
  tied.add(1.0, 1.0);
  tied.end_group();
  tied.end_group();
  CHECK(tied.area() == Approx(0.5));
  CHECK(std::isnan(RiskArea().area()));
}

TEST_CASE("metrics: a mean of what exists") {
  Mean mean;
  CHECK(std::isnan(mean.value()));
  mean.add(1.0, not_stated);
  mean.add(1.0, 2.0);
  mean.add(3.0, 6.0);
  CHECK(mean.value() == Approx(5.0));
}
