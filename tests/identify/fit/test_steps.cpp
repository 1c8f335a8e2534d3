#include <Eigen/Core>
#include <catch2/catch.hpp>
#include <cmath>

#include "identify/fit/fit.hpp"
#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;

namespace {

identify::Rig with_play(double play) {
  return test::rig_with({"free_play", {{"kinetic", 3.0}, {"play", play}}, {"kinetic", "play"}});
}

/// A fit of kinetic and play, of which no value is stated, without profiles.
identify::Fit fit_to_loop(double play, const identify::Record& record) {
  std::string fault;
  const identify::Experiments experiments = identify::experiments_of(record, {.name = "loop", .loop = true}, fault);
  REQUIRE(fault.empty());
  identify::Rig rig = test::loop_alone(with_play(play));
  std::vector<identify::FitParameter> sought = test::sought_in(rig, {"kinetic", "play"}, 1.0);
  for (identify::FitParameter& parameter : sought) parameter.stated = identify::unknown;
  return identify::fit_rig(rig, sought, experiments, {.profile = false});
}

/// A part of a loop under `free_play`, from sample `begin` on.
identify::Record loop_part(double play, std::ptrdiff_t begin, std::ptrdiff_t end) {
  identify::Record record = test::loop_of(with_play(play), 0.01, 0.01, 3);
  identify::History& loop = record.histories.front();
  for (std::vector<double>* signal : {&loop.x, &loop.v, &loop.force})
    *signal = {signal->begin() + begin, signal->begin() + end};
  return record;
}

}  // namespace

TEST_CASE("steps: a play without a stated value is found in a loop, with an interval and no travel",
          "[identify][fit]") {
  constexpr double play = 4e-3;
  const identify::Fit fit = fit_to_loop(play, loop_part(play, 0, 500));
  REQUIRE(fit.outcome.ok());
  CHECK(fit.noise_units == Approx(1.0).margin(0.1));
  CHECK(fit.parameters.size() == 2);
  CHECK(fit.not_identifiable.empty());
  CHECK(test::fitted(fit, "kinetic").value == Approx(3.0).epsilon(2e-3));
  const identify::FittedParameter& found = test::fitted(fit, "play");
  CHECK(std::isnan(found.std));
  CHECK(found.interval95[0] < play);
  CHECK(found.interval95[1] > play);
  // The readings leave open no more than the way of one sample.
  CHECK(found.interval95[1] - found.interval95[0] < 0.2e-3);
  // A prediction knows the play no better than this interval: its variance had been rounding, 1e-38 m^2.
  const Eigen::Index at = fit.parameters[0].parameter.name == "play" ? 0 : 1;
  CHECK(std::sqrt(fit.covariance(at, at)) ==
        Approx((found.interval95[1] - found.interval95[0]) / 3.92).epsilon(1e-9));
  CHECK(fit.covariance(at, 1 - at) == 0.0);
  CHECK(fit.undetermined.cols() == 0);
}

TEST_CASE("steps: a loop that was cut out of a test has the same play, and a loaded contact", "[identify][fit]") {
  constexpr double play = 2e-3;
  const identify::Fit fit = fit_to_loop(play, loop_part(play, 200, 600));
  REQUIRE(fit.outcome.ok());
  CHECK(fit.noise_units == Approx(1.0).margin(0.1));
  CHECK(test::fitted(fit, "play").value == Approx(play).epsilon(0.02));
  CHECK(fit.warnings.size() == 1);
}
