// What the data of a fit leave open, in words.

#include <catch2/catch.hpp>

#include "identify/fit/trade_offs.hpp"

using namespace dualdamp;

TEST_CASE("trade-offs: what a profile ends is known to its end, whatever the deviation says near the estimate",
          "[identify][fit]") {
  // The static level of a mass that hardly sticks: at the kinetic one it has no effect, so the deviation is 17 N.
  const std::vector<identify::FitParameter> parameters = {{.name = "kinetic", .unit = "N"},
                                                          {.name = "static", .unit = "N", .above = 0}};
  identify::WeakDirection direction{.change = Eigen::Vector2d(0.0, 0.1),
                                    .share = Eigen::Vector2d(0.0, 1.0),
                                    .effect = Eigen::Vector2d(0.0, 1.0),
                                    .deviation = 170.0,
                                    .near_zero = Eigen::Vector2d(0.0, 0.1),
                                    .reach = Eigen::Vector2d(identify::unknown, identify::unknown)};
  CHECK(identify::trade_off(direction, parameters)->text ==
        "the data hardly show static - kinetic: it is known to 34 N, and is zero within that");
  direction.reach[1] = 0.0302;
  CHECK(identify::trade_off(direction, parameters)->text ==
        "the data hardly show static - kinetic: it is known to 0.03 N, and is zero within that");
}
