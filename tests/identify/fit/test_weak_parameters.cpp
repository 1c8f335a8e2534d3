#include <catch2/catch.hpp>
#include <string>

#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;

TEST_CASE("fit: intervals hold what a parameter without effect at the estimate makes possible far from there",
          "[identify][fit]") {
  // At this noise the exponent of the yield ends at the largest value of the search, where it has no effect. A
  // round yield of a stiffer spring fits nearly as well.
  constexpr double noise = 2.0;
  constexpr std::uint64_t seed = 16;
  const test::LawCase& law = test::law_case_of("bouc_wen");
  const identify::Record record = test::loop_of(test::rig_with(law), law.amplitude, noise, seed);
  std::string fault;
  const identify::Experiments experiments = identify::experiments_of(record, {.name = "loop", .loop = true}, fault);
  const auto fitted_with = [&](const std::vector<std::string>& sought, double stiffness, bool profile) {
    identify::Rig rig = test::loop_alone(test::rig_with(law));
    rig.laws.front().values.set("stiffness", stiffness);
    std::vector<identify::FitParameter> parameters = test::sought_in(rig, sought, 1.0);
    return identify::fit_rig(rig, std::move(parameters), experiments, {.profile = profile});
  };
  const identify::Fit whole = fitted_with(law.sought, 3000.0, true);
  REQUIRE(whole.outcome.ok());
  // Of the sum of squares with the stiffness held, in variances: the interval ends where it is that of 1.96
  // squared.
  const auto growth_at = [&](double held) {
    const identify::Fit fit = fitted_with({"limit", "exponent"}, held, false);
    const double ratio = fit.signals.front().rms / whole.signals.front().rms;
    return (ratio * ratio - 1.0) * whole.signals.front().freedom;
  };
  const identify::FittedParameter& stiffness = test::fitted(whole, "friction.stiffness");
  CAPTURE(stiffness.value, stiffness.std, stiffness.interval95[1], test::fitted(whole, "exponent").value);
  CHECK(growth_at(5600.0) < 3.5);
  CHECK(stiffness.interval95[1] > 5600.0);
  CHECK(growth_at(6300.0) > 4.2);
  CHECK(stiffness.interval95[1] < 6300.0);
}
