// Laws compared by AICc: what their weights rest on.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "friction_models/registry.hpp"
#include "identify/fit/comparison.hpp"
#include "identify/fit/fit.hpp"
#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;

TEST_CASE("comparison: weights that rest on few degrees of freedom and no stated noise are told",
          "[identify][fit]") {
  const auto fits = [](double freedom, double chi2_per_freedom) {
    identify::Fit fit;
    fit.AICc = 1.0;
    fit.signals.resize(1);
    fit.signals[0].freedom = freedom;
    fit.signals[0].chi2_per_freedom = chi2_per_freedom;
    return std::vector<identify::Fit>{fit, fit};
  };
  CHECK_THAT(identify::warning_of_weights(fits(5.0, identify::unknown)),
             Catch::StartsWith("the weights of the laws rest on 5 degrees of freedom and on no stated noise"));
  CHECK(identify::warning_of_weights(fits(50.0, identify::unknown)).empty());
  CHECK(identify::warning_of_weights(fits(5.0, 1.0)).empty());
  CHECK(identify::warning_of_weights({fits(5.0, identify::unknown).front()}).empty());
}

TEST_CASE("comparison: only laws that may be the best have profiles, and the fit of the best is that of it alone",
          "[identify][fit]") {
  const identify::Rig truth = test::rig_with({"coulomb", {{"kinetic", 1.0}}, {}});
  std::string fault;
  const identify::Experiments data =
      identify::experiments_of(test::history_of(truth, {}, 4), {.name = "history"}, fault);
  REQUIRE(fault.empty());
  std::vector<identify::RigToFit> rigs;
  for (const char* law : {"coulomb", "asymmetric_coulomb", "gap_spring"}) {
    identify::RigToFit one{truth, {}};
    one.rig.laws = {{friction::find_law(law), {}}};
    std::vector<std::string> faults;
    one.parameters = identify::unstated_parameters(one.rig, faults);
    for (const identify::RecordParameter which : identify::sought_of_record(*data.front(), true))
      one.parameters.push_back(identify::parameter_of_record(*data.front(), 0, which, true));
    identify::arrange(one.rig, one.parameters);
    rigs.push_back(std::move(one));
  }
  const std::vector<identify::Fit> fits = identify::fit_rigs(rigs, data);
  const auto has_profile = [](const identify::Fit& fit) {
    return std::ranges::any_of(
        fit.parameters, [](const identify::FittedParameter& one) { return std::isfinite(one.profile95[0]); });
  };
  REQUIRE(fits.size() == 3);
  REQUIRE(fits[2].outcome.ok());
  CHECK(fits[0].noise_units == Approx(1.0).margin(0.1));
  CHECK(fits[1].noise_units == Approx(1.0).margin(0.1));
  CHECK(fits[2].noise_units > 3.0);
  CHECK(has_profile(fits[0]));
  CHECK(has_profile(fits[1]));
  CHECK(!has_profile(fits[2]));
  const identify::Fit alone = identify::fit_rig(rigs[0].rig, rigs[0].parameters, data);
  CHECK(test::fitted(fits[0], "kinetic").value == test::fitted(alone, "kinetic").value);
  CHECK(test::fitted(fits[0], "kinetic").profile95[0] == test::fitted(alone, "kinetic").profile95[0]);
}
