// What the data of a fit leave open, in words.

#include <catch2/catch.hpp>

#include "core/constants.hpp"
#include "identify/fit/intervals/trade_offs.hpp"

using namespace dualdamp;

namespace {

constexpr auto displacement = core::Coordinate::displacement;
constexpr auto angle = core::Coordinate::angle;

}  // namespace

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
  CHECK(identify::trade_off(direction, parameters, displacement)->text ==
        "the data hardly show static - kinetic: it is known to 34 N, and is zero within that");
  direction.reach[1] = 0.0302;
  CHECK(identify::trade_off(direction, parameters, displacement)->text ==
        "the data hardly show static - kinetic: it is known to 0.03 N, and is zero within that");
  CHECK(identify::trade_off(direction, parameters, angle)->text ==
        "the data hardly show static - kinetic: it is known to 0.03 N.m, and is zero within that");
  // A profile without an end says more than the deviation near the estimate.
  direction.reach[1] = core::infinity;
  CHECK(identify::trade_off(direction, parameters, displacement)->text ==
        "the data hardly show static - kinetic: its profile has no end");
}

TEST_CASE("trade-offs: what a parameter without an effect near the estimate has further off", "[identify][fit]") {
  identify::FittedParameter exponent{.parameter = {.name = "exponent", .unit = "1"}, .value = 300.0};
  exponent.parameter.range = {1.0, core::infinity};
  exponent.interval95 = {1.8, core::infinity};
  const identify::TradeOff found = identify::known_further_off(exponent, displacement);
  CHECK(found.parameters == std::vector<std::string>{"exponent"});
  CHECK(found.text == "the data show of exponent only that it is above 1.8");
  exponent.interval95 = {1.8, 950.0};
  CHECK(identify::known_further_off(exponent, displacement).text ==
        "the data show of exponent only that it is above 1.8 and below 950");
  exponent.interval95[0] = 1.0;
  CHECK(identify::known_further_off(exponent, displacement).text ==
        "the data show of exponent only that it is below 950");
  exponent.parameter.unit = "N/m";
  CHECK(identify::known_further_off(exponent, angle).text ==
        "the data show of exponent only that it is below 950 N.m/rad");
}
